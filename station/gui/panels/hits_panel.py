"""Every hit of the result over the bars of the lesson, and a bar by ear: the teacher's, and one's own.

Shapes and colours are those of the page and the score: a dot on time, arrows up late and down early, a square on a
wrong pad, barred rings missed and crosses not written on the floor of the plot.
"""

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from station.app.model import ShownResult
from station.core.labels import piece_name
from station.core.pieces import Piece
from station.gui import theme
from station.gui.panels.playback_row import PlaybackRow
from station.gui.widgets.flow_row import FlowRow
from station.music.judgement import Label
from station.render import palette
from station.render.notation.judgement_marks import ON_TIME_MS, timing_colour
from station.render.text.draw_list import Colour
from station.scenes.hit_table import EveryHit, nearest, words_of

HITS = "Every hit"
ABOUT = "How early or late every stroke was, over the bars of the lesson; and a bar to hear: the teacher's and yours"
_REACH_MS = 80.0
"""Half the plot's height; what lies farther out stands on its edge, as on the page."""
_LINES_MS = (-60, -30, 0, 30, 60)
_LEFT, _FLOOR, _NUMBERS = 66.0, 22.0, 20.0
"""Design pixels: the labels beside the plot, the floor of misses, the bars' numbers below."""
_DOT, _NEAR = 4.5, 12.0
"""Design pixels: a dot's radius, and how near the mouse must come to ask."""
_LEAST_HEIGHT = 110.0


class HitsPanel:
    """The plot; `piece` is shown alone where it is not None, `ear` chooses what is heard."""

    def __init__(self, ear: PlaybackRow) -> None:
        self._ear = ear
        self._shown: EveryHit | None = None
        self.piece: Piece | None = None
        self.at = np.empty((0, 2))
        """Where the dots lie in the window, in pixels."""
        self.pointed = ""
        """What is told of the dot under the mouse."""

    def gui(self, report: ShownResult | None) -> None:
        """Draw every hit of the `report`, None where there is no result to be seen."""
        if report is None or not len(report.hits.dots):
            theme.soft("After a session every stroke stands here, early or late, at its place in the bar.")
            return
        hits = report.hits
        if hits is not self._shown:
            self._shown, self.piece = hits, None
        row = FlowRow()
        self._pieces(hits, row)
        self._ear.gui(report, row)
        self._plot(hits, hits.of(self.piece))

    def _pieces(self, hits: EveryHit, row: FlowRow) -> None:
        for piece in (None, *hits.pieces):
            name = "all" if piece is None else piece_name(piece)
            row.place(imgui.calc_text_size(name).x + theme.points(40))
            if imgui.radio_button(f"{name}##piece", self.piece is piece):
                self.piece = piece
            theme.tooltip("Every piece" if piece is None else f"The {name} alone")

    # --- the plot -----------------------------------------------------------------------------------------------------

    def _plot(self, hits: EveryHit, dots: NDArray[np.void]) -> None:
        room = imgui.get_content_region_avail()
        size = imgui.ImVec2(max(room.x, 1.0), max(room.y, theme.points(_LEAST_HEIGHT)))
        pressed = imgui.invisible_button("##plot", size)
        corner = imgui.get_item_rect_min()
        frame = _Frame(hits, (corner.x, corner.y), (size.x, size.y))
        frame.paper(self._ear.bar)
        self.at = frame.places(dots)
        for (x, y), dot in zip(self.at.tolist(), dots, strict=True):
            _draw(imgui.get_window_draw_list(), (x, y), dot)
        self._point(dots, pressed)

    def _point(self, dots: NDArray[np.void], pressed: bool) -> None:
        """Tell of the dot under the mouse; a click on it chooses its bar."""
        self.pointed = ""
        if not imgui.is_item_hovered():
            return
        mouse = imgui.get_mouse_pos()
        index = nearest(self.at, (mouse.x, mouse.y), theme.points(_NEAR))
        if index is None:
            return
        self.pointed = words_of(dots[index])
        imgui.set_tooltip(self.pointed)
        if pressed:
            self._ear.bar, self._ear.pass_number = int(dots["bar"][index]), int(dots["pass"][index])


