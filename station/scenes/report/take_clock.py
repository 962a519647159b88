"""The clock of a take: when each tick of the score was, by the click or, without one, by the student.

The take's time 0 is the start of the count-in, so many bars before the score's tick 0 that no stroke comes before it.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.core.units import NS_PER_S, PPQ
from station.music.judgement import Label
from station.music.score import Score
from station.music.tempo import TempoChange, TempoMap
from station.practice.session.cues.click_pattern import count_in
from station.practice.session.session import EARLIEST_NS, SessionResult

Array = NDArray[np.float64]

_US_PER_S = 1_000_000


@dataclass(frozen=True, eq=False)
class TakeClock:
    """`count_in` is its length in ns and ticks; `tempo_map` the take's, from the count-in on.

    `ticks` of the score (k,) and their times `time_s` (k,) in the take both rise; straight between.
    """

    lead_ns: int
    lead: Score
    tempo_map: TempoMap
    ticks: Array
    time_s: Array

    @classmethod
    def of(cls, result: SessionResult) -> "TakeClock":
        """The clock of a session."""
        lead, score = _lead(result), result.plan.score
        lead_ns = lead.length_ns
        joined = Score.joined([lead, score]).tempo_map
        ticks = np.arange(0, score.end_tick + PPQ, PPQ)
        if result.plan.click is not None:
            return cls(
                lead_ns, lead, joined, ticks.astype(np.float64), (lead_ns + score.tempo_map.ns_at(ticks)) / NS_PER_S
            )
        own_ticks, time_s = _by_student(result)
        clock = cls(lead_ns, lead, joined, own_ticks, np.asarray(time_s + lead_ns / NS_PER_S, np.float64))
        return cls(lead_ns, lead, clock._own_tempi(score), clock.ticks, clock.time_s)

    def seconds_at(self, ticks: ArrayLike) -> Array:
        """When ticks of the score are in the take."""
        return np.asarray(np.interp(np.asarray(ticks, np.float64), self.ticks, self.time_s))

    def _own_tempi(self, score: Score) -> TempoMap:
        """The tempo of each bar as the student played it, the count-in's until they came in."""
        starts = [score.tempo_map.bar_start(bar) for bar in range(score.bar_count + 1)]
        at_s = [0.0, *self.seconds_at(starts).tolist()]
        places = [0, *(self.lead.end_tick + start for start in starts)]
        tempi = [
            TempoChange(tick, max(1, round(_US_PER_S * (until_s - from_s) * PPQ / (until - tick))))
            for (tick, until), (from_s, until_s) in zip(pairwise(places), pairwise(at_s), strict=True)
        ]
        return TempoMap.build(tempi, self.tempo_map.meters, is_played=True)


def _lead(result: SessionResult) -> Score:
    """The count-in: the bar before the section, more of them where it is very short."""
    section = result.plan.section
    pickup = section.tempo_map.pickup_ticks(section.end_tick)
    for bars in range(1, 9):
        tempo_map, ticks = count_in(section.tempo_map, bars, pickup)
        lead = Score.from_notes([], tempo_map, ticks)
        if lead.length_ns > 2 * EARLIEST_NS:
            break
    return lead


def _by_student(result: SessionResult) -> tuple[Array, Array]:
    """Ticks of the score and when they were due by how the student played, seconds from the passes' start."""
    score, alignment = result.score, result.alignment
    played = (alignment.note_label == Label.MATCH) & ~score.is_grace
    hit_ns = result.performance.hits["at_ns"][alignment.hit_of_note[played]]
    due_s = (hit_ns - alignment.asynchrony_ns[played]) / NS_PER_S
    end_tick = result.plan.score.end_tick + PPQ
    if not played.any():
        return np.array([0.0, end_tick]), np.asarray(score.tempo_map.seconds_at([0, end_tick]))
    ticks, first = np.unique(score.notes["tick"][played], return_index=True)
    due_s = np.maximum.accumulate(due_s[first])
    before_s = score.tempo_map.seconds_at([0, int(ticks[0])])
    after_s = score.tempo_map.seconds_at([int(ticks[-1]), end_tick])
    knots = np.concatenate([[-1e-3], ticks, [end_tick + 1e-3]])
    times = [due_s[0] - np.diff(before_s)[0], *due_s, due_s[-1] + np.diff(after_s)[0]]
    return knots, np.asarray(times)
