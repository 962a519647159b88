"""Strokes, signs and beats set in a text; the expected texts are written by hand."""

import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.drills.editing.edit_lesson import edited
from station.drills.editing.lesson_edits import CutBeat, LessonEdit, LineAt, SetSign, SetStroke, SetText, TextLine

GROOVE = """\
# mine
title = "T"   # the title
[grid]   # g
hihat = "xxxxxxxx | %3"  # keep
snare    = "--o---o- | % | %2"
sticking = "RRBRRRBR | %3"
kick = "o---o---|%|%2"
"""


def stroke(piece: Piece, bar: int, beat: float, letter: str, grid: int = 0, limb: Limb = Limb.UNKNOWN) -> SetStroke:
    return SetStroke(LineAt(grid, piece, limb), bar, round(beat * PPQ), letter)


def after(text: str, *edits: LessonEdit) -> str:
    for edit in edits:
        text = edited(text, edit, "my.toml")
    return text


def line(text: str, key: str) -> str:
    """The line of a key, its bars without blanks."""
    rows = [row for row in text.split("\n") if row.partition("=")[0].strip() == key]
    assert len(rows) == 1, text
    return "".join(rows[0].partition('"')[2].partition('"')[0].split()).strip("|")


def test_a_stroke_in_a_written_bar_is_in_its_repeats_too_and_comments_stay() -> None:
    assert after(GROOVE, stroke(Piece.SNARE, 0, 3.5, "g")) == (
        """\
# mine
title = "T"   # the title
[grid]   # g
#             1& 2& 3& 4&
hihat    = "| xx xx xx xx | %3     |"  # keep
snare    = "| -- o- -- og | % | %2 |"
sticking = "| RR BR RR BB | %3     |"
kick     = "| o- -- o- -- | % | %2 |"
"""
    )


def test_a_stroke_in_a_repeat_writes_that_bar_out_and_no_other_changes() -> None:
    text = after(GROOVE, stroke(Piece.SNARE, 1, 0.25, "g"))
    assert line(text, "snare") == "--o---o-|-g--o-------o---|--o---o-|%"
    assert line(text, "kick") == "o---o---|%|%2"


def test_a_repeat_of_several_bars_is_parted() -> None:
    text = after('[grid]\nkick = "o---|%5"\n', stroke(Piece.KICK, 3, 2, "o"))
    assert line(text, "kick") == "o---|%2|o-o-|o---|%"


@pytest.mark.parametrize(
    ("bar", "beat", "expected"),
    [
        ("o---", 0.5, "ox------"),
        ("o---", 1.25, "o----x----------"),
        ("o---", 1 / 3, "(ox-)---"),
        ("o", 3, "o--x"),
        ("oo", 0.5, "ox--o---"),
        ("o-o-o-o-", 2 / 3, "(o-x)o-o-o-"),
        ("oooooooo", 2 / 3, "(o--ox-)oooooo"),
        ("oooo(ooo)oo", 2 + 1 / 6, "oooo(oxo-o-)oo"),
        ("oooo(ooo)oo", 2.5, "oooo(o-oxo-)oo"),
        ("oooo(ooo)oo", 0.25, "oxo-o-o-(ooo)o-o-"),
        ("ooo ooo ooo ooo", 0.5, "o-oxo-o-o-o-o-o-o-o-o-o-"),
        ("ooo ooo ooo ooo", 1 / 6, "oxo-o-o-o-o-o-o-o-o-o-o-"),
        ("tt--", 3.5, "tt-(-x)"),
        ("b~-z", 1.5, "b~~x--z~"),
    ],
)
def test_a_bar_is_cut_finer_as_little_as_needed(bar: str, beat: float, expected: str) -> None:
    """By hand: halves where halves do, else the beat in parentheses; diddles and rolls stay as long as they were."""
    assert line(after(f'[grid]\nsnare = "{bar}"\n', stroke(Piece.SNARE, 0, beat, "x")), "snare") == expected


def test_a_bar_with_coarse_cells_to_spare_is_left_as_its_teacher_chose() -> None:
    assert (
        line(after('[grid]\nsnare = "o---------------"\n', stroke(Piece.SNARE, 0, 2, "o")), "snare")
        == "o-------o-------"
    )


