"""How far from their time the strokes were: a histogram, with mean and spread and the interval of each below it."""

import numpy as np

from station.render.palette import INK, INK_SOFT, with_opacity
from station.render.report.page.charts.chart import (
    LABEL,
    LETTER,
    WIDTH,
    Axis,
    Chart,
    Spot,
    mean_mark,
    reach_ms,
    sides,
    spread_bar,
    time_axis,
    time_colour,
)
from station.render.report.page.session_page import StrokeTiming
from station.render.report.page.timing_words import side, timing_words
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle

_TOP, _LOW, _HEIGHT = 30.0, 170.0, 236.0
_MEAN_Y, _SD_Y = 203.0, 225.0
_LEFT = 46.0
_BIN_MS, _LEAST_MS, _MOST_MS = 5.0, 40.0, 120.0
"""Bins of a third of what a good player spreads; beyond 120 ms hardly anything is paired (our choice)."""


def asynchrony_histogram(timing: StrokeTiming, atlas: Atlas) -> Chart:
    """The histogram of a session's strokes."""
    values = timing.asynchrony_ms
    reach = reach_ms(
        [float(x) for x in np.percentile(np.abs(values), [98])] if len(values) else [], _LEAST_MS, _MOST_MS
    )
    axis, draw_list = Axis(-reach, reach, _LEFT, WIDTH - 22.0), DrawList(atlas)
    edges = np.arange(-reach, reach + _BIN_MS / 2, _BIN_MS)
    counts, _ = np.histogram(np.clip(values, -reach + 1e-6, reach - 1e-6), edges)
    time_axis(draw_list, axis, _TOP, _LOW, 20.0 if reach <= 80.0 else 40.0)
    sides(draw_list, axis, 16.0)
    spots = _bars(draw_list, axis, counts.tolist(), timing.on_time_ms, edges.tolist())
    _below(draw_list, axis, timing)
    figures, count = timing.figures, len(values)
    words = f"{count} {'stroke' if count == 1 else 'strokes'}, {timing_words(figures, timing.has_own_clock)}."
    legend = f"On time is within {timing.on_time_ms:g} ms."
    if beyond := int((np.abs(values) > reach).sum()):
        legend += f" Farther out than the ends: {beyond}."
    return Chart("How far from the beat", words, draw_list.shapes(), (WIDTH, _HEIGHT), tuple(spots), legend, words)


def _bars(draw_list: DrawList, axis: Axis, counts: list[int], on_time_ms: float, edges: list[float]) -> list[Spot]:
    most, spots = max([*counts, 1]), []
    for count, low in zip(counts, edges, strict=False):
        left, right = axis.x(low), axis.x(low + _BIN_MS)
        high = (_LOW - _TOP - 6) * count / most
        if count:
            colour = time_colour(low + _BIN_MS / 2, on_time_ms)
            draw_list.box((left + 0.5, _LOW - high), (right - left - 1.0, high), colour)
            words = f"{count} from {side(low, '.0f')} to {side(low + _BIN_MS, '.0f')}"
            spots.append(Spot(words, left, _TOP, right - left, _LOW - _TOP))
    draw_list.box((axis.left, _LOW - 0.6), (axis.right - axis.left, 1.2), INK_SOFT)
    draw_list.text(str(most), (axis.left - 6, _TOP + 14), TypeStyle(LETTER - 1, INK_SOFT, align=1.0))
    draw_list.text("0", (axis.left - 6, _LOW), TypeStyle(LETTER - 1, INK_SOFT, align=1.0))
    return spots


def _below(draw_list: DrawList, axis: Axis, timing: StrokeTiming) -> None:
    """Mean and spread on the axis of the strokes."""
    figures = timing.figures
    if figures.mean_ms is None:
        return
    mean = figures.mean_ms
    draw_list.text("mean", (2.0, _MEAN_Y + 4.5), LABEL)
    mean_mark(draw_list, axis, _MEAN_Y, mean, figures.mean_ci, time_colour(mean, timing.on_time_ms))
    if figures.sd_ms is None:
        return
    sd = figures.sd_ms
    draw_list.text("SD", (2.0, _SD_Y + 4.5), LABEL)
    left, right = axis.x(mean - sd), axis.x(mean + sd)
    draw_list.box((left, _SD_Y - 1.0), (right - left, 2.0), INK)
    for way in (-1, 1):
        if figures.sd_ci is not None:
            ends = sorted((mean + way * figures.sd_ci[0], mean + way * figures.sd_ci[1]))
            spread_bar(draw_list, axis, _SD_Y, (ends[0], ends[1]), with_opacity(INK, 0.9))
        draw_list.box((axis.x(mean + way * sd) - 1.0, _SD_Y - 6.0), (2.0, 12.0), INK)
