"""The lanes of the figure panel: a control over the lesson's bars, drawn and dragged with the mouse or typed in.

A press on a point drags it, a press beside one draws, a right click takes a point away; the list below does the same by
the keyboard.
"""

import numpy as np
from imgui_bundle import imgui, implot

from station.app.style.style_controls import CONTROLS
from station.app.style.style_options import PIECES, StyleOptions
from station.core.labels import name_of
from station.gui import theme
from station.gui.widgets import plots
from station.gui.widgets.lane_frame import LaneFrame
from station.motion.style.automation_lanes import drawn, value_at, with_moved, with_point, without_point
from station.motion.style.style import Automation, range_of
from station.music.score import Score
from station.render import palette

CANVAS = "##lane"
_HEIGHT, _LIST, _POINT_PX = 190, 160, 6.0
_MARGIN = 0.02
"""Of the bars, and half as much as of the values, beyond the ends (our choice)."""
_MOST_BAR_LINES = 40
"""More bars than this have a line every few bars only (our choice)."""


def _labels() -> dict[str, str]:
    tabs = {"frequency": "frequency: ", "amplitude": "amplitude: "}
    numbers = {n: tabs.get(n.split("_")[0], "") + c.label for n, c in CONTROLS.items()}
    return {**numbers, **{name: name_of(name) for name in PIECES}}


LABELS = _labels()


