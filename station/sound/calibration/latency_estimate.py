"""A latency as it was measured: signed, with its interval, and with what speaks against trusting it.

Milliseconds; positive means later than reported. `doubts` are reasons not to trust the figure, `remarks` what a user
should know beside it. A doubtful estimate is reported, and stored only by somebody who insists.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_quantile_95

Floats = NDArray[np.float64]

OUTLIER_SDS = 4.0
"""Values this far from the median, in robust SDs, are something else than what was asked for (our choice)."""
MIN_SD_MS = 0.3
"""The robust SD never counts as less, lest values that all but agree throw each other out: USB's polling (ANCHORS)."""
_MAD_PER_SD = 0.6745
"""The median absolute deviation of a normal distribution with SD 1."""
MIN_COUNT = 3
"""Fewer values have no interval worth the name (our choice)."""
MAX_HALF_MS = 3.0
"""An interval wider than this to either side is doubtful: half of the 6 ms that an ear notices (HUMANS)."""


@dataclass(frozen=True, slots=True)
class LatencyEstimate:
    """`value_ms` and its 95 % interval; `sd_ms` of single measurements, `count` of them."""

    value_ms: float
    low_ms: float
    high_ms: float
    sd_ms: float
    count: int
    doubts: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()

    @property
    def trusted(self) -> bool:
        """Whether nothing speaks against it."""
        return not self.doubts

    @property
    def half_ms(self) -> float:
        """Half the interval's width."""
        return (self.high_ms - self.low_ms) / 2

    def doubted(self, *doubts: str) -> Self:
        """The same with further doubts."""
        return replace(self, doubts=self.doubts + doubts)

    def less(self, known_ms: float) -> Self:
        """What is left of it when `known_ms` belong to something else."""
        return replace(
            self,
            value_ms=self.value_ms - known_ms,
            low_ms=self.low_ms - known_ms,
            high_ms=self.high_ms - known_ms,
        )

    def remarked(self, *remarks: str) -> Self:
        """The same with further remarks."""
        return replace(self, remarks=self.remarks + remarks)


def inliers(values: Floats) -> NDArray[np.bool_]:
    """Which of `values` (n,) belong together: those near the median by the robust SD."""
    off = np.abs(values - np.median(values))
    scale = max(float(np.median(off)) / _MAD_PER_SD, MIN_SD_MS)
    kept: NDArray[np.bool_] = off <= OUTLIER_SDS * scale
    return kept


def estimate_of(
    rounds: Sequence[Floats], effective: float = 1.0, max_half_ms: float = MAX_HALF_MS
) -> LatencyEstimate | None:
    """The mean of what belongs together in `rounds`, each the values (ms) of one opening of the devices.

    A device may start a little sooner or later each time it is opened; so with several rounds the interval is at least
    that of the rounds' own means. `effective` is the share of the values that are independent. None of fewer than
    `MIN_COUNT` values. Doubts an interval beyond `max_half_ms` to either side.
    """
    values = np.concatenate([np.asarray(each, np.float64) for each in rounds]) if rounds else np.empty(0)
    if len(values) < MIN_COUNT:
        return None
    kept = inliers(values)
    which = np.repeat(np.arange(len(rounds)), [len(each) for each in rounds])[kept]
    good = values[kept]
    sd_ms = float(np.std(good, ddof=1)) if len(good) > 1 else 0.0
    free = max(effective * len(good), 2.0)
    half = t_quantile_95(free - 1.0) * sd_ms / free**0.5
    means = np.array([good[which == each].mean() for each in np.unique(which)])
    value = float(means.mean())
    if len(means) > 1:
        half = max(half, t_quantile_95(len(means) - 1.0) * float(np.std(means, ddof=1)) / len(means) ** 0.5)
    found = LatencyEstimate(value, value - half, value + half, sd_ms, len(good))
    if half > max_half_ms:
        return found.doubted(f"the measurements scatter: ± {half:.1f} ms")
    return found
