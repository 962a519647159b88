"""Lines, bars and grids added, copied and taken away; the expected texts are written by hand."""

import tomllib
from typing import Any

import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.drills.editing.edit_lesson import edited
from station.drills.editing.lesson_edits import (
    REST,
    AddBars,
    AddGrid,
    AddLine,
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
    TextLine,
)
from station.drills.reading.lesson_file import parse_lesson

SONG = """\
tempo_bpm = 90
loop = [2, 3]
form = "A, B, A"
[goals]
min_accuracy = 0.9
[[goals.bars]]
bars = [3, 3]
min_accuracy = 0.95
[[grid]]
name = "A"
at = [{bar = 1, say = "one"}, {bar = 2, say = "two"}]
hihat = "xxxxxxxx|%"
snare = "--o---o-|%"
left_hand.tom_1 = "----|----"
kick = "o---|o---"
# about B
[[grid]]
name = "B"
like = "A"
kick = "o-oo|o-oo" # busy
"""


def after(text: str, *edits: LessonEdit) -> dict[str, Any]:
    """What the text says after some edits; the lesson that it is has no fault."""
    text = f'title = "T"\n{text}'
    for edit in edits:
        text = edited(text, edit, "my.toml")
    assert parse_lesson(text, "my.toml", "my").faults == []
    return tomllib.loads(text)


def bars(line: str) -> list[str]:
    return "".join(line.split()).strip("|").split("|")


def test_new_bars_stand_in_all_lines_and_in_the_variations_that_follow() -> None:
    """By hand: played are A1 A2 B1 B2 A1 A2, with new bars behind each first; bars 2, 3 are A2, B1, then 3 and 4."""
    lesson = after(SONG, AddBars(0, 1))
    first, second = lesson["grid"]
    assert bars(first["hihat"]) == ["xxxxxxxx", "--------", "xxxxxxxx"]
    assert bars(first["left_hand"]["tom_1"]) == ["----", "----", "----"]
    assert bars(second["kick"]) == ["o-oo", "----", "o-oo"]
    assert set(second) == {"name", "like", "kick"}
    assert [cue["bar"] for cue in first["at"]] == [1, 3]
    assert lesson["loop"] == [3, 4]
    assert lesson["goals"]["bars"][0]["bars"] == [4, 4]


def test_a_variation_that_gets_bars_of_its_own_has_all_its_lines_itself() -> None:
    lesson = after(SONG, AddBars(1, 2))
    assert bars(lesson["grid"][0]["hihat"]) == ["xxxxxxxx", "%"]
    assert bars(lesson["grid"][1]["hihat"]) == ["xxxxxxxx", "%", "--------"]
    assert lesson["loop"] == [2, 3]


def test_bars_taken_away_take_with_them_what_is_said_of_them() -> None:
    """By hand: A2 B2 A2 are left; bars 2 and 3 were A2 and B1: the loop is A2 alone, the goal of B1 is gone."""
    lesson = after(SONG, RemoveBars(0, 0, 0))
    assert lesson["grid"][0]["at"] == [{"bar": 1, "say": "two"}]
    assert bars(lesson["grid"][0]["hihat"]) == ["xxxxxxxx"]
    assert lesson["loop"] == [1, 1]
    assert "bars" not in lesson["goals"]


def test_a_loop_over_the_whole_lesson_stays_so() -> None:
    lesson = after('loop = [1, 2]\n[grid]\nsnare = "o|o"\n', AddBars(0, 2, 2))
    assert lesson["loop"] == [1, 4]


def test_copied_bars_bring_their_lines() -> None:
    text = '[[grid]]\nname = "A"\nsnare = "o---|-o--"\nsticking = "R---|-L--"\n[[grid]]\nname = "B"\nkick = "o---"\n'
    lesson = after(text, CopyBars(0, 1, 1, 1, 1))
    assert {key: bars(lesson["grid"][1][key]) for key in ("snare", "sticking", "kick")} == {
        "snare": ["----", "-o--"],
        "sticking": ["----", "-L--"],
        "kick": ["o---", "----"],
    }
    over = after(text, CopyBars(1, 0, 0, 0, 1, over=True))["grid"][0]
    assert bars(over["snare"]) == ["o---", "----"]
    assert bars(over["kick"]) == ["----", "o---"]
    assert bars(over["sticking"])[1] == "----"


