"""Bars of a score shared out over the lines of a page: how wide each wants to be, and which stand together.

Widths are staff spaces. A bar wants room for its shortest step between strokes; a line holds one, two, four or eight
bars where it can, so that phrases stand under each other, and is then spread to its full width.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from station.core.units import PPQ
from station.music.score import Score

_STEP, _GRACE_STEP = 2.4, 1.1
"""What two strokes after each other take at the least, and each grace stroke between them; our choice, from the
engraved head's width of 1.3 and what hangs on it."""
_INSET, REPEAT, _BRACKET = 1.25, 1.5, 0.9
"""From a bar line to its first beat; what a repeat sign takes besides; what a grace stroke's bracket does."""
_LEAST_BAR = 9.0
_FINEST = PPQ // 8
"""Steps finer than a thirty-second do not widen a bar: played scores have flams that are no rhythm (our choice)."""
_TOGETHER = (8, 4, 2, 1)
_MORE = 1.25
"""A last line may be spread so much more than the one before it (our choice)."""
_KNOT = PPQ // 4
"""Between these ticks time runs evenly over the line."""


@dataclass(frozen=True, slots=True)
class BarBox:
    """A bar on its line: where its bar line stands, where its first beat does, and where the next bar line."""

    bar: int
    left: float
    start: float
    right: float


@dataclass(frozen=True, slots=True)
class Want:
    """What a bar needs: `inset` from its bar line to its first beat, `width` from there to the next bar line."""

    inset: float
    width: float


def want(score: Score, bar: int, before: float = 0.0) -> Want:
    """What the bar needs, in staff spaces, where so much stands `before` its notes."""
    tempo = score.tempo_map
    start, end = tempo.bar_start(bar), tempo.bar_start(bar + 1)
    first, last = np.searchsorted(score.notes["tick"], [start, end])
    notes, is_grace = score.notes[first:last], score.is_grace[first:last]
    ticks = np.unique([*notes["tick"][~is_grace], *_tails(score, start, end)]).astype(np.int64)
    steps = np.diff([*ticks.tolist(), end])
    shortest = max(int(steps.min()), _FINEST) if len(ticks) else end - start
    graced, counts = np.unique(notes["tick"][is_grace], return_counts=True)
    step = _STEP + (_GRACE_STEP * (1 + int(counts.max())) if len(counts) else 0.0)
    inset = _INSET + before
    if len(graced) and graced[0] == start:
        inset += _GRACE_STEP * int(counts[0]) + _BRACKET
    return Want(inset, max(_LEAST_BAR, step * (end - start) / shortest))


def _tails(score: Score, start: int, end: int) -> Iterator[int]:
    """Where rolls that are held over a beat are tied and end in [start, end) ticks."""
    notes = score.notes[score.notes["duration_ticks"] > 0]
    for tick, length in zip((notes["tick"] - start).tolist(), notes["duration_ticks"].tolist(), strict=True):
        first, last = (tick // PPQ + 1) * PPQ, (tick + length - 1) // PPQ * PPQ
        if first <= last:
            yield from (start + at for at in (first, last, tick + length) if 0 <= at < end - start)


def systems(score: Score, width: float, before: Mapping[int, float] | None = None) -> list[list[BarBox]]:
    """The lines of the score, each at most `width` staff spaces long; `before` is what stands before a bar's notes."""
    wanted = [want(score, bar, (before or {}).get(bar, 0.0)) for bar in range(score.bar_count)]
    found: list[list[BarBox]] = []
    at, stretch = 0, 1.0
    while at < len(wanted):
        count = _count(wanted[at:], width) if at else _count_first(wanted, width)
        line = wanted[at : at + count]
        full = (width - sum(bar.inset for bar in line)) / sum(bar.width for bar in line)
        is_last = bool(found) and at + count == len(wanted)
        if not is_last or full <= _MORE * stretch:  # a short last line is not spread to the end
            stretch = full
        found.append(_laid(line, at, stretch))
        at += count
    return found


def _count_first(wanted: Sequence[Want], width: float) -> int:
    """How many bars stand in the first line: all, if it holds them."""
    return len(wanted) if _fit(wanted, width) else _count(wanted, width)


def _count(wanted: Sequence[Want], width: float) -> int:
    """How many of the next bars stand in a line."""
    return next((k for k in _TOGETHER if k <= len(wanted) and _fit(wanted[:k], width)), 1)


def _fit(wanted: Sequence[Want], width: float) -> bool:
    return sum(bar.inset + bar.width for bar in wanted) <= width


def _laid(line: Sequence[Want], first: int, stretch: float) -> list[BarBox]:
    boxes, left = [], 0.0
    for bar, wish in enumerate(line, first):
        right = left + wish.inset + wish.width * stretch
        boxes.append(BarBox(bar, left, left + wish.inset, right))
        left = right
    return boxes


def ruler(score: Score, box: BarBox) -> Callable[[float], float]:
    """Where a second of the score stands in its bar's line, in staff spaces."""
    tempo = score.tempo_map
    start, end = tempo.bar_start(box.bar), tempo.bar_start(box.bar + 1)
    ticks = [*range(start, end, _KNOT), end]
    places = [box.start + (tick - start) / (end - start) * (box.right - box.start) for tick in ticks]
    seconds = tempo.seconds_at(ticks)
    return lambda time_s: float(np.interp(time_s, seconds, places))
