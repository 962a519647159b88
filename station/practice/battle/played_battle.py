"""What a window or a terminal plays: a battle at one station, or one end of a battle of two."""

from collections.abc import Sequence
from typing import Protocol

from station.engine.messages import Command, EngineEvent
from station.practice.battle.battle_ear import BattleEar
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.battle_view import BattleView
from station.practice.session.engine_state import EngineState


class PlayedBattle(Protocol):
    """Call `start`, then `handle` every event and `advance` the time until `over`; then `stop`.

    Every call returns the commands for the engine.
    """

    @property
    def rules(self) -> BattleRules:
        """What it is played by."""
        ...

    @property
    def ear(self) -> BattleEar:
        """What was heard."""
        ...

    @property
    def heard(self) -> EngineState:
        """What the engine has said."""
        ...

    @property
    def paused(self) -> bool:
        """Whether a pause was asked for here, and lasts until `resume`."""
        ...

    @property
    def over(self) -> bool:
        """Whether nothing more is played."""
        ...

    def start(self) -> tuple[Command, ...]:
        """Begin with the count-in."""
        ...

    def stop(self) -> tuple[Command, ...]:
        """End it, at the present that it knows."""
        ...

    def pause(self) -> tuple[Command, ...]:
        """Ask for a pause; nothing where it may not pause."""
        ...

    def resume(self) -> tuple[Command, ...]:
        """Go on after a pause."""
        ...

    def handle(self, event: EngineEvent) -> tuple[Command, ...]:
        """Take one event of the engine."""
        ...

    def advance(self, now_ns: int) -> Sequence[Command]:
        """Move on to the present."""
        ...

    def view(self) -> BattleView:
        """What a stage and a window show, as of the last event and time."""
        ...

    def result(self) -> BattleResult:
        """All that was played, judged once more."""
        ...
