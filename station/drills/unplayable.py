"""What nobody can play in a lesson: asked of `motion/feasibility`, told by letter and with the tempo that would do.

Asked of the whole score, of the step from the end of the loop to its start, and of the landing; at the written tempo
first, then at the goal's. A letter is blamed once however often the form plays it, and a limb that the written tempo
asks too much of is not blamed for the goal's as well.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import floor

import numpy as np

from station.core.toml_faults import Faults
from station.core.units import PPQ
from station.drills.grid.cell_strokes import Origin
from station.drills.lesson import Lesson
from station.motion.feasibility.playable import Impossible, impossible
from station.music.score import Score

LANDING = "landing"
_COARSE_FROM_BPM = 20.0
"""Tempi from here on are told in whole beats a minute, slower ones in tenths (our choice)."""


@dataclass(frozen=True, slots=True)
class _Finding:
    """What is impossible at `row` of the lesson's score, or in its landing where that is None; and `when`."""

    row: int | None
    what: Impossible
    when: str = ""


def note_unplayable(
    lesson: Lesson, origins: Sequence[Origin], beat_ticks_at: Callable[[int], int], faults: Faults
) -> None:
    """Note what cannot be played, at its letter: `origins` of the score's rows; tempi in `beat_ticks_at` a tick."""
    blamed: set[Origin | None] = set()
    overtaxed: set[str] = set()
    for goal_bpm in (None, *_goals(lesson)):
        speed = 1.0 if goal_bpm is None else lesson.target_tempo_bpm / lesson.tempo_bpm
        findings = list(_findings(lesson, speed))
        for found in findings:
            origin = None if found.row is None else origins[found.row]
            if origin not in blamed and found.what.too_fast_for not in overtaxed:
                blamed.add(origin)
                words = _words(lesson, found, goal_bpm, beat_ticks_at)
                faults.add(
                    (LANDING,) if origin is None else origin.path, words, None if origin is None else origin.char
                )
        overtaxed = {found.what.too_fast_for for found in findings} - {""}


def _goals(lesson: Lesson) -> Iterator[float]:
    """The tempo to reach in the lesson's own beat, if it is another than the written."""
    if lesson.target_tempo_bpm > lesson.tempo_bpm:
        yield lesson.target_tempo_bpm * PPQ / lesson.beat_ticks


def _findings(lesson: Lesson, speed: float) -> Iterator[_Finding]:
    """All that is impossible at `speed`; what repeats is found more than once."""
    score, (first, last) = lesson.score.at_speed(speed), lesson.loop
    if not len(score):
        return
    yield from (_Finding(found.note, found) for found in impossible(score))
    in_loop = np.flatnonzero((score.bar >= first) & (score.bar <= last)).tolist()
    loop = score.bars(first, last)
    for found in impossible(loop.repeated(2)) if in_loop else ():
        if found.note >= len(in_loop):
            yield _Finding(in_loop[found.note - len(in_loop)], found, " as the loop starts again")
    if len(lesson.landing):
        landing = Score.from_array(lesson.landing, loop.tempo_map)
        for found in impossible(Score.joined([loop, landing])):
            if found.note >= len(in_loop):
                yield _Finding(None, found, " on the landing")


def _words(lesson: Lesson, found: _Finding, goal_bpm: float | None, beat_ticks_at: Callable[[int], int]) -> str:
    share = found.what.playable_at
    if share is None:
        return found.what.text + found.when
    tempo = goal_bpm or _tempo_at(lesson, found.row, beat_ticks_at)
    at = f"the goal of {tempo:g}" if goal_bpm else f"{tempo:g}"
    return f"too fast at {at}: {found.what.text}{found.when}; playable up to {_floored(tempo * share):g} bpm"


def _tempo_at(lesson: Lesson, row: int | None, beat_ticks_at: Callable[[int], int]) -> float:
    """The tempo that is written where `row` stands, as a teacher counts it there; at the loop's start for a landing."""
    tempo_map = lesson.score.tempo_map
    tick = tempo_map.bar_start(lesson.loop[0]) if row is None else int(lesson.score.notes["tick"][row])
    return round(tempo_map.bpm_at(tick) * PPQ / beat_ticks_at(tick), 1)


def _floored(bpm: float) -> float:
    """The tempo rounded down, so that it can be played."""
    parts = 1 if bpm >= _COARSE_FROM_BPM else 10
    return floor(bpm * parts + 1e-6) / parts
