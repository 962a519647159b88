"""A bar of a session to be heard: as the teacher plays it, as the student did, and as in an earlier session.

All begin alike, to the click, a breath before the bar, so that a stroke that came early is heard. A stroke of the
student's belongs to the bar of the note that it answers, else to the bar of its own time. Those of an earlier session
fall as many seconds from their beats as they fell then, whatever the tempo.
"""

from dataclasses import replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S
from station.music.performance import Performance
from station.practice.records.previous_session import PreviousSession
from station.practice.session.cues.click_pattern import PLAIN, click_cues
from station.practice.session.cues.listening import RING_NS, Listening, cues_between, played_cues
from station.practice.session.cues.stroke_cues import demonstration_cues, moved_by
from station.practice.session.session import SessionResult

BREATH_NS = 250 * NS_PER_MS
"""How long before the bar it begins; our choice: as early as a stroke is judged."""


class Whose(Enum):
    """Who is heard: `PREVIOUS` is the student in an earlier session."""

    TEACHER = "teacher"
    STUDENT = "student"
    PREVIOUS = "earlier"


def bar_by_ear(result: SessionResult, bar: int, played: Performance | None) -> Listening:
    """The result's `bar`, from 0, as it was `played` (in the time of the result's score), or as it is written."""
    start_ns, end_ns = _span_ns(result, bar)
    from_ns = start_ns - BREATH_NS
    pattern = replace(result.plan.click or PLAIN, gap=None)
    one = result.score.bars(bar, bar)
    clicks = moved_by(click_cues(one.tempo_map, one.end_tick, pattern), start_ns)
    strokes = moved_by(demonstration_cues(one), start_ns) if played is None else played_cues(played)
    cues = np.concatenate([clicks, strokes])
    cues = cues_between(cues[np.argsort(cues["at_ns"], kind="stable")], from_ns, end_ns + RING_NS)
    return Listening(cues, end_ns - from_ns + RING_NS, from_ns)


def students_bar(result: SessionResult, bar: int) -> Performance:
    """What the student played in `bar`, from 0, of the result's score."""
    tempo_map, performance = result.score.tempo_map, result.performance
    hits, note = performance.hits, result.alignment.note_of_hit
    ticks = _ticks(result, hits["at_ns"])
    ticks[note >= 0] = result.score.notes["tick"][note[note >= 0]]
    mine = hits[tempo_map.bars_at(np.maximum(ticks, 0)) == bar]
    chokes = performance.chokes
    grabbed = chokes[tempo_map.bars_at(np.maximum(_ticks(result, chokes["at_ns"]), 0)) == bar]
    return Performance.from_array(mine.copy(), grabbed.copy())


def previous_bar(result: SessionResult, bar: int, previous: PreviousSession) -> Performance:
    """What was played earlier in the lesson's bar that is `bar`, from 0, of the result's score, laid over it."""
    tempo_map = result.score.tempo_map
    start = tempo_map.bar_start(bar)
    at, strokes = previous.in_bar(result.plan.bar_names[bar] + 1)
    ticks = start + np.round((at[:, 0] - 1) * tempo_map.meter_at(start).beat_ticks).astype(np.int64)
    strokes = strokes.copy()
    strokes["at_ns"] = tempo_map.ns_at(ticks) + np.round(at[:, 1] * NS_PER_S).astype(np.int64)
    return Performance.from_array(strokes)


def previous_tempo(result: SessionResult, bar: int, previous: PreviousSession) -> float | None:
    """At how many beats a minute, as the lesson counts them, `previous_bar` was played; None where nothing tells."""
    tempo_map = result.score.tempo_map
    seconds = previous.beat_s(result.plan.bar_names[bar] + 1)
    if seconds is None:
        return None
    return 60 / seconds * tempo_map.meter_at(tempo_map.bar_start(bar)).beat_ticks / result.plan.lesson.beat_ticks


def _span_ns(result: SessionResult, bar: int) -> tuple[int, int]:
    """From and until when `bar` is played."""
    tempo_map = result.score.tempo_map
    start_ns, end_ns = tempo_map.ns_at([tempo_map.bar_start(bar), tempo_map.bar_start(bar + 1)])
    return int(start_ns), int(end_ns)


def _ticks(result: SessionResult, at_ns: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.asarray(result.score.tempo_map.ticks_at_ns(at_ns), np.int64)
