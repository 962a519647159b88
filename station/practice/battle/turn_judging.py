"""What each turn of a battle is worth: an answer by the phrase it repeats, an improvisation by its marks.

It is the one answer, live at the end of each turn, at the end of the battle and from a capture.
"""

from collections.abc import Sequence

from station.core.units import NS_PER_MS
from station.practice.battle.battle_ear import BattleEar
from station.practice.battle.battle_result import BattleResult, JudgedTurn
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.judging.judged_improvisation import judged_improvisation
from station.practice.battle.phrase import Turn
from station.practice.battle.phrase_as_turn import phrase_as_turn
from station.practice.battle.repeating.answer_marks import answer_marks
from station.practice.battle.turn_marks import TurnMarks
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.scoring.matching.unheard import Span

ARRIVES_NS = 150 * NS_PER_MS
"""A stroke has arrived so long after it was played (as in `session.loop_recording`)."""


def judged_turn(rules: BattleRules, planned: PlannedTurn, ear: BattleEar, before: Sequence[JudgedTurn]) -> JudgedTurn:
    """A turn with what it is worth; `before` are all turns before it, judged."""
    played = played_in(rules, planned, ear)
    if played is None:
        return JudgedTurn(planned, None, None)
    if rules.mode is BattleMode.IMPROVISE:
        return JudgedTurn(planned, played, _improvised(rules, JudgedTurn(planned, played, None), ear, before))
    return JudgedTurn(planned, played, _repeated(rules, planned, ear, played))


def judged_at_ns(rules: BattleRules, planned: PlannedTurn) -> int:
    """When in the battle a turn can be judged: the last stroke that may belong to it has come by then."""
    late_ns = rules.late_ns + ARRIVES_NS if planned.kind is TurnKind.ANSWER else 0
    return rules.ground.ns_of_bars(planned.end_bar) + late_ns


def turns_over(rules: BattleRules, plan: Sequence[PlannedTurn], ear: BattleEar) -> Sequence[PlannedTurn]:
    """The turns of `plan` that are over; where the transport stands those before the part that is to come again."""
    if ear.at_ns is None:
        return [turn for turn in plan if rules.ground.ns_of_bars(turn.end_bar) <= ear.from_ns]
    return [turn for turn in plan if judged_at_ns(rules, turn) <= ear.at_ns]


def judged_turns(rules: BattleRules, plan: Sequence[PlannedTurn], ear: BattleEar) -> tuple[JudgedTurn, ...]:
    """All turns of `plan`, judged one after the other."""
    judged: list[JudgedTurn] = []
    for planned in plan:
        judged.append(judged_turn(rules, planned, ear, judged))
    return tuple(judged)


def result_of(rules: BattleRules, plan: Sequence[PlannedTurn], ear: BattleEar, is_complete: bool) -> BattleResult:
    """The battle of the turns of `plan` that are over."""
    turns = judged_turns(rules, turns_over(rules, plan, ear), ear)
    devices = (None, *(ear.strokes.device_of(player) for player in rules.players))
    return BattleResult(rules, turns, is_complete, ear.heard.latency, ear.heard.output, devices)


def played_in(rules: BattleRules, planned: PlannedTurn, ear: BattleEar) -> Turn | None:
    """What was played in a turn, by the drummer or a player; None where nobody plays."""
    if planned.kind is TurnKind.ANSWER:
        return ear.turn(planned)
    if planned.kind is TurnKind.CALL and planned.phrase is not None:
        return phrase_as_turn(planned.phrase, rules.ground)
    return None


def _repeated(rules: BattleRules, planned: PlannedTurn, ear: BattleEar, played: Turn) -> TurnMarks | None:
    if planned.kind is not TurnKind.ANSWER or planned.phrase is None:
        return None
    return answer_marks(planned.phrase, played, rules.level.windows, ear.unheard(planned))


def _improvised(rules: BattleRules, turn: JudgedTurn, ear: BattleEar, before: Sequence[JudgedTurn]) -> TurnMarks | None:
    """The marks of an improvised turn, the drummer's as anybody's; None where too little of it could be heard.

    It answers the last turn of somebody else.
    """
    planned = turn.planned
    if planned.kind is TurnKind.ANSWER and _unheard_ns(ear.unheard(planned)) > rules.beat_ns:
        return None
    own = [one.played for one in before if one.planned.side == planned.side and one.played is not None]
    others = [one.played for one in before if one.planned.side != planned.side and one.played is not None]
    assert turn.played is not None, "whoever plays a turn has played something, if only nothing"
    return judged_improvisation(turn.played, own, others[-1] if others else None)


def _unheard_ns(spans: Sequence[Span]) -> int:
    return sum(end_ns - begin_ns for begin_ns, end_ns in spans)
