"""How hard a lesson of any length is, as the levels of the lessons that ship say it."""

from dataclasses import replace
from math import ceil
from statistics import median

from station.drills.difficulty import difficulty
from station.drills.lesson import Lesson

_LEVELS_FROM = (13.0, 18.5, 23.7, 27.9)
"""From which difficulty on a lesson is of level 2, 3, 4, 5: half way between the medians of the lessons that ship, at
the tempo to reach, which are 10.0, 16.0, 21.0, 26.4 and 29.4."""
_LEVEL_BARS = 2
"""Bars of the middle lesson that ships, of every level but the first. Longer runs of bars have more to know."""
_MOST_MEASURED = 50
"""Pairs of bars that tell the level of a piece, spread over it (our choice; a second at most)."""


def level_of(lesson: Lesson) -> int:
    """How hard it is, 1–5: as hard as the middle one of its pairs of bars, for lessons that ship have two bars."""
    last = lesson.score.bar_count - 1
    step = _LEVEL_BARS * ceil((last + 1) / (_LEVEL_BARS * _MOST_MEASURED))
    parts = [replace(lesson, loop=(bar, min(bar + _LEVEL_BARS - 1, last))) for bar in range(0, last + 1, step)]
    middle = median([difficulty(each).total for each in parts if len(each.loop_score)] or [0.0])
    return 1 + sum(middle >= least for least in _LEVELS_FROM)
