"""Rolls that are held over the beats that follow: how far each lasts, which beats one long note fills, and its ties.

In one voice a roll ends where the next stroke begins. Inside its own beat group it is written like a stroke, to the
next one or the group's end (`rhythm`); what is held beyond that lasts exactly as long as it is held.
"""

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation
from station.core.units import PPQ
from station.music.score import Score
from station.render.notation.beams import Anchor, StaffVoice
from station.render.notation.rhythm import BeatGroup, TimedValue, Value, spell
from station.render.palette import INK

_LONG: Mapping[int, Value] = MappingProxyType(
    {2 * PPQ: Value(2), 3 * PPQ: Value(2, 1), 4 * PPQ: Value(1), 6 * PPQ: Value(1, 1)}
)
"""The lengths of several beats that one note writes."""
_STEPS = 24
"""A tie bends in so many level steps, for time stretches level shapes alone (`loudness_row`)."""
_OFF, _DEPTH, _THICK = 0.75, 0.6, 0.15
"""How far from its heads' middle a tie begins, how deep it hangs, how thick it is, in staff spaces (our choice)."""
_SHORT_DEPTH = 0.3
"""How deep one hangs that comes from the line before."""


def held_until(score: Score, is_foot: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Up to which written tick each stroke is held, shape (n,): its own where it is no roll."""
    notes = score.notes
    written = notes["tick"] - notes["swing_ticks"]
    straight = dict(zip(notes["tick"].tolist(), written.tolist(), strict=True))
    until: NDArray[np.int64] = written.copy()
    for i in np.flatnonzero((notes["articulation"] == Articulation.BUZZ) & (notes["duration_ticks"] > 0)):
        end = int(notes["tick"][i] + notes["duration_ticks"][i])
        later = written[(is_foot == is_foot[i]) & (written > written[i])]
        until[i] = min([straight.get(end, end), *later.tolist()])
    return until


def long_groups(
    groups: Sequence[tuple[int, int]], holds: Sequence[tuple[int, int]]
) -> Iterator[tuple[int, int, Value | None]]:
    """The beat groups of a bar, those that one long note fills joined, with its value; all ticks from the bar's start.

    `holds` are the ticks from which and up to which rolls are held.
    """
    i = 0
    while i < len(groups):
        start = groups[i][0]
        until = max((end for begin, end in holds if begin <= start), default=start)
        ends = {k: end for k, (_, end) in enumerate(groups[i:], i) if end <= until and end - start in _LONG}
        last = max(ends, default=i)
        yield start, groups[last][1], _LONG[ends[last] - start] if ends else None
        i = last + 1


def spelled(onsets: Sequence[int], group: tuple[int, int, Value | None], held: int | None) -> BeatGroup:
    """One group of `long_groups`; `held` is up to which tick what sounds at its start was held before, or None."""
    start, end, long = group
    if long is not None:
        return BeatGroup(start, end, (TimedValue(start, long),), ())
    return spell(onsets, start, end, held if held is not None and held < end else None)


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