def test_setting_what_stands_and_erasing_what_does_not_changes_nothing() -> None:
    assert after(GROOVE, stroke(Piece.SNARE, 2, 1, "o")) == GROOVE
    assert after(GROOVE, stroke(Piece.SNARE, 2, 1 / 7, "-"), stroke(Piece.TOM_1, 2, 0, "-")) == GROOVE


def test_a_missing_line_is_made_where_lessons_write_it() -> None:
    text = after(
        GROOVE, stroke(Piece.CRASH_1, 0, 0, "X"), stroke(Piece.TOM_1, 3, 3.75, "o"), stroke(Piece.RIDE, 0, 1, "x")
    )
    keys = [row.partition("=")[0].strip() for row in text.split("\n") if '"|' in row]
    assert keys == ["crash", "ride", "hihat", "tom_1", "snare", "sticking", "kick"]
    assert line(text, "crash") == "X-------|--------|--------|--------"
    assert line(text, "tom_1") == "--------|--------|--------|---------------o"


@pytest.mark.parametrize(
    ("edits", "bar"),
    [
        ([stroke(Piece.SNARE, 0, 1, "-")], "RRRRRRBR"),
        ([stroke(Piece.HIHAT, 0, 1, "-")], "RRLRRRBR"),
        ([stroke(Piece.HIHAT, 0, 0, "-")], "-RBRRRBR"),
        ([stroke(Piece.SNARE, 0, 0, "g")], "BRBRRRBR"),
        ([stroke(Piece.SNARE, 0, 0, "g"), stroke(Piece.TOM_1, 0, 0, "o")], "BRBRRRBR"),
        ([stroke(Piece.HIHAT, 0, 1, "o")], "RRBRRRBR"),
    ],
)
def test_the_sticking_goes_with_its_strokes(edits: list[SetStroke], bar: str) -> None:
    """B is the right hand on the hi-hat and the left on the snare (`RIGHT_FIRST`): what is left keeps its hand."""
    text = after(GROOVE, *edits)
    assert line(text, "sticking").split("|")[0] == bar


def test_a_roll_goes_with_its_holds_and_a_crash_with_its_choke() -> None:
    text = '[grid]\nsnare = "b~~~|~---"\ncrash = "x-#-|----"\nkick="o|o"\n'
    text = after(text, stroke(Piece.SNARE, 0, 0, "o"), stroke(Piece.CRASH_1, 0, 0, "-"))
    assert line(text, "snare") == "o---|----"
    assert line(text, "crash") == "----|----"


def test_a_variation_gets_a_line_of_its_own_and_its_model_stays() -> None:
    text = '[[grid]]\nname = "A"\nhihat = "xxxx"\nkick = "o---" # k\n[[grid]]\nname = "B"\nlike = "A"\nkick = "oo--"\n'
    assert after(text, stroke(Piece.HIHAT, 0, 1, "o", grid=1)).split("[[grid]]")[2] == (
        '\nname = "B"\nlike = "A"\n#          1 2 3 4\nhihat = "| x o x x |"\nkick  = "| o o - - |"\n'
    )
    assert after(text, stroke(Piece.HIHAT, 0, 1, "o", grid=1)).split("[[grid]]")[1] == text.split("[[grid]]")[1]


def test_lines_of_limbs_stand_by_dotted_keys_or_in_their_table() -> None:
    hand = stroke(Piece.HIHAT, 0, 1, "x", limb=Limb.LEFT_HAND)
    assert line(after('[grid]\nkick = "o---"\n', hand), "left_hand.hihat") == "-x--"
    assert line(after('[grid]\nkick = "o---"\n[grid.left_hand]\nsnare = "o---"\n', hand), "hihat") == "-x--"
    braces = after('[grid]\nkick = "o---"\nleft_hand = {snare = "o---"}\n', hand)
    assert 'left_hand = {snare = "o---", hihat = "| -x-- |"}' in braces


def test_the_foot_of_the_kick_is_one_line_with_the_kick() -> None:
    text = after('[grid]\nkick = "o---"\n', stroke(Piece.KICK, 0, 1, "o", limb=Limb.RIGHT_FOOT))
    assert line(text, "kick") == "oo--"


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ('grid = {snare = "o---", kick = "o"}', 'grid = {snare = "oo--", kick = "o"}'),
        ('title="x"\ngrid.snare = "o---"\ngrid.kick = "o"\n', 'grid.snare = "| o o - - |"'),
        ("[grid]\nsnare = '''\n| o--- |\n'''\n", "snare = '| o o - - |'"),
        ("[grid]\nsnare = 'o---'\n", "snare = '| o o - - |'"),
    ],
)
def test_every_way_to_write_a_grid_can_be_edited(text: str, key: str) -> None:
    assert key in after(text, stroke(Piece.SNARE, 0, 1, "o")).replace("grid.snare  ", "grid.snare ")


