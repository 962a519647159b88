"""What a turn is worth, as both stations must find it: the same strokes, the same function, the same numbers.

A station judges its own player and says so (`Claim`); the other judges the same strokes again. Claims agree when every
figure does, to `NEAR`: two computers may round the last place of a mean otherwise. What does not agree is shown, and
counts for nobody.
"""

from collections.abc import Sequence
from math import isclose

from station.practice.battle.judging.improvisation_marks import ImprovisationMarks
from station.practice.battle.judging.judged_improvisation import judged_improvisation
from station.practice.battle.link.link_messages import Claim, Figure
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.repeating.answer_marks import AnswerMarks, answer_marks
from station.practice.battle.turn_marks import TurnMarks
from station.scoring.matching.hit_windows import Level
from station.scoring.matching.unheard import Span

DIGITS = 6
"""Decimals of a figure that is sent (our choice: a millionth of a point)."""
NEAR = 2e-6
"""Two of them may stand on either side of a rounding (our choice)."""
_COUNTS = ("notes", "known", "right", "answered", "wrong_pieces", "extras", "mean_ms")


def judged_answer(phrase: Phrase, turn: Turn, level: Level, unheard: Sequence[Span]) -> AnswerMarks:
    """What an answer is worth."""
    return answer_marks(phrase, turn, level.windows, unheard)


def judged_trade(
    turn: Turn, unheard: Sequence[Span], before: Sequence[Turn], call: Turn | None
) -> ImprovisationMarks | None:
    """What an improvised turn is worth, which answers `call` after the same player's turns `before`.

    None where the kit was not heard for more than a beat of it, as in every battle.
    """
    beat_ns = turn.ground.tempo_map.ns_at(turn.ground.beat_ticks)
    if sum(end_ns - begin_ns for begin_ns, end_ns in unheard) > beat_ns:
        return None
    return judged_improvisation(turn, before, call)


def claim_of(marks: TurnMarks | None, target: float) -> Claim:
    """What is said of a turn that is worth `marks`; None: nobody can tell."""
    if marks is None:
        return Claim(None, None, ())
    if isinstance(marks, AnswerMarks):
        figures = tuple(Figure(name, _rounded(getattr(marks, name))) for name in _COUNTS)
        return Claim(_rounded(marks.points), marks.is_won(target), figures)
    figures = tuple(Figure(one.component.value, _rounded(one.points)) for one in marks.components)
    return Claim(_rounded(marks.points), None, figures)


def agree(one: Claim, other: Claim) -> bool:
    """Whether two claims say the same."""
    names = [figure.name for figure in one.figures] == [figure.name for figure in other.figures]
    mine, theirs = ([claim.points, *(figure.value for figure in claim.figures)] for claim in (one, other))
    return names and one.won == other.won and all(map(_is_near, mine, theirs))


def _is_near(one: float | None, other: float | None) -> bool:
    if one is None or other is None:
        return one is other
    return isclose(one, other, rel_tol=0, abs_tol=NEAR)


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(float(value), DIGITS)
