"""Who plays the pedals: the kick's foot, the hi-hat's, and both on a double pedal where one alone is too slow.

A kick that is written for the hi-hat's foot is on the slave board; a kit without one leaves it to the kick's foot, and
nobody else can close the hi-hat. Kicks that say no foot are the kick's foot's, but for runs that are quicker than one
foot keeps up: there the feet alternate, if the other has the time to come over from the hi-hat.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.kinematics.foot_path import MOVE_S, READY_S, Visits
from station.motion.kit.kit import Kit
from station.music.score import Score

ONE_FOOT_S = 1 / 6
"""One foot repeats so fast for long, heel up (HUMANS: 5–6 Hz)."""
RUN = 4
"""From so many on it is a run: two or three quick kicks are one foot's (our choice)."""
THERE_S = MOVE_S + READY_S
"""Before a run's second stroke the other foot has nothing else to do for so long, nor after its last."""

KICKS, CLOSES, IN_TURN = "the kick's foot", "the hi-hat's foot", "in turn: too quick for one foot"
NO_SLAVE = "this kit has no second pedal"


def feet(score: Score, kit: Kit) -> tuple[NDArray[np.int8], list[str]]:
    """The notes that a foot plays; `Limb.UNKNOWN` and no reason at the others."""
    pieces, written = score.notes["piece"], score.notes["limb"]
    limbs = np.full(len(score), Limb.UNKNOWN, np.int8)
    why = [""] * len(score)
    kick, hat = kit.feet
    for piece, foot, reason in ((Piece.KICK, kick, KICKS), (Piece.HIHAT_PEDAL, hat, CLOSES)):
        for row in np.flatnonzero(pieces == piece):
            said = Limb(written[row])
            limbs[row], why[row] = foot, "written" if said is foot else reason
            if piece is Piece.KICK and said is hat:
                limbs[row], why[row] = (hat, "written") if kit.slave else (kick, NO_SLAVE)
    if kit.slave is not None:
        for row in _in_turn(score, limbs, kit):
            limbs[row], why[row] = hat, IN_TURN
    return limbs, why


def _in_turn(score: Score, limbs: NDArray[np.int8], kit: Kit) -> NDArray[np.int64]:
    """The rows of free kicks that the hi-hat's foot takes: every second one of runs that are too quick for one foot."""
    onset = score.onset_s
    rows = np.flatnonzero(score.notes["piece"] == Piece.KICK)
    rows = rows[np.argsort(onset[rows], kind="stable")]
    quick = np.diff(onset[rows]) < ONE_FOOT_S
    ends = np.flatnonzero(~np.concatenate(([False], quick, [False])))
    busy = Visits.of(score, limbs, kit.feet[1]).time_s
    taken = [np.zeros(0, np.int64)]
    for first, last in pairwise(ends.tolist()):
        run = rows[first:last]
        if len(run) < RUN or (score.notes["limb"][run] != Limb.UNKNOWN).any():
            continue
        start, end = onset[run[1]] - THERE_S, onset[run[-1]] + THERE_S
        if np.searchsorted(busy, start) == np.searchsorted(busy, end):
            taken.append(run[1::2])
    return np.concatenate(taken)
