"""The angles of both arms over time as the graph shows them: sampled in stretches, when they are first looked at.

A stretch of `STRETCH_S` takes a few milliseconds; only those in sight are sampled, and kept as long as the drummer is
the same. Degrees; seconds from the score's tick 0.
"""

from dataclasses import dataclass
from math import ceil, floor

import numpy as np
from numpy.typing import NDArray

from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.pose import ANGLE_NAMES

Array = NDArray[np.float64]

STRETCH_S = 2.0
RATE_HZ = 120
"""Twice what a screen shows; strikes have samples of their own, so that no corner is cut off (our choice)."""
MOST_CACHED = 64
"""Stretches kept: two minutes, more than one looks at together (our choice)."""


@dataclass(frozen=True, slots=True)
class JointCurve:
    """One angle: its name in `ANGLE_NAMES`, the joint in words, and whose arm it is."""

    angle: str
    joint: str
    right: bool

    @property
    def label(self) -> str:
        """As the legend says it."""
        return f"{'right' if self.right else 'left'} {self.joint}"


CURVES = tuple(
    JointCurve(f"{'right' if right else 'left'}_{joint}", joint, right)
    for right in (True, False)
    for joint in ("shoulder", "elbow", "wrist")
)
"""Shoulder forward from hanging, elbow bent, wrist bent back (`station.motion.kinematics.pose`)."""
_COLUMNS = [ANGLE_NAMES.index(curve.angle) for curve in CURVES]


class JointCurves:
    """The curves of one drummer."""

    def __init__(self, drummer: Drummer) -> None:
        self.drummer = drummer
        self._onset_s = np.sort(drummer.score.onset_s)
        self._stretches: dict[int, tuple[Array, Array]] = {}
        self._shown: tuple[int, int] | None = None
        self._joined = (np.empty(0), np.empty((0, len(CURVES))))

    def between(self, low_s: float, high_s: float) -> tuple[Array, Array]:
        """Times (n,) that cover `low_s` … `high_s`, in order, and the angles then in degrees, (n, 6) by `CURVES`.

        At most `MOST_CACHED` stretches from `low_s` on: who looks at more at once sees no curve any more.
        """
        first = floor(low_s / STRETCH_S)
        last = min(ceil(high_s / STRETCH_S), first + MOST_CACHED)
        if (first, last) != self._shown:
            if len(self._stretches) > MOST_CACHED:
                self._stretches = {i: s for i, s in self._stretches.items() if first <= i < last}
            parts = [self._stretch(index) for index in range(first, last)]
            self._shown = first, last
            self._joined = np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])
        return self._joined

    def _stretch(self, index: int) -> tuple[Array, Array]:
        if index not in self._stretches:
            low, high = index * STRETCH_S, (index + 1) * STRETCH_S
            struck = self._onset_s[(self._onset_s >= low) & (self._onset_s < high)]
            time_s = np.union1d(np.linspace(low, high, round(STRETCH_S * RATE_HZ), endpoint=False), struck)
            angles = np.degrees(self.drummer.rows(time_s)[:, frame.ANGLES][:, _COLUMNS])
            self._stretches[index] = time_s, angles
        return self._stretches[index]
