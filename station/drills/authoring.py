"""What a teacher does with lesson and course files: check them, look at them, begin a new one."""

from collections.abc import Sequence
from pathlib import Path

from station.core.errors import BadInput
from station.drills.course import is_course, parse_course
from station.drills.faults import Fault
from station.drills.lesson_file import lesson_text, parse_lesson
from station.drills.library import lessons_for

_ENDING = "*.toml"

NEW_LESSON = '''\
# A lesson of the drum station. Lines that start with # are notes to yourself.
title = "My groove"
author = ""
level = 1                # 1 first steps … 5 expert
tags = ["rock", "groove"]
about = """
What to listen for, in a sentence or two.
"""

tempo_bpm = 80
meter = "4/4"
swing_ratio = 1.0        # 2.0 swings eighths as triplets
loop = [1, 2]            # first and last bar that are practised
passes = 8               # how often
count_in_bars = 1
demonstrations = 2       # the drummer plays it first

[goals]
min_accuracy = 0.9       # share of the notes right
target_tempo_bpm = 100

# One character is one cell: 8 a bar are eighths, 12 triplets, 16 sixteenths. - rests, | ends a bar, % repeats it.
# Drums: o stroke, O accent, g ghost, f flam, d drag, t diddle, b buzz, r rim shot, x cross-stick.
# Cymbals: x stroke, X accent, # choke. Hi-hat: x closed, h half open, o open. hihat_pedal: x chick, o splash.
[grid]
#             1& 2& 3& 4&   1& 2& 3& 4&
hihat    = "| xx xx xx xx | xx xx xx xx |"
snare    = "| -- O- -- O- | -- O- -- O- |"
sticking = "| RR BR RR BR | RR BR RR BR |"
kick     = "| o- -- o- -- | o- -o o- -- |"
'''
"""The text that a new lesson starts from; it is a lesson already."""


def check_lessons(paths: Sequence[str]) -> tuple[list[Fault], int]:
    """Every fault of lessons and courses at `paths` (files, or folders of `.toml` files), and how many were read.

    A path that cannot be read is a fault at line 1. A folder without lessons is one too.
    """
    faults: list[Fault] = []
    count = 0
    for given in paths:
        path = Path(given)
        files = sorted(path.rglob(_ENDING)) if path.is_dir() else [path]
        if not files:
            faults.append(Fault(given, 1, 1, "no lesson in this folder; expected .toml files"))
        for file in files:
            count += 1
            faults += _check(file)
    return faults, count


def _check(file: Path) -> list[Fault]:
    try:
        text = lesson_text(file)
    except BadInput as fault:
        line = fault.place.removeprefix("line ")
        return [Fault(str(file), int(line) if line.isdecimal() else 1, 1, fault.fault)]
    if is_course(file):
        return parse_course(text, file, lessons_for(file.parent))[1]
    return parse_lesson(text, str(file), file.stem).faults
