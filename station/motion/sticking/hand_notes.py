"""The notes that hands play, in order of time, and all that the choice of a hand depends on.

Natural sticking is worked out here: the leading hand has the even places of the grid that fits a quarter, the other
hand the odd ones ("e" and "a" of sixteenths), triplets alternate, and a rest does not shift the hands.
Times in seconds, lengths in metres.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.motion.kit.kit import Kit
from station.music.score import Score

RIGHT, LEFT = 0, 1


class Hands(Enum):
    """Who leads: `OPEN` is a right-handed kit whose hi-hat the left hand plays, uncrossed."""

    RIGHT = "right"
    LEFT = "left"
    OPEN = "open"


OSTINATO_PIECES = (Piece.HIHAT, Piece.RIDE, Piece.RIDE_2)
"""What one hand plays on and on."""
EASY_REPEAT_S = 0.155
"""One hand repeats so fast for long: 5–7 Hz in general (Fujii 2009)."""

AT_ONCE_S = 0.05
"""Two pieces this near in time are struck at once: in 50 ms no hand strikes, travels and strikes again (our choice)."""
ONE_HAND_S = 1 / 7
"""An ostinato quicker than this goes to both hands: the upper end of those 5–7 Hz."""
_EVEN = 1.6
"""Gaps whose ratio is below this are one run; a swung ride's skip note stands apart (our choice)."""


@dataclass(frozen=True, eq=False)
class HandNotes:
    """The notes of hands in order of time; lists, to be read one by one. `order` are their rows among those given."""

    time_s: list[float]
    piece: list[int]  # as this kit plays it
    kind: list[int]  # equal where the piece and the struck spot are
    spot: list[list[list[float]]]  # of each hand and note: x, y, z
    velocity: list[int]
    written: list[int]
    ostinato: list[bool]  # whether it belongs to an ostinato that one hand can play
    natural: list[int]  # the hand of natural sticking
    firm: list[bool]  # whether drummers insist on that hand: a drum and a hat at once in a quick run
    odd: list[bool]  # whether it falls between the strokes that the leading hand has
    again: list[bool]  # whether both hands strike the same two pieces at once as they did just before
    laid: list[bool]  # whether it is a cross-stick
    paired: list[int]  # +1: with the same hand as the note before (the second of a double), −1 another, 0 free
    lead: int
    open_handed: bool
    order: NDArray[np.int64]

    def ostinato_hand(self, i: int) -> int:
        """The hand that has an ostinato on note `i`'s piece: an open-handed player's hi-hat is the other one's."""
        return 1 - self.lead if self.open_handed and self.piece[i] == Piece.HIHAT else self.lead

    @classmethod
    def of(cls, score: Score, kit: Kit, rows: NDArray[np.int64], hands: Hands) -> "HandNotes":
        """The hand notes `rows` of `score` on `kit`."""
        order = np.argsort(score.onset_ns[rows], kind="stable")
        rows = rows[order]
        notes = score.notes[rows]
        lead = LEFT if hands is Hands.LEFT else RIGHT
        kinds, which = np.unique(np.stack([notes["piece"], notes["zone"]], 1), axis=0, return_inverse=True)
        which = which.reshape(-1)
        spots = []
        for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND):
            points = np.array([kit.target(Piece(p), Zone(z), limb).point_m for p, z in kinds.tolist()])
            spots.append(points.reshape(-1, 3)[which].tolist())
        odd = _odd(score, rows)
        played = np.array([kit.stand_in(Piece(p)) for p, _ in kinds.tolist()], np.int64)[which]
        for_ostinato = np.isin(played, OSTINATO_PIECES)
        ostinato = _ostinato(score.onset_s[rows], for_ostinato)
        quick = for_ostinato & ~ostinato
        firm = _with_another(score.onset_s[rows], played, quick)
        again = _again(score.onset_s[rows], played)
        firm &= ~again
        keeps = np.where((played == Piece.HIHAT) & (hands is Hands.OPEN), 1 - lead, lead)
        natural = np.where(again & quick, keeps, np.where(odd ^ (firm & quick), 1 - lead, lead))
        natural = _between(score.onset_s[rows], ostinato, keeps, natural)
        return cls(
            time_s=score.onset_s[rows].tolist(),
            piece=played.tolist(),
            kind=which.tolist(),
            spot=spots,
            velocity=notes["velocity"].tolist(),
            written=notes["limb"].tolist(),
            ostinato=ostinato.tolist(),
            natural=natural.tolist(),
            firm=firm.tolist(),
            odd=odd.tolist(),
            again=again.tolist(),
            laid=(notes["articulation"] == Articulation.CROSS_STICK).tolist(),
            paired=_paired(notes).tolist(),
            lead=lead,
            open_handed=hands is Hands.OPEN,
            order=order,
        )


