"""What an answer is worth, by hand: notes right of those asked and those too many, at 100 beats a minute in 4/4."""

from collections.abc import Iterable

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.music.performance import Performance
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.repeating.answer_marks import AnswerMarks, answer_marks, percent_of
from station.scoring.matching.hit_windows import Level
from tests.fakes.played_battle import Stroke, hit, phrase

GROUND = Ground(100.0)
BEAT_MS = 600.0
PADS = (
    Piece.KICK, Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.TOM_3, Piece.HIHAT, Piece.RIDE, Piece.CRASH_1,
)  # fmt: skip
FOUR = phrase(GROUND, *((beat, Piece.SNARE) for beat in range(4)))
THIRTEEN = phrase(
    GROUND, *((beat / 2, Piece.HIHAT) for beat in range(8)), (0, Piece.KICK), (2, Piece.KICK), (2.5, Piece.KICK),
    (1, Piece.SNARE), (3, Piece.SNARE),
)  # fmt: skip


def marks(of: Phrase, strokes: Iterable[Stroke]) -> AnswerMarks:
    hits = [hit(round(ms * NS_PER_MS), piece) for ms, piece in sorted(strokes)]
    return answer_marks(of, Turn(GROUND, 1, Performance.from_hits(hits)), Level.INTERMEDIATE.windows)


def quarters(*pieces: Piece) -> list[Stroke]:
    return [(BEAT_MS * beat, piece) for beat, piece in enumerate(pieces)]


ALL_RIGHT = quarters(*[Piece.SNARE] * 4)


@pytest.mark.parametrize(
    ("strokes", "accuracy"),
    [
        (ALL_RIGHT, 1.0),
        ([*ALL_RIGHT, (950.0, Piece.RIDE)], 4 / 5),
        (ALL_RIGHT[:3], 3 / 4),
        ([*ALL_RIGHT[:3], (1880.0, Piece.SNARE)], 3 / 5),
        (quarters(Piece.SNARE, Piece.SNARE, Piece.TOM_1, Piece.SNARE), 3 / 4),
        ([], 0.0),
    ],
    ids=[
        "as written",
        "a stray stroke",
        "one missed",
        "one 80 ms late is missed, and one too many",
        "one on another pad",
        "nothing",
    ],
)
def test_a_fault_in_a_phrase_of_four_costs_a_fifth_or_a_quarter_and_one_that_is_two_both(
    strokes: list[Stroke], accuracy: float
) -> None:
    assert marks(FOUR, strokes).accuracy == pytest.approx(accuracy)


def test_who_hammers_every_pad_on_every_sixteenth_has_a_tenth() -> None:
    """128 strokes on 13 notes."""
    hammered = [(BEAT_MS * sixteenth / 4, piece) for sixteenth in range(16) for piece in PADS]
    assert marks(THIRTEEN, hammered).accuracy == pytest.approx(13 / 128)


def test_who_hammers_the_pad_that_is_asked_loses() -> None:
    hammered = [(BEAT_MS * sixteenth / 4, Piece.SNARE) for sixteenth in range(16)]
    assert marks(FOUR, hammered).accuracy == pytest.approx(4 / 16)


def test_a_percentage_never_reads_as_the_target_that_was_missed() -> None:
    assert [percent_of(share) for share in (0.0, 0.009, 0.29, 0.8999, 0.9, 1.0)] == [0, 0, 29, 89, 90, 100]
    assert np.isclose(marks(FOUR, ALL_RIGHT).percent or 0, 100)