def test_bars_of_meters_in_turn_stay_in_turn() -> None:
    text = 'meter = ["4/4", "3/4"]\n[grid]\nsnare = "o---|o--"\n'
    assert bars(after(text, AddBars(0, 2))["grid"]["snare"]) == ["o---", "o--", "----"]
    assert bars(after(text, AddBars(0, 0, 2))["grid"]["snare"]) == ["----", "---", "o---", "o--"]
    for edit in (AddBars(0, 0), RemoveBars(0, 0, 0), CopyBars(0, 0, 0, 0, 1, over=True)):
        with pytest.raises(BadInput, match=r"in turn|is of 4/4, its new place of 3/4"):
            edited(text, edit)


def test_a_grid_alone_becomes_a_list_and_its_variation_says_nothing_itself() -> None:
    assert edited('[grid] # mine\nsnare = "o---"\n', AddGrid("B", 0, 0)) == (
        '[[grid]] # mine\nname = "A"\n#          1 2 3 4\nsnare = "| o - - - |"\n\n[[grid]]\nname = "B"\nlike = "A"\n'
    )


def test_a_grid_of_rests_has_the_lines_of_the_one_before_it_and_comes_last_in_the_form() -> None:
    lesson = after(SONG, AddGrid("C", 1))
    assert lesson["form"] == "A, B, A, C"
    assert bars(lesson["grid"][2]["hihat"]) == ["----"]


def test_what_a_grid_took_from_the_one_before_it_stays() -> None:
    """B has no tempo and goes on with that of A, whatever stands between them then, and when A is gone."""
    text = '[[grid]]\nname = "A"\ntempo_bpm = 70\nsnare = "o"\n[[grid]]\nname = "X"\ntempo_bpm = 100\nsnare = "o"\n'
    text += '[[grid]]\nname = "B"\nsnare = "oo"\n'
    assert after(text, RemoveGrid(1))["grid"][1] == {"name": "B", "snare": "| o o |", "tempo_bpm": 100}
    between = after(text, AddGrid("Y", 1, 0))["grid"]
    assert [grid["name"] for grid in between] == ["A", "X", "Y", "B"]
    assert between[3]["tempo_bpm"] == 100


def test_variations_of_a_grid_that_goes_say_everything_themselves() -> None:
    lesson = after(SONG, RemoveGrid(0))
    (grid,) = lesson["grid"]
    assert {key: bars(grid[key]) for key in ("hihat", "snare", "kick")} == {
        "hihat": ["xxxxxxxx", "%"],
        "snare": ["--o---o-", "%"],
        "kick": ["o-oo", "o-oo"],
    }
    assert "like" not in grid
    assert lesson["form"] == "B"
    assert lesson["goals"]["bars"][0]["bars"] == [1, 1]


def test_an_ending_goes_with_its_grid() -> None:
    text = '[[grid]]\nname = "A"\nsnare = "o"\n[[grid]]\nname = "B"\nsnare = "o"\n[[grid]]\nending = 2\nsnare = "x"\n'
    assert [grid["name"] for grid in after(text, RemoveGrid(1))["grid"]] == ["A"]
    assert [grid.get("name") for grid in after(text, AddGrid("C", 1))["grid"]] == ["A", "B", None, "C"]


def test_lines_are_added_once_and_taken_away_with_their_hands() -> None:
    text = '[grid]\nhihat = "xxxx"\nsnare = "--o-"\nsticking = "RRBR"\nkick = "o"\n'
    lesson = after(text, AddLine(LineAt(0, Piece.RIDE)), AddLine(LineAt(0, Piece.RIDE)))
    assert bars(lesson["grid"]["ride"]) == ["----"]
    assert after(text, RemoveLine(LineAt(0, Piece.HIHAT), 0))["grid"]["sticking"].replace(" ", "") == "|--L-|"
    assert "sticking" not in after(text, RemoveLine(TextLine.STICKING, 0))["grid"]


