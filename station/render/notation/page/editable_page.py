"""A score on one endless page that can be pointed at: every bar once, lines as wide as the screen has room.

Units are staff spaces, y down from the page's upper edge. Bars stand a little wider than on paper: each half beat has
its place, so that a note can be written where none is.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.music.score import Score
from station.render.notation.engraving import Engraver
from station.render.notation.head_places import heads_x
from station.render.notation.page.line_breaks import BarBox, SetBar, lines
from station.render.notation.page.page_places import LinePlace, PageHead, PagePlaces
from station.render.notation.page.sheet import SheetWords, line_words
from station.render.notation.page.sheet_bars import BarRun, unfolded_bars
from station.render.notation.page.sheet_line import KeptBars, LineSetter, LineShapes
from station.render.notation.staff import height, step_of
from station.render.notation.swing_words import swing_marks
from station.render.text.draw_list import SHAPE_DTYPE
from station.render.text.paper import OutlineAtlas

_BETWEEN = 1.6
"""Between two lines, in staff spaces (our choice: a screen is lower than a page of paper)."""
_REACH, _STEP = (-8.5, 6.0), 3.0
"""So far up and down a line reaches at the least, a chord with a crash, an accent and sticking, and grows by so much:
what is written seldom moves the staff under the mouse (our choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class EditablePage:
    """The shapes (n,) of `SHAPE_DTYPE`, their glyphs from `atlas`, and where things are."""

    shapes: NDArray[np.void]
    height: float
    places: PagePlaces
    atlas: OutlineAtlas


class PageSetter:
    """Sets one score; its bars stand as `runs` say, under `words`. Pages of several widths cost little more than one.

    `kept` has the bars of scores that were set with the same `atlas` before.
    """

    def __init__(
        self,
        score: Score,
        runs: Sequence[BarRun],
        words: SheetWords,
        atlas: OutlineAtlas,
        kept: KeptBars | None = None,
    ) -> None:
        swing, self._score, self._atlas = swing_marks(score), score.as_written, atlas
        bars = unfolded_bars(self._score, runs)
        above = line_words(self._score, words, swing)
        engraver = Engraver(self._score, atlas, as_written=True)
        self._setter = LineSetter(engraver, bars, above, atlas, words.beat_ticks // 2, kept)
        self._bars = self._setter.set_bars()
        self._heads = _heads_by_bar(engraver)

    def page(self, width: float) -> EditablePage:
        """The page with lines so wide."""
        return _Stack(self._setter, self._bars, self._heads).page(lines(self._bars, width), self._atlas)


@dataclass(slots=True)
class _Stack:
    """Lines on top of each other."""

    setter: LineSetter
    bars: Sequence[SetBar]
    heads: Mapping[int, Sequence["_Head"]]
    y: float = 0.0

    def page(self, found: Sequence[Sequence[BarBox]], atlas: OutlineAtlas) -> EditablePage:
        placed = [self._line(boxes) for boxes in found]
        shapes = np.concatenate([line for line, _ in placed] or [np.empty(0, SHAPE_DTYPE)])
        return EditablePage(shapes, self.y, PagePlaces(tuple(place for _, place in placed)), atlas)

    def _line(self, boxes: Sequence[BarBox]) -> tuple[NDArray[np.void], LinePlace]:
        line = self.setter.shapes_of(boxes, self.bars)
        top, bottom = -_reach(-line.top, -_REACH[0]), _reach(line.bottom, _REACH[1])
        middle = self.y - top
        self.y = middle + bottom + _BETWEEN
        return _lowered(line, middle), self._place(boxes, middle, (middle + top, middle + bottom))

    def _place(self, boxes: Sequence[BarBox], middle: float, reach: tuple[float, float]) -> LinePlace:
        bars = tuple(self.setter.place(box, self.bars, boxes[0].index) for box in boxes)
        heads = tuple(
            PageHead(h.tick, h.piece, bar.bar, bar.x_at(h.written) + h.beside, middle + height(step_of(h.piece)))
            for bar in bars
            for h in self.heads.get(bar.bar, ())
        )
        return LinePlace(middle, *reach, bars, heads)


def _reach(needed: float, least: float) -> float:
    """How far a line reaches on one side, so much or more."""
    return least + _STEP * max(ceil((needed - least) / _STEP), 0)


def _lowered(line: LineShapes, y: float) -> NDArray[np.void]:
    shapes = line.shapes.copy()
    shapes["centre"][:, 1] += y
    return shapes


@dataclass(frozen=True, slots=True)
class _Head:
    """A head that is drawn: its stroke's tick and piece, the tick of its bar where it stands, and how far aside."""

    tick: int
    piece: Piece
    written: int
    beside: float


def _heads_by_bar(engraver: Engraver) -> dict[int, list[_Head]]:
    """The heads of all strokes but grace strokes and the second ones of diddles, by bar."""
    whole, strokes = engraver.whole, engraver.strokes
    shown = np.flatnonzero(~strokes.is_hidden & ~whole.is_grace)
    bars, written = whole.tempo_map.bars_at(strokes.tick[shown]), strokes.tick[shown]
    columns = (bars, written, whole.notes["tick"][shown], whole.notes["piece"][shown], heads_x(whole)[shown])
    found: dict[int, list[_Head]] = {}
    for bar, at, tick, piece, beside in zip(*(column.tolist() for column in columns), strict=True):
        head = _Head(tick, Piece(piece), at - whole.tempo_map.bar_start(bar), beside)
        found.setdefault(bar, []).append(head)
    return found
