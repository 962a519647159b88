"""The strokes of a battle in battle time, and which turn each of them belongs to.

A stroke belongs to the answer of whoever plays on its device: from a little before the turn's downbeat, for nobody
hits it to the millisecond, until half a beat after its last bar, where what was meant for it may still come.
"""

from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from operator import attrgetter

from station.core.events import Hit
from station.music.performance import Performance
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.people.player import Player
from station.practice.battle.phrase import Turn
from station.practice.battle.turn_plan import PlannedTurn, TurnKind

_time_of = attrgetter("at_ns")


class TurnStrokes:
    """Every stroke that was heard while the transport ran."""

    def __init__(self, rules: BattleRules) -> None:
        self._rules = rules
        self._hits: list[Hit] = []

    def __len__(self) -> int:
        return len(self._hits)

    def add(self, hit: Hit) -> None:
        """Take a stroke, in battle time."""
        insort(self._hits, hit, key=_time_of)

    def forget_from(self, from_ns: int) -> None:
        """Forget what was played from then on."""
        del self._hits[bisect_left(self._hits, from_ns, key=_time_of) :]

    def of(self, turn: PlannedTurn, until_ns: int | None = None) -> tuple[Hit, ...]:
        """The strokes of an answer in turn time, those before `until_ns` of the battle alone; empty of other turns."""
        if turn.kind is not TurnKind.ANSWER:
            return ()
        start_ns = self._rules.ground.ns_of_bars(turn.first_bar)
        return tuple(replace(hit, at_ns=hit.at_ns - start_ns) for hit in self._between(turn, until_ns))

    def device_of(self, player: Player) -> str | None:
        """What most of a player's strokes came from; None where there were none."""
        devices = Counter(hit.device for hit in self._hits if player.plays_on(hit.device))
        return devices.most_common(1)[0][0] if devices else None

    def turn(self, turn: PlannedTurn, until_ns: int | None = None) -> Turn:
        """The same as what somebody has played."""
        return Turn(self._rules.ground, turn.bars, Performance.from_hits(self.of(turn, until_ns)))

    def is_of(self, turn: PlannedTurn, hit: Hit) -> bool:
        """Whether `hit`, in battle time, belongs to `turn`."""
        if turn.kind is not TurnKind.ANSWER or not self._rules.player_of(turn.side).plays_on(hit.device):
            return False
        begin_ns, end_ns = self._span(turn)
        return begin_ns <= hit.at_ns < end_ns

    def _between(self, turn: PlannedTurn, until_ns: int | None) -> Iterator[Hit]:
        begin_ns, end_ns = self._span(turn)
        if until_ns is not None:
            end_ns = min(until_ns, end_ns)
        first, last = (bisect_left(self._hits, at_ns, key=_time_of) for at_ns in (begin_ns, max(begin_ns, end_ns)))
        player = self._rules.player_of(turn.side)
        return (hit for hit in self._hits[first:last] if player.plays_on(hit.device))

    def _span(self, turn: PlannedTurn) -> tuple[int, int]:
        rules, ground = self._rules, self._rules.ground
        return ground.ns_of_bars(turn.first_bar) - rules.early_ns, ground.ns_of_bars(turn.end_bar) + rules.late_ns
