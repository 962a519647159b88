"""What nobody can play in a lesson: asked of `motion/feasibility`, told by letter and with the tempo that would do.

Asked of the whole score, of the step from the end of the loop to its start, and of the landing; at the goal's tempo,
and where there is something, at the written one too. A letter is blamed once however often the form plays it, and a
limb that the written tempo asks too much of is not blamed for the goal's as well.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import floor

import numpy as np

from station.core.toml.toml_faults import Faults
from station.core.units import PPQ
from station.drills.grid.cell_strokes import Origin
from station.drills.lesson import Lesson
from station.motion.feasibility.playable import Impossible, impossible
from station.music.score import Score

_COARSE_FROM_BPM = 20.0
"""Tempi from here on are told in whole beats a minute, slower ones in tenths (our choice)."""


@dataclass(frozen=True, slots=True)
class _Finding:
    """What is impossible at `row` of the lesson's score, the rows of its landing behind it; and `when`."""

    row: int
    what: Impossible
    when: str = ""


def note_unplayable(
    lesson: Lesson, origins: Sequence[Origin], beat_ticks_at: Callable[[int], int], faults: Faults
) -> None:
    """Note what cannot be played at its letter, one of `origins`: the score's rows, then the landing's.

    `beat_ticks_at` is the beat in which a teacher counts at a tick.
    """
    goal_speed = max(1.0, lesson.target_tempo_bpm / lesson.tempo_bpm)
    at_goal = list(_findings(lesson, goal_speed))
    written = list(_findings(lesson, 1.0)) if at_goal and goal_speed > 1 else at_goal  # what is slower is no harder
    goal_bpm = lesson.target_tempo_bpm * PPQ / lesson.beat_ticks
    blamed: set[Origin] = set()
    overtaxed: set[str] = set()
    for found, tempo in (*((each, None) for each in written), *((each, goal_bpm) for each in at_goal)):
        origin, limb = origins[found.row], found.what.too_fast_for
        if origin in blamed or limb in overtaxed:
            continue
        blamed.add(origin)
        overtaxed |= {limb} - {""}
        words = _words(lesson, found, tempo, beat_ticks_at)
        faults.add(origin.path, words, origin.char)


def _findings(lesson: Lesson, speed: float) -> Iterator[_Finding]:
    """All that is impossible at `speed`, in the whole, and as the loop is played twice and lands."""
    score, (first, last) = lesson.score.at_speed(speed), lesson.loop
    in_loop = np.flatnonzero((score.bar >= first) & (score.bar <= last)).tolist()
    if len(in_loop) < len(score):
        yield from (_Finding(found.note, found) for found in impossible(score))
    if not in_loop:
        return
    loop, notes = score.bars(first, last), len(in_loop)
    landing = [Score.from_array(lesson.landing, loop.tempo_map)] if len(lesson.landing) else []
    for found in impossible(Score.joined([loop, loop, *landing])):
        if found.note < 2 * notes:
            again = " as the loop starts again" if found.note >= notes else ""
            yield _Finding(in_loop[found.note % notes], found, again)
        else:
            yield _Finding(len(score) + found.note - 2 * notes, found, " on the landing")


def _words(lesson: Lesson, found: _Finding, goal_bpm: float | None, beat_ticks_at: Callable[[int], int]) -> str:
    share = found.what.playable_at
    if share is None:
        return found.what.text + found.when
    tempo = goal_bpm or _tempo_at(lesson, found.row, beat_ticks_at)
    at = f"the goal of {tempo:g}" if goal_bpm else f"{tempo:g}"
    return f"too fast at {at}: {found.what.text}{found.when}; playable up to {_floored(tempo * share):g} bpm"


def _tempo_at(lesson: Lesson, row: int, beat_ticks_at: Callable[[int], int]) -> float:
    """The tempo that is written where `row` stands, as a teacher counts it there; at the loop's start for a landing."""
    score = lesson.score
    tick = int(score.notes["tick"][row]) if row < len(score) else score.tempo_map.bar_start(lesson.loop[0])
    return round(score.tempo_map.bpm_at(tick) * PPQ / beat_ticks_at(tick), 1)


def _floored(bpm: float) -> float:
    """The tempo rounded down, so that it can be played."""
    parts = 1 if bpm >= _COARSE_FROM_BPM else 10
    return floor(bpm * parts + 1e-6) / parts
