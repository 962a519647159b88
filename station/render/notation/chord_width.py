"""What stands beside and over the heads of a chord: how far they reach, and the sticking's letters.

Units are staff spaces from the middle of a plain round head (`head_places`).
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Piece
from station.render.notation.head_places import EDGE_X, placed_heads
from station.render.notation.staff import ledger_steps, step_of
from station.render.text.sign_outlines import LEDGER_OUT, sign_box

LETTERS = {Limb.RIGHT_HAND: "R", Limb.LEFT_HAND: "L", Limb.RIGHT_FOOT: "R", Limb.LEFT_FOOT: "L"}
GRACE = 0.62
"""How large grace notes are: Gould has three quarters to two thirds; ours are read beside a full flag (our choice)."""
GRACE_GAP, GRACE_STEP = 0.91, 1.0
"""From what stands left of the main note to the middle of the last grace note, and between two of them: their flags
and ledger lines have room there."""
DOT_GAP = 0.25


class Extent(NamedTuple):
    """How far something reaches: to the `left` and to the `right`, both ≥ 0."""

    left: float
    right: float


def heads_extent(mains: NDArray[np.void], is_small: NDArray[np.bool_]) -> Extent:
    """What the heads of main strokes take, with brackets, ledger lines and accents (`placed_heads`)."""
    left = right = EDGE_X
    heads = placed_heads(mains, is_small)
    for row, head in zip(mains, heads, strict=True):
        out = LEDGER_OUT if ledger_steps(head.step) else 0.0
        left, right = max(left, out - head.left), max(right, head.right + out)
        if (pair := head.brackets) is not None:
            left, right = max(left, pair.half_width - pair.left), max(right, pair.half_width + pair.right)
        if row["dynamic"] == Dynamic.ACCENT:
            left, right = max(left, sign_box("accent").right), max(right, sign_box("accent").right)
    return Extent(left, right)


def sticking(notes: NDArray[np.void], limbs: NDArray[np.int8], is_up: bool) -> list[str]:
    """The letters over (`is_up`, the hands) or under a chord, from the staff outward; none where none are written.

    Grace strokes are small before the main one, as drummers write them (lR, llR); what two hands strike at once is
    written on top of each other, as the heads are.
    """
    is_main = notes["lead_ms"] <= 0
    steps = [step_of(Piece(int(piece))) for piece in notes["piece"]]
    order = sorted(np.flatnonzero(is_main).tolist(), key=lambda i: steps[i])
    letters = [LETTERS[Limb(int(limbs[i]))] for i in order if limbs[i] in LETTERS and Limb(limbs[i]).is_hand == is_up]
    letters = list(dict.fromkeys(letters))
    early = np.flatnonzero(~is_main & is_up)
    early = early[np.argsort(-notes["lead_ms"][early], kind="stable")]
    graces = "".join(LETTERS[Limb(int(limbs[i]))].lower() for i in early if limbs[i] in LETTERS)
    return [graces + letters[0], *letters[1:]] if letters else [graces] * bool(graces)
