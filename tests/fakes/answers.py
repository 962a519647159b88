"""A performance that answers every note of a score in a stated way, aligned: what is planted is known to the ms."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_MS
from station.music.performance import CHOKE_DTYPE, HIT_DTYPE, Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.matching.alignment import Alignment


@dataclass(frozen=True, eq=False)
class Take:
    """A score, what was played to it, and which hit answers which note."""

    score: Score
    performance: Performance
    alignment: Alignment


@dataclass(frozen=True, eq=False)
class Played:
    """How: `off_ms` played − written and `velocity` a note (scalars for all), rows left out, more hits and chokes.

    `more` are (ms, piece, velocity); `chokes` (ms, piece); `openness` of every stroke, None as written; `limbs` of the
    hands that struck, None unknown; `kit_velocity` None as written.
    """

    off_ms: ArrayLike = 0.0
    velocity: ArrayLike | None = None
    left_out: tuple[int, ...] = ()
    more: tuple[tuple[float, Piece, int], ...] = ()
    chokes: tuple[tuple[float, Piece], ...] = ()
    openness: ArrayLike | None = None
    limbs: NDArray[np.int8] | None = None
    pieces: Mapping[int, Piece] = field(default_factory=dict)


def take(score: Score, how: Played | None = None, clocked: bool = True) -> Take:
    """The take in which every note of `score` is played as `how` says."""
    how = how or Played()
    rows = np.zeros(len(score), HIT_DTYPE)
    for name in ("piece", "zone", "articulation", "velocity", "openness"):
        rows[name] = score.notes[name]
    rows["at_ns"] = score.onset_ns + np.rint(np.broadcast_to(how.off_ms, len(score)) * NS_PER_MS).astype(np.int64)
    if how.velocity is not None:
        rows["velocity_fraction"], rows["velocity"] = np.modf(how.velocity)
    if how.openness is not None:
        rows["openness"] = how.openness
    rows["limb"] = Limb.UNKNOWN if how.limbs is None else how.limbs
    rows["position"] = np.nan
    for row, piece in how.pieces.items():
        rows["piece"][row] = piece
    kept = np.delete(rows, list(how.left_out))
    more = np.zeros(len(how.more), HIT_DTYPE)
    more["openness"], more["limb"] = np.nan, Limb.UNKNOWN
    for k, (at_ms, piece, velocity) in enumerate(how.more):
        more[k]["at_ns"], more[k]["piece"], more[k]["velocity"] = round(at_ms * NS_PER_MS), piece, velocity
    chokes = np.array([(round(at_ms * NS_PER_MS), piece) for at_ms, piece in how.chokes], CHOKE_DTYPE)
    performance = Performance.from_array(np.concatenate([kept, more]), chokes)
    return Take(score, performance, align(score, performance, clocked))
