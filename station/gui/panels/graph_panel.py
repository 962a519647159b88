"""The graph: both arms' angles over the music, and below them the student's timing and loudness (SMED, figure 4.5).

The time axis follows the play line and keeps the width that the user has chosen by wheel or drag; while nothing plays
it stays where it is put. The play line can be dragged.
"""

from collections.abc import Callable

import numpy as np
from imgui_bundle import imgui, implot

from station.core.units import NS_PER_S
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow
from station.render import palette
from station.render.text.draw_list import Colour
from station.scenes.curves import ScoreCurves, StudentStrokes
from station.scenes.joint_curves import CURVES, JointCurves
from station.scenes.music_ticks import music_ticks

ABOUT = "Joint angles of both arms over the music, your timing and loudness below"
HELP = (
    "How far shoulder, elbow and wrist of both arms are turned over the beats and bars; the left arm is paler. It"
    " follows the play line; the wheel zooms, a drag shifts, and between sessions the line itself can be dragged. In a"
    " session and beside a result every stroke of yours stands below: its timing, early below the line,"
    " and how hard it was."
)
PLOT, STRIP = "##angles", "##strokes"
_BEHIND_S = 4.0
"""What is seen before and after the play line at first, as in the score (SMED)."""
_STANDS_S = 1e-6
"""A play line that moves less stands: it is where it was dragged to, but for rounding."""
_DEGREES = ([-90.0, 0.0, 90.0, 180.0], ["-90°", "0°", "90°", "180°"])
_MILLISECONDS = ([-100.0, -50.0, 0.0, 50.0, 100.0], ["-100", "-50 ms", "0", "50 ms", "100"])
_LEGEND = (640.0, 170.0)
"""Design pixels, wide and high, that a panel needs for a legend of every curve."""
_LEAST = 84.0
"""Design pixels below which a plot does not go: the panel scrolls."""
_MARGIN_S, _RESULT_S = 0.3, 24.0
"""Of a result so much is seen at first (our choice: three passes of a two-bar loop)."""
_COLOUR_OF_JOINT = {"shoulder": palette.WRONG, "elbow": palette.GOOD, "wrist": palette.BRAND}
_LEFT_OPACITY = 0.5
_STRIP_SHARE = 0.42
_MOST_EARLY_MS, _MOST_LATE_MS = -70.0, 130.0
"""The strip's edges at first; our choice: three times what is just noticed, and above it room for the legend."""
_TOLD = (
    "Wheel: nearer. Drag: to and fro. Double click: all of it. Drag the orange line to go there. A click on a name"
    " hides its curve"
)


