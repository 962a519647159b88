"""Bars of the shipped lessons that fit a ground: what a teacher wrote, to be repeated or to be talked with.

A lesson in twelve eighths is four beats of triplets, and gives its bars to a ground of 4/4 with that feel.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.drills.library import find_lesson, lesson_rows
from station.music.score import Score
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.vocabulary.asked_of_limbs import Coordination, Dynamics, coordination_of, dynamics_of

FOLDERS = ("grooves", "fills", "hands", "rudiments", "trading", "reading", "orchestrated", "independence")
"""Kinds of lessons whose bars stand for themselves."""
LENGTHS = (1, 2, 4)
"""Bars of a phrase: a figure, a call, a call and its answer."""
_TRIPLETS = frozenset({PPQ // 3, PPQ * 2 // 3, PPQ // 6, PPQ * 5 // 6})
_HALVES = frozenset({PPQ // 4, PPQ // 2, PPQ * 3 // 4})


@dataclass(frozen=True, eq=False, slots=True)
class LessonBars:
    """`rows` (n,) of `NOTE_DTYPE` from tick 0 on, `bars` long, and what they ask; `tags` are of their `lesson`."""

    rows: NDArray[np.void]
    bars: int
    coordination: Coordination
    dynamics: Dynamics
    lesson: str = ""
    tags: frozenset[str] = frozenset()

    @property
    def strokes(self) -> int:
        """How many strokes they have, grace strokes apart."""
        return int(np.count_nonzero(self.rows["lead_ms"] <= 0))

    def on(self, ground: Ground) -> Score:
        """The bars at the ground's tempo."""
        return Score.from_array(self.rows, ground.tempo_map, self.bars * ground.bar_ticks)


@cache
def lesson_bars(beats: int, unit: int, feel: Feel) -> tuple[LessonBars, ...]:
    """All bars, pairs and fours of bars of shipped lessons in `beats`/`unit` with that feel, none of them twice."""
    found: dict[bytes, LessonBars] = {}
    for row in lesson_rows():
        if row.folder in FOLDERS and not row.is_song and _meter(row.meter) in _alike(beats, unit, feel):
            lesson = find_lesson(row.name)
            tags = frozenset((*lesson.tags, row.folder.removesuffix("s")))
            from_compound = _meter(row.meter) == (12, 8) and unit == 4
            for one in _windows(lesson.score, beats * 4 * PPQ // unit, from_compound):
                if _feel(one.rows, unit) in (None, feel):
                    found.setdefault(one.rows.tobytes(), replace(one, lesson=row.name, tags=tags))
    return tuple(found.values())


def known_bars(ground: Ground, vocabulary: Sequence[str]) -> tuple[LessonBars, ...]:
    """Those that fit `ground` and bear one of the tags of a `vocabulary`."""
    return _known(ground.beats, ground.unit, ground.feel, tuple(vocabulary))


@cache
def _known(beats: int, unit: int, feel: Feel, vocabulary: tuple[str, ...]) -> tuple[LessonBars, ...]:
    return tuple(one for one in lesson_bars(beats, unit, feel) if one.tags & set(vocabulary))


def _meter(text: str) -> tuple[int, int]:
    """Beats and unit of such as `3+2+2/8`."""
    beats, _, unit = text.partition("/")
    return sum(map(int, beats.split("+"))), int(unit)


def _alike(beats: int, unit: int, feel: Feel) -> tuple[tuple[int, int], ...]:
    return ((beats, unit), (12, 8)) if (beats, unit, feel) == (4, 4, Feel.TRIPLET) else ((beats, unit),)


def _windows(score: Score, bar_ticks: int, from_compound: bool) -> list[LessonBars]:
    """Runs of 1, 2 and 4 bars that begin where such runs do, none without strokes."""
    if len(score.tempo_map.meters) > 1:
        return []
    rows = score.notes.copy()
    rows["swing_ticks"], rows["midi_note"] = 0, 0
    for column in ("tick", "duration_ticks", "choke_ticks") if from_compound else ():
        rows[column] = rows[column] * 2 // 3  # a dotted quarter becomes a quarter
    windows = [(first, bars) for bars in LENGTHS for first in range(0, score.bar_count - bars + 1, bars)]
    cut = [(_between(rows, first * bar_ticks, (first + bars) * bar_ticks), bars) for first, bars in windows]
    return [LessonBars(some, bars, coordination_of(some), dynamics_of(some)) for some, bars in cut if len(some)]


def _between(rows: NDArray[np.void], start: int, end: int) -> NDArray[np.void]:
    some = rows[(rows["tick"] >= start) & (rows["tick"] < end)].copy()
    some["tick"] -= start
    some.setflags(write=False)
    return some


def _feel(rows: NDArray[np.void], unit: int) -> Feel | None:
    """How its beats are divided, None where they are not; in eighths' meters everything is straight."""
    inside = set((rows["tick"] % PPQ).tolist()) - {0}
    if unit == 8 or not inside:
        return None
    if inside <= _TRIPLETS | {PPQ // 2}:
        return Feel.TRIPLET if inside & _TRIPLETS else Feel.STRAIGHT
    return Feel.STRAIGHT if inside & _HALVES else Feel.TRIPLET
