"""Editing keeps each stroke's timing with its stroke, and playing in gives the text that a mouse gives."""

from itertools import cycle
from random import Random

import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.editing.edit_lesson import edited
from station.drills.editing.lesson_edits import (
    REST,
    AddBars,
    AddGrid,
    CopyBars,
    CutBeat,
    LessonEdit,
    LineAt,
    PlayedStroke,
    PlayIn,
    Quantise,
    RemoveBars,
    RemoveGrid,
    RemoveLine,
    SetStroke,
)
from station.drills.reading.lesson_file import parse_lesson

SNARE, HATS, KICK = (LineAt(0, piece) for piece in (Piece.SNARE, Piece.HIHAT, Piece.KICK))
SIXTEENTH = PPQ // 4
PLAYED = """title = "T"
tempo_bpm = 120

[grid]
snare = "| o - o - | o o - - |"
kick  = "| o - - - | %       |"
[grid.timing]
snare = [1, 2, 3, 4] # as played
kick = [5, 6]
"""


def _late(text: str, piece: Piece = Piece.SNARE) -> list[float]:
    """What the reader makes of a text: the timing of the strokes of a piece in the order in which they are played."""
    found = parse_lesson(text, "t.toml", "t")
    assert found.lesson is not None, [str(fault) for fault in found.faults]
    return [note.late_ms for note in found.lesson.score if note.piece is piece]


@pytest.mark.parametrize(
    ("edit", "snare", "kick"),
    [
        (SetStroke(SNARE, 0, PPQ, "o"), [1, 0, 2, 3, 4], [5, 6]),
        (SetStroke(SNARE, 0, SIXTEENTH, "o"), [1, 0, 2, 3, 4], [5, 6]),
        (SetStroke(SNARE, 0, 0, "O"), [1, 2, 3, 4], [5, 6]),
        (SetStroke(SNARE, 0, 0, REST), [2, 3, 4], [5, 6]),
        (SetStroke(KICK, 0, PPQ, "o"), [1, 2, 3, 4], [5, 0, 6, 0]),  # the second bar repeats the first
        (SetStroke(HATS, 0, 0, "x"), [1, 2, 3, 4], [5, 6]),
        (CutBeat(0, 0, 0, 3), [1, 2, 3, 4], [5, 6]),
        (AddBars(0, 1), [1, 2, 3, 4], [5, 6]),
        (AddBars(0, 0, 2), [1, 2, 3, 4], [5, 6]),
        (RemoveBars(0, 0, 0), [3, 4], [6]),
        (CopyBars(0, 0, 0, 0, 2), [1, 2, 3, 4, 1, 2], [5, 6, 5]),
        (CopyBars(0, 0, 0, 0, 0), [1, 2, 1, 2, 3, 4], [5, 5, 6]),
        (CopyBars(0, 0, 0, 0, 1, over=True), [1, 2, 1, 2], [5, 5]),
        (CopyBars(0, 1, 1, 0, 0, over=True, text=PLAYED), [3, 4, 3, 4], [6, 6]),
        (RemoveLine(KICK, 0), [1, 2, 3, 4], []),
        (AddGrid("B", 0), [1, 2, 3, 4], [5, 6]),
        (AddGrid("B", 0, like=0), [1, 2, 3, 4] * 2, [5, 6] * 2),
    ],
)
def test_every_edit_leaves_the_numbers_with_their_strokes(
    edit: LessonEdit, snare: list[float], kick: list[float]
) -> None:
    text = edited(PLAYED, edit)
    assert _late(text) == snare
    assert _late(text, Piece.KICK) == kick
    if _late(text) == [1, 2, 3, 4]:
        assert "snare = [1, 2, 3, 4] # as played" in text  # what did not change is not written anew


def test_a_list_whose_strokes_are_all_gone_goes_too() -> None:
    text = edited(edited(PLAYED, SetStroke(KICK, 1, 0, REST)), SetStroke(KICK, 0, 0, REST))
    assert "kick = [" not in text
    assert _late(text) == [1, 2, 3, 4]


VARIED = """title = "T"
[[grid]]
name = "A"
snare = "o-o-"
timing.snare = [1, 2]
[[grid]]
name = "B"
like = "A"
"""


def test_a_variation_keeps_what_it_had_when_its_line_becomes_its_own() -> None:
    assert _late(edited(VARIED, SetStroke(LineAt(1, Piece.SNARE), 0, PPQ, "o"))) == [1, 2, 1, 0, 2]
    assert _late(edited(VARIED, SetStroke(SNARE, 0, PPQ, "o"))) == [1, 0, 2] * 2
    assert _late(edited(VARIED, RemoveGrid(0))) == [1, 2]


def test_a_timing_that_does_not_fit_is_left_for_the_teacher_to_mend() -> None:
    wrong = PLAYED.replace("[1, 2, 3, 4]", "[1, 2]")
    assert "snare = [1, 2] # as played" in edited(wrong, SetStroke(KICK, 0, 2 * PPQ, "o"))


# --- playing in -------------------------------------------------------------------------------------------------------

EMPTY = 'title = "T"\ntempo_bpm = 120\n\n[grid]\nhihat = "| -------- | -------- |"\nsnare = "| - | - |"\n'


