"""SMED's assignment of hands: the five passes of figure 4.19 of the thesis, in order, each O(n).

The thesis leaves its threshold open; ours is `THRESHOLD_S`. Like the thesis, the passes know no kit: a drum is left or
right of another by its place on the standard kit, clockwise from the snare (§ 4.2.2). The feet are assigned before, as
its first pass does, and a written limb is kept, as its score format lets the user do.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.sticking.hand_notes import LEFT, RIGHT, HandNotes

THRESHOLD_S = 0.16
"""The least time between two strokes of one hand (our choice: sixteenths alternate from 94 bpm up)."""

_CLOCKWISE = (
    Piece.SNARE,
    Piece.HIHAT,
    Piece.COWBELL,
    Piece.SPLASH,
    Piece.CRASH_1,
    Piece.TOM_1,
    Piece.TOM_2,
    Piece.TOM_3,
    Piece.TOM_4,
    Piece.CRASH_2,
    Piece.RIDE,
    Piece.RIDE_2,
    Piece.CHINA,
    Piece.FLOOR_TOM_1,
    Piece.FLOOR_TOM_2,
)
"""Snare, hi-hat, crash, high tom, mid tom, ride, floor tom; the pieces that the thesis lacks at their neighbours."""
_PLACE = {piece: place for place, piece in enumerate(_CLOCKWISE)}
_NOBODY = -1
_RIDES = (Piece.RIDE, Piece.RIDE_2)
_LEADING = (Piece.HIHAT, Piece.CRASH_1, Piece.CRASH_2, Piece.SPLASH, Piece.CHINA, Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_2)

_FIXED = "fixed to its hand (first pass)"
_FORTH = "the other hand than the quick note before (second pass)"
_BACK = "the other hand than the quick note after (third pass)"
_LEADS = "the leading hand's piece (fourth pass)"
_ALTERNATE = "alternates (fifth pass)"
_SIDES = "left and right drum at once"


def smed_hands(notes: HandNotes) -> tuple[NDArray[np.int8], list[str]]:
    """The hand of every note, and the pass that chose it, in the order of the rows that `notes` were made from."""
    n = len(notes.time_s)
    hands, why = [_NOBODY] * n, [""] * n
    for i in range(n):
        if notes.written[i] in (Limb.RIGHT_HAND, Limb.LEFT_HAND):
            hands[i], why[i] = notes.written[i], "written"
        elif notes.piece[i] in _RIDES:
            hands[i], why[i] = notes.lead, _FIXED
    _quick(notes, hands, why, range(n - 1), 1, _FORTH)
    _quick(notes, hands, why, range(n - 1, 0, -1), -1, _BACK)
    for i in range(n):
        if hands[i] == _NOBODY and notes.piece[i] in _LEADING:
            hands[i], why[i] = notes.lead, _LEADS
    for i in range(n):
        if hands[i] == _NOBODY:
            hands[i], why[i] = (1 - hands[i - 1] if i else notes.lead), _ALTERNATE
    limbs, reasons = np.empty(n, np.int8), [""] * n
    for i, row in enumerate(notes.order.tolist()):
        limbs[row] = Limb.RIGHT_HAND if hands[i] == RIGHT else Limb.LEFT_HAND
        reasons[row] = why[i]
    return limbs, reasons


def _quick(notes: HandNotes, hands: list[int], why: list[str], indices: range, step: int, reason: str) -> None:
    """The second pass (`step` 1) or the third (−1): what is quicker than the threshold goes to different hands."""
    for i in indices:
        j = i + step
        if hands[j] != _NOBODY or abs(notes.time_s[j] - notes.time_s[i]) >= THRESHOLD_S:
            continue
        if hands[i] != _NOBODY:
            hands[j], why[j] = 1 - hands[i], reason
        elif notes.piece[i] != notes.piece[j]:
            first_is_left = _PLACE.get(Piece(notes.piece[i]), 0) < _PLACE.get(Piece(notes.piece[j]), 0)
            hands[i], hands[j] = (LEFT, RIGHT) if first_is_left else (RIGHT, LEFT)
            why[i] = why[j] = _SIDES
        elif step < 0:  # the leading hand has the stroke nearer to an even division
            lead_first = notes.natural[i] == notes.lead
            hands[i], hands[j] = (notes.lead, 1 - notes.lead) if lead_first else (1 - notes.lead, notes.lead)
            why[i] = why[j] = _BACK
