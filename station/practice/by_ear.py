"""A bar of a session to be heard: as the teacher plays it, and as the student did, both to the click.

The two begin alike, a breath before the bar, so that a stroke that came early is heard. A stroke of the student's
belongs to the bar of the note that it answers, else to the bar of its own time.
"""

from dataclasses import replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.performance import Performance
from station.practice.click import PLAIN, click_cues
from station.practice.listening import RING_NS, Listening, played_cues, stretch
from station.practice.plan import demonstration_cues
from station.practice.session import SessionResult

BREATH_NS = 250 * NS_PER_MS
"""How long before the bar it begins; our choice: as early as a stroke is judged."""


class Whose(Enum):
    """Who is heard."""

    TEACHER = "teacher"
    STUDENT = "student"


def bar_by_ear(result: SessionResult, bar: int, whose: Whose) -> Listening:
    """The result's `bar`, from 0, as it was written or played."""
    tempo_map = result.score.tempo_map
    start_ns, end_ns = (int(ns) for ns in tempo_map.ns_at([tempo_map.bar_start(bar), tempo_map.bar_start(bar + 1)]))
    from_ns = start_ns - BREATH_NS
    pattern = replace(result.plan.click or PLAIN, gap=None)
    one = result.score.bars(bar, bar)
    clicks = _moved(click_cues(one.tempo_map, one.end_tick, pattern), start_ns)
    strokes = _moved(demonstration_cues(one), start_ns) if whose is Whose.TEACHER else _students(result, bar)
    cues = np.concatenate([clicks, strokes])
    cues = stretch(cues[np.argsort(cues["at_ns"], kind="stable")], from_ns, end_ns + RING_NS)
    return Listening(cues, end_ns - from_ns + RING_NS, from_ns)


def _students(result: SessionResult, bar: int) -> NDArray[np.void]:
    tempo_map, performance = result.score.tempo_map, result.performance
    hits, note = performance.hits, result.alignment.note_of_hit
    ticks = _ticks(result, hits["at_ns"])
    ticks[note >= 0] = result.score.notes["tick"][note[note >= 0]]
    mine = hits[tempo_map.bars_at(np.maximum(ticks, 0)) == bar]
    chokes = performance.chokes
    grabbed = chokes[tempo_map.bars_at(np.maximum(_ticks(result, chokes["at_ns"]), 0)) == bar]
    return played_cues(Performance.from_array(mine.copy(), grabbed.copy()))


def _ticks(result: SessionResult, at_ns: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.asarray(result.score.tempo_map.ticks_at_ns(at_ns), np.int64)


def _moved(cues: NDArray[np.void], by_ns: int) -> NDArray[np.void]:
    moved = cues.copy()
    moved["at_ns"] += by_ns
    return moved
