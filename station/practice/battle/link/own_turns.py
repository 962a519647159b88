"""The turns of the player at this station: sent bar by bar while they are played, and whole once they are over."""

from collections.abc import Sequence

from station.core.events import Hit
from station.practice.battle.battle_ear import BattleEar
from station.practice.battle.link.linked_rounds import LinkedRounds
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.repeating.live_answer import LiveAnswer
from station.practice.battle.turn_judging import ARRIVES_NS, judged_at_ns
from station.practice.battle.turn_plan import PlannedTurn, TurnKind


class OwnTurns:
    """Hands `rounds` what the `ear` has heard of each turn of ours, as soon as it is whole.

    `live` are our answers by the indices of their turns, as they are shown while they are played.
    """

    def __init__(self, agreed: Agreed, ear: BattleEar, rounds: LinkedRounds) -> None:
        self.live: dict[int, LiveAnswer] = {}
        self._agreed, self._ear, self._rounds = agreed, ear, rounds
        self._first = 0  # the first of the plan that may be a turn of ours that is not over
        self._bars = 0  # its bars that were sent

    def show(self, stroke: Hit, plan: Sequence[PlannedTurn]) -> None:
        """Judge a stroke, in battle time, for the view: as soon as it comes."""
        for turn in plan[self._first :]:
            if turn.phrase is not None and self._ear.strokes.is_of(turn, stroke):
                live = self.live.setdefault(turn.index, LiveAnswer(turn.phrase, self._ns(turn.first_bar)))
                live.hit(stroke)

    def send(self, plan: Sequence[PlannedTurn], at_ns: int) -> bool:
        """Send what of a turn of ours is whole; whether there was something."""
        turn = next((one for one in plan[self._first :] if self._is_ours(one)), None)
        if turn is None:
            return False
        whole_ns = self._bar_whole_ns(turn)
        if whole_ns is not None and at_ns >= whole_ns:
            self._rounds.bar_played(turn.round, self._bars, self._ear.turn(turn))
            self._bars += 1
            return True
        if at_ns < judged_at_ns(self._agreed.rules, turn):
            return False
        self._rounds.turn_played(turn.round, self._ear.turn(turn), self._ear.unheard(turn))
        self._first, self._bars = turn.index + 1, 0
        return True

    def _bar_whole_ns(self, turn: PlannedTurn) -> int | None:
        """When the next bar of the turn has come whole; None where all were sent."""
        if self._bars == turn.bars:
            return None
        return self._ns(turn.first_bar + self._bars + 1) - self._agreed.rules.early_ns + ARRIVES_NS

    def _is_ours(self, turn: PlannedTurn) -> bool:
        return turn.kind is TurnKind.ANSWER and turn.side == self._agreed.our_side

    def _ns(self, bar: int) -> int:
        return self._agreed.rules.ground.ns_of_bars(bar)
