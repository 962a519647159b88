"""What each turn of a battle is worth: an answer by the phrase it repeats, an improvisation by its marks.

It is the one answer, live at the end of each turn, at the end of the battle and from a capture.
"""

from collections.abc import Sequence

from station.practice.battle.battle_ear import BattleEar
from station.practice.battle.battle_result import JudgedTurn
from station.practice.battle.phrase import Turn
from station.practice.battle.phrase_as_turn import phrase_as_turn
from station.practice.battle.repeating.answer_marks import answer_marks
from station.practice.battle.rules import BattleMode, BattleRules
from station.practice.battle.turn_marks import TurnMarks
from station.practice.battle.turn_plan import PlannedTurn, TurnKind


def judged_turn(rules: BattleRules, planned: PlannedTurn, ear: BattleEar, before: Sequence[JudgedTurn]) -> JudgedTurn:
    """A turn with what it is worth; `before` are all turns before it, judged."""
    played = played_in(rules, planned, ear)
    if played is None:
        return JudgedTurn(planned, None, None)
    return JudgedTurn(planned, played, _marks(rules, planned, ear, played))


def judged_turns(rules: BattleRules, plan: Sequence[PlannedTurn], ear: BattleEar) -> tuple[JudgedTurn, ...]:
    """All turns of `plan`, judged one after the other."""
    judged: list[JudgedTurn] = []
    for planned in plan:
        judged.append(judged_turn(rules, planned, ear, judged))
    return tuple(judged)


def played_in(rules: BattleRules, planned: PlannedTurn, ear: BattleEar) -> Turn | None:
    """What was played in a turn, by the drummer or a player; None where nobody plays."""
    if planned.kind is TurnKind.ANSWER:
        return ear.turn(planned)
    if planned.kind is TurnKind.CALL and planned.phrase is not None:
        return phrase_as_turn(planned.phrase, rules.ground)
    return None


def _marks(rules: BattleRules, planned: PlannedTurn, ear: BattleEar, played: Turn) -> TurnMarks | None:
    if rules.mode is BattleMode.REPEAT:
        if planned.kind is not TurnKind.ANSWER or planned.phrase is None:
            return None
        return answer_marks(planned.phrase, played, rules.level.windows, ear.unheard(planned))
    return None
