"""Takes with a click as people play them, and what each hit was meant for.

The noise of a stroke is half the moment's, carried on in part to the next (first-order autoregression over the slots,
lag-1 .3), and half the limb's own, so that strokes of one slot correlate by a half (HUMANS, Timing: lag-1 .21–.37,
kick and snare .54). Misses, extras and wrong pieces fall anywhere; an extra is a stroke on a piece of the music.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_MS
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Score

_LAG_1 = 0.3
_KIT = (Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.RIDE, Piece.CRASH_1, Piece.TOM_1, Piece.FLOOR_TOM_1)


@dataclass(frozen=True, slots=True)
class Hands:
    """A player: SD of a stroke and largest lean of a piece in ms, shares of the notes that go wrong."""

    sd_ms: float = 15.0
    lean_ms: float = 25.0
    missed: float = 0.03
    extra: float = 0.03
    wrong: float = 0.02


@dataclass(frozen=True, eq=False)
class Take:
    """`performance` (m hits), and the note that each hit was meant for, −1 for an extra, shape (m,)."""

    performance: Performance
    note_of_hit: NDArray[np.int64]


def take(score: Score, hands: Hands, seed: int) -> Take:
    """`score` played once through, hits in score time."""
    rng = np.random.default_rng(seed)
    rows = np.flatnonzero(rng.random(len(score)) >= hands.missed)
    at_ms = score.onset_ns[rows] / NS_PER_MS + noise_ms(score, hands.sd_ms, rng)[rows] + _leans(score, hands, rng)[rows]
    piece = score.notes["piece"][rows].astype(np.int64)
    for k in np.flatnonzero(rng.random(len(rows)) < hands.wrong):
        piece[k] = rng.choice([p for p in _KIT if p != piece[k]])
    more = rng.binomial(len(score), hands.extra)
    at_ms = np.concatenate((at_ms, rng.uniform(0, score.length_ns / NS_PER_MS, more)))
    piece = np.concatenate((piece, rng.choice(np.unique(score.notes["piece"]), more)))
    meant = np.concatenate((rows, np.full(more, -1)))
    order = np.argsort(at_ms, kind="stable")
    hits = np.zeros(len(order), HIT_DTYPE)
    hits["at_ns"], hits["piece"] = np.rint(at_ms[order] * NS_PER_MS), piece[order]
    hits["velocity"], hits["openness"], hits["limb"] = 80, np.nan, Limb.UNKNOWN
    return Take(Performance.from_array(hits), meant[order])


def noise_ms(score: Score, sd_ms: float, rng: np.random.Generator) -> NDArray[np.float64]:
    """The noise of each stroke (n,)."""
    ticks, slot = np.unique(score.notes["tick"], return_inverse=True)
    white = rng.normal(0.0, (1 - _LAG_1**2) ** 0.5, len(ticks))
    common = np.zeros(len(ticks))
    for k in range(len(ticks)):
        common[k] = white[k] + (_LAG_1 * common[k - 1] if k else 0.0)
    noise: NDArray[np.float64] = sd_ms * 0.5**0.5 * (common[slot] + rng.normal(0.0, 1.0, len(slot)))
    return noise


def _leans(score: Score, hands: Hands, rng: np.random.Generator) -> NDArray[np.float64]:
    pieces, which = np.unique(score.notes["piece"], return_inverse=True)
    return np.asarray(rng.uniform(-hands.lean_ms, hands.lean_ms, len(pieces))[which])
