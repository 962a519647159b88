"""The maximum of E(φ) = E1(φ) − λE2(φ) among the centres, and beside the best by a parabola (paper, § 3.2, 10 to 18).

Phases are *places* here: in steps between centres, place j at centre μ_j.
"""

from math import floor, sqrt
from typing import Any

import numpy as np
import numpy.typing as npt

from station.sync.signals.signal import FloatArray

Best = tuple[int, float, float, float]
"""Where E is largest: at which centre (from 0), and how many steps from there; E itself, and E1 at the centre."""

Offsets = npt.NDArray[np.int64]


class Objective:
    """Finds the best place for n_m = `count` centres and λ = `smoothing`.

    Of two centres that are alike the one nearer to the expected place wins. A centre that lies d steps away, where
    the nearest is at most 1/2 step away, cannot win if λ(d² − 1/4) > 2n_m², for E1 lies in [−1, 1].
    """

    def __init__(self, count: int, smoothing: float) -> None:
        self.count, self.price = count, smoothing / count**2
        self.offsets = by_nearness(reach(count, smoothing), count)
        self._beyond_neighbours = 1 - self.price * 1.5**2

    def best(self, products: FloatArray, per_length: float, expected: float) -> Best:
        """The best place beside the `expected` one; E1 are the `products` (n_m,) times `per_length`."""
        count, price, item = self.count, self.price, products.item
        near = round(expected)
        rest = expected - near
        near %= count
        middle = near if 2 * near < count else near - count  # Python's negative indices go round
        likeness = item(middle) * per_length
        here = likeness - price * rest * rest
        above = item(middle + 1) * per_length - price * (1 - rest) * (1 - rest)
        below = item(middle - 1) * per_length - price * (1 + rest) * (1 + rest)
        if here < above or here < below or here < self._beyond_neighbours:
            return self._searched(products * per_length, near, rest)
        a, b = 0.5 * (above + below) - here, 0.5 * (above - below)
        x = -b / (2 * a) if a < 0 else 0.0
        return near, x, here + 0.5 * b * x, likeness

    def _searched(self, likeness: FloatArray, near: int, rest: float) -> Best:
        """The same, from all centres that can win."""
        apart = self.short(self.offsets - rest)
        at = (self.offsets + near) % self.count
        offset = int(self.offsets[(likeness[at] - self.price * apart**2).argmax()])
        around = np.array([offset - 1, offset, offset + 1])
        below, here, above = (
            likeness[(around + near) % self.count] - self.price * self.short(around - rest) ** 2
        ).tolist()
        a, b = 0.5 * (above + below) - here, 0.5 * (above - below)
        x = -b / (2 * a) if a < 0 else 0.0
        centre = (near + offset) % self.count
        return centre, x, here + 0.5 * b * x, float(likeness[centre])

    def short(self, steps: npt.NDArray[np.floating[Any]]) -> FloatArray:
        """Steps the short way round."""
        short: FloatArray = steps - self.count * np.rint(steps / self.count)
        return short


def reach(count: int, smoothing: float) -> int:
    """How many centres to each side of the one nearest to the expected place can win."""
    if smoothing <= 0:
        return count // 2
    return min(floor(0.5 + sqrt(2 * count**2 / smoothing + 0.25)), count // 2)


def by_nearness(most: int, count: int) -> Offsets:
    """The offsets 0, −1, 1, −2, 2 … up to `most`, each of `count` centres at most once."""
    return np.array(([0] + [side * ring for ring in range(1, most + 1) for side in (-1, 1)])[:count])