def _take(*strokes: tuple[LineAt, float, str]) -> tuple[PlayedStroke, ...]:
    return tuple(PlayedStroke(line, beats * PPQ, letter, 80) for line, beats, letter in strokes)


GROOVE = [
    *((HATS, beat / 2, "x") for beat in range(16)),
    *((SNARE, beat, "O") for beat in (1, 3, 5, 7)),
    *((KICK, beat, "o") for beat in (0, 2, 2.5, 4, 6.75)),
]


def test_a_groove_that_is_played_in_reads_as_one_that_is_clicked() -> None:
    clicked = EMPTY
    for line, beat, letter in sorted(GROOVE, key=lambda stroke: (stroke[1], stroke[0].piece)):
        bar, tick = divmod(round(beat * PPQ), 4 * PPQ)
        clicked = edited(clicked, SetStroke(line, bar, tick, letter))
    off = cycle([0.03, -0.04])
    sloppy = _take(*((line, beat + next(off), letter) for line, beat, letter in GROOVE))
    assert edited(EMPTY, PlayIn(0, 0, 1, sloppy)) == clicked
    assert edited(EMPTY, PlayIn(0, 0, 1, sloppy, over=True)) == clicked


def test_triplets_stand_in_their_beat() -> None:
    text = edited(EMPTY, PlayIn(0, 0, 0, _take((SNARE, 0, "o"), (SNARE, 1.34, "o"), (SNARE, 1.66, "o")), Quantise(3)))
    assert "(-oo)" in text.replace(" ", "")
    assert _late(text) == [0, 0, 0]


def test_playing_over_bars_that_repeat_changes_those_alone() -> None:
    text = EMPTY.replace('"| - | - |"', '"| o--- | %2 |"').replace("-------- | --------", "- | - | -")
    got = edited(text, PlayIn(0, 1, 1, _take((SNARE, 3, "o"))))
    assert 'snare = "| o - - - | - - - o | o - - - |"' in got
    got = edited(text, PlayIn(0, 0, 0, _take((SNARE, 3, "o"))))
    assert 'snare = "| - - - o | o - - - | % |"' in got


def test_what_is_left_of_the_way_is_kept_in_milliseconds() -> None:
    """A tenth of a beat at 120 is 50 ms; half of the way is gone."""
    strokes = _take((SNARE, 1.1, "o"), (SNARE, 2.9, "o"), (KICK, 4, "o"))
    text = edited(EMPTY, PlayIn(0, 0, 1, strokes, Quantise(4, 0.5, keeps_timing=True)))
    assert _late(text) == [25, -25]
    assert "kick = [" not in text  # which is on its cell
    again = edited(text, PlayIn(0, 1, 1, _take((SNARE, 1.02, "o")), Quantise(4, 0.0, keeps_timing=True), over=True))
    assert _late(again) == [25, -25, 10]
    assert _late(edited(again, PlayIn(0, 0, 0, _take((SNARE, 1.05, "o"), (SNARE, 3, "o"))))) == [0, 0, 10]


def test_a_stroke_without_a_cell_of_its_own_goes_to_the_nearest() -> None:
    """Beside a diddle in thirds of a beat no fourth can begin: it would move the diddle's second stroke."""
    text = EMPTY.replace('"| - | - |"', '"| (ttt) - - - | - |"')
    got = edited(text, PlayIn(0, 0, 0, _take((SNARE, 0.25, "O")), over=True))
    assert "(tOt)" in got.replace(" ", "")


def test_bars_that_are_not_there_are_told() -> None:
    with pytest.raises(BadInput, match="no bars 2 to 3; the grid has 2"):
        edited(EMPTY, PlayIn(0, 1, 2, ()))


# --- whatever is done -------------------------------------------------------------------------------------------------


def _any_edit(random: Random, bars: int) -> LessonEdit:
    bar, tick = random.randrange(bars), random.randrange(16) * SIXTEENTH
    line = random.choice((SNARE, KICK, HATS))
    letter = random.choice("xX-" if line is HATS else "oO-")
    others: list[LessonEdit] = [
        CutBeat(0, bar, random.randrange(4), random.choice((1, 2, 3, 4, 6))),
        AddBars(0, bar),
        CopyBars(0, bar, bar, 0, random.randrange(bars + 1)),
        CopyBars(0, bar, bar, 0, random.randrange(bars), over=True),
        *([RemoveBars(0, bar, bar)] if bars > 1 else []),
    ]
    return SetStroke(line, bar, tick, letter) if random.random() < 0.7 else random.choice(others)


def test_after_any_edits_every_list_fits_its_line() -> None:
    """No number is made up, none stands where there is no stroke, and what an edit refuses changes nothing."""
    random = Random(17)
    text, done = PLAYED, 0
    for _ in range(150):
        lesson = parse_lesson(text, "t.toml", "t").lesson
        assert lesson is not None
        known = {note.late_ms for note in lesson.score} | {0}
        try:
            text = edited(text, _any_edit(random, min(lesson.score.bar_count, 8)))
        except BadInput:
            continue
        done += 1
        found = parse_lesson(text, "t.toml", "t")
        assert found.lesson is not None or "timing" not in str(found.faults[0])
        if found.lesson is None:  # hands cannot play it, or nothing is left
            text = PLAYED
            continue
        assert {note.late_ms for note in found.lesson.score} <= known
    assert done > 100
