"""Spread apart from bias: each piece's own lean, and the swing that the player holds, are no scatter.

Asynchronies are in ms, negative is early; both are taken out with the degrees of freedom that this costs.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Ornament
from station.music.score import Score
from station.scoring.analysis.timing_spread import timed_notes
from station.scoring.matching.alignment import Alignment

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

LEAST_FREEDOM = 3
"""With fewer degrees of freedom a spread says nothing; our choice."""
_ROLLS = (Ornament.DIDDLE, Ornament.ROLL)


@dataclass(frozen=True, slots=True)
class Leaning:
    """What is the player's own and no fault, `swing_ms` of swung rows; and the spread that is left, None unknown."""

    swing_ms: float
    sd_ms: float | None


def steady_strokes(score: Score, alignment: Alignment) -> Flags:
    """The strokes (n,) whose time counts: matched, neither grace strokes nor parts of diddles and rolls."""
    notes = score.notes
    rolled = np.isin(notes["ornament"], _ROLLS) | (notes["duration_ticks"] > 0)
    return np.asarray(timed_notes(score, alignment) & ~rolled)


def leaning(score: Score, off_ms: Floats, rows: Flags, offbeat: Flags) -> Leaning:
    """Least squares over the `rows` (n,) that count: a lean for each piece, and one that swung offbeats share."""
    pieces = np.unique(score.notes["piece"][rows])
    by_piece = score.notes["piece"][:, None] == pieces
    columns = np.column_stack([by_piece, offbeat]).astype(np.float64)[rows]
    lean, _, rank, _ = np.linalg.lstsq(columns, off_ms[rows], rcond=None)
    left, freedom = off_ms[rows] - columns @ lean, int(rows.sum()) - int(rank)
    sd_ms = float((left @ left / freedom) ** 0.5) if freedom >= LEAST_FREEDOM else None
    return Leaning(float(lean[-1]), sd_ms)
