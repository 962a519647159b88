"""The lanes of the figure panel: a control over the lesson's bars, drawn and dragged with the mouse or typed in.

A press on a point drags it, a press beside one draws, a right click takes a point away; the list below does the same by
the keyboard.
"""

from itertools import pairwise

from imgui_bundle import imgui

from station.app.style_controls import CONTROLS
from station.app.style_options import PIECES, StyleOptions
from station.core.labels import name_of
from station.gui import theme
from station.gui.widgets.lane_frame import LaneFrame
from station.motion.style.lanes import drawn, value_at, with_moved, with_point, without_point
from station.motion.style.style import Automation, range_of
from station.music.score import Score
from station.render import palette
from station.render.text.draw_list import Colour

CANVAS = "##lane"
_HEIGHT, _LIST, _POINT_PX = 170, 160, 5.0
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
        self._grabbed: int | None = None
        self._under: Automation = ()
        self._stroke: list[tuple[float, float]] = []
        self._last = (0.0, 0.0)

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
        corner, width = imgui.get_cursor_screen_pos(), max(imgui.get_content_region_avail().x, 50.0)
        height = theme.points(_HEIGHT)
        frame = LaneFrame(corner.x, corner.y, width, height, bars, beats, *range_of(self.control))
        imgui.invisible_button(CANVAS, imgui.ImVec2(width, height))
        options = self._mouse(options, frame)
        self._draw(frame, options)
        if place is not None:
            x, _ = frame.pixel(place, frame.low)
            low = imgui.ImVec2(x, frame.top + height)
            imgui.get_window_draw_list().add_line(imgui.ImVec2(x, frame.top), low, _ink(palette.INK), 1.5)
        if imgui.is_item_hovered() and not imgui.is_item_active():
            bar, value = frame.point(*imgui.get_mouse_pos())
            imgui.set_tooltip(f"bar {int(bar)}, beat {1 + round((bar % 1) * beats)}: {value:.1f}\n{_HELP}")
        return options

    def _mouse(self, options: StyleOptions, frame: LaneFrame) -> StyleOptions:
        at = imgui.get_mouse_pos()
        here = (at.x, at.y)
        lane = options.lane(self.control) or ()
        if imgui.is_item_hovered() and imgui.is_mouse_clicked(imgui.MouseButton_.right):
            meant = frame.nearest(lane, *here)
            if meant is not None:
                return options.draw_lane(self.control, without_point(lane, meant))
        elif imgui.is_item_activated():
            self._grabbed = frame.nearest(lane, *here)
            self._under, self._stroke, self._last = lane, [], here
            return options.draw_lane(self.control, self._dragged(frame, here, lane))
        elif imgui.is_item_active() and here != self._last:
            return options.draw_lane(self.control, self._dragged(frame, here, lane))
        return options

    def _dragged(self, frame: LaneFrame, here: tuple[float, float], lane: Automation) -> Automation:
        if self._grabbed is None:
            self._stroke += frame.stroke(self._last, here)
            lane = drawn(self._under, self._stroke)
        elif here != self._last:
            lane = with_moved(lane, self._grabbed, *frame.point(*here))
        self._last = here
        return lane

    def _draw(self, frame: LaneFrame, options: StyleOptions) -> None:
        lane = options.lane(self.control)
        ink = imgui.get_window_draw_list()
        left, top, right, low = frame.left, frame.top, frame.left + frame.width, frame.top + frame.height
        ink.add_rect_filled(
            imgui.ImVec2(left, top), imgui.ImVec2(right, low), _ink(palette.with_opacity(palette.INK, 0.06)), 6.0
        )
        every = -(-frame.bars // _MOST_BAR_LINES)
        ink.push_clip_rect(imgui.ImVec2(left, top), imgui.ImVec2(right, low), True)
        for bar in range(0, frame.bars, every):
            x, _ = frame.pixel(bar + 1, frame.low)
            ink.add_line(imgui.ImVec2(x, top), imgui.ImVec2(x, low), _ink(palette.with_opacity(palette.INK, 0.16)))
            ink.add_text(imgui.ImVec2(x + 4, top + 2), _ink(palette.INK_SOFT), str(bar + 1))
        points = lane or ((1.0, options.value(self.control)),)
        edges = [(1.0, value_at(points, 1.0)), *points, (frame.bars + 1.0, value_at(points, frame.bars + 1.0))]
        colour = _ink(palette.BRAND if lane else palette.INK_SOFT)
        pixels = [imgui.ImVec2(*frame.pixel(*point)) for point in edges]
        for start, end in pairwise(pixels):
            ink.add_line(start, end, colour, 2.5)
        for place in pixels[1:-1] if lane else ():
            ink.add_circle_filled(place, theme.points(_POINT_PX), colour)
        ink.pop_clip_rect()

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


_HELP = "Press beside a point and draw, drag a point, right click takes it away"


def _ink(colour: Colour) -> int:
    return int(imgui.get_color_u32(imgui.ImVec4(*theme.dyed(colour))))
