"""Bar by bar of the lesson, all passes together: the mean with its interval, what was right, missed, and too many.

Here late is up, for bars go to the right as in the score.
"""

from collections.abc import Sequence
from math import ceil

import numpy as np

from station.render.palette import EXTRA, GOOD, INK, INK_FAINT, INK_SOFT, MISSED, with_opacity
from station.render.report.page.charts.chart import (
    ARROW,
    CUT,
    HAIR,
    LETTER,
    WIDTH,
    Chart,
    Spot,
    reach_ms,
    time_colour,
)
from station.render.report.page.session_page import BarFigures
from station.render.report.page.timing_words import signed, timing_words
from station.render.text.atlas import Atlas
from station.render.text.draw_list import Colour, DrawList, TypeStyle

_LEFT, _RIGHT = 62.0, WIDTH - 8.0
_TOP, _LOW = 12.0, 142.0
_STRIPS = (("right", 152.0), ("missed", 174.0), ("extra", 196.0))
_STRIP, _HEIGHT = 18.0, 238.0
_NUMBERED = 20.0
"""A cell so wide has room for its number."""


def bar_chart(bars: Sequence[BarFigures], on_time_ms: float, atlas: Atlas) -> Chart:
    """The chart of `bars`, at least one."""
    draw_list = DrawList(atlas)
    ends = [abs(end) for bar in bars for end in (bar.group.timing.mean_ci or (bar.group.timing.mean_ms or 0.0,))]
    reach = reach_ms(ends, 40.0, 100.0)
    wide = (_RIGHT - _LEFT) / len(bars)
    for ms in (-reach / 2, 0.0, reach / 2):
        y = _y(ms, reach)
        draw_list.box(
            (_LEFT, y - HAIR / 2), (_RIGHT - _LEFT, HAIR), INK_SOFT if not ms else with_opacity(INK_FAINT, 0.6)
        )
        draw_list.text(signed(ms) if ms else "0 ms", (_LEFT - 6, y + 4.5), TypeStyle(LETTER - 1, INK_SOFT, align=1.0))
    draw_list.text("late", (_LEFT - 6, _TOP + 9), TypeStyle(LETTER, INK, align=1.0))
    draw_list.text("early", (_LEFT - 6, _LOW), TypeStyle(LETTER, INK, align=1.0))
    for name, top in _STRIPS:
        draw_list.text(name, (_LEFT - 6, top + 13), TypeStyle(LETTER, INK_SOFT, align=1.0))
    most = max([1, *(max(bar.group.misses, bar.extras) for bar in bars)])
    every = ceil(26.0 / wide)
    spots = []
    for index, bar in enumerate(bars):
        left = _LEFT + index * wide
        _mean(draw_list, left + wide / 2, bar, reach, (on_time_ms, wide))
        _cells(draw_list, left, wide, bar, most)
        if index % every == 0:
            draw_list.text(str(bar.bar), (left + wide / 2, 228.0), TypeStyle(LETTER - 1, INK_SOFT, align=0.5))
        spots.append(Spot(_words(bar), left, _TOP, wide, 204.0))
    draw_list.text("bar", (_LEFT - 6, 228.0), TypeStyle(LETTER - 1, INK_SOFT, align=1.0))
    words = " ".join(f"{spot.words}." for spot in spots[:_MOST_SAID])
    return Chart("Bar by bar", words, draw_list.shapes(), (WIDTH, _HEIGHT), tuple(spots), _LEGEND)


_LEGEND = (
    f"Dots are means, of five passes and more with their 95 % intervals ({CUT})."
    " The fuller a cell, the more was right, missed, or not written at all."
)
_MOST_SAID = 32
"""Bars whose figures are said to those who hear the page (our choice): more, nobody listens to."""


def _y(ms: float, reach: float) -> float:
    return (_TOP + _LOW) / 2 - (_LOW - _TOP) / 2 * min(max(ms / reach, -1.0), 1.0)


def _mean(draw_list: DrawList, x: float, bar: BarFigures, reach: float, scale: tuple[float, float]) -> None:
    on_time_ms, wide = scale
    timing, size = bar.group.timing, min(max(wide / 3, 1.2), 4.6)
    if timing.mean_ms is None:
        return
    if timing.mean_ci is not None:
        top, low = _y(timing.mean_ci[1], reach), _y(timing.mean_ci[0], reach)
        draw_list.box((x - size / 4, top), (size / 2, max(low - top, 0.5)), INK)
        for y, is_cut, angle in (
            (top, timing.mean_ci[1] > reach, -np.pi / 2),
            (low, timing.mean_ci[0] < -reach, np.pi / 2),
        ):
            if is_cut:
                draw_list.triangle((x, y), (ARROW[0] * size / 4.6, ARROW[1] * size / 4.6), INK, angle)
    draw_list.ellipse((x, _y(timing.mean_ms, reach)), (size, size), INK)
    inner = max(size - 1.3, 0.6)
    draw_list.ellipse((x, _y(timing.mean_ms, reach)), (inner, inner), time_colour(timing.mean_ms, on_time_ms))


def _cells(draw_list: DrawList, left: float, wide: float, bar: BarFigures, most: int) -> None:
    group = bar.group
    shares: tuple[tuple[float, Colour, int], ...] = (
        (bar.right / group.notes if group.notes else 0.0, GOOD, bar.right),
        (group.misses / most, MISSED, group.misses),
        (bar.extras / most, EXTRA, bar.extras),
    )
    gap = min(1.0, wide / 6)
    for (_, top), (share, colour, count) in zip(_STRIPS, shares, strict=True):
        draw_list.box((left + gap / 2, top), (wide - gap, _STRIP), with_opacity(INK_FAINT, 0.18))
        if count:
            high = max(_STRIP * share, 2.0)
            draw_list.box((left + gap / 2, top + _STRIP - high), (wide - gap, high), with_opacity(colour, 0.6))
        if wide >= _NUMBERED and (count or colour is GOOD):
            draw_list.text(str(count), (left + wide / 2, top + 13.5), TypeStyle(LETTER - 1, INK, align=0.5))


def _words(bar: BarFigures) -> str:
    group = bar.group
    found = f"Bar {bar.bar}: {bar.right} of {group.notes} right, {group.misses} missed, {bar.extras} extra"
    return f"{found}, {timing_words(group.timing)}" if group.timing.mean_ms is not None else found
