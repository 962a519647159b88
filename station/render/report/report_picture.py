"""The result of a session as a page: points, every stroke's timing, each piece's lean and spread, what to do next.

The window shows the page behind its buttons and `draw_report_png` writes it to a file, both by the same shapes. Where
its parts lie `report_layout` says; units are the page's.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.music.judgement import Label
from station.render.files.png_file import write_png
from station.render.flat_picture import flat_pictures
from station.render.gpu.shape_renderer import Transform
from station.render.palette import (
    BRAND,
    EXTRA,
    GOOD,
    INK,
    INK_FAINT,
    INK_SOFT,
    MISSED,
    WRONG,
    with_opacity,
)
from station.render.report.report_cards import PADDING, Pieces, Plot, badge, paper
from station.render.report.report_layout import EDGE, ReportBox, ReportPage, page_for
from station.render.report.result_facts import ResultFacts, headline
from station.render.text.atlas import Atlas
from station.render.text.draw_list import LINE_HEIGHT, DrawList, TypeStyle
from station.render.text.fonts import Face

_TICKS = 48
_DIAL = 62.0
"""The dial's radius."""
_COUNTS = 150.0
"""Width of the counts beside the dial."""
_ADVICE_SIZES = (20.0, 18.0, 17.0, 16.0)
"""The largest in which all advice has room; at the least the last sentences are left to the report's text."""


def report_shapes(facts: ResultFacts, atlas: Atlas, page: ReportPage) -> NDArray[np.void]:
    """The page in its own units, origin top left."""
    return _Drawn(facts, DrawList(atlas), page).shapes()


def report_sheet(size: tuple[int, int], page: ReportPage) -> Transform:
    """How the page lies on the picture of `size` that it was laid out for."""
    return Transform(size, unit=page.unit)


def draw_report_png(facts: ResultFacts, path: Path, size: tuple[int, int] = (1280, 800)) -> None:
    """Write the page to `path`; raises `DeviceError` without OpenGL or if the disk refuses."""
    page = page_for(size)
    with flat_pictures(size, page.unit) as maker:
        write_png(maker.picture(report_shapes(facts, maker.atlas, page)), path)


class _Drawn:
    def __init__(self, facts: ResultFacts, draw_list: DrawList, page: ReportPage) -> None:
        self._facts, self._draw_list, self._page = facts, draw_list, page

    def shapes(self) -> NDArray[np.void]:
        self._head()
        self._card()
        if self._page.plot is not None:
            Plot(self._facts, self._draw_list, self._page.plot).draw()
        if self._page.pieces is not None:
            Pieces(self._facts, self._draw_list, self._page.pieces).draw()
        return self._draw_list.shapes()

    def _head(self) -> None:
        title, line, width = TypeStyle(28, INK, Face.BOLD), TypeStyle(17, INK_SOFT), self._page.width - 2 * EDGE
        self._draw_list.text(self._draw_list.fitted(self._facts.words.title, title, width), (EDGE, 34), title)
        self._draw_list.text(self._draw_list.fitted(self._facts.words.subtitle, line, width), (EDGE, 59), line)

    # --- the card -----------------------------------------------------------------------------------------------------

    def _card(self) -> None:
        """The points, beside them the counts, and in words below or beside both what they come to."""
        card = self._page.card
        paper(self._draw_list, card)
        self._points((card.left + PADDING + _DIAL, card.top + PADDING + _DIAL))
        beside = card.left + PADDING + 2 * _DIAL + 16
        self._counts((beside, card.top + PADDING + 24), card.left + PADDING + 2 * _DIAL + _COUNTS - beside)
        if self._page.wide:
            left = beside + _COUNTS + 6
            self._words(ReportBox(left, card.top + 8, card.right - PADDING - left, card.height - 8))
        else:
            top = card.top + PADDING + 2 * _DIAL + 12
            self._words(ReportBox(card.left + PADDING, top, card.width - 2 * PADDING, card.bottom - top))

    def _points(self, centre: tuple[float, float]) -> None:
        """A dial of ticks, as many lit as there are points."""
        x, y = centre
        share = 0.0 if self._facts.words.points is None else self._facts.words.points / 100
        for k in range(_TICKS):
            a = 2 * np.pi * (k + 0.5) / _TICKS
            way = np.array([np.sin(a), -np.cos(a)])
            colour = BRAND if (k + 0.5) / _TICKS <= share else INK_FAINT
            inner, outer = ((x + radius * way[0], y + radius * way[1]) for radius in (_DIAL - 13, _DIAL))
            self._draw_list.line(inner, outer, 3.6, colour)
        number = "–" if self._facts.words.points is None else f"{self._facts.words.points:.0f}"
        self._draw_list.text(number, (x, y + 14), TypeStyle(48, INK, Face.BOLD, 0.5))
        self._draw_list.text("of 100", (x, y + 33), TypeStyle(15, INK_SOFT, Face.REGULAR, 0.5))

    def _counts(self, at: tuple[float, float], width: float) -> None:
        facts, style = self._facts, TypeStyle(17, INK)
        right = f"{int(facts.right.sum())} of {int(facts.known.sum())}"
        longer = f"{right} right"
        rows = [
            (GOOD, longer if self._draw_list.width(longer, style) <= width - 24 else right),
            (MISSED, f"{facts.count(Label.MISS)} missed"),
            (WRONG, f"{facts.count(Label.WRONG_PIECE)} wrong pad"),
            (EXTRA, f"{facts.count(Label.EXTRA)} extra"),
        ]
        if unknown := facts.count(Label.UNKNOWN):
            rows.append((INK_SOFT, f"{unknown} unknown"))
        for i, (colour, text) in enumerate(rows):
            y = at[1] + 29 * i
            badge(self._draw_list, i, (at[0] + 8, y - 6), with_opacity(colour, 1.0))
            self._draw_list.text(text, (at[0] + 24, y), style)

    def _words(self, room: ReportBox) -> None:
        """What it comes to, and what to do next."""
        y = room.top + 26
        y += self._draw_list.paragraph(
            headline(self._facts).capitalize() + ".", (room.left, y), TypeStyle(21, INK, Face.BOLD), room.width
        )
        if self._facts.words.advice:
            self._draw_list.text("WHAT TO DO NEXT", (room.left, y + 4), TypeStyle(14, BRAND, Face.BOLD))
            self._advice(ReportBox(room.left, y + 30, room.width, room.bottom - 10 - y - 30))

    def _advice(self, room: ReportBox) -> None:
        """The sentences, in the largest type in which they fit; in the least as many of them as do."""
        for size in _ADVICE_SIZES:
            style, gap = TypeStyle(size, INK_SOFT), 0.5 * size
            lines = [self._draw_list.broken(sentence, style, room.width) for sentence in self._facts.words.advice]
            if sum(map(len, lines)) * LINE_HEIGHT * size + gap * (len(lines) - 1) <= room.height + 0.3 * size:
                break
        y, lowest = room.top + size - _ADVICE_SIZES[-1], room.bottom
        for number, sentence in enumerate(lines):
            fit = int((lowest - y) / (LINE_HEIGHT * size)) + 1
            if len(sentence) > fit and number:
                break
            if len(sentence) > fit:
                sentence[fit - 1 :] = [self._draw_list.fitted(" ".join(sentence[fit - 1 :]), style, room.width)]
            for line in sentence:
                self._draw_list.text(line, (room.left, y), style)
                y += LINE_HEIGHT * size
            y += gap
