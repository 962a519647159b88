"""What one limb, or some bars, came to in a pass: the measures of the whole pass, over the part's strokes alone."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.drills.mastery.pass_measures.asked_parts import Part
from station.drills.mastery.pass_measures.pass_spread import LEAST_FREEDOM, Flags, Floats, leaning
from station.music.score import Score
from station.scoring.analysis.timing_spread import slope


@dataclass(frozen=True, slots=True)
class PartResult:
    """A part: `right` of `notes` were; the spread about each piece's lean, the mean asynchrony.

    `loudness_error_db` is the distance from the written loudness, `tempo_error_pct` how much faster than the click it
    was played, for bars. No data is None.
    """

    part: Part
    notes: int
    right: int
    sd_ms: float | None = None
    lean_ms: float | None = None
    loudness_error_db: float | None = None
    tempo_error_pct: float | None = None


@dataclass(frozen=True, eq=False)
class NoteFacts:
    """What is known of each note of a `score`, shapes (n,).

    `bar` the lesson's bar, `off_ms` the asynchrony, `steady` whether its time counts, `offbeat` whether it swings,
    `right`, and `off_db` the distance from the written loudness, NaN where it is not judged. `is_clocked` False where
    nobody knows what was early.
    """

    score: Score
    bar: NDArray[np.int64]
    off_ms: Floats
    steady: Flags
    offbeat: Flags
    right: Flags
    off_db: Floats
    is_clocked: bool

    def lean_ms(self, rows: Flags) -> float | None:
        """The mean asynchrony of the strokes of `rows` whose time counts."""
        rows = rows & self.steady
        return float(self.off_ms[rows].mean()) if rows.any() and self.is_clocked else None

    def loudness_error_db(self, rows: Flags) -> float | None:
        """The mean distance from the written loudness, to either side."""
        judged = rows & ~np.isnan(self.off_db)
        return float(np.abs(self.off_db[judged]).mean()) if judged.any() else None


def part_result(part: Part, notes: NoteFacts) -> PartResult:
    """Sum up one part of a pass."""
    rows = _rows(part, notes)
    return PartResult(
        part,
        notes=int(rows.sum()),
        right=int(notes.right[rows].sum()),
        sd_ms=leaning(notes.score, notes.off_ms, rows & notes.steady, notes.offbeat).sd_ms if rows.any() else None,
        lean_ms=notes.lean_ms(rows),
        loudness_error_db=notes.loudness_error_db(rows),
        tempo_error_pct=_tempo_error_pct(notes, rows & notes.steady) if part.bars and notes.is_clocked else None,
    )


def _rows(part: Part, notes: NoteFacts) -> Flags:
    """The notes (n,) of a part."""
    if part.bars is None:
        return np.asarray(notes.score.notes["limb"] == part.limb)
    first, last = part.bars
    return np.asarray((notes.bar >= first) & (notes.bar <= last))


def _tempo_error_pct(notes: NoteFacts, rows: Flags) -> float | None:
    """How much faster than written the strokes of `rows` follow each other, from the slope of their asynchronies.

    Each visit to the bars has a mean of its own: what was early as they began is no tempo.
    """
    visit = _visits(notes.score, notes.bar)[rows]
    at_ms, off_ms = notes.score.onset_ns[rows] / NS_PER_MS, notes.off_ms[rows]
    if len(off_ms) - len(np.unique(visit)) - 1 < LEAST_FREEDOM:
        return None
    rise = slope(_about_means(at_ms, visit), _about_means(off_ms, visit))
    return None if rise is None or rise.value <= -1.0 else 100.0 * (1.0 / (1.0 + rise.value) - 1.0)


def _visits(score: Score, bar: NDArray[np.int64]) -> NDArray[np.int64]:
    """Which run through the lesson's bars, in their order, each note (n,) belongs to."""
    turned = (np.diff(bar) < 0) | (np.diff(score.bar) > np.maximum(np.diff(bar), 1))
    same_again = (np.diff(bar) == 0) & (np.diff(score.bar) > 0)
    return np.concatenate([[0], np.cumsum(turned | same_again)]) if len(bar) else np.zeros(0, np.int64)


def _about_means(values: Floats, group: NDArray[np.int64]) -> Floats:
    """`values` (n,) less the mean of their own `group` (n,)."""
    _, index = np.unique(group, return_inverse=True)
    return np.asarray(values - (np.bincount(index, weights=values) / np.bincount(index))[index])
