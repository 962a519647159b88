"""What a turn is worth as plain JSON; numbers are rounded, no data is null."""

from station.practice.battle.judging.improvisation_marks import ImprovisationMarks
from station.practice.battle.repeating.answer_marks import AnswerMarks
from station.practice.battle.turn_marks import TurnMarks
from station.scoring.report.assessment_document import Json

_PLACES = 3


def marks_fields(marks: TurnMarks) -> dict[str, Json]:
    """An answer's counts, or an improvisation's components."""
    return _answer(marks) if isinstance(marks, AnswerMarks) else _improvisation(marks)


def _answer(marks: AnswerMarks) -> dict[str, Json]:
    return {
        "points": _rounded(marks.points),
        "accuracy": _rounded(marks.accuracy),
        "notes": marks.notes,
        "known": marks.known,
        "right": marks.right,
        "answered": marks.answered,
        "wrong_pieces": marks.wrong_pieces,
        "extras": marks.extras,
        "mean_ms": _rounded(marks.mean_ms),
    }


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, _PLACES)


def _improvisation(marks: ImprovisationMarks) -> dict[str, Json]:
    return {
        "points": _rounded(marks.points),
        "components": [
            {
                "component": str(one.component),
                "points": _rounded(one.points),
                "weight": _rounded(marks.weights[one.component]),
                "words": one.words,
                "figures": {name: _rounded(figure) for name, figure in one.figures.items()},
                "places": [
                    {"bar": place.bar + 1, "beat": None if place.beat is None else place.beat + 1, "words": place.words}
                    for place in one.places
                ],
            }
            for one in marks.components
        ],
        "bar_points": [_rounded(points) for points in marks.bar_points],
    }
