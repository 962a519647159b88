"""Which limb a virtual student plays each stroke with, where the score leaves it open.

Written sticking rules. The kick is the right foot's, the hi-hat pedal the left's. Of the other strokes the right hand
takes cymbals and everything else that keeps time; a drum is the left hand's when the right hand strikes in the same
slot, and else the hand's that did not play the slot before. That is how a right-handed beginner reads a chart; whoever
knows better writes the limbs into the score first (`Score.with_limbs`).
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CYMBALS, OTHER_HAND, USUAL_FEET, Limb, Piece
from station.music.passages import TIMEKEEPERS
from station.music.score import Score

_RIGHT_HAND_PIECES = CYMBALS.union(TIMEKEEPERS)


_KEPT_SCORES = 256
"""A learner practises the same few scores again and again; their limbs are worked out once."""


@lru_cache(maxsize=_KEPT_SCORES)
def limbs_of(score: Score) -> NDArray[np.int8]:
    """The limb of every row, shape (n,), read-only; none is `Limb.UNKNOWN`. A grace stroke goes by its tick's rule."""
    limbs = score.notes["limb"].copy()
    pieces, ticks = score.notes["piece"].tolist(), score.notes["tick"].tolist()
    last, busy, busy_tick = Limb.LEFT_HAND, Limb.UNKNOWN, -1
    order = np.lexsort((~np.isin(score.notes["piece"], list(_RIGHT_HAND_PIECES)), ticks))
    for row in order.tolist():
        piece, tick = Piece(pieces[row]), ticks[row]
        if tick != busy_tick:
            busy, busy_tick = Limb.UNKNOWN, tick
        limb = Limb(int(limbs[row]))
        if limb is Limb.UNKNOWN:
            limb = USUAL_FEET[piece] if piece in USUAL_FEET else _free_hand(piece, busy, last)
        if limb.is_hand:
            last = busy = limb
        limbs[row] = limb
    limbs.setflags(write=False)
    return limbs


def _free_hand(piece: Piece, busy: Limb, last: Limb) -> Limb:
    """The hand for `piece` when `busy` strikes in the same slot (or `UNKNOWN`) and `last` struck before it."""
    if busy in OTHER_HAND:
        return OTHER_HAND[busy]
    return Limb.RIGHT_HAND if piece in _RIGHT_HAND_PIECES else OTHER_HAND[last]
