"""The tempo that was kept, bar by bar as it was played, beside the one that was asked for."""

from itertools import pairwise

import numpy as np

from station.render.palette import BRAND, GOOD, INK_FAINT, INK_SOFT, with_opacity
from station.render.report.page.charts.chart import HAIR, LETTER, WIDTH, Axis, Chart, Spot
from station.render.report.page.session_page import TempoLine
from station.render.report.page.timing_words import signed
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle

_LEFT, _RIGHT = 46.0, WIDTH - 10.0
_TOP, _LOW, _HEIGHT = 12.0, 172.0, 200.0
_LEAST_BPM = 4.0
"""The axis reaches so far beyond the tempi at the least (our choice): a hand's own scatter is no drama."""
_STEPS = (1, 2, 5, 10, 20, 50, 100)


def tempo_chart(tempo: TempoLine, atlas: Atlas) -> Chart:
    """The chart of a tempo that has at least one bar."""
    draw_list = DrawList(atlas)
    both = np.concatenate([tempo.beats_a_minute, tempo.asked])
    low, high = float(both.min()) - _LEAST_BPM, float(both.max()) + _LEAST_BPM
    end_s = max(tempo.end_s, float(tempo.at_s.max(initial=1.0)), 1.0)
    axis = Axis(0.0, end_s, _LEFT, _RIGHT)

    def y(bpm: float) -> float:
        return _LOW - (_LOW - _TOP) * (bpm - low) / (high - low)

    _grid(draw_list, (low, high), end_s, axis)
    _asked(draw_list, tempo, axis, [y(bpm) for bpm in tempo.asked.tolist()], end_s)
    points = [(axis.x(at), y(bpm)) for at, bpm in zip(tempo.at_s.tolist(), tempo.beats_a_minute.tolist(), strict=True)]
    for start, end in pairwise(points):
        draw_list.line(start, end, 1.8, GOOD)
    size = float(np.clip(120.0 / len(points), 1.2, 3.4))
    for point in points:
        draw_list.ellipse(point, (size, size), GOOD)
    spots = tuple(
        Spot(f"bar {index} as played, at {_clock(at)}: {bpm:.1f} bpm", axis.x(at) - 4.0, _TOP, 8.0, _LOW - _TOP)
        for index, (at, bpm) in enumerate(zip(tempo.at_s.tolist(), tempo.beats_a_minute.tolist(), strict=True), 1)
    )
    legend = f"Dots are bars as they were played, the broken line is the {tempo.asks}."
    return Chart("Tempo", _words(tempo), draw_list.shapes(), (WIDTH, _HEIGHT), spots, legend, _words(tempo))


def _grid(draw_list: DrawList, ends: tuple[float, float], end_s: float, axis: Axis) -> None:
    low, high = ends
    step = next((each for each in _STEPS if (high - low) / each <= 6), _STEPS[-1])
    for bpm in range(int(np.ceil(low / step)) * step, int(high) + 1, step):
        y = _LOW - (_LOW - _TOP) * (bpm - low) / (high - low)
        draw_list.box((_LEFT, y - HAIR / 2), (_RIGHT - _LEFT, HAIR), with_opacity(INK_FAINT, 0.5))
        draw_list.text(str(bpm), (_LEFT - 6, y + 4.5), TypeStyle(LETTER - 1, INK_SOFT, align=1.0))
    seconds = next((each for each in (5, 10, 15, 30, 60, 120, 300, 600, 1800) if end_s / each <= 6), 3600)
    for at in range(0, int(end_s) + 1, seconds):
        x = min(axis.x(at), WIDTH - 14.0)
        draw_list.text(_clock(at), (x, _LOW + 18), TypeStyle(LETTER - 1, INK_SOFT, align=0.5))


def _asked(draw_list: DrawList, tempo: TempoLine, axis: Axis, heights: list[float], end_s: float) -> None:
    """The broken line of what was asked for."""
    dash, ends = 7.0, [*tempo.asked_s.tolist()[1:], end_s]
    for start, end, y in zip(tempo.asked_s.tolist(), ends, heights, strict=True):
        x, last = axis.x(start), axis.x(end)
        while x < last:
            draw_list.box((x, y - 0.9), (min(dash, last - x), 1.8), BRAND)
            x += 1.6 * dash


def _clock(at_s: float) -> str:
    return f"{int(at_s) // 60}:{int(at_s) % 60:02d}"


def _words(tempo: TempoLine) -> str:
    middle = "" if tempo.median is None else f"{tempo.median:.1f} bpm in the middle of all bars"
    if tempo.drift is None:
        return f"{middle}."
    ci = tempo.drift_ci
    bears = "" if ci is None else f" (95 %: {signed(ci[0], '.2f')} to {signed(ci[1], '.2f')} %)"
    return f"{middle}, drift {signed(tempo.drift, '.2f')} % a minute{bears}."