class _Frame:
    """Where things lie in the plot, in pixels."""

    def __init__(self, hits: EveryHit, corner: tuple[float, float], size: tuple[float, float]) -> None:
        self._first, last = hits.bars
        self._bars = last - self._first + 1
        self._left = corner[0] + theme.points(_LEFT)
        self._width = max(size[0] - theme.points(_LEFT + 12), 1.0)
        self._top = corner[1] + theme.points(8)
        self._floor = corner[1] + size[1] - theme.points(_NUMBERS + _FLOOR)
        self._numbers = corner[1] + size[1] - theme.points(_NUMBERS)

    def places(self, dots: NDArray[np.void]) -> NDArray[np.float64]:
        """Where each dot lies, (n, 2); late is up."""
        late_ms = np.clip(dots["late_ms"], -_REACH_MS, _REACH_MS)
        below = np.where(dots["label"] == Label.EXTRA, 0.85, 0.4) * theme.points(_FLOOR)
        y = np.where(np.isnan(late_ms), self._floor + below, self._height(late_ms))
        return np.column_stack([self._across(dots["place"]), y])

    def _across(self, place: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(self._left + (place - self._first) / self._bars * self._width)

    def _height(self, late_ms: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(self._top + (self._floor - self._top) * (0.5 - late_ms / (2 * _REACH_MS)))

    def paper(self, chosen: int) -> None:
        """Lines of early and late, bars and their numbers; the chosen bar is lit."""
        ink = imgui.get_window_draw_list()
        edges = self._across(np.arange(self._first, self._first + self._bars + 1, dtype=np.float64))
        gap = float(self._height(np.array(0.0)) - self._height(np.array(30.0)))
        band = self._height(np.array([ON_TIME_MS, -ON_TIME_MS]))
        lit = edges[chosen - self._first : chosen - self._first + 2]
        if len(lit) == 2:
            ink.add_rect_filled((lit[0], self._top), (lit[1], self._numbers), _ink(palette.BRAND, 0.10))
        ink.add_rect_filled((edges[0], band[0]), (edges[-1], band[1]), _ink(palette.GOOD, 0.10))
        step = 30 if gap >= imgui.get_font_size() else 60
        for ms in _LINES_MS:
            y = float(self._height(np.array(float(ms))))
            ink.add_line((edges[0], y), (edges[-1], y), _ink(palette.INK_FAINT if ms else palette.INK_SOFT))
            text = "0 ms" if ms == 0 else f"{abs(ms)} {'late' if ms > 0 else 'early'}"
            size = imgui.calc_text_size(text)
            if ms % step:
                continue
            ink.add_text((edges[0] - size.x - theme.points(8), y - size.y / 2), _ink(palette.INK_SOFT), text)
        wide = imgui.calc_text_size("000").x
        every = max(1, int(np.ceil(wide * self._bars / self._width)))
        for index, x in enumerate(edges.tolist()):
            ink.add_line((x, self._top), (x, self._numbers), _ink(palette.INK_FAINT))
            if index < self._bars and index % every == 0:
                at = (x + theme.points(4), self._numbers + theme.points(2))
                ink.add_text(at, _ink(palette.INK_SOFT), str(self._first + index))


def _draw(ink: imgui.ImDrawList, at: tuple[float, float], dot: np.void) -> None:
    """One dot in its shape and colour."""
    (x, y), r, late_ms = at, theme.points(_DOT), float(dot["late_ms"])
    match Label(int(dot["label"])):
        case Label.MISS:
            colour = _ink(palette.MISSED)
            ink.add_circle(at, r, colour, 0, theme.points(1.6))
            ink.add_line((x - 0.7 * r, y + 0.7 * r), (x + 0.7 * r, y - 0.7 * r), colour, theme.points(1.6))
        case Label.EXTRA:
            colour, s = _ink(palette.EXTRA), 0.7 * r
            ink.add_line((x - s, y - s), (x + s, y + s), colour, theme.points(1.8))
            ink.add_line((x - s, y + s), (x + s, y - s), colour, theme.points(1.8))
        case Label.WRONG_PIECE:
            ink.add_rect((x - r, y - r), (x + r, y + r), _ink(palette.WRONG), 0.0, theme.points(1.8))
        case _ if abs(late_ms) <= ON_TIME_MS:
            ink.add_circle_filled(at, r, _ink(timing_colour(late_ms), 0.9))
        case _:
            up = -1.0 if late_ms > 0 else 1.0
            tip, base = (x, y + up * 1.2 * r), y - up * 0.8 * r
            ink.add_triangle_filled(tip, (x - 1.1 * r, base), (x + 1.1 * r, base), _ink(timing_colour(late_ms)))


def _ink(colour: Colour, opacity: float = 1.0) -> int:
    dyed = theme.dyed(colour)
    return int(imgui.get_color_u32(imgui.ImVec4(*palette.with_opacity(dyed, opacity))))
