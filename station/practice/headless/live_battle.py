"""A battle in real time without a window: the engine process plays and hears, the battle moves on, a text shows it.

The capture is written by the engine as the bytes come, so that nothing that follows can lose a stroke.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from station.core.clock import Clock
from station.core.errors import DeviceError, StationError
from station.practice.battle.battle import Battle
from station.practice.battle.battle_result import BattleResult
from station.practice.headless.end_signals import EndAsked
from station.practice.headless.guarded_output import GuardedOutput
from station.practice.headless.live import POLL_S, EngineLink, begin, end


@dataclass(frozen=True, eq=False)
class LiveBattle:
    """A battle's result and, where something went wrong that the players must know, the `fault`."""

    result: BattleResult
    fault: StationError | None


@dataclass(frozen=True, slots=True)
class BattleSetup:
    """Where a battle is played: its `engine` and `clock`, who is shown what is new, who may end it.

    A `show` that fails costs no battle: `telling` remembers it.
    """

    engine: EngineLink
    clock: Clock
    show: Callable[[Battle], None]
    telling: GuardedOutput = field(default_factory=GuardedOutput)
    asked: EndAsked = field(default_factory=EndAsked)

    def step(self, battle: Battle) -> None:
        """Take in what the engine has heard, move on to the present, do what that asks for and show it."""
        events = self.engine.events(POLL_S)
        for command in battle.update(self.clock.now_ns(), events):
            self.engine.send(command)
        self.telling.attempt(self.show, battle)

    def fault(self, battle: Battle) -> StationError | None:
        """What the players must know at the end that nobody has raised."""
        if not battle.heard.devices:
            return DeviceError("the kit was unplugged and did not come back; what was played until then is kept")
        return self.telling.fault("not all could be shown while you played, the battle is kept")


def battle_live(setup: BattleSetup, battle: Battle, capture: Path) -> LiveBattle:
    """Play `battle` until it is over, the end is asked for, or the engine dies.

    Raises `DeviceError` if the engine dies before the transport runs: then there is nothing to report.
    """
    try:
        begin(setup.engine, battle, capture)
        while not battle.over and not setup.asked:
            setup.step(battle)
    except DeviceError as error:
        if not battle.started:
            raise
        fault: StationError | None = error
    else:
        fault = end(setup.engine, battle)
    return LiveBattle(battle.result(), fault or setup.fault(battle))
