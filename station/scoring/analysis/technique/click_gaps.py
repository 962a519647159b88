"""Where the click was silent: how far off the player is when it comes back.

On return the first stroke is still played by the inner clock alone, for its click was not heard before. Its asynchrony,
less where the player stands while the click sounds, is the *drift*: negative, the player rushed in the dark. Divided by
how long the silence was, it is the error of the inner tempo.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.score import Score
from station.scoring.analysis.technique.estimates import Estimate, figure
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Alignment, Reference

Indices = NDArray[np.int64]

Silences = tuple[tuple[int, int], ...]
"""Score ns from which and until which the click was silent."""

_RETURN_BEATS = 1.0
"""A first stroke later than so many beats after the click came back has heard it (our choice)."""


@dataclass(frozen=True, slots=True)
class Return:
    """One silence: the bar (from 0) in which the click came back, and by how much the player was off, None unknown."""

    bar: int
    quiet_s: float
    drift_ms: float | None


@dataclass(frozen=True, slots=True)
class ClickGaps:
    """All silences.

    `drift_ms` on return, signed; `size_ms` the same without signs; `tempo_pct` of the inner tempo, positive is fast.
    """

    returns: tuple[Return, ...]
    drift_ms: Estimate
    size_ms: Estimate
    tempo_pct: Estimate


def gaps(score: Score, alignment: Alignment, silences: Silences) -> ClickGaps | None:
    """How the player came out of each of `silences`; None without any, or of a recording that was not to a click."""
    if not silences or alignment.reference is Reference.PLAYER:
        return None
    timed = np.flatnonzero(timed_notes(score, alignment))
    due, off = score.onset_ns[timed], asynchrony_ms(alignment)[timed]
    home_ms = _home_ms(due, off, silences)
    returns = tuple(_return(score, due, off - home_ms, silence) for silence in silences)
    drift = np.array([np.nan if r.drift_ms is None else r.drift_ms for r in returns])
    quiet_ms = np.array([r.quiet_s * 1e3 for r in returns])
    each = np.arange(len(returns))
    return ClickGaps(returns, figure(drift, each), figure(np.abs(drift), each), figure(-100 * drift / quiet_ms, each))


def _home_ms(due: Indices, off: NDArray[np.float64], silences: Silences) -> float:
    """Where the player stands while the click sounds: the median; 0 where nothing was played then."""
    quiet = np.zeros(len(due), np.bool_)
    for start, end in silences:
        quiet |= (due > start) & (due <= end)
    return float(np.median(off[~quiet])) if (~quiet).any() else 0.0


def _return(score: Score, due: Indices, off: NDArray[np.float64], silence: tuple[int, int]) -> Return:
    start, end = silence
    tick = int(score.tempo_map.ticks_at_ns(end))
    latest = end + round(_RETURN_BEATS * 60e9 / score.tempo_map.bpm_at(tick))
    slots = np.unique(due[(due >= end) & (due < latest)])
    drift = float(off[due == slots[0]].mean()) if len(slots) else None
    return Return(int(score.tempo_map.bars_at(tick)), (end - start) / (1000 * NS_PER_MS), drift)
