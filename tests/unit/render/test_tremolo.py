"""Diddles and open rolls: which become one note with a slash, by the letters that write them in lessons."""

import numpy as np
import pytest

from station.core.pieces import Articulation, Ornament, Piece
from station.core.units import PPQ
from station.drills.reading.lesson_file import parse_lesson
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.notation.engraving import Engraver
from station.render.notation.voice.written_strokes import feet_of, written_strokes
from station.render.text.atlas import Atlas
from station.render.text.fonts import Face
from tests.unit.render.scores import score_of

ATLAS = Atlas()


def cells(score: Score) -> list[tuple[float, float]]:
    """Where each cell that one note writes begins and ends, in quarters."""
    strokes = written_strokes(score, feet_of(score))
    rows = np.flatnonzero(strokes.is_measured)
    assert strokes.is_hidden.sum() == len(rows), "each has its second stroke"
    return [(strokes.tick[i] / PPQ, strokes.until[i] / PPQ) for i in rows]


def lesson(grid: str, more: str = "") -> Score:
    found = parse_lesson(f'title = "T"\n{more}\n[grid]\n{grid}', "t", "t").lesson
    assert found
    return found.played_once


def slashes(score: Score) -> int:
    shapes = Engraver(score, ATLAS).bar(0)
    uv = np.array(ATLAS.sign("tremolo_1").uv, np.float32)
    return int((np.sort(shapes["uv"], axis=1) == np.sort(uv)).all(axis=1).sum())


def test_a_diddle_is_one_note_of_its_cell() -> None:
    score = lesson('snare = "ot-- t--- oooo --tt"')
    assert cells(score) == [(0.25, 0.5), (1, 1.25), (3.5, 3.75), (3.75, 4)]
    assert slashes(score) == 4


def test_the_hand_of_a_diddle_is_written_twice() -> None:
    shapes = Engraver(lesson('snare = "t- o- t- o-"\nsticking = "R- L- L- R-"'), ATLAS).bar(0)
    found = [int((shapes["uv"] == np.array(ATLAS.letter(c, Face.BOLD).uv, np.float32)).all(axis=1).sum()) for c in "RL"]
    assert found == [3, 3], "RR L LL R"


def test_the_feet_beneath_a_roll_do_not_break_it() -> None:
    assert cells(lesson('snare = "tt tt -- --"\nkick = "oooo oooo ---- ----"')) == [
        (0, 0.5),
        (0.5, 1),
        (1, 1.5),
        (1.5, 2),
    ]


def test_a_hand_that_strikes_something_else_has_both_strokes_written_out() -> None:
    """On the ride it strikes once: a slash on the stem that they share would say twice."""
    score = lesson('snare = "t- -- -- --"\nride = "x- -- -- --"')
    assert cells(score) == []
    assert slashes(score) == 0


def test_two_hands_that_roll_together_share_the_slash() -> None:
    assert cells(lesson('snare = "t- -- -- --"\nfloor_tom = "t- -- -- --"')) == [(0, 0.5), (0, 0.5)]


def test_a_cell_of_more_than_a_beat_is_written_out() -> None:
    assert cells(lesson('snare = "t t"')) == [], "four quarters"
    assert cells(lesson('snare = "t - t -"')) == [(0, 1), (2, 3)], "quarters that are two eighths each"


def test_a_swung_diddle_is_written_straight() -> None:
    assert cells(lesson('snare = "ot -- -- --"', "swing_ratio = 2")) == [(0.5, 1)]


def test_a_buzz_is_no_diddle() -> None:
    buzz = Note(0, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=PPQ)
    assert cells(score_of(buzz)) == []


@pytest.mark.parametrize("count", [1, 3])
def test_a_stroke_without_its_second_one_is_a_stroke(count: int) -> None:
    notes = [Note(k * PPQ // 8, Piece.SNARE, ornament=Ornament.DIDDLE) for k in range(count)]
    assert len(cells(Score.from_notes(notes, TempoMap.constant(120)))) == count // 2