class GraphPanel:
    """Keeps the time span that is shown and the curves of the drummer who was drawn last."""

    def __init__(self, seek: Callable[[float], None]) -> None:
        self._seek = seek
        self._low, self._high = implot.BoxedValue(-_MARGIN_S), implot.BoxedValue(2 * _BEHIND_S - _MARGIN_S)
        self._position_s: float | None = None
        self.line_x = 0.0
        """Where the play line is on the screen, as of the last frame."""
        self._curves: JointCurves | None = None
        self._degrees = (np.inf, -np.inf)

    @property
    def span_s(self) -> tuple[float, float]:
        """The times that are shown."""
        return self._low.value, self._high.value

    def gui(self, graphed: ScoreCurves | None, can_seek: bool) -> None:
        """Draw it; `can_seek` where the play line may be dragged."""
        if graphed is None:
            theme.soft("There is nothing to graph here.")
            return
        if self._curves is None or self._curves.drummer is not graphed.drummer:
            self._curves, self._degrees = JointCurves(graphed.drummer), (np.inf, -np.inf)
        self._follow(graphed)
        room = imgui.get_content_region_avail()
        has_legend = room.x >= theme.points(_LEGEND[0]) and room.y >= theme.points(_LEGEND[1])
        if not has_legend:
            _short_legend()
            room = imgui.get_content_region_avail()
        strip = 0.0 if graphed.played is None else max(room.y * _STRIP_SHARE, theme.points(_LEAST))
        gap = imgui.get_style().item_spacing.y if strip else 0.0
        high = max(room.y - strip - gap, theme.points(_LEAST))
        flags = implot.Flags_.no_mouse_text | (0 if has_legend else implot.Flags_.no_legend)
        _push_style()
        if implot.begin_aligned_plots("##graphs"):
            if implot.begin_plot(PLOT, imgui.ImVec2(-1, high), flags):
                self._angles(graphed, self._curves, can_seek, bare=strip > 0)
                implot.end_plot()
            theme.tooltip(_TOLD)
            if graphed.played is not None:
                if implot.begin_plot(STRIP, imgui.ImVec2(-1, strip), flags):
                    self._strokes(graphed, graphed.played)
                    implot.end_plot()
                theme.tooltip("Dots: how early (below) or late (above) you were. Bars: how hard you struck")
            implot.end_aligned_plots()
        implot.pop_style_var(3)
        implot.pop_style_color(_COLOURS)

    def _follow(self, graphed: ScoreCurves) -> None:
        """Bring the play line to the middle whenever it has moved; a result is shown from its beginning."""
        position_s, before_s = graphed.position_s, self._position_s
        self._position_s = position_s
        if position_s is None and before_s is not None:
            end_s = graphed.score.length_ns / NS_PER_S
            self._low.value, self._high.value = -_MARGIN_S, min(end_s + _MARGIN_S, _RESULT_S)
        elif position_s is not None and before_s is not None and abs(position_s - before_s) > _STANDS_S:
            half = (self._high.value - self._low.value) / 2
            self._low.value, self._high.value = position_s - half, position_s + half

    def _time_axis(self, graphed: ScoreCurves, bare: bool) -> None:
        flags = implot.AxisFlags_.no_label | implot.AxisFlags_.no_menus | implot.AxisFlags_.no_highlight
        if bare:
            flags |= implot.AxisFlags_.no_tick_labels
        implot.setup_axis(implot.ImAxis_.x1, "", flags)
        implot.setup_axis_links(implot.ImAxis_.x1, self._low, self._high)
        implot.setup_axis_zoom_constraints(implot.ImAxis_.x1, 0.1, 120.0)
        values, words = music_ticks(graphed.score, graphed.bar_numbers, *self.span_s)
        if values:
            implot.setup_axis_ticks(implot.ImAxis_.x1, values, words)

    def _angles(self, graphed: ScoreCurves, curves: JointCurves, can_seek: bool, bare: bool) -> None:
        time_s, degrees = curves.between(*self.span_s)
        low, high = min(self._degrees[0], float(degrees.min())), max(self._degrees[1], float(degrees.max()))
        grown, self._degrees = (low, high) != self._degrees, (low, high)
        self._time_axis(graphed, bare)
        implot.setup_axis(implot.ImAxis_.y1, "", implot.AxisFlags_.no_label | implot.AxisFlags_.no_menus)
        implot.setup_axis_ticks(implot.ImAxis_.y1, *_DEGREES)
        cond = implot.Cond_.always if grown else implot.Cond_.once
        implot.setup_axis_limits(implot.ImAxis_.y1, low - 5.0, high + 5.0, cond)
        implot.setup_legend(implot.Location_.north, implot.LegendFlags_.horizontal | implot.LegendFlags_.outside)
        for column, curve in enumerate(CURVES):
            colour = theme.dyed(_COLOUR_OF_JOINT[curve.joint])
            shown = colour if curve.right else palette.with_opacity(colour, _LEFT_OPACITY)
            implot.plot_line(
                curve.label,
                time_s,
                np.ascontiguousarray(degrees[:, column]),
                _spec(shown, weight=theme.points(2.0 if curve.right else 1.5)),
            )
        self._play_line(graphed.position_s, can_seek)

    def _play_line(self, position_s: float | None, can_seek: bool) -> None:
        if position_s is None:
            return
        self.line_x = implot.plot_to_pixels(position_s, 0.0).x
        flags = implot.DragToolFlags_.none if can_seek else implot.DragToolFlags_.no_inputs
        moved, to_s, *_ = implot.drag_line_x(0, position_s, _vec(palette.BRAND), theme.points(2.0), flags)
        if moved:
            self._seek(to_s)
            self._position_s = to_s  # the graph stays under the hand that drags

    def _strokes(self, graphed: ScoreCurves, played: StudentStrokes) -> None:
        self._time_axis(graphed, bare=False)
        implot.setup_axis(implot.ImAxis_.y1, "", implot.AxisFlags_.no_label | implot.AxisFlags_.no_menus)
        implot.setup_axis_ticks(implot.ImAxis_.y1, *_MILLISECONDS)
        implot.setup_axis_limits(implot.ImAxis_.y1, _MOST_EARLY_MS, _MOST_LATE_MS, implot.Cond_.once)
        hidden = implot.AxisFlags_.opposite | implot.AxisFlags_.no_decorations | implot.AxisFlags_.lock
        implot.setup_axis(implot.ImAxis_.y2, "", hidden)
        implot.setup_axis_limits(implot.ImAxis_.y2, 0.0, 300.0, implot.Cond_.always)
        implot.setup_legend(implot.Location_.north_east, implot.LegendFlags_.horizontal)
        implot.set_axes(implot.ImAxis_.x1, implot.ImAxis_.y2)
        for words, velocity, colour in (
            ("written loudness", played.written, palette.INK_FAINT),
            ("yours", played.velocity, palette.GOOD),
        ):
            there = ~np.isnan(velocity)
            spec = _spec(theme.dyed(colour), weight=theme.points(4.0 if velocity is played.written else 2.0))
            implot.plot_stems(words, played.time_s[there], velocity[there], 0.0, spec)
        implot.set_axes(implot.ImAxis_.x1, implot.ImAxis_.y1)
        hit = ~np.isnan(played.asynchrony_ms)
        spec = _spec(theme.dyed(palette.BRAND), size=theme.points(3.5), marker=implot.Marker_.circle)
        implot.plot_scatter("timing", played.time_s[hit], played.asynchrony_ms[hit], spec)
        spec = _spec(theme.dyed(palette.MISSED), size=theme.points(4.5), marker=implot.Marker_.cross)
        implot.plot_scatter("missed", played.time_s[~hit], np.zeros(int((~hit).sum())), spec)
        self._play_line(graphed.position_s, can_seek=False)


