"""Signs of life that no note asks for: breathing and blinking, by chance but alike in every run of one seed."""

import math
from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BREATH_S = 3.8
"""A breath at light work, 16 a minute (our choice)."""
BREATH_M = 0.004
"""How far it lifts the shoulders (our choice)."""
BLINK_S = 0.16
BLINK_EVERY_S = 4.0
"""People blink about 15 times a minute, each for about 0.15 s (our choice)."""


@dataclass(frozen=True, eq=False)
class Blinks:
    """When the eyes close: `start_s` (n,) in order."""

    start_s: list[float]

    @classmethod
    def of(cls, from_s: float, to_s: float, seed: int) -> "Blinks":
        """Blinks at random intervals of at least a second between the two times."""
        random = np.random.default_rng([seed, 1])
        count = int((to_s - from_s) / BLINK_EVERY_S * 1.5) + 2
        starts = from_s + np.cumsum(1.0 + random.exponential(BLINK_EVERY_S - 1.0, count))
        return cls(starts[starts < to_s].tolist())

    def at(self, time_s: float) -> float:
        """How far the eyes are open, 0 … 1."""
        i = bisect_right(self.start_s, time_s) - 1
        if i < 0 or time_s - self.start_s[i] > BLINK_S:
            return 1.0
        return abs(2 * (time_s - self.start_s[i]) / BLINK_S - 1)

    def many(self, time_s: Array) -> Array:
        """How far the eyes are open at each time."""
        return np.array([self.at(t) for t in time_s.tolist()])


BREATH_RATE = 2 * math.pi / BREATH_S
