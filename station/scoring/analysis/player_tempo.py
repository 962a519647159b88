"""The player's own tempo, bar by bar, and how it drifted.

Within a bar a straight line is fitted to when its notes were played over when they are written (least squares); its
slope is the tempo. A bar with fewer than `_FEWEST` moments has none. Where the alignment jumped inside a bar, only the
segment with most notes counts. Tempi are in quarter notes a minute.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.timing_spread import slope, timed_notes
from station.scoring.matching.alignment import Alignment

Floats = NDArray[np.float64]

_FEWEST = 3
_S_PER_MINUTE = 60.0


@dataclass(frozen=True, slots=True)
class BarTempo:
    """Bar `bar` (from 0, as played through the score) began at `at_s` of the performance at `tempo_bpm`."""

    bar: int
    at_s: float
    tempo_bpm: float


@dataclass(frozen=True, slots=True)
class TempoCurve:
    """All bars that have a tempo, their median, and the drift in percent a minute with its 95 % interval.

    None where too little is known: a drift needs three bars, an interval `MIN_SLOTS`.
    """

    bars: tuple[BarTempo, ...]
    median_bpm: float | None
    drift_pct_per_minute: float | None
    drift_ci: tuple[float, float] | None


def tempo_curve(score: Score, performance: Performance, alignment: Alignment) -> TempoCurve:
    """The tempo that `performance` kept."""
    timed = np.flatnonzero(timed_notes(score, alignment))
    hit = alignment.hit_of_note[timed]
    played_s = performance.hits["at_ns"][hit] / NS_PER_S
    written_s, bar, segment = score.onset_s[timed], score.bar[timed], alignment.segment[hit]
    bars = []
    for b in np.unique(bar).tolist():
        here = np.flatnonzero(bar == b)
        here = here[segment[here] == np.bincount(segment[here]).argmax()]
        pace = _pace(written_s[here], played_s[here])
        if pace is not None:
            written_bpm = score.tempo_map.bpm_at(score.tempo_map.bar_start(b))
            bars.append(BarTempo(b, float(played_s[here].min()), written_bpm / pace))
    return TempoCurve(tuple(bars), _median(bars), *_drift(score, bars))


def _pace(x: Floats, y: Floats) -> float | None:
    """Slope of y over x; None of too few different places or where time does not pass."""
    if len(np.unique(x)) < _FEWEST:
        return None
    pace = slope(x, y)
    return pace.value if pace is not None and pace.value > 0 else None


def _median(bars: list[BarTempo]) -> float | None:
    return float(np.median([bar.tempo_bpm for bar in bars])) if bars else None


def _drift(score: Score, bars: list[BarTempo]) -> tuple[float | None, tuple[float, float] | None]:
    """By how much the tempo, as a share of the written one, rose a minute, in percent; negative: it fell.

    Its interval is that of a straight line whose deviations may hang together (`timing_spread`).
    """
    starts = [score.tempo_map.bpm_at(score.tempo_map.bar_start(bar.bar)) for bar in bars]
    share = np.array([100 * bar.tempo_bpm / written for bar, written in zip(bars, starts, strict=True)])
    at_min = np.array([bar.at_s for bar in bars]) / _S_PER_MINUTE
    if len(np.unique(at_min)) < _FEWEST:
        return None, None
    drift = slope(at_min, share)
    return (None, None) if drift is None else (drift.value, drift.ci)
