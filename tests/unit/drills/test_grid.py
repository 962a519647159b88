"""Ticks are reckoned by hand from a quarter of 107520."""

import pytest

from station.drills.reading.lesson_file import parse_lesson
from tests.unit.drills.reading import EIGHTH, QUARTER, SIXTEENTH, TRIPLET, WHOLE, faults, read, text_of, ticks


def test_eight_cells_are_eighths() -> None:
    assert ticks('snare = "o-oo----"') == [0, QUARTER, QUARTER + EIGHTH]


def test_sixteen_cells_are_sixteenths() -> None:
    assert ticks('snare = "-o-- ---- ---- ---o"') == [26880, 403200]


def test_twelve_cells_are_triplets() -> None:
    assert ticks('snare = "ooo --- --- ---"') == [0, 35840, 71680]


def test_twenty_cells_are_quintuplets() -> None:
    assert ticks('snare = "ooooo ----- ----- -----"') == [0, 21504, 43008, 64512, 86016]


def test_twenty_eight_cells_are_septuplets() -> None:
    assert ticks('snare = "-o----- ------- ------- -------"') == [15360]


def test_fewer_cells_than_beats_are_longer_notes() -> None:
    assert ticks('snare = "oo"') == [0, 2 * QUARTER]
    assert ticks('snare = "o"') == [0]


def test_parentheses_fill_one_beat() -> None:
    found = ticks('snare = "o--- (ooo) --o- ----"')
    assert found == [0, QUARTER, QUARTER + TRIPLET, QUARTER + 2 * TRIPLET, 2 * QUARTER + EIGHTH]


def test_a_bar_of_parentheses_alone() -> None:
    assert ticks('snare = "(o)(oo)(-)(ooooo)"')[:4] == [0, QUARTER, QUARTER + EIGHTH, 3 * QUARTER]


def test_parentheses_fill_the_beat_that_the_lesson_counts() -> None:
    assert ticks('snare = "(oooo) ---"', 'meter = "6/8"\nbeat = "3/8"') == [0, 40320, 80640, 120960]


def test_blanks_and_outer_bar_lines_mean_nothing() -> None:
    plain = ticks('snare = "o-o-o-o-|--o-----"')
    assert plain == ticks('snare = "|  o-o-o-o-  | --o- ----   |"')
    assert plain == ticks('snare = """\n| o-o- o-o- |\n| --o- ---- |\n"""')


def test_bars_follow_each_other_in_any_division() -> None:
    assert ticks('snare = "o--- | -oo --- --- --- | -o"') == [
        0,
        WHOLE + TRIPLET,
        WHOLE + 2 * TRIPLET,
        2 * WHOLE + WHOLE // 2,
    ]


def test_percent_repeats_the_bar_before_it() -> None:
    assert ticks('snare = "o--- | -o-- | %"') == [0, WHOLE + QUARTER, 2 * WHOLE + QUARTER]
    assert ticks('snare = "--o- | %3"') == [2 * QUARTER + i * WHOLE for i in range(4)]


def test_times_repeats_the_grid() -> None:
    lesson = read('times = 3\nsnare = "--o- | -"')
    assert lesson.score.bar_count == 6
    assert lesson.score.notes["tick"].tolist() == [2 * QUARTER + 2 * i * WHOLE for i in range(3)]


def test_seven_eight() -> None:
    assert ticks('snare = "o--o--o | -"', 'meter = "7/8"') == [0, 3 * EIGHTH, 6 * EIGHTH]
    assert read('snare = "o--o--o | -"', 'meter = "7/8"').score.end_tick == 14 * EIGHTH


def test_grids_follow_each_other_with_their_own_meter_and_tempo() -> None:
    text = """
title = "T"
tempo_bpm = 60
[[grid]]
name = "one"
snare = "o---"
[[grid]]
meter = "3/4"
tempo_bpm = 120
snare = "--o | o--"
[[grid]]
snare = "-o-"
"""
    lesson = parse_lesson(text, "t", "t").lesson
    assert lesson
    tempo_map = lesson.score.tempo_map
    assert lesson.score.notes["tick"].tolist() == [0, WHOLE + 2 * QUARTER, WHOLE + 3 * QUARTER, WHOLE + 7 * QUARTER]
    assert [(t.tick, t.us_per_quarter) for t in tempo_map.tempos] == [(0, 1_000_000), (WHOLE, 500_000)]
    assert [(m.tick, m.beats, m.unit) for m in tempo_map.meters] == [(0, 4, 4), (WHOLE, 3, 4)]
    assert lesson.score.end_tick == WHOLE + 9 * QUARTER
    assert [(s.name, s.first_bar, s.last_bar) for s in lesson.sections] == [("one", 0, 0), ("", 1, 2), ("", 3, 3)]


