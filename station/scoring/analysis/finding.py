"""One fault that a performance shows, and the bars where it is worst."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.music.judgement import Label
from station.scoring.analysis.summary import Summary

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

MIN_SLOTS = 6
"""Fewer moments bear no sentence (our choice)."""

CHANCE = 2.8
"""Standard errors: one fault-free effect in two hundred goes beyond."""

Z_95 = 1.959964
"""Standard errors to both sides of a 95 % interval."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One fault: its size with sign and 95 % interval in `unit`, the lesson's bars (from 0) where it is worst.

    `subject` names what it is about, in words; `severity` is its size in units of the smallest that a teacher minds.
    `alternatives` are the words of other explanations that the data do not tell from this one.
    """

    fault: str
    subject: str
    effect: float
    ci: tuple[float, float]
    unit: str
    severity: float
    bars: tuple[int, ...]
    alternatives: tuple[str, ...] = ()


def worst_bars(summary: Summary, badness: Floats, notes: Flags, most: int = 3) -> list[int]:
    """Up to `most` bars, in order, whose notes (mask (n,), `badness` ≥ 0, one value each) are worse than the mean."""
    bars = summary.view.bars(summary.score)[notes]
    if not len(bars):
        return []
    mean = np.bincount(bars, weights=badness) / np.maximum(np.bincount(bars), 1)
    worse = [int(b) for b in np.argsort(-mean, kind="stable") if mean[b] > 0 and mean[b] >= badness.mean()]
    return sorted(worse[:most])


def farthest_bars(summary: Summary, strokes: Flags, off: Floats) -> tuple[int, ...]:
    """The bars in which the strokes (n,) that were played lie farthest up in `off` (n,)."""
    judged = strokes & (summary.alignment.note_label == Label.MATCH) & ~np.isnan(off)
    if not judged.any():
        return ()
    return tuple(worst_bars(summary, off[judged] - off[judged].min(), judged))
