"""Where a band that plays without a click is in its song: a time in the sound file for every beat of the score.

`band_following.follow_band(score, points, onsets)` answers it; this module holds what goes in and what comes out.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.tempo import TempoChange, TempoMap

SHOWN_RESIDUAL_MS = 20.0
"""A point that the curve misses by more is shown: a listener hears it beside the drums (part 12)."""

_US_PER_S = 1e6


@dataclass(frozen=True, slots=True)
class BandPoint:
    """The band plays `tick` of the score at `at_s` seconds of the sound file: by ear, tap or onset."""

    tick: int
    at_s: float


@dataclass(frozen=True, slots=True)
class PlacedPoint:
    """A point and how far the curve misses it: `residual_ms` > 0 where the curve is later than the point says."""

    tick: int
    at_s: float
    residual_ms: float

    @property
    def is_off(self) -> bool:
        """Whether the residual is to be shown."""
        return abs(self.residual_ms) > SHOWN_RESIDUAL_MS


@dataclass(frozen=True, eq=False)
class BandTempo:
    """The band's tempo.

    `tempo_map` has the score's meters and a tempo for every beat; its tick 0 lies at `start_s` of the sound file, which
    may be negative. `beat_ticks` (n,) and `beat_s` (n,) are the beats, first to last, and their times in the file;
    `confidence` (n,), 0 … 1, says how well the sound bears each out: 0 where it tells nothing.
    """

    tempo_map: TempoMap
    start_s: float
    beat_ticks: NDArray[np.int64]
    beat_s: NDArray[np.float64]
    confidence: NDArray[np.float64]
    points: tuple[PlacedPoint, ...] = ()

    def seconds_at(self, tick: int) -> float:
        """The second of the sound file at which the band plays `tick`."""
        return self.start_s + float(self.tempo_map.seconds_at(tick))


def tempo_map_of(written: TempoMap, beat_ticks: Sequence[int], beat_s: Sequence[float]) -> tuple[TempoMap, float]:
    """The map in which beat `beat_ticks[i]` comes at `beat_s[i]`, and the second at which its tick 0 lies.

    Ticks from 0 rise, n ≥ 2, and so do the seconds. A tempo is a whole number of microseconds a quarter: each one makes
    up for the rounding of those before, so that no beat is off by more than a microsecond for each of its quarters.
    The first tempo holds from tick 0, the last to the end.
    """
    tempos: list[TempoChange] = []
    reached_us = beat_s[0] * _US_PER_S
    for (tick, next_tick), next_s in zip(pairwise(beat_ticks), beat_s[1:], strict=True):
        quarters = (next_tick - tick) / PPQ
        us_per_quarter = max(1, round((next_s * _US_PER_S - reached_us) / quarters))
        reached_us += us_per_quarter * quarters
        tempos.append(TempoChange(tick, us_per_quarter))
    first = tempos[0]
    start_s = beat_s[0] - first.tick / PPQ * first.us_per_quarter / _US_PER_S
    return TempoMap.build([TempoChange(0, first.us_per_quarter), *tempos], written.meters, is_played=True), start_s
