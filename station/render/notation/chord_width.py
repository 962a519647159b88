"""What stands beside and over the heads of a chord: how far they reach, and the sticking's letters.

Units are staff spaces from the middle of a plain round head (`head_places`).
"""

from collections.abc import Sequence
from typing import NamedTuple

from station.core.pieces import Dynamic, Limb
from station.render.notation.head_places import EDGE_X, placed_heads
from station.render.notation.staff import ledger_steps
from station.render.notation.staff_strokes import StaffStroke
from station.render.text.sign_outlines import LEDGER_OUT, sign_box

_HANDS = {int(Limb.RIGHT_HAND): "R", int(Limb.LEFT_HAND): "L"}
_FEET = {int(Limb.RIGHT_FOOT): "R", int(Limb.LEFT_FOOT): "L"}
LETTERS = _HANDS | _FEET
_ACCENT = int(Dynamic.ACCENT)
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


def heads_extent(mains: Sequence[StaffStroke]) -> Extent:
    """What the heads of main strokes take, with brackets, ledger lines and accents (`placed_heads`)."""
    left = right = EDGE_X
    heads = placed_heads(mains)
    for stroke, head in zip(mains, heads, strict=True):
        out = LEDGER_OUT if ledger_steps(head.step) else 0.0
        left, right = max(left, out - head.left), max(right, head.right + out)
        if (pair := head.brackets) is not None:
            left, right = max(left, pair.half_width - pair.left), max(right, pair.half_width + pair.right)
        if stroke.dynamic == _ACCENT:
            left, right = max(left, sign_box("accent").right), max(right, sign_box("accent").right)
    return Extent(left, right)


def sticking(strokes: Sequence[StaffStroke], is_up: bool) -> list[str]:
    """The letters over (`is_up`, the hands) or under a chord, from the staff outward; none where none are written.

    Grace strokes are small before the main one, as drummers write them (lR, llR); what two hands strike at once is
    written on top of each other, as the heads are.
    """
    known = _HANDS if is_up else _FEET
    mains = sorted((s for s in strokes if s.is_main and s.limb in known), key=lambda s: s.step)
    letters = list(dict.fromkeys(known[s.limb] for s in mains))
    early = sorted((s for s in strokes if is_up and not s.is_main and s.limb in LETTERS), key=lambda s: -s.lead_ms)
    graces = "".join(LETTERS[s.limb].lower() for s in early)
    return [graces + letters[0], *letters[1:]] if letters else [graces] * bool(graces)
