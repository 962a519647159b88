"""Groups of a meter, meters in turn, and cells that divide no beat exactly; ticks by hand from a quarter of 107520."""

import pytest

from station.core.toml.toml_faults import Wrong
from station.drills.grid.grid_timing import meter, meters
from station.drills.reading.lesson_file import parse_lesson
from tests.unit.drills.reading import EIGHTH, QUARTER, WHOLE, faults, read, text_of, ticks

SEVEN = 'tempo_bpm = 60\nmeter = "3+2+2/8"'


def test_a_meter_may_say_its_groups() -> None:
    found = meter("3+2+2/8")
    assert (found.beats, found.unit, found.groups) == (7, 8, (3, 2, 2))
    assert str(found) == "3+2+2/8"
    assert meter(" 12/8 ").groups == ()


@pytest.mark.parametrize(
    "text", ["3+/8", "+3/8", "3+0/8", "3+2+2", "3-2/8", "16+17/8", "3+2/6", "", 7, "³/4", "9999/4"]
)
def test_what_is_no_meter(text: object) -> None:
    with pytest.raises(Wrong, match="expected a meter"):
        meter(text)


def test_meters_in_turn() -> None:
    assert [str(m) for m in meters(["7/8", "4/4"])] == ["7/8", "4/4"]
    with pytest.raises(Wrong, match="expected 1 to 64 meters"):
        meters([])


def test_parentheses_fill_the_group_in_which_they_start() -> None:
    assert ticks('snare = "(oo) (o) (ooo)"', SEVEN) == [
        0,
        80640,  # half of three eighths
        3 * EIGHTH,
        5 * EIGHTH,
        5 * EIGHTH + 35840,
        5 * EIGHTH + 71680,
    ]


def test_plain_cells_stand_beside_groups() -> None:
    assert ticks('snare = "ooo (ooooo) o-"', SEVEN) == [
        *(i * EIGHTH for i in range(3)),
        *(3 * EIGHTH + i * 21504 for i in range(5)),
        5 * EIGHTH,
    ]
    assert ticks('snare = "(oooo) o-o- o-o-"', SEVEN)[:5] == [0, 40320, 80640, 120960, 3 * EIGHTH]
    assert ticks('snare = "(oooo) o-o- o-o-"', SEVEN)[5:] == [4 * EIGHTH, 5 * EIGHTH, 6 * EIGHTH]


def test_the_meter_of_the_score_has_its_groups() -> None:
    assert [m.groups for m in read('snare = "ooooooo"', SEVEN).score.tempo_map.meters] == [(3, 2, 2)]


def test_pairs_swing_in_each_group_and_the_odd_cell_stays() -> None:
    swung = 71680  # two thirds of a pair of eighths
    found = ticks('hihat = "xxx xx xx"', SEVEN + "\nswing_ratio = 2.0")
    assert found == [0, swung, 2 * EIGHTH, 3 * EIGHTH, 3 * EIGHTH + swung, 5 * EIGHTH, 5 * EIGHTH + swung]


def test_bars_take_their_meters_in_turn() -> None:
    lesson = read('snare = "o------ | o--- | ------o | ---o"', 'meter = ["7/8", "4/4"]\ntempo_bpm = 60')
    turn = 7 * EIGHTH + WHOLE
    assert lesson.score.notes["tick"].tolist() == [0, 7 * EIGHTH, turn + 6 * EIGHTH, turn + 7 * EIGHTH + 3 * QUARTER]
    assert [(m.tick, str(m)) for m in lesson.score.tempo_map.meters] == [
        (0, "7/8"),
        (7 * EIGHTH, "4/4"),
        (turn, "7/8"),
        (turn + 7 * EIGHTH, "4/4"),
    ]


def test_a_repetition_begins_with_the_first_meter() -> None:
    lesson = read('times = 2\nsnare = "o-- | o-- | o--"', 'meter = ["3/4", "3/8"]\ntempo_bpm = 60')
    long, short = 3 * QUARTER, 3 * EIGHTH
    assert lesson.score.notes["tick"].tolist() == [
        *(0, long, long + short),
        *(2 * long + short, 3 * long + short, 3 * long + 2 * short),
    ]


def test_the_next_grid_has_the_same_meters_from_the_first_on() -> None:
    text = 'title = "T"\n[[grid]]\nmeter = ["3/4", "2/4"]\nsnare = "ooo"\n[[grid]]\nsnare = "ooo | oo"'
    lesson = parse_lesson(text, "t", "t").lesson
    assert lesson
    assert [str(m) for m in lesson.score.tempo_map.meters] == ["3/4", "2/4"]
    assert [m.tick for m in lesson.score.tempo_map.meters] == [0, 6 * QUARTER]


@pytest.mark.parametrize("cells", [9, 11, 13, 17, 37, 64])
def test_cells_start_at_the_nearest_tick(cells: int) -> None:
    found = ticks(f'snare = "o--- ({"o" * cells}) ---- o---"', "tempo_bpm = 10")
    assert found[1:-1] == [QUARTER + round(107520 * i / cells) for i in range(cells)]
    assert found[-1] == 3 * QUARTER


def test_nine_ten_and_fourteen_to_every_beat() -> None:
    for cells in (9, 10, 14):
        assert ticks(f'snare = "{"o" * 4 * cells}"', "tempo_bpm = 20") == [
            round(430080 * i / (4 * cells)) for i in range(4 * cells)
        ]


@pytest.mark.parametrize(
    ("line", "column", "words"),
    [
        ("ooo (ooo) ooo", 10, "6 cells beside (…) do not fill a 3+2+2/8 bar; each (…) starts a group and fills it"),
        ("oo (ooo) ooo", 10, "5 cells beside (…) do not fill a 3+2+2/8 bar"),
        ("(o)(o)(o)(o)", 19, "a 3+2+2/8 bar holds 3 (…) of one group each; this is one too many"),
        ("oooooo", 10, "6 cells do not fill a 3+2+2/8 bar; expected 1, 7, 14, 21, 28, 42 or 56"),
        ("xx", 10, "2 cells do not fill"),
        ("ooo oo o-o-", 17, "9 cells do not fill"),
        ("o-o-o- o-o o-o-", 17, "13 cells do not fill"),
        ("(o)(o)", 10, "0 cells beside (…) do not fill a 3+2+2/8 bar"),
    ],
)
def test_what_fills_no_groups(line: str, column: int, words: str) -> None:
    (fault,) = faults(text_of(f'snare = "{line}"', 'meter = "3+2+2/8"'))
    assert (fault.line, fault.column) == (4, column)
    assert words in fault.text


def test_a_bar_is_not_repeated_in_another_meter() -> None:
    (fault,) = faults(text_of('snare = "oooo | %"', 'meter = ["4/4", "3/4"]'))
    assert (fault.line, fault.column) == (4, 17)
    assert fault.text == "% repeats a bar of 4/4, and this one is of 3/4; expected it written out"


def test_a_wrong_meter_in_a_list_has_its_place() -> None:
    (fault,) = faults('title = "T"\nmeter = ["4/4", "4/5"]\n[grid]\nsnare = "oooo"')
    assert (fault.line, fault.column) == (2, 17)
