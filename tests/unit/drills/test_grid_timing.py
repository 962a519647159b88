"""What a grid says for itself and for those after it: swing, dynamics, graces, tempo."""

import pytest

from station.core.toml.toml_faults import Faults
from station.core.units import PPQ
from station.drills.grid.grid_reader import GridSection, read_grid
from station.drills.grid.grid_timing import GridTiming
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.music.tempo import MeterChange
from tests.unit.drills.reading import EIGHTH, QUARTER, WHOLE, faults

TIMING = GridTiming(80, (MeterChange(0, 4, 4),), PPQ)


def lesson(text: str) -> Lesson:
    reading = parse_lesson('title = "T"\n' + text, "t", "t")
    assert reading.faults == []
    assert reading.lesson
    return reading.lesson


def section(table: dict[str, object], before: GridTiming = TIMING) -> GridSection:
    faults = Faults()
    found = read_grid(table, ("grid",), before, faults)
    assert faults.noted == []
    return found


def test_swing_holds_until_a_grid_says_otherwise() -> None:
    found = lesson(
        'swing_ratio = 2\n[[grid]]\nride = "xx xx xx xx"\n[[grid]]\nswing_ratio = 3\nride = "xx -- -- --"\n'
        '[[grid]]\nride = "xx -- -- --"\n[[grid]]\nswing_ratio = 1\nride = "xx -- -- --"'
    )
    ticks = found.score.notes["tick"].tolist()
    assert ticks[:2] == [0, 71680]
    assert [t - bar * WHOLE for bar, t in zip((1, 2, 3), ticks[9::2], strict=True)] == [80640, 80640, EIGHTH]
    assert [s.swing.ratio for s in found.sections] == [2, 3, 3, 1]


def test_the_unit_of_swing_may_change_alone() -> None:
    found = section(
        {"swing_unit": "1/16", "ride": "xxxx ---- ---- ----"}, section({"swing_ratio": 2.0, "ride": "x"}).timing
    )
    assert [s.place.played for s in found.at(0)] == [0, 35840, EIGHTH, EIGHTH + 35840]


def test_dynamics_hold_until_a_grid_says_otherwise() -> None:
    found = lesson(
        '[dynamics]\naccent = 110\n[[grid]]\nsnare = "goO-"\n[[grid]]\nsnare = "goO-"\nkick = "---o"\n'
        '[grid.dynamics]\nghost = 20\n[grid.dynamics.kick]\nnormal = 70\n[[grid]]\nsnare = "goO-"\nkick = "---o"'
    )
    assert found.score.notes["velocity"].tolist() == [32, 80, 110, 20, 80, 110, 70, 20, 80, 110, 70]


def test_graces_hold_until_a_grid_says_otherwise() -> None:
    found = lesson(
        '[graces]\nflam_ms = 20\n[[grid]]\nsnare = "fd--"\n[[grid]]\nsnare = "fd--"\n'
        '[grid.graces]\nshare = 0.5\ndrag_ms = 70\n[[grid]]\nsnare = "fd--"'
    )
    leads = [n.lead_ms for n in found.score if n.lead_ms]
    assert leads == [20, 110, 55, 20, 140, 70, 20, 140, 70]
    assert [n.velocity for n in found.score if n.lead_ms] == [32] * 3 + [40] * 6


def test_a_ramp_is_this_grids_alone() -> None:
    first = section({"tempo_bpm": 100, "tempo_to_bpm": 120, "beat": "3/8", "meter": "6/8", "snare": "o"})
    assert (first.timing.tempo_bpm, first.timing.tempo_to_bpm) == (150, 180)
    second = section({"snare": "o"}, first.timing)
    assert (second.timing.tempo_bpm, second.timing.tempo_to_bpm) == (150, None)


def test_repetitions_can_be_asked_for_and_moved() -> None:
    found = section({"times": 2, "meter": ["3/4", "2/4"], "snare": "--o | b~", "crash": "--x | #-"})
    assert (found.times, found.bar_count, found.length_ticks) == (2, 2, 5 * QUARTER)
    moved = {s.piece.name: s for s in found.repetition(1, 10 * QUARTER) if s.place.straight < 13 * QUARTER}
    assert moved["SNARE"].place.played == 12 * QUARTER
    assert moved["CRASH_1"].until is not None
    assert moved["CRASH_1"].until.played == 13 * QUARTER
    assert [m.tick for m in found.bars_at(QUARTER)] == [QUARTER, 4 * QUARTER]
    assert sorted({s.place.straight // QUARTER for s in found.at(0)}) == [2, 3, 7, 8]


HEAD = 'title = "T"\nswing_ratio = 2\n[[grid]]\nsnare = "oooo"\n[[grid]]\n'


@pytest.mark.parametrize(
    ("grid", "line", "column", "words"),
    [
        ("[grid.dynamics]\nghost = 100", 8, 9, "ghost 100, normal 80, accent 116: expected rising velocities"),
        ("[grid.dynamics.kick]\nnormal = 127", 8, 10, "ghost 32, normal 127, accent 116"),
        ("[grid.dynamics]\ngost = 20", 8, 1, "no such key: gost; did you mean ghost?"),
        ("[grid.graces]\nflam_ms = 5", 8, 11, "expected a number from 10 to 80, found 5"),
        ("[grid.graces]\nshare = 2", 8, 9, "expected a number from 0.1 to 1, found 2"),
        ("swing_ratio = 9", 7, 15, "expected a number from 1 to 3.5"),
        ("tempo_bpm = 900\nbeat = '1/2'", 7, 13, "1800 quarter notes a minute; expected 10 to 1000"),
        ("tempo_to_bpm = 1", 7, 16, "expected a number from 10 to 1000"),
        ("times = 101", 7, 9, "expected a whole number from 1 to 100"),
        ("bars = 0", 7, 8, "expected a whole number from 1 to 2000"),
        ("meter = '6/8'\nbeat = '3/8'", 2, 15, "the beat is no whole number of pairs to swing; expected a shorter"),
        ("meter = '6/8'\nbeat = '3/8'\nswing_unit = '1/8'", 9, 14, "expected a shorter swing_unit"),
    ],
)
def test_each_fault_is_told_once_at_its_place(grid: str, line: int, column: int, words: str) -> None:
    snare = "oooooo" if "6/8" in grid else "oooo"
    (fault,) = faults(f'{HEAD}snare = "{snare}"\n{grid}\n')
    assert (fault.line, fault.column) == (line, column), fault
    assert words in fault.text


@pytest.mark.parametrize("grid", ['snare = "(oooo) (ooo)"', 'snare = "o"', 'meter = "3+3/8"\nsnare = "oooooo"'])
def test_swing_crosses_no_beat_where_nothing_swings_or_each_group_is_filled(grid: str) -> None:
    meter = "" if "meter" in grid else 'meter = "6/8"\n'
    assert faults(f'{HEAD}{meter}beat = "3/8"\n{grid}') == []
