"""When a student has stopped, and where a session goes on after a pause.

Two bars that contain notes and get none mean that the student has stopped (TEACHING, detail 2). A session goes on from
the start of the bar in which the last stroke fell, after a bar of count-in: what was played from there on is played
again and counts once, as it is played last. So the score stays one line of time, and every note is judged once
(docs/decisions/0026). Score time is ns from tick 0 of the plan's score, plan time ns from the plan's beginning.
"""

from bisect import bisect_left, bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.score import Score
from station.practice.session.cues.click_pattern import PLAIN, click_cues, count_in, counting, leads_ns
from station.practice.session.plan import Plan

SILENT_BARS = 2
"""TEACHING, detail 2: auto-pause after two bars that contain notes and get none."""
NEAR_NS = 100 * NS_PER_MS
"""A stroke so near a bar may belong to it: the judgement's usual reach (`matching.hit_windows`)."""


@dataclass(frozen=True, slots=True)
class SessionPause:
    """A pause: the bar of the score, from 0, from which the session went on, and how many strokes were played again.

    `asked` tells a pause that the student asked for from one that came of silence.
    """

    bar: int
    asked: bool
    strokes: int


@dataclass(frozen=True, eq=False)
class TransportRun:
    """A run of the transport over a plan: the score is judged `from_ns` on, plan time is the transport's + `jump_ns`.

    It is counted in until `from_ns`; `cues` are what sounds, on the transport.
    """

    from_ns: int
    jump_ns: int
    cues: NDArray[np.void]


class Silence:
    """Counts the bars of a score that got nothing."""

    def __init__(self, score: Score) -> None:
        bars = np.unique(score.bar).tolist()
        tempo_map = score.tempo_map
        self._starts: list[int] = [int(tempo_map.ns_at(tempo_map.bar_start(bar))) for bar in bars]
        self._ends: list[int] = [int(tempo_map.ns_at(tempo_map.bar_start(bar + 1))) for bar in bars]

    def bars(self, last_ns: int | None, from_ns: int, now_ns: int) -> int:
        """Bars with notes, wholly over at `now_ns`, since the last stroke at `last_ns`, or since `from_ns` without."""
        since_ns = from_ns if last_ns is None else max(last_ns + NEAR_NS, from_ns)
        return bisect_right(self._ends, now_ns - NEAR_NS) - bisect_left(self._starts, since_ns)


def bar_of(score: Score, at_ns: int | None) -> int:
    """The bar, from 0, that holds `at_ns`; the first for what comes before it, and for None."""
    if at_ns is None or at_ns < 0:
        return 0
    return min(int(score.tempo_map.bars_at([score.tempo_map.ticks_at_ns(at_ns)])[0]), score.bar_count - 1)


def start_of(score: Score, bar: int) -> int:
    """When `bar` begins, in score time."""
    return int(score.tempo_map.ns_at(score.tempo_map.bar_start(bar)))


def from_bar(plan: Plan, bar: int) -> TransportRun:
    """The rest of the passes from `bar` of the score on, behind a bar of count-in in its tempo and meter."""
    from_ns = start_of(plan.score, bar)
    empty, end_tick = count_in(plan.score.bars(bar, bar).tempo_map, 1)
    length_ns = int(empty.ns_at(end_tick))
    start_ns = plan.passes_start_ns + from_ns
    rest = plan.cues[plan.cues["at_ns"] + leads_ns(plan.cues) >= start_ns].copy()
    rest["at_ns"] += length_ns - start_ns
    cues = np.concatenate([click_cues(empty, end_tick, counting(plan.click or PLAIN)), rest])
    return TransportRun(from_ns, start_ns - length_ns, cues[np.argsort(cues["at_ns"], kind="stable")])
