"""Who plays what: a limb for every stroke of a score.

`station` (the default) chooses the hands that are cheapest together over the whole score (`sticking`), `smed` runs the
five passes of the thesis (`smed_limbs`). Both leave the feet where the pedals are and a written limb as it is written.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.motion.beyond import Beyond, beyond_human
from station.motion.hand_notes import HandNotes, Hands
from station.motion.kit import Kit
from station.motion.smed_limbs import smed_hands
from station.motion.sticking import choose_hands
from station.music.score import Score

METHODS = ("station", "smed")


@dataclass(frozen=True, eq=False)
class Assignment:
    """`limbs` (n,) of `Limb` in the order of the score's notes, `why` each was chosen, and by which `method`.

    `beyond` is what is beyond a human; `warnings` say it, such as "bar 12 needs 14 strokes a second of one hand".
    """

    limbs: NDArray[np.int8]
    why: tuple[str, ...]
    method: str
    beyond: tuple[Beyond, ...]

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence for each demand that is beyond a human, in order of bars."""
        return tuple(b.text for b in self.beyond)


def assign_limbs(score: Score, kit: Kit, method: str = "station", hands: Hands | None = None) -> Assignment:
    """A limb for every note; `hands` is who leads, as the kit is built where it is not said.

    Raises `BadInput` for an unknown method.
    """
    if method not in METHODS:
        raise BadInput("method", method, f"no such method of limb assignment; there are {' and '.join(METHODS)}")
    lead = hands or (Hands.LEFT if kit.left_handed else Hands.RIGHT)
    limbs, why = _feet(score, kit.left_handed)
    rows = np.flatnonzero(limbs == Limb.UNKNOWN)
    written = np.isin(score.notes["limb"], (Limb.RIGHT_HAND, Limb.LEFT_HAND))
    if len(rows):
        notes = HandNotes.of(score, kit, rows, lead)
        chosen, reasons = choose_hands(notes) if method == "station" else smed_hands(notes)
        limbs[rows] = chosen
        for row, reason in zip(rows, reasons, strict=True):
            why[row] = "written" if written[row] else reason
    return Assignment(limbs, tuple(why), method, beyond_human(score, kit, limbs))


def _feet(score: Score, left_handed: bool) -> tuple[NDArray[np.int8], list[str]]:
    """The notes that a foot plays; `Limb.UNKNOWN` and no reason at the others."""
    pieces, written = score.notes["piece"], score.notes["limb"]
    limbs = np.full(len(score), Limb.UNKNOWN, np.int8)
    why = [""] * len(score)
    kick, hat = (Limb.LEFT_FOOT, Limb.RIGHT_FOOT) if left_handed else (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)
    for piece, foot, reason in ((Piece.KICK, kick, "the kick's foot"), (Piece.HIHAT_PEDAL, hat, "the hi-hat's foot")):
        for row in np.flatnonzero(pieces == piece):
            said = written[row] in (Limb.LEFT_FOOT, Limb.RIGHT_FOOT)
            limbs[row] = written[row] if said else foot
            why[row] = "written" if said else reason
    return limbs, why


def as_led(score: Score, kit: Kit) -> Score:
    """`score` with its written sticking read for the player of `kit`.

    Lessons write R and L for a right-handed drummer: R means the hand that leads. On a left-handed kit every written
    limb changes sides; what is read so says what is played, and is not to be read so again.
    """
    if not kit.left_handed:
        return score
    return score.with_limbs(_OTHER_SIDE[score.notes["limb"].astype(np.int64)])


_OTHER_SIDE = np.array([Limb.LEFT_HAND, Limb.RIGHT_HAND, Limb.LEFT_FOOT, Limb.RIGHT_FOOT, Limb.UNKNOWN], np.int8)
"""By `Limb`, whose unknown −1 finds the last."""
