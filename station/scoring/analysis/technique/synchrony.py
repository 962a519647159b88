"""Whether limbs strike together what is written together.

In every slot that two pieces share, the asynchrony of one less that of the other: its mean is how the two lean apart,
which is feel up to 25 ms, its SD how well they hold together. HUMANS: 15–20 ms between the instruments of one slot in
human takes, 19–24 ms are just noticed. The player's clock falls out, for it is in both.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.music.score import Score
from station.scoring.analysis.technique.estimates import Estimate, Scatter, figure, scatter
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Alignment

Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class LimbPair:
    """Two pieces, or two limbs: `apart_ms` the first's asynchrony less the second's, over the slots that they share."""

    first: Piece | Limb
    second: Piece | Limb
    apart_ms: Estimate


@dataclass(frozen=True, slots=True)
class Synchrony:
    """`sd_ms` the scatter of all pairs of pieces about their own means; single pairs of `pieces` and of `limbs`."""

    sd_ms: Scatter
    pieces: tuple[LimbPair, ...]
    limbs: tuple[LimbPair, ...]


def synchrony(score: Score, alignment: Alignment) -> Synchrony | None:
    """How simultaneous what is written together was; None for a score or a take in which nothing is."""
    rows = np.flatnonzero(timed_notes(score, alignment))
    pieces = _differences(score, alignment, rows, score.notes["piece"])
    if not pieces:
        return None
    limbed = rows[score.notes["limb"][rows] != Limb.UNKNOWN]
    limbs = _differences(score, alignment, limbed, score.notes["limb"])
    values, ticks = (np.concatenate([part[k] for part in pieces.values()]) for k in (0, 1))
    group = np.repeat(np.arange(len(pieces)), [len(part[0]) for part in pieces.values()])
    return Synchrony(
        scatter(values, group, ticks),
        tuple(LimbPair(Piece(a), Piece(b), figure(*part)) for (a, b), part in pieces.items()),
        tuple(LimbPair(Limb(a), Limb(b), figure(*part)) for (a, b), part in limbs.items()),
    )


def _differences(
    score: Score, alignment: Alignment, rows: Indices, who: NDArray[np.generic]
) -> dict[tuple[int, int], tuple[NDArray[np.float64], Indices]]:
    """For every two of `who` that share slots: the differences (k,) in ms and their ticks."""
    ticks, off = score.notes["tick"], asynchrony_ms(alignment)
    first = {w: _first_of_slot(rows[who[rows] == w], ticks) for w in np.unique(who[rows]).tolist()}
    found = {}
    for a, b in combinations(first, 2):
        shared, i, j = np.intersect1d(ticks[first[a]], ticks[first[b]], return_indices=True)
        if len(shared):
            found[a, b] = (off[first[a][i]] - off[first[b][j]], shared)
    return found


def _first_of_slot(rows: Indices, ticks: Indices) -> Indices:
    """One row a slot."""
    return rows[np.unique(ticks[rows], return_index=True)[1]]
