"""Who plays what: a limb for every stroke of a score.

`station` (the default) chooses the hands that are cheapest together over the whole score (`hand_choice`), `smed` runs
the five passes of the thesis (`smed_limbs`). Both leave the feet where the pedals are (`feet`) and a written limb as it
is written.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.motion.feasibility.on_a_kit import InfeasibleDemand, infeasible_demands
from station.motion.kit.kit import Kit
from station.motion.sticking.feet import feet
from station.motion.sticking.hand_choice import choose_hands
from station.motion.sticking.hand_notes import HandNotes, Hands
from station.motion.sticking.smed_limbs import smed_hands
from station.music.score import Score

METHODS = ("station", "smed")


@dataclass(frozen=True, eq=False)
class Assignment:
    """`limbs` (n,) of `Limb` in the order of the score's notes, `why` each was chosen, and by which `method`.

    `infeasible` is what is beyond a human; `warnings` say it, such as "bar 12 needs 14 strokes a second of one hand".
    """

    limbs: NDArray[np.int8]
    why: tuple[str, ...]
    method: str
    infeasible: tuple[InfeasibleDemand, ...]

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence for each demand that is beyond a human, in order of bars."""
        return tuple(b.text for b in self.infeasible)


def assign_limbs(score: Score, kit: Kit, method: str = "station", hands: Hands | None = None) -> Assignment:
    """A limb for every note; `hands` is who leads, as the kit is built where it is not said.

    Raises `BadInput` for an unknown method.
    """
    limbs, why = limbs_and_reasons(score, kit, method, hands)
    return Assignment(limbs, tuple(why), method, infeasible_demands(score, kit, limbs))


def limbs_and_reasons(
    score: Score, kit: Kit, method: str = "station", hands: Hands | None = None
) -> tuple[NDArray[np.int8], list[str]]:
    """The same without the question what is beyond a human: the limbs (n,), and why each was chosen."""
    if method not in METHODS:
        raise BadInput("method", method, f"no such method of limb assignment; there are {' and '.join(METHODS)}")
    lead = hands or (Hands.LEFT if kit.left_handed else Hands.RIGHT)
    score = score.on_the_grid
    limbs, why = feet(score, kit)
    rows = np.flatnonzero(limbs == Limb.UNKNOWN)
    written = np.isin(score.notes["limb"], (Limb.RIGHT_HAND, Limb.LEFT_HAND))
    if len(rows):
        notes = HandNotes.of(score, kit, rows, lead)
        chosen, reasons = choose_hands(notes) if method == "station" else smed_hands(notes)
        limbs[rows] = chosen
        for row, reason in zip(rows, reasons, strict=True):
            why[row] = "written" if written[row] else reason
    return limbs, why


def as_led(score: Score, kit: Kit, hands: Hands | None = None) -> Score:
    """`score` with its written sticking read for the player of `kit`, who may be open-handed.

    Lessons write R and L for a right-handed drummer: R means the hand that leads. On a left-handed kit every written
    limb changes sides. `Hands.OPEN` on another kit: while the right hand alone keeps time on the hi-hat, both hands
    change sides. What is read so says what is played, and is not to be read so again.
    """
    if not kit.left_handed and hands is not Hands.OPEN:
        return score
    written = score.notes["limb"].astype(np.int64)
    turned = np.ones(len(score), bool) if kit.left_handed else _beside_the_hat(score)
    return score.with_limbs(np.where(turned, _OTHER_SIDE[written], written).astype(np.int8))


def _beside_the_hat(score: Score) -> NDArray[np.bool_]:
    """The strokes of hands (n,) from a bar's first stroke on the hi-hat to its last, where the right hand has them all.

    So a fill behind them starts with the right hand as it is written. A bar whose hi-hat both hands play, as in quick
    sixteenths, or the left, as where the lesson is written open-handed, stays as it is.
    """
    tick, limb, bar = score.notes["tick"], score.notes["limb"], score.bar
    turned = np.zeros(len(score), bool)
    on_hat = score.notes["piece"] == Piece.HIHAT
    for one in np.unique(bar[on_hat]).tolist():
        rows = np.flatnonzero(on_hat & (bar == one))
        if (limb[rows] == Limb.RIGHT_HAND).all():
            turned |= (tick >= tick[rows[0]]) & (tick <= tick[rows[-1]])
    return turned & np.isin(limb, (Limb.RIGHT_HAND, Limb.LEFT_HAND))


_OTHER_SIDE = np.array([Limb.LEFT_HAND, Limb.RIGHT_HAND, Limb.LEFT_FOOT, Limb.RIGHT_FOOT, Limb.UNKNOWN], np.int8)
"""By `Limb`, whose unknown −1 finds the last."""
