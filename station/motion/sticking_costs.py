"""What it costs a hand to play a note: the terms that the choice of hands weighs.

A cost of 1 is what a drummer would go out of the way for a little. Each term has a name, because the term that decided
becomes the reason that is shown. Times in seconds, lengths in metres; the sources are HUMANS and the drummers' rules of
natural sticking: the leading hand has the beat and the "and", the other "e" and "a", triplets alternate, and a rest
does not shift the hands.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.motion.kit import Kit
from station.music.score import Score

RIGHT, LEFT = 0, 1


class Hands(Enum):
    """Who leads: `OPEN` is a right-handed kit whose hi-hat the left hand plays, uncrossed."""

    RIGHT = "right"
    LEFT = "left"
    OPEN = "open"


# --- speeds -----------------------------------------------------------------------------------------------------------

TOGETHER_S = 0.025
"""Two notes this near are struck at once, or are a flam: never by one hand (flams are 15–40 ms)."""
BOUNCE_S = 0.105
"""Up to here one hand plays two notes as a rebound, not as two strokes (second bounce after 50–90 ms)."""
EASY_REPEAT_S = 0.155
"""One hand repeats at 5–7 Hz in general."""
TRAVEL_S_PER_M = 0.40
"""Minimum jerk takes 0.25 s for 40 cm of the hand at 3 m/s; the tip goes half as far again as the hand."""
STRIKE_S = 0.06
"""A stroke needs this besides the travel (our choice)."""

# --- prices: our choices, tuned on the patterns that the tests name ---------------------------------------------------

IMPOSSIBLE = 1000.0
CRUSHED = 200.0
UNEVEN = 12.0
LATE = 2.5
SLOW = 4.0
BOUNCE = 1.3
LATE_BOUNCE = 0.25
METRE = 0.8
CROSSING = 2.5
NATURAL = 0.45
OSTINATO = 0.9
SWITCH = 0.6
GRACE = 8.0
HOME = 0.15
MIDDLE_M = 0.10
WRITTEN = 1e6

BEGIN = 0.1
PHRASE_S = 1.0
"""After so long a rest the leading hand begins (our choice)."""
CROSSING_MARGIN_M = 0.08
"""Hands this near in x are beside each other, not crossed."""
CROSSING_FADES_S = 0.6
"""A hand that has not played for so long is out of the way."""
OSTINATO_PIECES = (Piece.HIHAT, Piece.RIDE, Piece.RIDE_2)


@dataclass(frozen=True, eq=False)
class HandNotes:
    """The notes that hands play, in order of time, and what their costs depend on; lists, to be read one by one."""

    time_s: list[float]
    piece: list[int]
    spot: list[list[list[float]]]  # of each hand and note: x, y, z
    written: list[int]
    natural: list[int]  # the hand of natural sticking
    odd: list[bool]  # whether it falls between the strokes that the leading hand has
    paired: list[int]  # +1: with the same hand as the note before (the second of a double), −1 another, 0 free
    lead: int
    ostinato_lead: int
    order: NDArray[np.int64]

    @classmethod
    def of(cls, score: Score, kit: Kit, rows: NDArray[np.int64], hands: Hands) -> "HandNotes":
        """The hand notes `rows` of `score` on `kit`."""
        order = np.argsort(score.onset_ns[rows], kind="stable")
        rows = rows[order]
        notes = score.notes[rows]
        lead = LEFT if hands is Hands.LEFT else RIGHT
        kinds, which = np.unique(np.stack([notes["piece"], notes["zone"]], 1), axis=0, return_inverse=True)
        spots = []
        for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND):
            points = np.array([kit.target(Piece(p), Zone(z), limb).point_m for p, z in kinds.tolist()])
            spots.append(points[which].tolist())
        odd = _odd(score, rows)
        played = np.array([kit.stand_in(Piece(p)) for p, _ in kinds.tolist()])
        return cls(
            time_s=score.onset_s[rows].tolist(),
            piece=played[which].tolist(),
            spot=spots,
            written=notes["limb"].tolist(),
            natural=np.where(odd, 1 - lead, lead).tolist(),
            odd=odd.tolist(),
            paired=_paired(notes).tolist(),
            lead=lead,
            ostinato_lead=LEFT if hands is Hands.OPEN else lead,
            order=order,
        )


def _paired(notes: NDArray[np.void]) -> NDArray[np.int8]:
    """Whether each note shares the hand of the note before it: 1 it does, −1 it takes the other, 0 either."""
    pairs = np.zeros(len(notes), np.int8)
    if len(notes) < 2:
        return pairs
    grace = notes["lead_ms"] > 0
    pairs[1:][grace[:-1] & ~grace[1:]] = -1  # the stroke that grace notes lead to
    pairs[1:][grace[:-1] & grace[1:]] = 1  # both strokes of a drag
    diddle = notes["ornament"] == Ornament.DIDDLE
    starts = diddle & ~np.concatenate(([False], diddle[:-1]))
    index = np.arange(len(notes)) - np.maximum.accumulate(np.where(starts, np.arange(len(notes)), 0))
    pairs[diddle & (index % 2 == 1)] = 1
    pairs[diddle & (index % 2 == 0) & (index > 0)] = -1
    return pairs


_GRIDS = (4, 3, 6, 8)
"""Strokes a quarter note that natural sticking knows: sixteenths, triplets, sextuplets, thirty-seconds."""
_SIMPLER = (1.0, 1.6, 4.0, 4.0)
"""A finer grid always fits better: its error must be smaller by this factor to be believed (our choice)."""
_GRID_FLOOR_TICKS = PPQ / 50
"""Deviations below this say nothing of the grid."""


def _odd(score: Score, rows: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Whether each row falls on an odd place of the grid that fits its quarter best: "e" and "a" on sixteenths."""
    ticks = score.tempo_map.ticks_at_ns(score.onset_ns[rows])
    ticks = np.where(score.notes["lead_ms"][rows] > 0, score.notes["tick"][rows], ticks)
    bars = score.bar[rows]
    starts = np.array([score.tempo_map.bar_start(b) for b in range(int(bars.max(initial=0)) + 1)], np.int64)
    place = ticks - starts[bars]
    quarter = np.cumsum(np.diff(ticks // PPQ, prepend=-1) != 0) - 1
    errors = np.empty((len(_GRIDS), int(quarter.max(initial=0)) + 1))
    for k, grid in enumerate(_GRIDS):
        step = PPQ / grid
        off = np.abs(place - np.rint(place / step) * step)
        square = np.maximum(off, _GRID_FLOOR_TICKS) ** 2
        errors[k] = np.bincount(quarter, square, errors.shape[1]) * _SIMPLER[k]
    best = np.array(_GRIDS)[np.argmin(errors, axis=0)][quarter]
    index = np.rint(place / (PPQ / best)).astype(np.int64)
    grace = score.notes["lead_ms"][rows] > 0  # stands on its main stroke's tick and falls to the other hand
    return np.asarray((index % 2 == 1) ^ grace)
