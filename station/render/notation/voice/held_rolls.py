"""Rolls that are held: how far each lasts, and its ties.

In one voice a roll ends where the next stroke begins, and lasts exactly as long as it is held: one within a beat is
as short as it sounds, lest it look like a stroke that is left to ring.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation
from station.core.units import PPQ
from station.music.score import Score
from station.render.notation.beams import Anchor, StaffVoice
from station.render.palette import INK

_STEPS = 24
"""A tie bends in so many level steps, for time draws out level shapes alone (`loudness_row`)."""
_OFF, _DEPTH, _THICK = 0.75, 0.6, 0.15
"""How far from its heads' middle a tie begins, how deep it hangs, how thick it is, in staff spaces (our choice)."""
_SHORT_DEPTH = 0.3
"""How deep one hangs that comes from the line before."""


def held_until(score: Score, is_foot: NDArray[np.bool_], written: NDArray[np.int64]) -> NDArray[np.int64]:
    """Up to which tick notation holds each stroke, shape (n,): its own `written` one where it is no roll."""
    notes = score.notes
    straight = dict(zip(notes["tick"].tolist(), written.tolist(), strict=True))
    late = dict(zip((notes["tick"] % PPQ).tolist(), notes["swing_ticks"].tolist(), strict=True))
    until: NDArray[np.int64] = written.copy()
    for i in np.flatnonzero((notes["articulation"] == Articulation.BUZZ) & (notes["duration_ticks"] > 0)):
        end = int(notes["tick"][i] + notes["duration_ticks"][i])
        later = written[(is_foot == is_foot[i]) & (written > written[i])]
        until[i] = min([straight.get(end, end - late.get(end % PPQ, 0)), *later.tolist()])
    return until


def draw_tie(anchor: Anchor, ticks: tuple[int, int], ends_x: tuple[float, float], head_y: float, way: int) -> None:
    """A tie between heads at two ticks, its ends so far beside them; `way` 1 hangs below the heads, −1 stands above."""
    depth = _DEPTH if ticks[0] < ticks[1] else _SHORT_DEPTH
    for k in range(_STEPS):
        a, b = k / _STEPS, (k + 1) / _STEPS
        anchor.at(round(ticks[0] + (ticks[1] - ticks[0]) * a))
        anchor.until(round(ticks[0] + (ticks[1] - ticks[0]) * b))
        y = head_y + way * (_OFF + depth * 4 * (a + b) / 2 * (1 - (a + b) / 2))
        left, right = (ends_x[0] + (ends_x[1] - ends_x[0]) * share for share in (a, b))
        anchor.draw_list.box((left - 0.02, y - _THICK / 2), (right - left + 0.04, _THICK), INK)
    anchor.draw_list.span_s = 0.0


def tie_way(voice: StaffVoice) -> int:
    """Ties keep to the side of the heads that stems do not."""
    return -voice.way
