"""Brush sweeps: between its taps a brush stays on the snare and draws ovals, in time with the beat.

One oval a beat, of quick beats one for two. On the beat the tip is at the hand's own spot of the head, where it taps;
from there the oval goes out to the hand's own side, so that the brushes never meet. The hand that leads, which taps the
time, only swishes a little. A sweep begins when a stroke has come to rest and ends before the next is raised.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kinematics.maths import Number
from station.motion.strokes.hand_events import HandEvents
from station.motion.strokes.stroke import Strokes
from station.motion.strokes.stroke_template import KEYS

Array = NDArray[np.float64]

SWEEP_M, SWISH_M = 0.05, 0.02
"""Half the oval's length, from the player's left to right, of the other and of the leading hand (our choice)."""
_DEEP = 0.8
"""Its depth as a share of its length (our choice)."""
_EASE_S = 0.12
"""A sweep grows out of the spot and back into it in so long (our choice)."""
_SHORTEST_S = 0.3
"""Where there is less time between strokes the brush lies still (our choice)."""
QUICK_S = 0.4
"""Beats shorter than this have one oval for two (our choice)."""


@dataclass(frozen=True, eq=False)
class Sweeps:
    """One hand's sweeps: their `start_s` and `end_s` in order, where the beats are, how many turns are made by each.

    `along_m` is half the oval's length, to the right positive; `slope` how the head rises to the right and away.
    """

    start_s: list[float]
    end_s: list[float]
    beat_s: list[float]
    turns: list[float]
    along_m: float
    slope: tuple[float, float]

    @classmethod
    def of(
        cls, events: HandEvents, strokes: Strokes, beat_s: Array, along_m: float, normal: tuple[float, float, float]
    ) -> "Sweeps":
        """The sweeps between `events` whose `strokes` are keyed, from the first of the beats (m,) to the last."""
        knots = strokes.knots_s.reshape(4, -1, KEYS)
        start = np.concatenate(([-np.inf], knots[..., -1].max(0)))
        end = np.concatenate((knots[..., 0].min(0), [np.inf]))
        on = events.key[:, 0] == Piece.SNARE
        on = np.concatenate((on[:1], on)) & np.concatenate((on, on[-1:]))
        start, end = np.maximum(start, beat_s[0]), np.minimum(end, beat_s[-1])
        kept = on & (end - start > _SHORTEST_S)
        a_beat = 0.5 if np.median(np.diff(beat_s)) < QUICK_S else 1.0
        nx, ny, nz = normal
        return cls(
            start_s=start[kept].tolist(),
            end_s=end[kept].tolist(),
            beat_s=beat_s.tolist(),
            turns=(a_beat * np.arange(len(beat_s))).tolist(),
            along_m=along_m,
            slope=(-nx / nz, -ny / nz),
        )

    def at(self, time_s: float) -> tuple[Number, Number, Number]:
        """How far the tip is right, forward and up from where it taps, at one instant."""
        k = bisect_right(self.start_s, time_s) - 1
        if k < 0 or time_s >= self.end_s[k]:
            return 0.0, 0.0, 0.0
        u = min(min(time_s - self.start_s[k], self.end_s[k] - time_s) / _EASE_S, 1.0)
        size = u * u * u * (10 + u * (6 * u - 15)) * self.along_m
        b = bisect_right(self.beat_s, time_s, 1, len(self.beat_s) - 1)
        since, whole = time_s - self.beat_s[b - 1], self.beat_s[b] - self.beat_s[b - 1]
        turn = 2 * math.pi * (self.turns[b - 1] + (self.turns[b] - self.turns[b - 1]) * since / whole)
        x, y = size * (1 - math.cos(turn)), size * _DEEP * math.sin(turn)
        return x, y, x * self.slope[0] + y * self.slope[1]

    def many(self, time_s: Array) -> tuple[Number, Number, Number]:
        """The same at each time."""
        x, y, z = np.array([self.at(t) for t in time_s.tolist()], np.float64).reshape(-1, 3).T
        return x, y, z