def _short_legend() -> None:
    """The joints in their colours, where there is no room for every curve."""
    row = FlowRow()
    for joint, colour in _COLOUR_OF_JOINT.items():
        row.place(imgui.calc_text_size(joint).x)
        imgui.text_colored(_vec(colour), joint)
    row.place(imgui.calc_text_size("(left: paler)").x)
    imgui.text_disabled("(left: paler)")


def _spec(colour: Colour, weight: float = 1.0, size: float = 4.0, marker: int = implot.Marker_.none) -> implot.Spec:
    spec = implot.Spec()
    packed = imgui.ImVec4(*colour)
    spec.line_color = spec.marker_line_color = spec.marker_fill_color = packed
    spec.line_weight, spec.marker_size, spec.marker = weight, size, marker
    return spec


_COLOURS = 5


def _push_style() -> None:
    """The panels' own colours for the plots."""
    clear = (0.0, 0.0, 0.0, 0.0)
    for slot, colour in (
        (implot.Col_.frame_bg, clear),
        (implot.Col_.plot_bg, palette.with_opacity(palette.INK, 0.04)),
        (implot.Col_.plot_border, clear),
        (implot.Col_.legend_bg, clear),
        (implot.Col_.legend_border, clear),
    ):
        implot.push_style_color(slot, _vec(colour))
    implot.push_style_var(implot.StyleVar_.plot_padding, imgui.ImVec2(theme.points(4), theme.points(2)))
    implot.push_style_var(implot.StyleVar_.plot_min_size, imgui.ImVec2(theme.points(60), theme.points(40)))
    implot.push_style_var(implot.StyleVar_.legend_spacing, imgui.ImVec2(theme.points(14), 0))


def _vec(colour: Colour) -> imgui.ImVec4:
    return imgui.ImVec4(*theme.dyed(colour))
