"""The plot of a tracked phase as in Boyd and Godbout 2012, figures 5 and 6: φ̂ above, E_max below, over time.

The phase stands as a share of the cycle, (φ + π)/2π; where the tracker is not sure of it, it is pale. Lines lie at the
thresholds of the triggers, discs where they sound, and small triangles on the lower edge where feet came down.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.render.palette import BRAND, GOOD, INK, INK_FAINT, INK_SOFT, WRONG, with_opacity
from station.render.report.report_cards import paper
from station.render.report.report_layout import ReportBox
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face

LIMB_COLOURS = {Limb.RIGHT_FOOT: BRAND, Limb.RIGHT_HAND: BRAND, Limb.LEFT_FOOT: WRONG, Limb.LEFT_HAND: WRONG}
"""Right and left, in the skeleton as in the plot; whatever is of neither side has `PLAIN`."""
PLAIN: Colour = INK
QUALITY_RANGE = (-1.0, 1.0)
"""E₁ is a correlation, and λE₂ takes from it at most what is seldom more than a correlation has (our choice)."""
_LEFT, _RIGHT, _HEAD, _FOOT, _BETWEEN = 54.0, 16.0, 54.0, 26.0, 16.0
"""Units round the two axes: for their numbers, for the title, and between them."""
_QUALITY_SHARE = 0.36
_UNSURE = 0.5
"""How opaque a phase is that nobody should use."""
_WRAP = 0.5
"""A phase that changes by more between two samples has wrapped."""
_TEXT = 13.0
_TICKS_S = (0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0)
_MOST_TICKS = 9


@dataclass(frozen=True, slots=True, eq=False)
class PhaseMark:
    """Something at `at_s`: a trigger that sounded at `share` of the cycle, or a footfall if that is None."""

    at_s: float
    limb: Limb
    share: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class PhaseTrace:
    """A phase over time: `time_s`, `share` 0 … 1, `quality` E_max and whether the tracker is `sure`, all (n,)."""

    title: str
    time_s: NDArray[np.float64]
    share: NDArray[np.float64]
    quality: NDArray[np.float64]
    sure: NDArray[np.bool_]
    marks: tuple[PhaseMark, ...] = ()
    thresholds: tuple[tuple[float, Limb], ...] = ()
    remark: str = ""
    span_s: tuple[float, float] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "span_s", (float(self.time_s[0]), max(float(self.time_s[-1]), self.time_s[0] + 1e-3)))


@dataclass(frozen=True, slots=True)
class PlotAxes:
    """Where a trace lies in its card: `phase` and `quality` are the two axes' boxes."""

    trace: PhaseTrace
    phase: ReportBox
    quality: ReportBox

    @classmethod
    def within(cls, trace: PhaseTrace, box: ReportBox) -> "PlotAxes":
        """The axes of a trace whose card is `box`."""
        left, width = box.left + _LEFT, box.width - _LEFT - _RIGHT
        high = box.height - _HEAD - _FOOT - _BETWEEN
        low = _QUALITY_SHARE * high
        phase = ReportBox(left, box.top + _HEAD, width, high - low)
        return cls(trace, phase, ReportBox(left, phase.bottom + _BETWEEN, width, low))

    def x(self, time_s: float) -> float:
        """Where a time lies."""
        first, last = self.trace.span_s
        return self.phase.left + self.phase.width * (time_s - first) / (last - first)

    def y_of_share(self, share: float) -> float:
        """Where a share of the cycle lies."""
        return self.phase.bottom - self.phase.height * share

    def y_of_quality(self, quality: float) -> float:
        """Where a quality lies; what is beyond the axis lies on its end."""
        low, high = QUALITY_RANGE
        return self.quality.bottom - self.quality.height * (min(max(quality, low), high) - low) / (high - low)


def draw_phase_plot(draw_list: DrawList, trace: PhaseTrace, box: ReportBox) -> PlotAxes:
    """Draw the card with the trace; returns where its axes lie."""
    axes = PlotAxes.within(trace, box)
    paper(draw_list, box)
    title, soft = TypeStyle(16, INK, Face.BOLD), TypeStyle(_TEXT, INK_SOFT)
    for words, style, y in ((trace.title, title, 23.0), (trace.remark, soft, 41.0)):
        draw_list.text(draw_list.fitted(words, style, axes.phase.width), (axes.phase.left, box.top + y), style)
    _grid(draw_list, axes)
    _curves(draw_list, axes)
    _marks(draw_list, axes)
    return axes