def test_a_variation_without_a_line_of_its_model_rests_there() -> None:
    lesson = after(SONG, RemoveLine(LineAt(1, Piece.SNARE), 1))
    assert bars(lesson["grid"][1]["snare"]) == ["--------", "--------"]
    assert bars(lesson["grid"][0]["snare"]) == ["--o---o-", "%"]


@pytest.mark.parametrize(
    ("edit", "fault"),
    [
        (RemoveGrid(2), "there is no grid 3; the lesson has 2"),
        (RemoveBars(0, 0, 1), "these are all bars of the grid"),
        (RemoveBars(0, 1, 2), "the grid has 2"),
        (AddBars(0, 3), "a lesson has at most 2000|bars before bar"),
        (AddBars(0, 0, 5000), "2000"),
        (AddGrid("A", 0), "two grids would be called A"),
        (AddGrid("", 0), "one line of text"),
        (AddGrid("C", 0, 1), "stands below the grid that it is like"),
        (CopyBars(0, 1, 0, 0, 0), "comes before"),
        (CopyBars(0, 0, 0, 0, 2, over=True), "there is no bar 3"),
        (RemoveLine(LineAt(0, Piece.RIDE), 0), "no such line"),
        (AddLine(LineAt(0, Piece.RIDE, cycle=0)), "there is no cycle 1; the grid has 0"),
        (AddLine(LineAt(0, Piece.KICK, Limb.LEFT_HAND)), "a hand plays no kick"),
    ],
)
def test_what_cannot_be_done_is_said(edit: LessonEdit, fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        edited(SONG, edit, "my.toml")


def test_the_last_line_and_the_last_grid_stay() -> None:
    text = '[grid]\nsnare = "o---"\nsticking = "R---"\n'
    for edit in (RemoveLine(LineAt(0, Piece.SNARE), 0), RemoveGrid(0)):
        with pytest.raises(BadInput, match="this is its last"):
            edited(text, edit)


@pytest.mark.parametrize(
    ("quantise", "at"),
    [(Quantise(0), 0.0), (Quantise(10**9), 0.0), (Quantise(4, float("nan")), 0.0), (Quantise(), float("nan"))],
)
def test_a_take_without_cells_or_times_is_refused(quantise: Quantise, at: float) -> None:
    stroke = PlayedStroke(LineAt(0, Piece.SNARE), at, "o", 80)
    with pytest.raises(BadInput, match=r"cells a beat|no number"):
        edited('[grid]\nsnare = "----"\n', PlayIn(0, 0, 0, (stroke,), quantise))


def test_bars_are_pasted_as_they_stood_when_they_were_copied() -> None:
    text = 'title = "T"\n\n[grid]\nsnare = "| o-o- | ---- |"\nkick = "| oooo | ---- |"\n'
    erased = edited(text, SetStroke(LineAt(0, Piece.SNARE), 0, 0, REST))
    pasted = edited(erased, CopyBars(0, 0, 0, 0, 1, over=True, text=text))
    assert 'snare = "| - - o - | o - o - |"' in pasted
    other = 'title = "Other"\n\n[grid]\nhihat = "| xxxx |"\n'
    joined = edited(other, CopyBars(0, 0, 0, 0, 1, text=text))
    assert 'kick  = "| - - - - | o o o o |"' in joined
    assert 'hihat = "| x x x x | - - - - |"' in joined
    with pytest.raises(BadInput, match="4/4, its new place of 3/4"):
        edited('title = "W"\nmeter = "3/4"\n\n[grid]\nsnare = "o--"\n', CopyBars(0, 0, 0, 0, 1, text=text))


def test_all_beats_of_a_bar_are_cut_at_once() -> None:
    text = 'title = "T"\n\n[grid]\nsnare = "| o-o- |"\nkick = "| oooo |"\n'
    assert 'snare = "| o-- --- o-- --- |"' in edited(text, CutBeat(0, 0, None, 3, LineAt(0, Piece.SNARE)))
    assert 'kick  = "| o-- o-- o-- o-- |"' in edited(text, CutBeat(0, 0, None, 3))
