"""Bars shared out over the lines of a page, and each line spread to its full width.

Units are staff spaces. All lines are chosen together so that the worst is as good as can be (Knuth and Plass, "Breaking
Paragraphs into Lines", 1981): a line is good where its springs are near their ease and where it ends with a phrase.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from math import inf, log

import numpy as np
from numpy.typing import NDArray

from station.render.notation.page.bar_columns import BarColumns, force_to

_WIDE, _NARROW = log(1.4), log(0.76)
"""A line drawn out or squeezed by so much is as bad as one that ends within a phrase (our choice)."""
_WITHIN_PHRASE = {4: 0.2, 2: 0.7, 1: 1.5}
"""What a break costs after a multiple of so many bars of a phrase; with the phrase it costs nothing (our choice)."""
_PHRASE_INSIDE = 0.8
"""What each phrase costs that begins within a line (our choice: a section is looked for where lines begin)."""
_WITHIN_ENDING = 2.0
"""A bracket over an ending is not to be torn (our choice)."""
_LONE_BAR = 3.0
"""What a last line of a single bar costs (our choice)."""
_OVERFULL = 1e3
_MOST_BARS = 16
"""Bars in a line at the most, rests though they are (our choice)."""
_LAST_FULL, _LAST_FORCE = 1.35, 1.15
"""A last line is spread to its end where it needs no more than the first; else it keeps the force of the line before
it, or the second where it is the only one (our choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class SetBar:
    """A bar to be set: its columns, and what a line takes because of it.

    `signature` is what a new meter takes before the notes; `lead` what clef and meter take of a line that begins with
    the bar, `courtesy` what a line takes at its end for the meter of this bar, if it begins the next one. `in_phrase`
    counts the bars from its phrase's first, 0. `within_ending`: an ending's bracket reaches over its left bar line.
    """

    columns: BarColumns
    lead: float
    signature: float = 0.0
    courtesy: float = 0.0
    in_phrase: int = 0
    within_ending: bool = False

    @property
    def inside(self) -> BarColumns:
        """The columns where the bar does not begin a line: a new meter stands before its notes."""
        return replace(self.columns, inset=self.columns.inset + self.signature)


@dataclass(frozen=True, slots=True, eq=False)
class BarBox:
    """Bar number `index` of the bars set, on its line: bar lines at `left` and `right`, its columns at `places` (k,).

    All are counted from where the line's notes begin, behind clef and meter.
    """

    index: int
    left: float
    right: float
    places: NDArray[np.float64]


def lines(bars: Sequence[SetBar], width: float) -> list[list[BarBox]]:
    """The lines of `bars`, each at most `width` long with its lead and courtesy; all but the last are full."""
    breaks = _breaks(bars, width)
    found, force = list[list[BarBox]](), _LAST_FORCE
    for first, after in breaks:
        columns = [bars[first].columns, *(bar.inside for bar in bars[first + 1 : after])]
        room = _room(bars, first, after, width)
        full = force_to(columns, room)
        is_ragged = after == len(bars) and full > _LAST_FULL
        force = min(full, force) if is_ragged else full
        found.append(_boxes(columns, first, force, room))
    return found


def line_count(bars: Sequence[SetBar], width: float) -> int:
    """How many lines there are."""
    return len(_breaks(bars, width))


def _room(bars: Sequence[SetBar], first: int, after: int, width: float) -> float:
    """What a line from bar `first` up to `after` has for its bars."""
    return width - bars[first].lead - (bars[after].courtesy if after < len(bars) else 0.0)


def _boxes(columns: Sequence[BarColumns], first: int, force: float, room: float) -> list[BarBox]:
    squeezed = min(1.0, room / sum(bar.width(force) for bar in columns))  # a bar too wide for paper still fits on it
    boxes, left = [], 0.0
    for index, bar in enumerate(columns, first):
        places = left + bar.places(force) * squeezed
        boxes.append(BarBox(index, left, float(places[-1]), places[:-1]))
        left = float(places[-1])
    return boxes


def _breaks(bars: Sequence[SetBar], width: float) -> list[tuple[int, int]]:
    """First bar of each line and the one after its last."""
    count = len(bars)
    eases = list(accumulate((bar.columns.width(1.0) + bar.signature for bar in bars), initial=0.0))
    leasts = list(accumulate((bar.columns.narrowest + bar.signature for bar in bars), initial=0.0))
    costs, befores = [0.0] + [inf] * count, [0] * (count + 1)
    for first in range(count):
        for after in range(first + 1, min(first + _MOST_BARS, count) + 1):
            room, more = _room(bars, first, after, width), bars[first].signature
            least = leasts[after] - leasts[first] - more
            if least > room and after > first + 1:
                break
            ease = eases[after] - eases[first] - more
            cost = costs[first] + _line_cost(bars, first, after, room / ease) + _OVERFULL * (least > room)
            if cost < costs[after]:
                costs[after], befores[after] = cost, first
    ends = [count]
    while ends[-1]:
        ends.append(befores[ends[-1]])
    return list(zip(ends[:0:-1], ends[-2::-1], strict=True))


def _line_cost(bars: Sequence[SetBar], first: int, after: int, force: float) -> float:
    """How bad a line is whose springs are drawn out by so much."""
    inside = _PHRASE_INSIDE * sum(bar.in_phrase == 0 for bar in bars[first + 1 : after])
    if after == len(bars):
        alone = _LONE_BAR if first == after - 1 and first else 0.0
        return inside + alone + ((log(force) / _NARROW) ** 2 if force < 1 else 0.0)
    badness = inside + (log(force) / (_WIDE if force > 1 else _NARROW)) ** 2
    bar = bars[after]
    part = next((cost for bars_, cost in _WITHIN_PHRASE.items() if bar.in_phrase % bars_ == 0), 0.0)
    return badness + (part if bar.in_phrase else 0.0) + _WITHIN_ENDING * bar.within_ending