class LanesEditor:
    """One control's lane at a time; `control` is its name."""

    def __init__(self) -> None:
        self.control = "amplitude_gain"
        self._under: Automation = ()
        self._stroke: list[tuple[float, float]] = []
        self._last: tuple[float, float] | None = None
        self.ends = np.zeros((2, 2))
        """Where the first bar begins, at the least value, and the last one ends, at the greatest; window pixels."""

    def gui(self, options: StyleOptions, score: Score, place: float | None) -> StyleOptions:
        """Draw the editor for the bars of `score`; `place` is where the music is. Returns what the user has made."""
        self._choose(options)
        beats = score.tempo_map.meters[0].beats
        bars = max(score.bar_count, 1)
        options = self._canvas(options, bars, beats, place)
        return self._points(options, bars, beats)

    def _choose(self, options: StyleOptions) -> None:
        imgui.set_next_item_width(-1)
        lanes = options.style.automation
        if imgui.begin_combo("##lane-control", LABELS[self.control]):
            for name, label in LABELS.items():
                mark = "  over the bars" if name in lanes else ""
                if imgui.selectable(f"{label}{mark}##{name}", name == self.control)[0]:
                    self.control = name
            imgui.end_combo()
        theme.tooltip("Which control changes over the bars")

    # --- the picture --------------------------------------------------------------------------------------------------

    def _canvas(self, options: StyleOptions, bars: int, beats: int, place: float | None) -> StyleOptions:
        frame = LaneFrame(bars, beats, *range_of(self.control))
        if implot.begin_plot(CANVAS, imgui.ImVec2(-1, theme.points(_HEIGHT)), plots.FIXED):
            _axes(frame)
            self.ends = plots.pixels(np.array([1.0, bars + 1.0]), np.array([frame.low, frame.high]))
            self._line(frame, options)
            if place is not None:
                implot.plot_inf_lines("##place", np.array([place]), plots.spec(palette.INK, 1.5))
            is_on_point, moved = self._drag_points(frame, options)
            options = moved if is_on_point and self._last is None else self._draw(frame, moved)
            implot.end_plot()
        return options

    def _line(self, frame: LaneFrame, options: StyleOptions) -> None:
        """The lane from the first bar to the last; one that is not drawn is level."""
        lane = options.lane(self.control)
        points = lane or ((1.0, options.value(self.control)),)
        last = frame.bars + 1.0
        ends = [(1.0, value_at(points, 1.0)), *points, (last, value_at(points, last))]
        bars, values = (np.array(numbers) for numbers in zip(*ends, strict=True))
        implot.plot_line("##line", bars, values, plots.spec(palette.BRAND if lane else palette.INK_SOFT, 2.5))

    def _drag_points(self, frame: LaneFrame, options: StyleOptions) -> tuple[bool, StyleOptions]:
        """The lane's points, dragged, or taken away by a right click; also whether the mouse is on one of them."""
        is_on_point, lane = False, options.lane(self.control) or ()
        for index, (bar, value) in enumerate(lane):
            moved, to_bar, to_value, _, is_hovered, is_held = implot.drag_point(
                index, bar, value, plots.vec(palette.BRAND), theme.points(_POINT_PX), 0, False, False, False
            )
            is_on_point |= bool(is_hovered or is_held)
            if is_hovered and imgui.is_mouse_clicked(imgui.MouseButton_.right):
                options = options.draw_lane(self.control, without_point(lane, index))
            elif moved:
                options = options.draw_lane(self.control, with_moved(lane, index, *frame.point(to_bar, to_value)))
        return is_on_point, options

    def _draw(self, frame: LaneFrame, options: StyleOptions) -> StyleOptions:
        """Draw from a press beside the points on, until it is let go."""
        at, hovered = implot.get_plot_mouse_pos(), implot.is_plot_hovered()
        here = at.x, at.y
        if hovered and imgui.is_mouse_clicked(imgui.MouseButton_.left):
            self._under, self._stroke, self._last = options.lane(self.control) or (), [], here
        elif not imgui.is_mouse_down(imgui.MouseButton_.left):
            self._last = None
        if self._last is None and hovered:
            bar, value = frame.point(*here)
            imgui.set_tooltip(f"bar {int(bar)}, beat {1 + round((bar % 1) * frame.beats)}: {value:.1f}\n{_HELP}")
        elif self._last is not None and (here != self._last or not self._stroke):
            self._stroke += frame.stroke(self._last, here)
            self._last = here
            return options.draw_lane(self.control, drawn(self._under, self._stroke))
        return options

    # --- the list -----------------------------------------------------------------------------------------------------

    def _points(self, options: StyleOptions, bars: int, beats: int) -> StyleOptions:
        control = self.control
        lane = options.lane(control) or ()
        if imgui.button("Add a point##add-point"):
            after = lane[-1][0] + 1.0 if lane else 1.0
            value = lane[-1][1] if lane else options.value(control)
            options = options.draw_lane(control, with_point(lane, min(after, bars + 1.0), value))
        theme.tooltip("A point a bar after the last one")
        if not theme.is_narrow():
            imgui.same_line()
        imgui.begin_disabled(not lane)
        if imgui.button("Same in all bars##end-lane"):
            options = options.end_lane(control)
        imgui.end_disabled()
        theme.tooltip("Take the lane away")
        # a child of its own, so that the picture stays where it is while points come and go under the mouse
        imgui.begin_child("##points", imgui.ImVec2(0, max(imgui.get_content_region_avail().y, theme.points(_LIST))))
        if not lane:
            theme.soft("The same in all bars. Draw in the picture, or add a point, to let it change.")
        for index, point in enumerate(lane):
            options = self._point(options, index, point, beats)
        imgui.end_child()
        return options

    def _point(self, options: StyleOptions, index: int, point: tuple[float, float], beats: int) -> StyleOptions:
        control, lane = self.control, options.lane(self.control) or ()
        narrow = theme.is_narrow()
        imgui.set_next_item_width(-1 if narrow else theme.points(140))
        moved, bar = imgui.input_float(f"##bar-of-{index}", point[0], 1 / beats, 1.0, "%.2f")
        theme.tooltip("Where the point is: bars from 1, a fraction is a place within the bar")
        if not narrow:
            imgui.same_line()
        imgui.set_next_item_width(-theme.points(28) - imgui.get_style().item_spacing.x)
        set_to, value = theme.slider_float(f"##value-of-{index}", point[1], *range_of(control), "%.1f")
        theme.tooltip("What the control is there")
        imgui.same_line()
        if imgui.button(f"×##point-{index}", imgui.ImVec2(-1, 0)):
            options = options.draw_lane(control, without_point(lane, index))
        elif moved or set_to:
            options = options.draw_lane(control, with_moved(lane, index, bar, value))
        theme.tooltip("Take this point away")
        return options


def _axes(frame: LaneFrame) -> None:
    """Bars across and values up, and a little more, so that points at the ends are whole."""
    margin = _MARGIN * frame.bars
    plots.fixed(implot.ImAxis_.x1, 1 - margin, frame.bars + 1 + margin)
    lines = range(1, frame.bars + 1, -(-frame.bars // _MOST_BAR_LINES))
    implot.setup_axis_ticks(implot.ImAxis_.x1, [*map(float, lines)], [*map(str, lines)])
    margin = 2 * _MARGIN * (frame.high - frame.low)
    plots.fixed(implot.ImAxis_.y1, frame.low - margin, frame.high + margin)


_HELP = "Press beside a point and draw, drag a point, right click takes it away"
