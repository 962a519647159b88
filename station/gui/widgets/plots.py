"""Plots as the panels have them: axes that stand still, lines in the theme's colours, and the marks of strokes."""

from collections.abc import Sequence

import numpy as np
from imgui_bundle import imgui, implot
from numpy.typing import NDArray

from station.gui import theme
from station.render.report.stroke_plot import StrokeMark, by_kind, heights_ms
from station.render.text.draw_list import Colour

Array = NDArray[np.float64]

FREE = implot.Flags_.no_frame | implot.Flags_.no_mouse_text
"""A plot that can be moved and zoomed."""
FIXED = FREE | implot.Flags_.no_legend | implot.Flags_.no_menus | implot.Flags_.no_box_select
"""A plot that is looked at and clicked on, and neither moved nor zoomed: its axes are `fixed`."""
SEEN = FIXED | implot.Flags_.no_inputs
"""One that is only looked at: the wheel over it scrolls the panel."""
_QUIET = implot.AxisFlags_.no_label | implot.AxisFlags_.no_menus | implot.AxisFlags_.no_highlight
BARE = implot.AxisFlags_.no_decorations
_CLEAR = (0.0, 0.0, 0.0, 0.0)
_MARKERS = {
    StrokeMark.DISC: implot.Marker_.circle,
    StrokeMark.UP: implot.Marker_.up,
    StrokeMark.DOWN: implot.Marker_.down,
    StrokeMark.SQUARE: implot.Marker_.square,
    StrokeMark.BARRED_RING: implot.Marker_.circle,
    StrokeMark.CROSS: implot.Marker_.cross,
    StrokeMark.RING: implot.Marker_.circle,
}
_FILLED = (StrokeMark.DISC, StrokeMark.UP, StrokeMark.DOWN)
_EDGE = 1.7
"""Design pixels: the line of a mark that is not filled."""


def axis(which: int, flags: int = 0) -> None:
    """Set up an axis without label, menu and highlight; `flags` of `AxisFlags_` are added."""
    implot.setup_axis(which, "", _QUIET | flags)


def fixed(which: int, low: float, high: float, flags: int = 0) -> None:
    """Set up an axis that goes from `low` to `high` and cannot be moved."""
    axis(which, implot.AxisFlags_.lock | flags)
    implot.setup_axis_limits(which, low, high, implot.Cond_.always)


def spec(colour: Colour, weight: float = 1.0, size: float = 4.0, marker: int = implot.Marker_.none) -> implot.Spec:
    """A colour of the night for lines, faces and marks; `weight` and `size`, a radius, are design pixels."""
    shown = vec(colour)
    return implot.Spec(
        line_color=shown,
        line_weight=theme.points(weight),
        fill_color=shown,
        marker=marker,
        marker_size=theme.points(size),
        marker_line_color=shown,
        marker_fill_color=shown,
    )


def across(name: str, heights: Sequence[float], look: implot.Spec) -> None:
    """Draw lines from side to side."""
    look.flags = implot.InfLinesFlags_.horizontal
    implot.plot_inf_lines(name, np.array(heights, np.float64), look)


def strokes(x: Array, label: NDArray[np.uint8], asynchrony_ms: Array, on_time_ms: float, radius: float) -> None:
    """Draw strokes at `x` as `stroke_plot` says; `radius` design pixels a dot."""
    at_ms = heights_ms(label, asynchrony_ms)
    for kind, rows in by_kind(label, asynchrony_ms, on_time_ms):
        is_line = kind.mark not in _FILLED
        look = spec(kind.colour, _EDGE if is_line else 1.0, radius * kind.radius, _MARKERS[kind.mark])
        if is_line:
            look.marker_fill_color = vec(_CLEAR)
        implot.plot_scatter(kind.name, x[rows], at_ms[rows], look)
        if kind.mark is StrokeMark.BARRED_RING:
            _bars(kind.name, x[rows], at_ms[rows], look)


def _bars(name: str, x: Array, y: Array, look: implot.Spec) -> None:
    """The bars of barred rings: ImPlot has no such marker."""
    reach = look.marker_size / np.sqrt(2) / _scale()
    ends = np.stack([[x - reach[0], y - reach[1]], [x + reach[0], y + reach[1]]], axis=-1).reshape(2, -1)
    bars = implot.Spec(line_color=look.line_color, line_weight=look.line_weight, flags=implot.LineFlags_.segments)
    implot.plot_line(name, ends[0], ends[1], bars)


def pixels(x: Array, y: Array) -> Array:
    """Where points of the present plot lie in the window, (n, 2)."""
    limits, corner, scale = implot.get_plot_limits(), implot.get_plot_pos(), _scale()
    return np.column_stack([corner.x + (x - limits.x.min) * scale[0], corner.y + (limits.y.max - y) * scale[1]])


def _scale() -> Array:
    """Pixels a unit of the present plot's axes, across and up."""
    limits, size = implot.get_plot_limits(), implot.get_plot_size()
    return np.array([size.x / limits.x.size(), size.y / limits.y.size()])


def vec(colour: Colour) -> imgui.ImVec4:
    """What the theme shows for a colour of the night."""
    return imgui.ImVec4(*theme.themed(colour))
