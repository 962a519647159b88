"""The maximum of E(φ) = E1(φ) − λE2(φ) among the centres, and beside the best by a parabola (paper, § 3.2, 10 to 18).

Phases are *places* here: in steps between centres, place j at centre μ_j.
"""

from math import floor, sqrt
from typing import Any

import numpy as np
import numpy.typing as npt

from station.sync.signals.signal import FloatArray

Best = tuple[int, float, float, float, float]
"""Where E is largest: at which centre (from 0), and how many steps from there; E itself, and E1 at the centre; how many
steps from the expected place."""

_FEW = 8
"""So many centres are looked at faster one by one than as an array (measured: 12 take as long either way)."""
Offsets = npt.NDArray[np.int64]


class Objective:
    """Finds the best place for n_m = `count` centres and λ = `smoothing`.

    Of two centres that are alike the one nearer to the expected place wins. A centre that lies d steps away, where
    the nearest is at most 1/2 step away, cannot win if λ(d² − 1/4) > 2n_m², for E1 lies in [−1, 1].
    """

    def __init__(self, count: int, smoothing: float) -> None:
        self.count, self.price = count, smoothing / count**2
        self.offsets = by_nearness(reach(count, smoothing), count)
        self._few: list[int] = self.offsets.tolist() if len(self.offsets) <= _FEW else []
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
            offset = self._searched(products, per_length, near, rest)
            below, here, above = (self._value(products, per_length, near, rest, offset + side) for side in (-1, 0, 1))
            near = (near + offset) % count
            rest -= offset
            likeness = item(near) * per_length
        a, b = 0.5 * (above + below) - here, 0.5 * (above - below)
        x = -b / (2 * a) if a < 0 else 0.0
        surprise = x - rest
        return near, x, here + 0.5 * b * x, likeness, surprise - count * round(surprise / count)

    def _searched(self, products: FloatArray, per_length: float, near: int, rest: float) -> int:
        """Which of all centres that can win does, by how far it lies from the one nearest to the expected place."""
        if len(self._few):
            values = [self._value(products, per_length, near, rest, offset) for offset in self._few]
            return self._few[values.index(max(values))]
        likeness = products.take((self.offsets + near) % self.count) * per_length
        return int(self.offsets[(likeness - self.price * self.short(self.offsets - rest) ** 2).argmax()])

    def _value(self, products: FloatArray, per_length: float, near: int, rest: float, offset: int) -> float:
        """E at the centre that lies `offset` from the nearest."""
        count, steps = self.count, offset - rest
        steps -= count * round(steps / count)
        return products.item((near + offset) % count) * per_length - self.price * steps * steps

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
