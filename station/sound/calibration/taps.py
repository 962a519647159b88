"""Latency by tapping along: equipment and habit together, which nothing that is tapped can tell apart.

Whoever taps to a click taps early as a rule; so a lean says nothing of the equipment unless it is greater than
people's. `total` is what was measured; `equipment` what is left for the equipment when the habit lies in `HABIT_MS`; it
is never free of doubt. Where the equipment is known from elsewhere the rest is the habit.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.core.units import NS_PER_MS
from station.sound.calibration.latency_estimate import Floats, LatencyEstimate, estimate_of

HABIT_MS = (-40.0, 10.0)
"""How far people tap beside a click, early negative: professionals 2 to 16 ms early (HUMANS, Timing), others up to
three times as much (our choice after the static lean's SD of 11 ms there)."""
EARLIEST = 0.25
"""So much of the click's interval before it a tap belongs to it, the rest of the interval after it (our choice)."""
SETTLING = 4
"""The first taps find the tempo and do not count (our choice)."""
ENOUGH_TAPS = 12
TOGETHER = 0.8
"""The mean resultant length of the taps' phases below which they do not follow the click (our choice: an SD of a tenth
of the interval)."""
MAX_HALF_MS = 10.0
"""An interval wider than this is doubtful: half the width that people's habits have (our choice)."""
_MAX_LAG_1 = 0.9


@dataclass(frozen=True, slots=True)
class Taps:
    """`total` equipment and habit together; `equipment` what may be the equipment's share, always in doubt."""

    total: LatencyEstimate
    equipment: LatencyEstimate

    def habit(self, equipment_ms: float) -> LatencyEstimate:
        """The player's own lean, early negative, where the equipment's latency is known."""
        return self.total.less(equipment_ms)


def taps(stamps_ns: NDArray[np.int64], clicks_ns: NDArray[np.int64]) -> Taps:
    """How much later than the clicks (m,), evenly spaced, taps (n,) were stamped; raises `DeviceError` of too few."""
    interval_ns = float(np.median(np.diff(clicks_ns)))
    offsets_ms, together = _offsets_ms(np.sort(stamps_ns), clicks_ns, interval_ns)
    offsets_ms = offsets_ms[SETTLING:]
    if len(offsets_ms) < ENOUGH_TAPS:
        raise DeviceError(f"too few taps: {len(offsets_ms)} after the first {SETTLING}; tap along with every click")
    total = estimate_of([offsets_ms], _independent(offsets_ms), MAX_HALF_MS)
    assert total is not None, "there are enough taps"
    if together < TOGETHER:
        total = total.doubted("the taps do not follow the click")
    return Taps(total, _equipment(total))


def _offsets_ms(stamps_ns: NDArray[np.int64], clicks_ns: NDArray[np.int64], interval_ns: float) -> tuple[Floats, float]:
    """Each tap's distance from its own click, all about one common delay; and how well they agree (0 to 1).

    A card that stalls shifts the clicks after it: what a tap is measured by is the click it belongs to, and no grid.
    """
    step = round(interval_ns)
    clicks = np.concatenate([[clicks_ns[0] - step], clicks_ns, [clicks_ns[-1] + step]])
    stamps = stamps_ns[(stamps_ns > clicks[0]) & (stamps_ns < clicks[-1])]
    if len(stamps) == 0:
        return np.empty(0), 0.0
    before = np.searchsorted(clicks, stamps, side="right") - 1
    phase = (stamps - clicks[before]) / interval_ns
    mean = np.exp(2j * np.pi * phase).mean()
    common = (np.angle(mean) / (2 * np.pi) + EARLIEST) % 1.0 - EARLIEST
    off = (phase - common + 0.5) % 1.0 - 0.5 + common
    own = np.clip(before + np.round(phase - off).astype(np.int64), 0, len(clicks) - 1)
    found: Floats = (stamps - clicks[own]) / NS_PER_MS
    return found, float(abs(mean))


def _independent(offsets_ms: Floats) -> float:
    """The share of the taps that are independent, for each carries a part of the last one's error on (first order)."""
    off = offsets_ms - offsets_ms.mean()
    power = float(off @ off)
    lag_1 = float(off[1:] @ off[:-1]) / power if power > 0.0 else 0.0
    rho = min(max(lag_1, 0.0), _MAX_LAG_1)
    return (1 - rho) / (1 + rho)


def _equipment(total: LatencyEstimate) -> LatencyEstimate:
    """What the equipment may have of `total`."""
    low, high = total.low_ms - HABIT_MS[1], total.high_ms - HABIT_MS[0]
    equipment = LatencyEstimate((low + high) / 2, low, high, total.sd_ms, total.count, total.doubts)
    if low <= 0.0 <= high:
        return equipment.doubted("it may be the player's habit alone")
    return equipment.doubted(
        f"the player's habit is in it: people tap {-HABIT_MS[0]:.0f} ms early to {HABIT_MS[1]:.0f} late"
    )
