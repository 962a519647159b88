"""A battle that is over as it looked while it was played: its view at any of its times, in their order."""

from collections.abc import Sequence
from dataclasses import replace

from station.core.events import Hit
from station.practice.battle.battle_result import BattleResult, JudgedTurn
from station.practice.battle.battle_view import BattleView, TurnView
from station.practice.battle.repeating.live_answer import LiveAnswer
from station.practice.battle.turn_judging import judged_at_ns
from station.practice.battle.turn_plan import TurnKind
from station.practice.battle.view_building import Moment, view_of


class KeptViews:
    """The views of `result`; all its turns are known from the beginning, their strokes as they fall."""

    def __init__(self, result: BattleResult) -> None:
        self._result, self._rules = result, result.rules
        self._planned = [turn.planned for turn in result.turns]
        self._live: dict[int, LiveAnswer] = {}
        self._told: dict[int, int] = {}
        self.hits = self._all_hits()
        """Every stroke of every player, in battle time and its order."""

    @property
    def end_ns(self) -> int:
        """When the last turn's bars end."""
        last = self._planned[-1].end_bar if self._planned else 0
        return self._rules.ground.ns_of_bars(last)

    def at(self, at_ns: int) -> BattleView:
        """The view at a battle time, not before that of the last call."""
        judged = [turn for turn in self._result.turns if judged_at_ns(self._rules, turn.planned) <= at_ns]
        is_over = at_ns >= self.end_ns and len(judged) == len(self._planned)
        moment = Moment(self._rules, at_ns, self._planned, judged, result=self._result if is_over else None)
        return view_of(moment, tuple(self._turn(turn, at_ns) for turn in self._result.turns))

    def whole_turns(self) -> tuple[TurnView, ...]:
        """All turns with all their strokes, as they are after the end."""
        return tuple(self._view(turn, _hits(turn)) for turn in self._result.turns)

    def _turn(self, turn: JudgedTurn, at_ns: int) -> TurnView:
        begin_ns, planned = self._rules.ground.ns_of_bars(turn.planned.first_bar), turn.planned
        heard = [hit for hit in _hits(turn) if hit.at_ns + begin_ns <= at_ns]
        shown = self._view(turn, heard)
        if planned.phrase is None or planned.kind is not TurnKind.ANSWER:
            return shown
        live = self._live.setdefault(planned.index, LiveAnswer(planned.phrase, begin_ns))
        for hit in heard[self._told.get(planned.index, 0) :]:
            live.hit(replace(hit, at_ns=hit.at_ns + begin_ns))
        self._told[planned.index] = len(heard)
        live.advance(at_ns)
        return replace(shown, played=live.played, judged=live.judged)

    def _view(self, turn: JudgedTurn, played: Sequence[Hit]) -> TurnView:
        planned = turn.planned
        return TurnView(
            planned.index,
            planned.round,
            planned.side,
            planned.kind,
            self._rules.ground.ns_of_bars(planned.first_bar),
            planned.bars,
            planned.phrase,
            planned.keeping,
            planned.step,
            played,
            marks=turn.marks,
        )

    def _all_hits(self) -> list[Hit]:
        hits = [
            replace(hit, at_ns=hit.at_ns + self._rules.ground.ns_of_bars(turn.planned.first_bar))
            for turn in self._result.turns
            for hit in _hits(turn)
        ]
        return sorted(hits, key=lambda hit: hit.at_ns)


def _hits(turn: JudgedTurn) -> list[Hit]:
    """What a player played in an answer; nothing of a call, which the drummer plays."""
    return [] if turn.planned.kind is not TurnKind.ANSWER or turn.played is None else list(turn.played.played)
