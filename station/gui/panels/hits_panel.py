"""Every hit of the result over the bars of the lesson, and a bar to be heard: the teacher's, and one's own."""

import numpy as np
from imgui_bundle import imgui, implot
from numpy.typing import NDArray

from station.app.room_state import ShownResult
from station.core.labels import piece_name
from station.core.pieces import Piece
from station.gui import theme
from station.gui.panels.playback_row import PlaybackRow
from station.gui.widgets import plots
from station.gui.widgets.flow_row import FlowRow
from station.render import palette
from station.render.report.stroke_plot import AXIS_MS, LINES, heights_ms, line_words
from station.render.text.draw_list import Colour
from station.scenes.hit_table import EveryHit, dot_label, nearest

HITS = "Every hit"
ABOUT = "How early or late every stroke was, over the bars of the lesson; and a bar to hear: the teacher's and yours"
_DOT, _NEAR = 4.5, 12.0
"""Design pixels: a dot's radius, and how near the mouse must come to ask."""
_LEAST_HEIGHT = 110.0
_MARGIN = 0.01
"""Of the bars, beyond the first and the last: what stands on their lines is whole (our choice)."""
_HIGHLIGHT = 0.10
"""Opacity of the bar that is chosen, and of the band that is on time."""


class HitsPanel:
    """The plot; `piece` is shown alone where it is not None, `playback` chooses what is heard."""

    def __init__(self, playback: PlaybackRow) -> None:
        self.playback = playback
        self._shown: EveryHit | None = None
        self.piece: Piece | None = None
        self.at = np.empty((0, 2))
        """Where the dots lie in the window, in pixels."""
        self.pointed = ""
        """The words for the dot under the mouse."""

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
        self.playback.gui(report, row)
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
        height = max(imgui.get_content_region_avail().y, theme.points(_LEAST_HEIGHT))
        if implot.begin_plot("##hits", imgui.ImVec2(-1, height), plots.FIXED):
            _axes(hits.bars, height)
            _paper(hits, self.playback.bar)
            plots.strokes(dots["place"], dots["label"], dots["late_ms"], hits.on_time_ms, _DOT)
            self.at = plots.pixels(dots["place"], heights_ms(dots["label"], dots["late_ms"]))
            self._point(hits, dots)
            implot.end_plot()

    def _point(self, hits: EveryHit, dots: NDArray[np.void]) -> None:
        """Tell of the dot under the mouse; a click on it chooses its bar."""
        self.pointed = ""
        if not implot.is_plot_hovered():
            return
        mouse = imgui.get_mouse_pos()
        index = nearest(self.at, (mouse.x, mouse.y), theme.points(_NEAR))
        if index is None:
            return
        self.pointed = dot_label(dots[index], hits.on_time_ms)
        imgui.set_tooltip(self.pointed)
        if imgui.is_mouse_clicked(imgui.MouseButton_.left):
            self.playback.bar, self.playback.pass_number = int(dots["bar"][index]), int(dots["pass"][index])


def _axes(bars: tuple[int, int], height: float) -> None:
    """Bars across, early and late up, as much as `height` pixels have room for."""
    (first, last), room = bars, imgui.get_content_region_avail().x
    margin = _MARGIN * (last + 1 - first)
    plots.fixed(implot.ImAxis_.x1, first - margin, last + 1 + margin)
    every = max(1, int(np.ceil(1.5 * imgui.calc_text_size("000").x * (last + 1 - first) / room)))
    numbers = [str(bar) if (bar - first) % every == 0 else "" for bar in range(first, last + 1)]
    implot.setup_axis_ticks(implot.ImAxis_.x1, [*map(float, range(first, last + 2))], [*numbers, ""])
    plots.fixed(implot.ImAxis_.y1, *AXIS_MS)
    letter_ms = imgui.get_font_size() / height * (AXIS_MS[1] - AXIS_MS[0])
    implot.setup_axis_ticks(implot.ImAxis_.y1, [*LINES], line_words(letter_ms))


def _paper(hits: EveryHit, chosen: int) -> None:
    """What is on time, and the chosen bar."""
    bars = hits.bars
    _band("##on time", (bars[0], bars[1] + 1), (-hits.on_time_ms, hits.on_time_ms), palette.GOOD)
    if bars[0] <= chosen <= bars[1]:
        _band("##chosen", (chosen, chosen + 1), AXIS_MS, palette.BRAND)
    plots.across("##0", [0.0], plots.spec(palette.INK_SOFT))


def _band(name: str, across: tuple[float, float], up: tuple[float, float], colour: Colour) -> None:
    look = plots.spec(palette.with_opacity(colour, _HIGHLIGHT))
    implot.plot_shaded(name, np.array(across, np.float64), np.full(2, up[1]), up[0], look)
