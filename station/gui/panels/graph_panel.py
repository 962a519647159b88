"""The graph: both arms' angles over the music, and below them the student's timing and loudness (SMED, figure 4.5).

The time axis follows the play line and keeps the width that the user has chosen by wheel or drag; while nothing plays
it stays where it is put. The play line can be dragged.
"""

from collections.abc import Callable

import numpy as np
from imgui_bundle import imgui, implot

from station.core.units import NS_PER_S
from station.gui import theme
from station.gui.panels.graph_axis import music_ticks
from station.gui.widgets import plots
from station.gui.widgets.flow_row import FlowRow
from station.render import palette
from station.render.report.stroke_plot import AXIS_MS, LINES, line_words
from station.scenes.curves import ScoreCurves, StudentStrokes
from station.scenes.joint_curves import CURVES, JointCurves

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
_LEGEND = (640.0, 170.0)
"""Design pixels, wide and high, that a panel needs for a legend of every curve."""
_LEAST = 84.0
"""Design pixels below which a plot does not go: the panel scrolls."""
_MARGIN_S, _RESULT_S = 0.3, 24.0
"""Of a result so much is seen at first (our choice: three passes of a two-bar loop)."""
_COLOUR_OF_JOINT = {"shoulder": palette.WRONG, "elbow": palette.GOOD, "wrist": palette.BRAND}
_LEFT_OPACITY = 0.5
_STRIP_SHARE = 0.48
_STRIP_LEGEND, _LEGEND_MS = (760.0, 110.0), 60.0
"""Design pixels, wide and high, that the strip needs for a legend; and the room for it above the strokes."""
_LOUDEST = 300.0
"""What loudness would be as high as the strip (our choice)."""
_DOT = 4.0
_TIP = (
    "Wheel: nearer. Drag: to and fro. Double click: all of it. Drag the orange line to go there. A click on a name"
    " hides its curve"
)
_STROKES_TIP = (
    "Dots and arrows: how early (below) or late (above) you were; squares: on a wrong pad; barred rings: missed. Bars:"
    " how hard you struck, over how loud it is written"
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

    def gui(self, score_curves: ScoreCurves | None, can_seek: bool) -> None:
        """Draw it; `can_seek` where the play line may be dragged."""
        if score_curves is None:
            theme.soft("There is nothing to graph here.")
            return
        if self._curves is None or self._curves.drummer is not score_curves.drummer:
            self._curves, self._degrees = JointCurves(score_curves.drummer), (np.inf, -np.inf)
        self._follow(score_curves)
        room = imgui.get_content_region_avail()
        has_legend = _fits(room, _LEGEND)
        if not has_legend:
            _short_legend()
            room = imgui.get_content_region_avail()
        strip = 0.0 if score_curves.played is None else max(room.y * _STRIP_SHARE, theme.points(_LEAST))
        gap = imgui.get_style().item_spacing.y if strip else 0.0
        high = max(room.y - strip - gap, theme.points(_LEAST))
        if implot.begin_aligned_plots("##graphs"):
            if implot.begin_plot(PLOT, imgui.ImVec2(-1, high), _flags(has_legend)):
                self._angles(score_curves, self._curves, can_seek, bare=strip > 0)
                implot.end_plot()
            theme.tooltip(_TIP)
            if score_curves.played is not None:
                self._strokes(score_curves, score_curves.played, imgui.ImVec2(room.x, strip))
            implot.end_aligned_plots()

    def _follow(self, score_curves: ScoreCurves) -> None:
        """Bring the play line to the middle whenever it has moved; a result is shown from its beginning."""
        position_s, before_s = score_curves.position_s, self._position_s
        self._position_s = position_s
        if position_s is None and before_s is not None:
            end_s = score_curves.score.length_ns / NS_PER_S
            self._low.value, self._high.value = -_MARGIN_S, min(end_s + _MARGIN_S, _RESULT_S)
        elif position_s is not None and before_s is not None and abs(position_s - before_s) > _STANDS_S:
            half = (self._high.value - self._low.value) / 2
            self._low.value, self._high.value = position_s - half, position_s + half

    def _time_axis(self, score_curves: ScoreCurves, bare: bool) -> None:
        plots.axis(implot.ImAxis_.x1, implot.AxisFlags_.no_tick_labels if bare else 0)
        implot.setup_axis_links(implot.ImAxis_.x1, self._low, self._high)
        implot.setup_axis_zoom_constraints(implot.ImAxis_.x1, 0.1, 120.0)
        values, words = music_ticks(score_curves.score, score_curves.bar_numbers, *self.span_s)
        if values:
            implot.setup_axis_ticks(implot.ImAxis_.x1, values, words)

    def _angles(self, score_curves: ScoreCurves, curves: JointCurves, can_seek: bool, bare: bool) -> None:
        time_s, degrees = curves.between(*self.span_s)
        low, high = min(self._degrees[0], float(degrees.min())), max(self._degrees[1], float(degrees.max()))
        grown, self._degrees = (low, high) != self._degrees, (low, high)
        self._time_axis(score_curves, bare)
        plots.axis(implot.ImAxis_.y1)
        implot.setup_axis_ticks(implot.ImAxis_.y1, *_DEGREES)
        cond = implot.Cond_.always if grown else implot.Cond_.once
        implot.setup_axis_limits(implot.ImAxis_.y1, low - 5.0, high + 5.0, cond)
        implot.setup_legend(implot.Location_.north, implot.LegendFlags_.horizontal | implot.LegendFlags_.outside)
        for column, curve in enumerate(CURVES):
            colour = _COLOUR_OF_JOINT[curve.joint]
            opacity, weight = (1.0, 2.0) if curve.right else (_LEFT_OPACITY, 1.5)
            look = plots.spec(palette.with_opacity(colour, opacity), weight)
            implot.plot_line(curve.label, time_s, np.ascontiguousarray(degrees[:, column]), look)
        self._play_line(score_curves.position_s, can_seek)

    def _play_line(self, position_s: float | None, can_seek: bool) -> None:
        if position_s is None:
            return
        self.line_x = implot.plot_to_pixels(position_s, 0.0).x
        flags = implot.DragToolFlags_.none if can_seek else implot.DragToolFlags_.no_inputs
        moved, to_s, *_ = implot.drag_line_x(0, position_s, plots.vec(palette.BRAND), theme.points(2.0), flags)
        if moved:
            self._seek(to_s)
            self._position_s = to_s  # the graph stays under the hand that drags

    def _strokes(self, score_curves: ScoreCurves, played: StudentStrokes, room: imgui.ImVec2) -> None:
        """The strip below the angles, as high as `room`."""
        has_legend = _fits(room, _STRIP_LEGEND)
        if implot.begin_plot(STRIP, imgui.ImVec2(-1, room.y), _flags(has_legend)):
            self._time_axis(score_curves, bare=False)
            low, high = AXIS_MS[0], AXIS_MS[1] + (_LEGEND_MS if has_legend else 0.0)
            plots.axis(implot.ImAxis_.y1)
            words = line_words(imgui.get_font_size() / room.y * (high - low))
            implot.setup_axis_ticks(implot.ImAxis_.y1, [*LINES], words)
            implot.setup_axis_limits(implot.ImAxis_.y1, low, high, implot.Cond_.once)
            plots.fixed(implot.ImAxis_.y2, 0.0, _LOUDEST, implot.AxisFlags_.opposite | plots.BARE)
            _draw_strokes(played)
            self._play_line(score_curves.position_s, can_seek=False)
            implot.end_plot()
        theme.tooltip(_STROKES_TIP)


def _draw_strokes(played: StudentStrokes) -> None:
    """How loud they were, on the second axis, and when they fell, on the first."""
    implot.setup_legend(implot.Location_.north_east, implot.LegendFlags_.horizontal)
    implot.set_axes(implot.ImAxis_.x1, implot.ImAxis_.y2)
    for words, velocity, look in (
        ("written loudness", played.written, plots.spec(palette.INK_FAINT, 4.0)),
        ("yours", played.velocity, plots.spec(palette.GOOD, 2.0)),
    ):
        there = ~np.isnan(velocity)
        implot.plot_stems(words, played.time_s[there], velocity[there], 0.0, look)
    implot.set_axes(implot.ImAxis_.x1, implot.ImAxis_.y1)
    plots.strokes(played.time_s, played.label, played.asynchrony_ms, played.on_time_ms, _DOT)


def _flags(has_legend: bool) -> int:
    return plots.FREE | (0 if has_legend else implot.Flags_.no_legend)


def _fits(room: imgui.ImVec2, needed: tuple[float, float]) -> bool:
    """Whether `room`, in pixels, is as wide and high as `needed`, in design pixels."""
    return bool(room.x >= theme.points(needed[0]) and room.y >= theme.points(needed[1]))


def _short_legend() -> None:
    """The joints in their colours, where there is no room for every curve."""
    row = FlowRow()
    for joint, colour in _COLOUR_OF_JOINT.items():
        row.place(imgui.calc_text_size(joint).x)
        imgui.text_colored(plots.vec(colour), joint)
    row.place(imgui.calc_text_size("(left: paler)").x)
    imgui.text_disabled("(left: paler)")