def test_rows_of_a_long_line_stay_rows() -> None:
    text = '[grid]\nsnare = """\n| o--- | oooo |\n| --o- | % |\n"""\n'
    assert after(text, stroke(Piece.SNARE, 3, 0, "g")) == (
        '[grid]\nsnare = """\n| o - - - | o o o o |\n| - - o - | g - o - |\n"""\n'
    )


@pytest.mark.parametrize(
    ("edit", "fault"),
    [
        (stroke(Piece.SNARE, 0, 0, "q"), "no letter for a snare line"),
        (stroke(Piece.CRASH_1, 0, 0, "~"), "no letter for a crash line"),
        (stroke(Piece.SNARE, 4, 0, "o"), "there is no bar 5; the grid has 4"),
        (stroke(Piece.SNARE, 0, 4, "o"), "outside the bar"),
        (stroke(Piece.SNARE, 0, 0, "o", grid=1), "there is no grid 2; the lesson has 1"),
        (stroke(Piece.SNARE, 0, 0.001, "o"), "no cell can begin there"),
        (stroke(Piece.KICK, 0, 0, "o", limb=Limb.LEFT_HAND), "a hand plays no kick"),
        (SetSign(0, TextLine.STICKING, 0, PPQ // 4, "R"), "no hand strikes here"),
        (SetSign(0, TextLine.STICKING, 0, 0, "X"), "expected R, L, B or -"),
        (SetSign(0, TextLine.LOUDNESS, 0, 0, "<"), "without a mark after it"),
        (CutBeat(0, 0, 4, 3), "there is no beat 5; the bar has 4"),
        (CutBeat(0, 0, 0, 65), "expected 1 to 64"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_sentence(edit: LessonEdit, fault: str) -> None:
    with pytest.raises(BadInput, match=fault) as told:
        edited(GROOVE, edit, "my.toml")
    assert str(told.value).startswith("my.toml")


def test_a_text_that_is_no_toml_is_edited_as_text_alone() -> None:
    with pytest.raises(BadInput, match="line 1, column 1"):
        edited("= 3", stroke(Piece.SNARE, 0, 0, "o"))
    assert edited("= 3", SetText("= 4")) == "= 4"


def test_signs_are_set_and_taken_away() -> None:
    text = after(GROOVE, SetSign(0, TextLine.LOUDNESS, 3, 0, "f"), SetSign(0, TextLine.LOUDNESS, 0, 2 * PPQ, "mp"))
    assert line(text, "loudness") == "----mp--|--------|--------|f-------"
    text = after(text, SetSign(0, TextLine.LOUDNESS, 2, 0, "<"), SetSign(0, TextLine.LOUDNESS, 0, 5 * PPQ // 2, "pp"))
    assert line(text, "loudness") == "----------------mp--pp----------|--------|<-------|f-------"
    text = after(text, SetSign(0, TextLine.LOUDNESS, 3, 0, "-"))
    assert line(text, "loudness").split("|")[2:] == ["--------", "--------"]
    assert line(after(GROOVE, SetSign(0, TextLine.STICKING, 1, 0, "L")), "sticking") == "RRBRRRBR|LRBRRRBR|RRBRRRBR|%"


@pytest.mark.parametrize(
    ("bar", "beat", "cells", "expected"),
    [
        ("oooooooo", 1, 3, "oo(oo-)oooo"),
        ("oo(ooo)oooo", 1, 2, "oooooooo"),
        ("o---", 0, 2, "(o-)---"),
        ("(oo)(oo)(oo)o", 3, 2, "ooooooo-"),
        ("oo", 0, 3, "(o--)-o-"),
        ("oooo", 2, 1, "oooo"),
    ],
)
def test_a_beat_is_cut_anew(bar: str, beat: int, cells: int, expected: str) -> None:
    """By hand; half a beat lies between the second third and the last: it goes to the earlier."""
    text = f'[grid]\nsnare = "{bar}"\n'
    assert line(after(text, CutBeat(0, 0, beat, cells)), "snare") == expected
