"""Rests: which sign, and how high it stands where two voices share the staff.

Units are staff spaces, y down, 0 on the staff's middle line. A voice alone has its rests in the middle of the staff;
of two, the hands' stand higher and the feet's lower, each by whole spaces and clear of what the other voice strikes
then (Gould, "Behind Bars", 2011, "Rests in double-stemmed parts").
"""

from collections.abc import Sequence
from math import ceil, floor

from station.render.notation.spelling.note_values import Value
from station.render.notation.staff import height
from station.render.palette import INK, INK_SOFT
from station.render.text.draw_list import DrawList
from station.render.text.sign_outlines import LEDGER_LINE, LEDGER_OUT, sign_box

_HANDS_Y, _FEET_Y = -1.0, 3.0
"""Where the two voices' rests stand at the least: the staff's upper half, and below its lower lines (our choice)."""
_CLEAR = 0.25
"""Between a rest and a head of the other voice (our choice)."""
_HEAD = 0.5
_KICK = 1.5
"""The height of the kick's head, which the hands' rests keep above."""
_DOT_GAP = 0.4
_ON_A_LINE, _STAFF = (1, 2), 2.0
"""Rests that hang from a line or sit on it, and have a ledger line where there is none: beyond the staff (Gould)."""


def draw_rest(
    draw_list: DrawList, value: Value, is_up: bool, other_steps: Sequence[int] | None, x: float = 0.0
) -> None:
    """A rest of `value` in the hands' voice (`is_up`) or the feet's; `other_steps`: the other voice's heads there.

    None where the other voice is silent in the bar. Its middle is at `x`.
    """
    name = f"rest_{min(value.base, 128)}"
    y = _lone_y(name) if other_steps is None else _shared_y(name, is_up, [height(step) for step in other_steps])
    draw_list.sign(name, (x, y), INK)
    if value.base in _ON_A_LINE and abs(y) > _STAFF:
        half = sign_box(name).width / 2 + LEDGER_OUT
        draw_list.line((x - half, y), (x + half, y), LEDGER_LINE, INK_SOFT)
    for k in range(value.dots):
        right = x + sign_box(name).right + _DOT_GAP + sign_box("dot").width * 1.5 * k
        draw_list.sign("dot", (right, y - 0.5), INK)


def rest_edge(base: int, is_up: bool, other_steps: Sequence[int]) -> float:
    """How far a rest of 1/`base` of one of two voices reaches towards the ends of that voice's stems."""
    name = f"rest_{min(base, 128)}"
    y = _shared_y(name, is_up, [height(step) for step in other_steps])
    return y - sign_box(name).top if is_up else y - sign_box(name).bottom


def _lone_y(name: str) -> float:
    """The middle line; a whole rest hangs from the one above."""
    return -1.0 if name == "rest_1" else 0.0


def _shared_y(name: str, is_up: bool, heights: Sequence[float]) -> float:
    box = sign_box(name)
    if is_up:
        lowest = min([*heights, _KICK]) - _HEAD - _CLEAR
        return min(_HANDS_Y, float(floor(lowest + box.bottom)))
    highest = max(heights, default=-2.0) + _HEAD + _CLEAR
    return max(_FEET_Y, float(ceil(highest + box.top)))
