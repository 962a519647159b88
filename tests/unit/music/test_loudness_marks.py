"""Loudness marks of parts, of stretches of them, and of parts one after the other: by hand."""

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.loudness_marks import LoudnessMark, joined_marks, marks_within
from station.music.score import Note, Score
from station.music.tempo import TempoMap

BAR = 4 * PPQ


def marks(*said: tuple[int, str]) -> tuple[LoudnessMark, ...]:
    return tuple(LoudnessMark(tick, sign) for tick, sign in said)


SWELL = marks((0, "p"), (100, "<"), (300, "f"))


def test_a_stretch_begins_with_what_holds_there() -> None:
    assert marks_within(SWELL, 0, 400) == SWELL
    assert marks_within(SWELL, 50, 400) == marks((0, "p"), (50, "<"), (250, "f"))
    assert marks_within(SWELL, 200, 300) == marks((0, "<"))
    assert marks_within(SWELL, 300, 400) == marks((0, "f"))
    assert marks_within((), 50, 400) == ()


def test_each_part_begins_as_loud_as_usual_and_nothing_is_said_twice() -> None:
    assert joined_marks([(0, SWELL), (400, ())]) == (*SWELL, *marks((400, "mf")))
    assert joined_marks([(0, ()), (400, SWELL)]) == marks((0, "mf"), (400, "p"), (500, "<"), (700, "f"))
    assert joined_marks([(0, marks((0, "f"))), (400, marks((0, "f")))]) == marks((0, "f"))
    assert joined_marks([(0, marks((100, "f"), (200, "mf"))), (400, ())]) == marks((0, "mf"), (100, "f"), (200, "mf"))
    assert joined_marks([(0, ()), (400, ())]) == ()


def test_a_score_s_bars_and_passes_keep_their_marks() -> None:
    notes = [Note(k * PPQ, Piece.SNARE) for k in range(8)]
    score = Score.from_array(
        Score.from_notes(notes, TempoMap()).notes,
        TempoMap(),
        loudness=marks((0, "p"), (PPQ, "<"), (BAR, "f")),
    )
    assert score.bars(1, 1).loudness == marks((0, "f"))
    assert score.at_speed(2.0).loudness == score.loudness
    twice = score.repeated(2).loudness
    assert [(mark.tick // PPQ, mark.sign) for mark in twice] == [
        (0, "p"), (1, "<"), (4, "f"), (8, "p"), (9, "<"), (12, "f")
    ]  # fmt: skip
    landing = Score.from_notes([Note(0, Piece.CRASH_1)], TempoMap()).notes
    assert score.landing_on(landing).loudness == score.loudness, "a landing has no mark of its own"


def test_a_rest_between_two_passes_is_neither_loud_nor_soft() -> None:
    note = Score.from_notes([Note(0, Piece.SNARE)], TempoMap()).notes
    loud = Score.from_array(note, TempoMap(), loudness=marks((0, "f")))
    rest = Score.from_notes([], TempoMap(), BAR)
    assert Score.joined([loud, rest, loud]).loudness == marks((0, "f"))
