"""Files read into lessons; expected values are what the text says, places counted by eye."""

import time
from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.drills.lesson import Goals
from station.drills.reading.lesson_file import parse_lesson, read_lesson
from station.scoring.analysis.fault_table import Asked
from station.scoring.matching.hit_windows import Level
from tests.unit.drills.reading import EIGHTH, QUARTER, SIXTEENTH, faults

WHOLE_LESSON = """
title = "Everything"
author = "A teacher"
level = 3
tags = ["rock", "test"]
about = \"\"\"
First line.
Second line.
\"\"\"
kit = "jazz"
tempo_bpm = 96
meter = "4/4"
swing_ratio = 1.5
swing_unit = "1/16"
loop = [2, 3]
passes = 4
count_in_bars = 2
demonstrations = 1

[dynamics]
accent = 120

[goals]
min_accuracy = 0.8
max_sd_ms = 25
max_lean_ms = 15.5
max_swing_error = 0.3
target_tempo_bpm = 120
min_score = 75
level = "elementary"
strictest_level = "advanced"
faults = {late_kick = 15, unsteady = "mute"}

[grid]
snare = "o--- | -o-- | --o- | ---o"
"""


def test_everything_that_a_file_can_say() -> None:
    lesson = parse_lesson(WHOLE_LESSON, "w", "whole").lesson
    assert lesson
    assert (lesson.name, lesson.title, lesson.author, lesson.level) == ("whole", "Everything", "A teacher", 3)
    assert lesson.tags == ("rock", "test")
    assert lesson.about == "First line.\nSecond line."
    assert (lesson.kit, lesson.tempo_bpm, lesson.meter) == ("jazz", 96, "4/4")
    assert (lesson.swing_ratio, lesson.swing.unit_ticks) == (1.5, SIXTEENTH)
    assert (lesson.loop, lesson.passes, lesson.count_in_bars, lesson.demonstrations) == ((1, 2), 4, 2, 1)
    faults = Asked({"late_kick": 15.0, "unsteady": None})
    assert lesson.goals == Goals(0.8, 25, 15.5, 0.3, 120, 75, Level.ELEMENTARY, Level.ADVANCED, faults)
    assert lesson.loop_score.notes["tick"].tolist() == [QUARTER, 4 * QUARTER + 2 * QUARTER]
    assert lesson.score.title == "Everything"


def test_what_a_file_need_not_say() -> None:
    lesson = parse_lesson('title = "T"\n[grid]\nsnare = "o | -"', "d", "d").lesson
    assert lesson
    assert (lesson.level, lesson.loop, lesson.passes, lesson.count_in_bars) == (1, (0, 1), 8, 1)
    assert lesson.demonstrations == 2  # TEACHING: demonstrate twice
    assert (lesson.tempo_bpm, lesson.meter, lesson.swing_ratio) == (80, "4/4", 1.0)
    assert lesson.swing.unit_ticks == EIGHTH
    assert lesson.goals == Goals()
    assert lesson.levels.choices == tuple(Level)
    assert lesson.target_tempo_bpm == 80


@pytest.mark.parametrize("bpm", [60, 77, 84, 90.5, 111, 133.33, 173])
def test_the_tempo_reads_as_written(bpm: float) -> None:
    lesson = parse_lesson(f'title = "T"\ntempo_bpm = {bpm}\n[grid]\nsnare = "o"', "d", "d").lesson
    assert lesson
    assert lesson.tempo_bpm == bpm