def _ostinato(time_s: NDArray[np.float64], on_piece: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The notes on pieces for ostinatos, less the even runs of three or more that are too quick for one hand."""
    run = np.flatnonzero(on_piece)
    gaps = np.diff(time_s[run])
    before, after = gaps[:-1], gaps[1:]
    even = np.maximum(before, after) < np.minimum(EASY_REPEAT_S, _EVEN * np.minimum(before, after))
    quick = np.flatnonzero(even & (before + after < 2 * ONE_HAND_S))
    ostinato = on_piece.copy()
    for place in range(3):
        ostinato[run[quick + place]] = False
    return ostinato


def _between(
    time_s: NDArray[np.float64],
    ostinato: NDArray[np.bool_],
    keeps: NDArray[np.int64],
    natural: NDArray[np.int64],
) -> NDArray[np.int64]:
    """The `natural` hands, but for a lone stroke between an ostinato's, or after its last, the other hand.

    `keeps` (n,) is who has each note if it belongs to an ostinato. What is struck at once counts as one.
    """
    if not len(time_s):
        return natural
    chord = np.cumsum(np.diff(time_s, prepend=time_s[:1]) > AT_ONCE_S)
    carries = np.full(int(chord[-1]) + 1, _NO_OSTINATO)
    carries[chord[ostinato]] = keeps[ostinato]
    near = np.diff(time_s[np.searchsorted(chord, np.arange(len(carries)))]) < OSTINATO_GAP_S
    before = np.append(_NOTHING, np.where(near, carries[:-1], _NOTHING))[chord]
    after = np.append(np.where(near, carries[1:], _NOTHING), _NOTHING)[chord]
    alone = ~ostinato & (before >= 0) & ((after == before) | (after == _NOTHING))
    return np.where(alone, 1 - before, natural)


_NO_OSTINATO, _NOTHING = -1, -2
"""Beside a stroke: strokes that are no ostinato's, or none that is near."""
OSTINATO_GAP_S = 0.6
"""An ostinato's strokes are at most so far from what falls between them: eighths at 50 a minute (our choice)."""


def _with_another(time_s: NDArray[np.float64], piece: NDArray[np.int64], quick: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The notes of a quick run that fall together with another piece's, and those: natural sticking has that one."""
    pair = (np.diff(time_s) < AT_ONCE_S) & (np.diff(piece) != 0) & (quick[1:] != quick[:-1])
    return np.concatenate(([False], pair)) | np.concatenate((pair, [False]))


def _again(time_s: NDArray[np.float64], piece: NDArray[np.int64]) -> NDArray[np.bool_]:
    """The notes of two pieces at once that are the same two as at the strokes before, as in a blast beat."""
    chord = np.cumsum(np.diff(time_s, prepend=time_s[:1]) > AT_ONCE_S)
    low, high = (np.full(int(chord.max(initial=-1)) + 1, fill) for fill in (len(Piece), -1))
    np.minimum.at(low, chord, piece)
    np.maximum.at(high, chord, piece)
    two = (np.bincount(chord, minlength=len(low)) == 2) & (low != high)
    same = two[1:] & two[:-1] & (np.diff(low) == 0) & (np.diff(high) == 0)
    return np.asarray(np.concatenate(([False], same))[chord])


def _paired(notes: NDArray[np.void]) -> NDArray[np.int8]:
    """Whether each note shares the hand of the note before it: 1 it does, −1 it takes the other, 0 either."""
    pairs = np.zeros(len(notes), np.int8)
    if len(notes) < 2:
        return pairs
    grace = notes["lead_ms"] > 0
    pairs[1:][grace[:-1] & ~grace[1:]] = -1  # the stroke that grace notes lead to
    pairs[1:][grace[:-1] & grace[1:]] = 1  # both strokes of a drag
    diddle = notes["ornament"] == Ornament.DIDDLE
    moved = np.concatenate(([True], np.diff(notes["piece"].astype(np.int64)) != 0))  # no rebound goes there
    starts = diddle & (moved | ~np.concatenate(([False], diddle[:-1])))
    index = np.arange(len(notes)) - np.maximum.accumulate(np.where(starts, np.arange(len(notes)), 0))
    pairs[diddle & (index % 2 == 1)] = 1
    pairs[diddle & (index % 2 == 0) & (index > 0)] = -1
    return pairs


_GRIDS = (2, 4, 3, 6, 8)
"""Strokes a quarter note that natural sticking knows: eighths, sixteenths, triplets, sextuplets, thirty-seconds."""
_SIMPLER = (1.0, 1.0, 1.0, 1.6, 4.0)
"""A finer grid always fits better: its error must be smaller by this factor to be believed (our choice)."""
_GRID_FLOOR_TICKS = PPQ / 50
"""Deviations below this say nothing of the grid."""


def _odd(score: Score, rows: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Whether each row falls on an odd place of the grid that fits its quarter best: "e" and "a" on sixteenths.

    Eighths have odd places, the "and", only where the tempo is too fast for one hand to play them all.
    """
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
    first = np.unique(quarter, return_index=True)[1]
    eighth_s = np.diff(score.tempo_map.seconds_at(np.stack([ticks[first], ticks[first] + PPQ // 2], 1)))[:, 0]
    errors[0, eighth_s >= EASY_REPEAT_S] = np.inf
    best = np.array(_GRIDS)[np.argmin(errors, axis=0)][quarter]
    index = np.rint(place / (PPQ / best)).astype(np.int64)
    grace = score.notes["lead_ms"][rows] > 0  # stands on its main stroke's tick and falls to the other hand
    return np.asarray((index % 2 == 1) ^ grace)
