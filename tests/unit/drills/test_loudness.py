"""Loudness by hand: a mark multiplies velocities by √(h/6), h in inches; hairpins change evenly in decibels."""

from itertools import pairwise
from math import log10, sqrt

import pytest

from station.core.units import PPQ
from station.drills.reading.lesson_file import parse_lesson
from tests.unit.drills.reading import faults, notes, text_of

NORMAL = 80


def velocities(loudness: str, line: str = "oooo oooo", head: str = "tempo_bpm = 60") -> list[int]:
    return [n.velocity for n in notes(f'snare = "{line}"\nloudness = "{loudness}"', head)]


@pytest.mark.parametrize(
    ("mark", "inches"),
    [("ppp", 1), ("pp", 2), ("p", 3), ("mp", 4.5), ("mf", 6), ("f", 9), ("ff", 12), ("fff", 15)],
)
def test_a_mark_is_a_height_of_the_stick(mark: str, inches: float) -> None:
    assert set(velocities(mark.ljust(8, "-"))) == {round(80 * sqrt(inches / 6))}


def test_no_mark_is_mf() -> None:
    assert velocities("--------") == [NORMAL] * 8


def test_a_mark_counts_from_its_own_cell_on() -> None:
    assert velocities("---- ff--") == [80] * 4 + [113] * 4  # 80·√2 = 113.1
    assert velocities("---- f-p-") == [80] * 4 + [98] * 2 + [57] * 2  # 80·√1.5 = 97.98, 80·√0.5 = 56.6


def test_a_hairpin_grows_evenly_in_decibels_to_the_next_mark() -> None:
    """From p to ff is a factor of √(12/3) = 2 over four cells: a fourth root of 2 each, 1.505 dB."""
    found = velocities("p-<- --ff", "oooo oooo")
    p = 80 * sqrt(0.5)
    assert found == [round(p), round(p), *(round(p * 2 ** (i / 4)) for i in range(4)), 113, 113]
    steps = [20 * log10(b / a) for a, b in pairwise(found[2:7])]
    assert steps == pytest.approx([1.505] * 4, abs=0.12)  # velocities are whole numbers


def test_further_hairpins_are_for_the_eye() -> None:
    assert velocities("p-<< <-ff") == velocities("p-<- --ff")
    assert velocities("ff>> >>p-") == velocities("ff>- --p-")


def test_a_hairpin_crosses_bars_and_reaches_strokes_between_its_cells() -> None:
    found = velocities("p<-- | ---- | f-", "o--- | o--- | o-")
    p, f = 80 * sqrt(0.5), 80 * sqrt(1.5)
    assert found == [round(p), round(p * (f / p) ** (3 / 7)), round(f)]  # a quarter after p begins to grow: 3 of 7


def test_every_repetition_begins_anew() -> None:
    lesson = 'times = 2\nsnare = "oooo"\nloudness = "--p-"'
    assert [n.velocity for n in notes(lesson)] == [80, 80, 57, 57] * 2


def test_the_dynamic_stays_as_written_and_the_velocity_stays_in_midi() -> None:
    loud = notes('snare = "gOo-"\nloudness = "fff-"')
    assert [(n.dynamic.name, n.velocity) for n in loud] == [("GHOST", 51), ("ACCENT", 127), ("NORMAL", 126)]
    head = "tempo_bpm = 60\n[dynamics]\nghost = 1"
    assert [n.velocity for n in notes('snare = "g---"\nloudness = "ppp-"', head)] == [1]


def test_grace_strokes_follow_their_note() -> None:
    grace, main = notes('snare = "f---"\nloudness = "p---"')
    assert (main.velocity, grace.velocity) == (57, 23)  # 0.4 of 57 is 22.8


@pytest.mark.parametrize(
    ("line", "column", "words"),
    [
        ("mmf- ----", 13, "'mmf' is no loudness; expected ppp, pp, p, mp, mf, f, ff, fff, < or > or -"),
        ("p--- <---", 18, "< without a mark after it in this grid; expected one such as f"),
        (">--- ----", 13, "> without a mark after it in this grid; expected one such as p"),
        ("p-<- >-p-", 18, "> follows < without a mark between them that says how loud it gets"),
        ("p-<- pp--", 15, "< grows, but pp is not louder than it is there; expected a louder mark after it"),
        ("p->- f---", 15, "> fades, but f is not softer than it is there"),
        ("p--o ----", 16, "'o' is no loudness"),
        ("p-- ----", 13, "7 cells do not fill a 4/4 bar"),
        ("p--- | -", 20, "2 bars, but kick has 1; is a bar line too many?"),
    ],
)
def test_each_fault_is_told_once_at_its_place(line: str, column: int, words: str) -> None:
    (fault,) = faults(text_of(f'kick = "-"\nsnare = "oooo oooo"\nloudness = "{line}"'))
    assert (fault.line, fault.column) == (6, column), fault
    assert words in fault.text


def marks_of(grids: str) -> list[tuple[float, str]]:
    """The lesson's marks, each with the quarter on which it stands."""
    lesson = parse_lesson(f'title = "T"\n{grids}', "t", "t").lesson
    assert lesson
    return [(mark.tick / PPQ, mark.sign) for mark in lesson.score.loudness]


def test_notation_shows_the_marks_and_each_hairpin_once() -> None:
    assert marks_of('[grid]\nsnare = "oooo oooo"\nloudness = "p-<< <<ff"\nmeter = "2/4"') == [
        (0, "p"),
        (0.5, "<"),
        (1.5, "ff"),
    ]
    assert marks_of('[grid]\nsnare = "oooo oooo oooo oooo"') == []


def test_notation_says_where_a_grid_is_as_loud_as_usual_again() -> None:
    loud = '[[grid]]\nname = "a"\nmeter = "2/4"\nsnare = "oooo oooo"\nloudness = "---- f---"\ntimes = 2\n'
    plain = '[[grid]]\nname = "b"\nsnare = "oooo oooo"\n'
    assert marks_of(loud + plain) == [(0, "mf"), (1, "f"), (2, "mf"), (3, "f"), (4, "mf")]