GRID = '\n[grid]\nsnare = "oooo"\n'


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("tempo_bpm = 80" + GRID, 1, 1, "title is missing"),
        ('title = "T"\n', 1, 1, "grid is missing"),
        ("title = 3" + GRID, 1, 9, "title: expected text in quotes"),
        ('title = ""' + GRID, 1, 9, "expected one line"),
        ('title = "T"\nlevel = 6' + GRID, 2, 9, "level: expected a whole number from 1 to 5"),
        ('title = "T"\nlevel = true' + GRID, 2, 9, "expected a whole number"),
        ('title = "T"\nlevel = 1.5' + GRID, 2, 9, "expected a whole number"),
        ('title = "T"\ntempo_bpm = "fast"' + GRID, 2, 13, "tempo_bpm: expected a number from 10 to 1000"),
        ('title = "T"\ntempo_bpm = nan' + GRID, 2, 13, "expected a number"),
        ('title = "T"\ntempo_bpm = 5' + GRID, 2, 13, "expected a number from 10 to 1000"),
        ('title = "T"\nbeat = "1/2"\ntempo_bpm = 600' + GRID, 3, 13, "1200 quarter notes a minute"),
        ('title = "T"\nmeter = "4"' + GRID, 2, 9, 'expected a meter such as "4/4"'),
        ('title = "T"\nmeter = "4/3"' + GRID, 2, 9, "expected a meter"),
        ('title = "T"\nmeter = "0/4"' + GRID, 2, 9, "expected a meter"),
        ('title = "T"\nmeter = 44' + GRID, 2, 9, "expected a meter"),
        ('title = "T"\nbeat = "5/8"' + GRID, 2, 8, "expected a note length"),
        ('title = "T"\nswing_ratio = 4.0' + GRID, 2, 15, "expected a number from 1 to 3.5"),
        (
            'title = "T"\nswing_ratio = 2\nmeter = "6/8"\nbeat = "3/8"' + GRID[:-2] + 'oo"',
            2,
            15,
            "no whole number of pairs",
        ),
        ('title = "T"\nswing_ratio = 2\nswing_unit = "1/4"' + GRID, 3, 14, "expected a shorter swing_unit"),
        ('title = "T"\ntags = "rock"' + GRID, 2, 8, "expected a list of words"),
        ('title = "T"\nloop = [0, 1]' + GRID, 2, 9, "loop: expected a whole number from 1 to 1"),
        ('title = "T"\nloop = [1]' + GRID, 2, 8, "expected two bar numbers"),
        ('title = "T"\nloop = [2, 1]\n[grid]\nsnare = "o|o"', 2, 8, "bar 1 comes before bar 2"),
        ('title = "T"\npasses = 0' + GRID, 2, 10, "expected a whole number from 1 to 1000"),
        ('title = "T"\ntempobpm = 80' + GRID, 2, 1, "no such key: tempobpm; did you mean tempo_bpm?"),
        ('title = "T"\ncolour = "red"' + GRID, 2, 1, "no such key: colour; the nearest are"),
        ('title = "T"\n[goals]\nmax_sd = 3' + GRID, 3, 1, "no such key: max_sd; did you mean max_sd_ms?"),
        ('title = "T"\n[goals]\nmin_accuracy = 90' + GRID, 3, 16, "expected a number from 0 to 1"),
        ('title = "T"\n[goals.faults]\nlate_kik = 9' + GRID, 3, 1, "no such fault: late_kik; did you mean late_kick?"),
        ('title = "T"\n[goals.faults]\nlate_kick = "no"' + GRID, 3, 13, 'expected a size, or "mute", found "no"'),
        ('title = "T"\ngoals = 3' + GRID, 2, 9, "goals: expected a table, found 3"),
        ('title = "T"\n[dynamics]\nghost = 90' + GRID, 3, 9, "expected rising velocities"),
        ('title = "T"\n[dynamics]\naccent = 128' + GRID, 3, 10, "expected a whole number from 1 to 127"),
        ('title = "T"\n[dynamics.snair]\naccent = 12' + GRID, 2, 1, "no such key: snair; did you mean snare?"),
        ('title = "T"\ngrid = 3', 2, 8, "expected a table"),
        ('title = "T"\ngrid = []', 2, 8, "no grid to play"),
        ('title = "T"\n[grid]\n', 2, 1, "grid has no line to play"),
        ('title = "T"\n[grid]\nsnare = | o o |\n', 3, 9, "expected a value"),  # and not that there is no line
        ('title = "T"\n[grid]\nsnare = "o–"\n', 3, 11, "(a long dash; a rest is the short one)"),
        ('title = "T"\n[grid]\nsnare = 3', 3, 9, "expected a line of the grid in quotes"),
        ('title = "T"\n[grid]\nsnare = ""', 3, 9, "expected a line of the grid in quotes"),
        ('title = "T"\n[grid]\nsnare = "----"', 2, 1, "nothing to play"),
        ('title = "T"\n[grid]\nkik = "oooo"\nsnare = "o---"', 3, 1, "no such line: kik; did you mean kick?"),
        ('title = "T"\n[grid]\ncrash = "x"\ncrash_1 = "x"', 3, 1, "are one line"),
        ('title = "T"\n[grid]\nright_hand.kick = "o"', 3, 19, "a hand plays no kick"),
        ('title = "T"\n[grid]\nleft_foot.snare = "o"', 3, 19, "a foot plays no snare"),
        ('title = "T"\n[grid]\nright_hand.snair = "o"\nsnare = "o"', 3, 1, "no such line: snair"),
        ('title = "T"\n[grid]\ntimes = 101\nsnare = "o"', 3, 9, "expected a whole number from 1 to 100"),
        ('title = "T"\n[grid]\ntimes = 100\nsnare = "o | %20"', 4, 9, "2100 bars; a lesson has at most 2000"),
        ('title = "T"\n[[grid]]\nsnare = "o"\n[[grid]]\nsnare = "q"', 5, 10, "'q' is no letter"),
    ],
)
def test_a_fault_names_its_place_and_what_was_expected(text: str, line: int, column: int, words: str) -> None:
    found = faults(text)
    assert (line, column) in [(f.line, f.column) for f in found], found
    assert any(words in f.text for f in found), found


