"""A roll of rebounds without a gap parted into the hands' strokes.

Each hand strikes before the other's rebounds have died, so that nothing but loudness and the beat tells where. Of the
divisions of the beat the one counts on whose cells the strokes stand out most from the rebounds about them: by a
t-value, less what the louder of two would have by chance.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.tempo import TempoMap

Floats = NDArray[np.float64]

FEWEST = 8
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


@dataclass(frozen=True, slots=True)
class _Heard:
    clear: float
    at: tuple[int, ...]


def hands_strokes(times_ms: Sequence[float], velocities: Sequence[int], tempo_map: TempoMap) -> tuple[int, ...]:
    """Which of a roll's strokes are the hands', the first always; empty where the beat does not tell."""
    times = np.asarray(times_ms, np.float64)
    loud = _standing_out(np.log(np.asarray(velocities, np.float64)))
    start = int(tempo_map.ticks_at_ns(round((times[0] - _REACH_MS) * NS_PER_MS)))
    found = [_heard(times, loud, _cells(times, start, tempo_map, parts)) for parts in _PARTS]
    best = max(found, key=lambda heard: heard.clear)
    return best.at if best.clear >= _CLEAR else ()


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
    """How clearly strokes on those cells stand out, and which they are."""
    if len(cells) < 2 or cells[1] - cells[0] < _FASTEST_MS:
        return _Heard(0.0, ())
    far = times - cells[:, None]
    worth = np.where(np.abs(far) <= _REACH_MS, loud - (far / _SPREAD_MS) ** 2 / 2, -np.inf)
    worth = worth[np.isfinite(worth).any(axis=1)]
    at = sorted({0, *np.argmax(worth, axis=1).tolist()})
    inner = at[1:]
    if not inner:
        return _Heard(0.0, ())
    return _Heard((float(loud[inner].mean()) - _BY_CHANCE) * float(np.sqrt(len(inner))), tuple(at))
