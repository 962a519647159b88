"""What the body reads off a score: its beats, how hard and how dense it is around each, and where the drums are struck.

Times in seconds from tick 0. The head's bob is scaled by two cofactors (thesis § 4.2.1, figure 4.13).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.music.score import Score

Array = NDArray[np.float64]

LEAD_IN_BEATS = 8
"""Beats before the score's start at which the body already moves: the count-in."""
LEAD_OUT_BEATS = 4

STRIKE_RANGE_S = 0.025
"""Onsets this near to the beat are on it (thesis)."""
EACH_NOTE = 0.10
"""What every onset on the beat adds to the velocity cofactor (thesis)."""
NEARNESS = 1.5
"""The constant c of the density cofactor: rests near the beat weigh more (thesis: 0.5–3)."""
SILENT_BOB = 0.3
"""The velocity cofactor of a beat on which nothing is struck: the head still keeps time (our choice)."""
SILENT_BEATS = 2
"""After so many beats without a stroke the music starts again (our choice)."""
_LOUD = tuple(set(Piece) - {Piece.HIHAT, Piece.HIHAT_PEDAL, Piece.RIDE, Piece.RIDE_2})


@dataclass(frozen=True, eq=False)
class Beats:
    """The felt beats, from before the score to after it: the meter's pulses (`MeterChange.pulses`).

    `time_s` (n,); `in_bar` (n,) which beat of its bar each is, from 0, and `of_bar` (n,) how many the bar has.
    """

    time_s: Array
    in_bar: NDArray[np.int64]
    of_bar: NDArray[np.int64]

    @classmethod
    def of(cls, score: Score) -> "Beats":
        """The beats of `score`, its tempo and meter changes followed."""
        tempo_map, end = score.tempo_map, max(score.end_tick, 1)
        felt = []
        for tick, index in tempo_map.beats_between(0, end):
            meter = tempo_map.meter_at(tick)
            starts = [start // meter.beat_ticks for start, _ in meter.pulses]
            if index in starts:
                felt.append((tick, starts.index(index), len(starts)))
        inside = tempo_map.seconds_at(np.array([*(f[0] for f in felt), end], np.int64))
        first = float(inside[1] - inside[0])
        last = float(inside[-2] - inside[-3]) if len(inside) > 2 else first  # the last beat may be cut short
        lead_in, lead_out = np.arange(-LEAD_IN_BEATS, 0), np.arange(1, LEAD_OUT_BEATS + 1)
        opening, closing = felt[0][2], felt[-1]
        return cls(
            np.concatenate((inside[0] + first * lead_in, inside[:-1], inside[-2] + last * lead_out)),
            np.concatenate((lead_in % opening, [f[1] for f in felt], (closing[1] + lead_out) % closing[2])),
            np.array([opening] * LEAD_IN_BEATS + [f[2] for f in felt] + [closing[2]] * LEAD_OUT_BEATS),
        )

    @property
    def rate_bpm(self) -> Array:
        """Felt beats a minute from each beat on, (n,)."""
        steps = np.diff(self.time_s)
        return 60.0 / np.concatenate((steps, steps[-1:]))

    @property
    def with_middles(self) -> Array:
        """The beats and the middles between them, (2n − 1,)."""
        times = np.empty(2 * len(self.time_s) - 1)
        times[::2] = self.time_s
        times[1::2] = 0.5 * (self.time_s[1:] + self.time_s[:-1])
        return times


def restarts(beats_s: Array, onset_s: Array) -> NDArray[np.bool_]:
    """The beats (n,) with or just before a stroke that follows a silence of `SILENT_BEATS`; onsets in order."""
    found = np.zeros(len(beats_s), np.bool_)
    if len(onset_s):
        beat = np.clip(np.searchsorted(beats_s, onset_s + STRIKE_RANGE_S) - 1, 0, len(beats_s) - 1)
        found[beat[np.diff(beat, prepend=-SILENT_BEATS) > SILENT_BEATS]] = True
    return found


def on_odd_beats(beats: Beats) -> NDArray[np.bool_]:
    """The first, third … beats of each bar, but not the last before another bar's first, (n,)."""
    return np.asarray((beats.in_bar % 2 == 0) & ((beats.in_bar + 1 < beats.of_bar) | (beats.of_bar == 1)))


def bob_cofactors(beats_s: Array, onset_s: Array, velocity: Array, piece: NDArray[np.uint8]) -> Array:
    """Velocity times density cofactor of each beat, (n,); onsets (m,) in order of time, velocities 1–127."""
    return _velocity(beats_s, onset_s, velocity, piece) * _density(beats_s, onset_s)


def _velocity(beats_s: Array, onset_s: Array, velocity: Array, piece: NDArray[np.uint8]) -> Array:
    near = _nearest(beats_s, onset_s)
    counts = np.isin(piece, _LOUD) & (np.abs(onset_s - beats_s[near]) <= STRIKE_RANGE_S)
    number = np.bincount(near[counts], minlength=len(beats_s))
    total = np.bincount(near[counts], velocity[counts] / 127, len(beats_s))
    loud = total / np.maximum(number, 1) * (1 + EACH_NOTE * number)
    return np.where(number > 0, np.maximum(loud, SILENT_BOB), SILENT_BOB)


def _density(beats_s: Array, onset_s: Array) -> Array:
    middles = 0.5 * (beats_s[1:] + beats_s[:-1])
    after = _rest(beats_s[:-1] + STRIKE_RANGE_S, middles, onset_s)
    before = _rest(-beats_s[1:] + STRIKE_RANGE_S, -middles, -onset_s[::-1], backwards=True)
    one = np.ones(1)
    return np.maximum(np.concatenate((one, before)), np.concatenate((after, one)))


def _rest(start: Array, end: Array, onset: Array, backwards: bool = False) -> Array:
    """How much rest each stretch from `start` out to `end` has, 0 … 1, the nearer to `start` the weightier.

    The onsets within divide a stretch of w seconds into parts wᵢ, i = 0, 1, … outward: Σ wᵢ/(1 + ic)/w.
    """
    if backwards:  # stretches rise with the index only forwards
        return _rest(start[::-1], end[::-1], onset)[::-1]
    width = np.maximum(end - start, 1e-9)
    stretch = np.searchsorted(start, onset, side="left") - 1
    inside = (stretch >= 0) & (onset > start[np.maximum(stretch, 0)]) & (onset < end[np.maximum(stretch, 0)])
    stretch, onset = stretch[inside], onset[inside]
    fresh = np.diff(stretch, prepend=-1) != 0
    order = np.arange(len(onset)) - np.maximum.accumulate(np.where(fresh, np.arange(len(onset)), 0))
    previous = np.where(fresh, start[stretch], np.concatenate(([0.0], onset[:-1])))
    rested = np.bincount(stretch, (onset - previous) / (1 + order * NEARNESS), len(start))
    number = np.bincount(stretch, minlength=len(start))
    last = start.copy()
    last[stretch] = onset  # the last onset of a stretch is written last
    return np.asarray((rested + (end - last) / (1 + number * NEARNESS)) / width)


def _nearest(beats_s: Array, onset_s: Array) -> NDArray[np.int64]:
    after = np.clip(np.searchsorted(beats_s, onset_s), 1, len(beats_s) - 1)
    return np.where(onset_s - beats_s[after - 1] < beats_s[after] - onset_s, after - 1, after)
