"""A battle with virtual players: the same engine, decoder and battle, on a clock that is moved by hand."""

import heapq
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from station.core.errors import DeviceError, StationError
from station.practice.battle.battle import Battle
from station.practice.battle.people.player import virtual_device
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.headless.engine_here import EngineHere
from station.practice.headless.live import begin, end
from station.practice.session.plan import TAIL_NS
from station.simulation.student_midi import TimedBytes

Performer = Callable[[PlannedTurn, Battle], Sequence[TimedBytes]]
"""A virtual player: what they play in an answer, as bytes with their times from its downbeat in ns, in order."""
_Coming = tuple[int, int, str, bytes]
"""A session time, a count that keeps the order, the device, its bytes."""


def battle_virtually(
    battle: Battle, performers: Mapping[int, Performer], capture: Path | None = None
) -> StationError | None:
    """Play `battle` until it is over; `performers` by their sides. Returns why the capture lacks some, if it does.

    On one kit all play the first one's. Raises `DeviceError` where the capture cannot be begun.
    """
    return _Stage(battle, performers).play(capture)


class _Stage:
    """A battle, those who play it, and what they are about to play."""

    def __init__(self, battle: Battle, performers: Mapping[int, Performer]) -> None:
        self._battle, self._performers = battle, performers
        self._devices = {side: virtual_device(1 if battle.rules.is_hot_seat else side) for side in performers}
        self._engine = EngineHere(sorted(set(self._devices.values())))
        self._coming: list[_Coming] = []
        self._performed = self._count = 0

    def play(self, capture: Path | None) -> StationError | None:
        battle, engine = self._battle, self._engine
        begin(engine, battle, capture)
        self._step(engine.now_ns)
        if battle.heard.capture_fault is not None:
            raise DeviceError(battle.heard.capture_fault)
        while not battle.over:
            self._perform()
            due_ns = [at_ns for at_ns in (battle.next_ns, self._coming[0][0] if self._coming else None) if at_ns]
            self._step(min(due_ns) if due_ns else engine.now_ns + TAIL_NS)
        return end(engine, battle)

    def _perform(self) -> None:
        """Have every answer played that has been planned since."""
        began_ns = self._battle.began_ns
        for turn in self._battle.plan[self._performed :] if began_ns is not None else ():
            self._performed += 1
            if turn.kind is not TurnKind.ANSWER or began_ns is None:
                continue
            start_ns = began_ns + self._battle.rules.ground.ns_of_bars(turn.first_bar)
            for at_ns, data in self._performers[turn.side](turn, self._battle):
                self._count += 1
                heapq.heappush(self._coming, (start_ns + at_ns, self._count, self._devices[turn.side], data))

    def _step(self, now_ns: int) -> None:
        """Let come what comes until then."""
        self._engine.advance_to(now_ns)
        while self._coming and self._coming[0][0] <= now_ns:
            at_ns, _, device, data = heapq.heappop(self._coming)
            self._engine.feed(device, data, at_ns)
        for command in self._battle.update(self._engine.now_ns, self._engine.events()):
            self._engine.send(command)