def _grid(draw_list: DrawList, axes: PlotAxes) -> None:
    phase, quality = axes.phase, axes.quality
    rows = [(axes.y_of_share(share), words) for share, words in ((0.0, "−π"), (0.5, "0"), (1.0, "π"))]
    rows += [(axes.y_of_quality(value), words) for value, words in ((-1.0, "−1"), (0.0, "0"), (1.0, "1"))]
    number = TypeStyle(_TEXT, INK_SOFT, Face.REGULAR, 1.0)
    for y, words in rows:
        draw_list.box((phase.left, y - 0.5), (phase.width, 1.0), INK_FAINT)
        draw_list.text(words, (phase.left - 8, y + 0.36 * _TEXT), number)
    name = TypeStyle(_TEXT, INK_SOFT)
    draw_list.text("phase", _name_of(phase), name)
    draw_list.text("E max", _name_of(quality), name)
    for share, limb in axes.trace.thresholds:
        y, colour = axes.y_of_share(share), with_opacity(LIMB_COLOURS.get(limb, PLAIN), 0.55)
        draw_list.box((phase.left, y - 0.6), (phase.width, 1.2), colour)
    for at_s, words in time_ticks(axes.trace.span_s):
        x = axes.x(at_s)
        draw_list.box((x - 0.5, phase.top), (1.0, quality.bottom - phase.top), with_opacity(INK_FAINT, 0.5))
        draw_list.text(words, (x, quality.bottom + 17), TypeStyle(_TEXT, INK_SOFT, Face.REGULAR, 0.5))


def _name_of(box: ReportBox) -> tuple[float, float]:
    return (box.left - _LEFT + 8, box.top + 0.5 * box.height - 12)


def time_ticks(span_s: tuple[float, float]) -> list[tuple[float, str]]:
    """Round times within a span, and how they are written."""
    first, last = span_s
    step = next((step for step in _TICKS_S if (last - first) / step <= _MOST_TICKS), _TICKS_S[-1])
    places = 0 if step >= 1 else 1
    ticks = np.arange(np.ceil(first / step - 1e-9), np.floor(last / step + 1e-9) + 1) * step
    return [(at_s, f"{at_s:.{places}f} s") for at_s in (ticks + 0.0).tolist()]


def _curves(draw_list: DrawList, axes: PlotAxes) -> None:
    trace = axes.trace
    for is_sure, part in _runs(trace.sure):
        colour = with_opacity(GOOD, 1.0 if is_sure else _UNSURE)
        for piece in _unwrapped(trace.share, part):
            _polyline(draw_list, [(axes.x(trace.time_s[k]), axes.y_of_share(trace.share[k])) for k in piece], colour)
        _polyline(draw_list, [(axes.x(trace.time_s[k]), axes.y_of_quality(trace.quality[k])) for k in part], colour)


def _runs(sure: NDArray[np.bool_]) -> Iterator[tuple[bool, range]]:
    """Stretches of samples of one kind; each reaches to the next one's first sample, so that lines have no gap."""
    edges = np.flatnonzero(np.diff(sure)) + 1
    begins, ends = [0, *edges.tolist()], [*edges.tolist(), len(sure)]
    for begin, end in zip(begins, ends, strict=True):
        yield bool(sure[begin]), range(begin, min(end + 1, len(sure)))


def _unwrapped(share: NDArray[np.float64], part: range) -> Iterator[range]:
    """The pieces of `part` between which the phase wraps."""
    begin = part.start
    for k in range(part.start + 1, part.stop):
        if abs(share[k] - share[k - 1]) > _WRAP:
            yield range(begin, k)
            begin = k
    yield range(begin, part.stop)


def _polyline(draw_list: DrawList, points: Sequence[tuple[float, float]], colour: Colour) -> None:
    for a, b in pairwise(points):
        draw_list.line(a, b, 1.8, colour)


def _marks(draw_list: DrawList, axes: PlotAxes) -> None:
    for mark in axes.trace.marks:
        colour, x = LIMB_COLOURS.get(mark.limb, PLAIN), axes.x(mark.at_s)
        if mark.share is None:
            draw_list.triangle((x, axes.phase.bottom - 5), (6, 4), colour, -np.pi / 2)
        else:
            draw_list.ellipse((x, axes.y_of_share(mark.share)), (4.2, 4.2), colour)
