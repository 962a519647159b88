"""The levels of the mixer's buses: how loud each is, and on which side, brought in a short ramp to what is set.

Pure numpy, in frames of the card; a bus's level has a factor for each side.
"""

import numpy as np
from numpy.typing import NDArray

from station.sound.buses import Bus
from station.sound.drum_kit import Frames

LEVEL_SLEW_S = 0.01
"""A bus takes so long to a new level: no zipper noise."""


def sides_of(pan: float) -> tuple[float, float]:
    """The factors of left and right for `pan` −1 … 1: the far side is lowered, the near one kept."""
    pan = min(1.0, max(-1.0, pan))
    return min(1.0, 1.0 - pan), min(1.0, 1.0 + pan)


class BusLevels:
    """The factors of every bus; `rate_hz` is the card's."""

    def __init__(self, rate_hz: int) -> None:
        self._slew = max(1, round(LEVEL_SLEW_S * rate_hz))
        self._now = np.ones((len(Bus), 2), np.float32)
        self._steps = np.zeros((len(Bus), 2), np.float32)
        self._targets = self._now.copy()
        self.moving = 0
        """The frames for which the levels still move: a piece that is mixed at once ends with them."""

    def set(self, bus: Bus, level: float, pan: float) -> None:
        """Set the level (0 silent, 1 full) and balance (−1 left … 1 right) of `bus`."""
        level = min(1.0, max(0.0, level))
        self._targets[bus] = [level * side for side in sides_of(pan)]
        self.moving = self._slew
        self._steps = (self._targets - self._now) / np.float32(self._slew)

    def sum(self, buses: NDArray[np.float32], out: Frames) -> None:
        """Write the sum of the `buses` (buses, frames, 2) at their levels to `out` (frames, 2), and move on."""
        if not self.moving:
            np.einsum("bnc,bc->nc", buses, self._now, out=out)
            return
        count = len(out)
        ramp = np.arange(count, dtype=np.float32)[None, :, None]
        np.einsum("bnc,bnc->nc", buses, self._now[:, None] + ramp * self._steps[:, None], out=out)
        self._now += count * self._steps
        self.moving -= count
        if not self.moving:
            self._now[:] = self._targets
