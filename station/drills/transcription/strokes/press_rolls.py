"""A roll of rebounds without a gap parted into the hands' strokes.

Each hand strikes before the other's rebounds have died, so that nothing but loudness and the beat tells where. Of the
divisions of the beat the one counts on whose cells the strokes stand out most from the rebounds about them: by a
t-value, less what the louder of two would have by chance.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from statistics import fmean

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.tempo import TempoMap

Floats = NDArray[np.float64]

FEWEST = 6
"""Strokes of a roll that holds several hands' strokes: fewer are one hand's (our choice)."""
_PARTS = (1, 2, 3, 4, 6, 8)
"""Into so many cells a beat is cut."""
_FASTEST_MS = 80.0
"""Hands' strokes in a press roll are hardly ever closer: 12 a second."""
_REACH_MS, _SPREAD_MS = 45.0, 18.0
"""So far from its cell a stroke is looked for, and how far it lies as a rule (HUMANS, Timing: 10–26 ms)."""
_ABOUT = 4
"""Loudness is held against so many strokes before and after (our choice)."""
_BY_CHANCE = 0.6
"""The louder of two like strokes stands out by so many standard deviations (the mean of the larger of two normals)."""
_CLEAR = 2.0
"""The t-value from which on the cells are heard (our choice: one in forty by chance)."""


_OTHERWISE = 1.5
"""By so much more clearly a roll must be in another division than the rest (our choice)."""


@dataclass(frozen=True, slots=True)
class Roll:
    """Strokes of one drum without a gap: times in ms, velocities 1–127."""

    times_ms: Sequence[float]
    velocities: Sequence[int]


@dataclass(frozen=True, slots=True)
class _Heard:
    """Under one division which strokes are the hands', and how far those after the first stand out."""

    worth: tuple[float, ...]
    at: tuple[int, ...]


def hands_strokes(rolls: Sequence[Roll], tempo_map: TempoMap) -> list[tuple[int, ...]]:
    """Of each roll of a drum which of its strokes are the hands', the first always; empty where nothing tells.

    What all rolls say together counts first, for few are in another division than the rest.
    """
    heard = [_by_parts(roll, tempo_map) for roll in rolls]
    shared = [_clear([worth for parts in heard for worth in parts[k].worth]) for k in range(len(_PARTS))]
    usual = int(np.argmax(shared)) if shared else 0
    found: list[tuple[int, ...]] = []
    for parts in heard:
        own = max(parts, key=lambda h: _clear(h.worth))
        is_own = _clear(own.worth) >= max(_CLEAR, _clear(parts[usual].worth) + _OTHERWISE)
        found.append(own.at if is_own else parts[usual].at if shared[usual] >= _CLEAR else ())
    return found


def _by_parts(roll: Roll, tempo_map: TempoMap) -> list[_Heard]:
    times = np.asarray(roll.times_ms, np.float64)
    loud = _standing_out(np.log(np.asarray(roll.velocities, np.float64)))
    start = int(tempo_map.ticks_at_ns(round((times[0] - _REACH_MS) * NS_PER_MS)))
    return [_heard(times, loud, _cells(times, start, tempo_map, parts)) for parts in _PARTS]


def _clear(worth: Sequence[float]) -> float:
    """The t-value of strokes that stand out so far."""
    return (fmean(worth) - _BY_CHANCE) * sqrt(len(worth)) if worth else 0.0


def _standing_out(loud: Floats) -> Floats:
    """How far each is above the middle of those about it, in standard deviations of those that are not."""
    around = [np.median(loud[max(i - _ABOUT, 0) : i + _ABOUT + 1]) for i in range(len(loud))]
    above: Floats = loud - np.array(around)
    spread = 1.4826 * float(np.median(np.abs(above)))
    return above / max(spread, 0.03)


def _cells(times: Floats, start: int, tempo_map: TempoMap, parts: int) -> Floats:
    """When the cells of the beats fall that the roll lasts, in ms."""
    meter = tempo_map.meter_at(max(start, 0))
    step = meter.usual_beat_ticks // parts
    bar = tempo_map.bar_start(int(tempo_map.bars_at(max(start, 0))))
    first = bar + -(-(max(start, 0) - bar) // step) * step
    last = int(tempo_map.ticks_at_ns(round(float(times[-1]) * NS_PER_MS)))
    ticks = np.arange(first, last + 1, step, dtype=np.int64)
    return np.asarray(tempo_map.ns_at(ticks) / NS_PER_MS, np.float64)


def _heard(times: Floats, loud: Floats, cells: Floats) -> _Heard:
    """Which strokes are on those cells."""
    if len(cells) > 1 and cells[1] - cells[0] < _FASTEST_MS:
        return _Heard((), (0,))
    if not len(cells):
        return _Heard((), (0,))
    far = times - cells[:, None]
    worth = np.where(np.abs(far) <= _REACH_MS, loud - (far / _SPREAD_MS) ** 2 / 2, -np.inf)
    worth = worth[np.isfinite(worth).any(axis=1)]
    at = sorted({0, *np.argmax(worth, axis=1).tolist()})
    return _Heard(tuple(loud[at[1:]].tolist()), tuple(at))
