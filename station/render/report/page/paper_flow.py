"""Words and drawings one below the other on pages of paper, none torn apart, with a title and a number on each page.

Lengths are points (1/72 inch), y down from the page's upper edge. Whoever fills a flow asks for nothing but an order.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.render.files.pdf_file import pdf
from station.render.notation.page.sheet import MARGIN, PAPERS
from station.render.palette import INK, INK_FAINT, INK_SOFT
from station.render.text.draw_list import LINE_HEIGHT, DrawList, TypeStyle
from station.render.text.fonts import Face
from station.render.text.paper import OutlineAtlas, PaperSpot, filled

BODY = TypeStyle(9.5, INK)
SOFT = TypeStyle(8.5, INK_SOFT)
HEADING = TypeStyle(12.5, INK, Face.BOLD)
TITLE = TypeStyle(20.0, INK, Face.BOLD)
GAP = 12.0
"""Between parts of a page."""
_RUNNING, _FOOT, _AFTER_HEAD = 24.0, 22.0, 7.0
_HERE = PaperSpot((0.0, 0.0), 1.0)
_BULLET = 10.0
_MOST_IN_CELL = 24
"""Lines of a cell: no page of ours has more than five, and a row has to have room on a page (our choice)."""
_LONG_WORD = 28
"""Letters of a word that may be broken where no line holds it (our choice)."""


class PaperFlow:
    """Pages of A4 that fill from the top; `title` stands small on all but the first."""

    def __init__(self, title: str, atlas: OutlineAtlas) -> None:
        self.atlas = atlas
        self._size = PAPERS["a4"]
        self.left, self.width = MARGIN, self._size[0] - 2 * MARGIN
        self._title = title
        self._pages: list[DrawList] = [DrawList(atlas)]
        self._drawn: list[list[NDArray[np.void]]] = [[]]
        self.y = MARGIN

    @property
    def _bottom(self) -> float:
        return self._size[1] - MARGIN - _FOOT

    def room(self, height: float) -> None:
        """Go to a new page where so much has no room on this one, and something stands on it."""
        if self.y + height > self._bottom and self.y > MARGIN + _RUNNING:
            self._pages.append(DrawList(self.atlas))
            self._drawn.append([])
            self.y = MARGIN + _RUNNING

    def gap(self, height: float = GAP) -> None:
        """Leave so much free."""
        self.y += height

    # --- words --------------------------------------------------------------------------------------------------------

    def heading(self, text: str, below: float = 40.0) -> None:
        """A heading, on the page of what stands `below` it."""
        self.room(HEADING.size * LINE_HEIGHT + _AFTER_HEAD + below)
        self.y += HEADING.size
        self._write(self._page.fitted(text, HEADING, self.width), self.left, self.y, HEADING)
        self.y += _AFTER_HEAD

    def paragraph(self, text: str, style: TypeStyle = BODY, indent: float = 0.0) -> None:
        """Words over as many lines as they need."""
        for line in self._broken(text, style, self.width - indent):
            self.room(style.size * LINE_HEIGHT)
            self.y += style.size * LINE_HEIGHT
            self._write(line, self.left + indent, self.y - 0.3 * style.size, style)

    def bullet(self, text: str, details: Sequence[str] = ()) -> None:
        """An entry of a list, and small print below it."""
        self.room(BODY.size * LINE_HEIGHT * 2)
        self._page.ellipse((self.left + 3.0, self.y + 0.65 * BODY.size * LINE_HEIGHT), (1.4, 1.4), INK_SOFT)
        self.paragraph(text, BODY, _BULLET)
        for line in details:
            self.paragraph(line, SOFT, _BULLET)
        self.y += 2.0

    def columns(self, rows: Iterable[tuple[str, str]], count: int) -> None:
        """Words, each under what it is called, so many beside each other."""
        entries, wide = list(rows), self.width / count
        for start in range(0, len(entries), count):
            cells = [
                (self._broken(what, SOFT, wide - 8)[:2], self._broken(which, BODY, wide - 8)[:_MOST_IN_CELL])
                for what, which in entries[start : start + count]
            ]
            lines = max(len(what) + len(which) for what, which in cells)
            height = lines * BODY.size * LINE_HEIGHT + 3.0
            self.room(height)
            for column, (what, which) in enumerate(cells):
                y, x = self.y, self.left + column * wide
                for line, style in [*((each, SOFT) for each in what), *((each, BODY) for each in which)]:
                    y += style.size * LINE_HEIGHT
                    self._write(line, x, y - 0.3 * style.size, style)
            self.y += height

    def table(self, rows: Sequence[Sequence[str]], shares: Sequence[float], has_head: bool = False) -> None:
        """Rows of cells whose widths are `shares` of the line, over as many lines as the longest needs."""
        for number, row in enumerate(rows):
            style = SOFT if has_head and not number else replace(BODY, size=8.5)
            broken = [
                self._broken(cell, style, share * self.width - 6)[:_MOST_IN_CELL]
                for cell, share in zip(row, shares, strict=True)
            ]
            height = max(map(len, broken)) * style.size * LINE_HEIGHT + 3.0
            self.room(height)
            x = self.left
            for lines, share in zip(broken, shares, strict=True):
                for index, line in enumerate(lines):
                    self._write(line, x, self.y + (index + 0.75) * style.size * LINE_HEIGHT, style)
                x += share * self.width
            self.y += height
            self._page.box((self.left, self.y - 1.5), (self.width, 0.4), INK_FAINT)
            self.y += 1.0

    # --- drawings -----------------------------------------------------------------------------------------------------

    def drawing(self, shapes: NDArray[np.void], unit: float, reach: tuple[float, float], left: float = 0.0) -> None:
        """A drawing of `unit` points a unit, from reach[0] to reach[1] of its y, so far right of the margin."""
        height = unit * (reach[1] - reach[0])
        self.room(height)
        self.at(shapes, unit, (self.left + left, self.y - unit * reach[0]))
        self.y += height

    def at(self, shapes: NDArray[np.void], unit: float, origin: tuple[float, float]) -> None:
        """A drawing whose origin lies at a place of this page."""
        self._drawn[-1].append(scaled(shapes, unit, origin))

    def words_at(self, text: str, at: tuple[float, float], style: TypeStyle, width: float) -> float:
        """A paragraph of `width` from a place of this page down; returns how high it is."""
        for index, line in enumerate(self._broken(text, style, width)):
            self._write(line, at[0], at[1] + (index + 0.75) * style.size * LINE_HEIGHT, style)
        return self.words_height(text, style, width)

    def words_height(self, text: str, style: TypeStyle, width: float) -> float:
        """How high a paragraph of `width` is."""
        return len(self._broken(text, style, width)) * style.size * LINE_HEIGHT if text else 0.0

    # --- the file -----------------------------------------------------------------------------------------------------

    def pdf(self, author: str) -> bytes:
        """The pages as a file."""
        pages = []
        for number, (page, drawn) in enumerate(zip(self._pages, self._drawn, strict=True), 1):
            if number > 1:
                running = page.fitted(f"{self._title} · {author}", SOFT, self.width)
                page.text(running, (self.left, MARGIN + SOFT.size), SOFT)
            foot = replace(SOFT, align=0.5)
            page.text(f"{number} / {len(self._pages)}", (self._size[0] / 2, self._size[1] - MARGIN), foot)
            pages.append(filled(np.concatenate([page.shapes(), *drawn]), self.atlas, _HERE))
        return pdf(pages, self._size, self._title, author, has_colours=True)

    @property
    def _page(self) -> DrawList:
        return self._pages[-1]

    def _write(self, text: str, x: float, y: float, style: TypeStyle) -> None:
        self._page.text(text, (x, y), style)

    def _broken(self, text: str, style: TypeStyle, width: float) -> list[str]:
        """Text in lines of at most `width`; a word that no line holds is broken too, for it may be a name."""
        words = [part for word in text.split() for part in _parts(word)]
        return self._page.broken(" ".join(words), style, width)


def _parts(word: str) -> list[str]:
    return [word[start : start + _LONG_WORD] for start in range(0, len(word), _LONG_WORD)]


def scaled(shapes: NDArray[np.void], unit: float, origin: tuple[float, float]) -> NDArray[np.void]:
    """The same shapes, `unit` times as large, their origin moved."""
    found = shapes.copy()
    found["centre"] = found["centre"] * np.float32(unit) + np.array(origin, np.float32)
    found["half"] *= np.float32(unit)
    found["style"] *= np.float32(unit)
    return found
