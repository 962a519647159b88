"""Tap tempo: the tempo that a few taps mean, deaf to a stray or a missing one.

Times are monotonic nanoseconds. The median interval is a first guess that no single slip moves. From each tap in turn a
chain is followed along the grid of that guess: a tap left out counts as two beats, one far off the grid is passed over.
A line through the longest chain (times against numbers) gives the tempo. Two taps are the least.
"""

from collections.abc import Sequence

import numpy as np

from station.core.units import NS_PER_S

PAUSE_NS = 3 * NS_PER_S
"""Whoever waits so long starts a new tempo (our choice: 20 bpm is the slowest)."""
MAX_TAPS = 16
"""Older taps no longer count, so that the tempo can be changed while tapping (our choice)."""
MAX_OFF_GRID = 0.2
"""A tap that lies this share of a beat beside the grid is a slip (our choice: five times a musician's scatter)."""
MIN_INTERVAL_NS = NS_PER_S // 20
"""Two taps nearer than this (1200 bpm) are one tap that bounced."""


class TapTempo:
    """Collects taps; `bpm` is the tempo that they mean."""

    def __init__(self) -> None:
        self._taps_ns: list[int] = []

    def tap(self, at_ns: int) -> float | None:
        """Take a tap and return the tempo so far; None until there are two."""
        if self._taps_ns and at_ns - self._taps_ns[-1] > PAUSE_NS:
            self._taps_ns.clear()
        if not self._taps_ns or at_ns - self._taps_ns[-1] >= MIN_INTERVAL_NS:
            self._taps_ns.append(at_ns)
        del self._taps_ns[:-MAX_TAPS]
        return self.bpm

    @property
    def bpm(self) -> float | None:
        """Taps a minute; None where there are fewer than two."""
        return tapped_bpm(self._taps_ns)


def tapped_bpm(taps_ns: Sequence[int]) -> float | None:
    """The tempo of taps in rising order, in taps a minute; None for fewer than two."""
    if len(taps_ns) < 2:
        return None
    times_s = [(tap_ns - taps_ns[0]) / NS_PER_S for tap_ns in taps_ns]
    guess_s = float(np.median(np.diff(times_s)))
    numbers, on_grid_s = max(
        (_chain(times_s[i:], guess_s) for i in range(len(times_s))), key=lambda chain: len(chain[0])
    )
    return 60.0 / (float(np.polyfit(numbers, on_grid_s, 1)[0]) if len(numbers) > 1 else guess_s)


def _chain(times_s: Sequence[float], beat_s: float) -> tuple[list[int], list[float]]:
    """The numbers and times of the taps that lie on the grid of the first; each is measured from the one before."""
    numbers, kept_s = [0], [times_s[0]]
    for time_s in times_s[1:]:
        beats = (time_s - kept_s[-1]) / beat_s
        if round(beats) >= 1 and abs(beats - round(beats)) < MAX_OFF_GRID:
            numbers.append(numbers[-1] + round(beats))
            kept_s.append(time_s)
    return numbers, kept_s