def test_the_tempo_counts_the_beat() -> None:
    lesson = read('snare = "oooooo"', 'meter = "6/8"\nbeat = "3/8"\ntempo_bpm = 60')
    assert lesson.tempo_bpm == 90
    assert lesson.beats_a_minute == 60
    assert lesson.score.length_ns == 2_000_001_000  # 666667 whole microseconds a quarter, as MIDI keeps them


PREFIX = 'snare = "'
"""The first character of the line stands in column 10 of line 4."""


@pytest.mark.parametrize(
    ("line", "column", "words"),
    [
        ("o-o-o-o", 10, "7 cells do not fill a 4/4 bar; expected 1, 2, 4, 8, 12, 16, 24 or 32"),
        ("oooo ooo oooo oooo", 15, "15 cells do not fill"),
        ("oooo|ooo", 15, "3 cells do not fill"),
        ("oooo||oooo", 15, "an empty bar"),
        ("%|oooo", 10, "% repeats the bar before it"),
        ("oooo|%0", 15, "repeated 1 to 200 times"),
        ("oooo|%201", 15, "repeated 1 to 200 times"),
        ("oo(ooo)o-", 10, "4 cells beside (…)"),
        ("oo (ooo oo", 13, "without its partner"),
        ("oooo oooo)", 19, "without its partner"),
        ("((ooo))ooo", 11, "without its partner"),
        ("ooo ()", 15, "nothing between the parentheses"),
        ("(o)(o)(o)(o)(o)", 22, "holds 4 (…) of one beat each"),
        ("(o)(o)(o)(o)o", 10, "1 cells for the 0 beats"),
        ("(o)(o)(o)", 10, "0 cells for the 1 beats"),
        ("(" + 65 * "o" + ")ooo", 10, "65 cells in one (…); expected 1 to 64"),
        ("oooq", 13, "'q' is no letter for a snare line"),
        ("oo©o", 12, "no letter"),
        ("o-~-", 12, "goes on with a buzz roll"),
        ("~---", 10, "goes on with a buzz roll"),
        ("o-#-", 12, "grabs a ringing cymbal"),
    ],
)
def test_a_fault_names_its_very_character(line: str, column: int, words: str) -> None:
    found = faults(text_of(f'{PREFIX}{line}"'))
    assert (4, column) in [(f.line, f.column) for f in found], found
    assert any(words in f.text for f in found if f.column == column), found


def test_parentheses_start_on_a_beat() -> None:
    found = faults(text_of('snare = "o(ooo)ooooo"'))
    assert [(f.line, f.column) for f in found] == [(4, 11)]
    assert "must start on a beat" in found[0].text


def test_columns_count_in_a_text_of_several_lines() -> None:
    found = faults(text_of('snare = """\n| oooo |\n| ooqo |\n"""'))
    assert [(f.line, f.column) for f in found] == [(6, 5)]


def test_columns_count_past_escapes() -> None:
    found = faults(text_of('snare = "o\\u002Doq"'))
    assert [(f.line, f.column) for f in found] == [(4, 18)]


def test_lines_need_as_many_bars_as_each_other() -> None:
    found = faults(text_of('hihat = "xxxx | xxxx | xxxx"\nsnare = "oooo | oooo"'))
    assert [(f.line, f.column, f.text) for f in found] == [
        (5, 20, "2 bars, but hihat has 3; % repeats a bar, - is a bar's rest")
    ]


def test_a_faulty_bar_does_not_shift_the_others() -> None:
    found = faults(text_of('hihat = "xxx | xxxx"\nsnare = "oooo | ooqo"\nkick = "oooo | o---"'))
    assert [(f.line, f.column) for f in found] == [(4, 10), (5, 19)]


def test_sixteenths_are_a_quarter_of_a_quarter() -> None:
    assert 4 * SIXTEENTH == QUARTER


@pytest.mark.parametrize(
    "lines",
    [
        'snare = "| |"',
        'snare = "o---"\nsticking = "R---| |"',
        'snare = "o---| |"\nkick = "o---"\nhihat = "x---"',
        'snare = "o---| | oooo"\nkick = "o--- | o---"',
        'snare = "o---| |"\nkick = "o--- | o---"',
    ],
)
def test_an_empty_bar_is_told_once(lines: str) -> None:
    assert [f.text for f in faults(text_of(lines))] == ["an empty bar; a bar's rest is written -"]


def test_bars_too_many_are_told_beside_an_empty_one() -> None:
    """Three bars with one of them empty are two, and the other line has one."""
    found = [f.text for f in faults(text_of('snare = "o---| | oooo"\nkick = "o---"'))]
    assert found == ["an empty bar; a bar's rest is written -", "3 bars, but kick has 1; is a bar line too many?"]