def test_every_fault_of_a_file_is_found() -> None:
    text = """\
titel = "T"
level = 9
tempo_bpm = 80 bpm
[goals]
min_accuracy = 2
[grid]
hihat = "xxqx"
snare = "ooo"
kick = "o---
sticking = "R---"
"""
    found = [(f.line, f.column) for f in faults(text)]
    assert found == [(1, 1), (2, 9), (3, 16), (5, 16), (7, 12), (8, 10), (9, 13)]


def test_a_missing_key_is_not_claimed_where_lines_could_not_be_read() -> None:
    assert [f.line for f in faults('title = T\n[grid]\nsnare = "o"')] == [1]


def test_reading_a_file_raises_its_first_fault(tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_text('title = "T"\n[grid]\nsnare = "oq"\nkick = "oq"\n')
    with pytest.raises(
        BadInput,
        match=r"bad\.toml: line 3, column 11: 'q'.*\(and 1 more: `station lesson check .*bad\.toml` lists them\)$",
    ):
        read_lesson(path)


FINE = "o" * 256  # a bar of 4/4, each beat in as many cells as it may have
LONG = {
    "letters": ("snare = '" + "|".join([FINE] * 3000) + "'", "770999 letters; a lesson has at most 200000"),
    "cells": (f"snare = '{FINE} | %200 | %200 | %200 | %200'", "205056 cells; a lesson has at most 200000"),
    "strokes": (f"snare = '{FINE} | %99'", "25600 strokes up to here; a lesson has at most 20000"),
    "bars": (
        "snare = 'o | %199'\ntimes = 10\n[[grid]]\nsnare = 'o'",
        "2001 bars up to here; a lesson has at most",
    ),
}


@pytest.mark.parametrize("what", LONG)
def test_a_lesson_of_more_than_anyone_practises_is_refused_at_once(what: str) -> None:
    """Nobody waits for it: less than a second of the processor's time, and of a slow one's three."""
    grid, words = LONG[what]
    began_s = time.process_time()
    found = faults(f'title = "T"\ntempo_bpm = 40\n[[grid]]\n{grid}\n')
    assert words in " ".join(fault.text for fault in found)
    assert time.process_time() - began_s < 3


def test_a_file_of_windows_notepad_reads(tmp_path: Path) -> None:
    path = tmp_path / "good.toml"
    path.write_bytes(b'\xef\xbb\xbftitle = "T"\r\n[grid]\r\nsnare = "o---"\r\n')
    assert read_lesson(path).name == "good"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b'title = "T"\n\xff\xfe', r"line 2, column 1: not UTF-8 text"),
        (b"#" * 1_000_001, "longer than 1000000 bytes"),
        (b"", "title is missing.*and 1 more"),
        (b"\x00", "line 1, column 1"),
    ],
)
def test_a_file_that_is_no_text(tmp_path: Path, data: bytes, words: str) -> None:
    path = tmp_path / "odd.toml"
    path.write_bytes(data)
    with pytest.raises(BadInput, match=words):
        read_lesson(path)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"none\.toml: no such file"):
        read_lesson(tmp_path / "none.toml")
    with pytest.raises(BadInput, match="cannot be read: Is a directory"):
        read_lesson(tmp_path)
