"""The practised bars, engraved line by line, each note's head apart so that a page may show how it was played.

Units are staff spaces, x right from the staff's left end, y down from its middle line.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.music.score import Score
from station.render.notation.engraving import Engraver
from station.render.notation.head_places import HEAD_SIGNS, heads_x
from station.render.notation.page.line_breaks import BarBox, lines
from station.render.notation.page.page_places import BarPlace
from station.render.notation.page.sheet import SheetWords, line_words
from station.render.notation.page.sheet_bars import BarRun, unfolded_bars
from station.render.notation.page.sheet_line import LineSetter
from station.render.notation.staff import height, step_of
from station.render.notation.swing_words import swing_marks
from station.render.report.page.session_page import JudgedBars
from station.render.text.draw_list import ShapeKind
from station.render.text.paper import OutlineAtlas

Shapes = NDArray[np.void]

_SIGNS = (*HEAD_SIGNS.values(), "head_half", "head_whole", "head_half_cross", "head_half_diamond")
_SIGNS += ("head_half_triangle", "head_half_ringed_cross")
_NEAR = 0.3
"""So far from where it is reckoned a head stands at the most: the middles of two heads are farther apart."""
_GRACES_REACH = 6.0
"""Grace notes stand within so many spaces before their main note (a ruff of four)."""
_HIDDEN_BESIDE = 0.9
"""So far right of its diddle's head the second stroke is marked, which has no head of its own (our choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class EngravedNote:
    """Note `index` of the section: its `head`, no shape where it has none of its own, and where its middle is."""

    index: int
    head: Shapes
    x: float
    y: float
    scale: float = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class EngravedLine:
    """A line `width` wide from `top` to `bottom`: all but the heads, the notes with theirs, and where time stands.

    `places` are ticks of the section and their x, both growing.
    """

    ground: Shapes
    notes: tuple[EngravedNote, ...]
    width: float
    top: float
    bottom: float
    places: tuple[tuple[int, float], ...]


class BarsSetter:
    """Sets the bars of one page; several widths cost little more than one."""

    def __init__(self, bars: JudgedBars, atlas: OutlineAtlas) -> None:
        section = bars.section
        swing, self._score, self._atlas = swing_marks(section), section.as_written, atlas
        self._sounding = _written_order(section)
        self._swing = section.notes["swing_ticks"][self._sounding].astype(np.int64)
        words = SheetWords("", "", bars.beats_a_minute, bars.beat_ticks, sections=bars.sections)
        runs = unfolded_bars(self._score, [BarRun(0, self._score.bar_count - 1)])
        numbered = [replace(bar, number=str(bar.bar + bars.first_bar)) for bar in runs]
        self._engraver = Engraver(self._score, atlas, as_written=True)
        above = line_words(self._score, words, swing)
        self._setter = LineSetter(self._engraver, numbered, above, atlas)
        self._set = self._setter.set_bars()
        self._numbers = [int(atlas.sign(name).uv[0]) for name in _SIGNS]

    def lines(self, width: float) -> list[EngravedLine]:
        """The lines, each `width` long or less."""
        return [self._line(boxes, width) for boxes in lines(self._set, width)]

    def _line(self, boxes: Sequence[BarBox], width: float) -> EngravedLine:
        found = self._setter.shapes_of(boxes, self._set)
        places = [self._setter.place(box, self._set, boxes[0].index) for box in boxes]
        notes, is_ground = self._notes(found.shapes, places), np.ones(len(found.shapes), np.bool_)
        taken = [row for _, row, _ in notes if row is not None]
        is_ground[taken] = False
        heads = tuple(
            EngravedNote(
                index,
                found.shapes[[] if row is None else [row]],
                *((x, y) if row is None else _middle(found.shapes[row])),
                scale=0.7 if self._score.is_grace[written] else 1.0,
            )
            for (index, written), row, (x, y) in notes
        )
        return EngravedLine(found.shapes[is_ground], heads, width, found.top, found.bottom, self._time(places))

    # --- heads --------------------------------------------------------------------------------------------------------

    def _notes(
        self, shapes: Shapes, places: Sequence[BarPlace]
    ) -> list[tuple[tuple[int, int], int | None, tuple[float, float]]]:
        """The notes of a line: their rows in the section and as written, the row of the head, and where it is."""
        is_head = (shapes["kind"] == ShapeKind.GLYPH) & np.isin(np.rint(shapes["uv"][:, 0]), self._numbers)
        free = dict.fromkeys(np.flatnonzero(is_head).tolist())
        found = []
        for written, x, y, is_grace in self._expected(places):
            near = _grace_head(shapes, free, x, y) if is_grace else _head(shapes, free, x, y)
            if near is not None:
                del free[near]
            at = (x, y) if near is not None or is_grace else (x + _HIDDEN_BESIDE, y)
            found.append(((int(self._sounding[written]), written), near, at))
        return found

    def _expected(self, places: Sequence[BarPlace]) -> Iterator[tuple[int, float, float, bool]]:
        """Row as written, where its head stands, and whether it is a grace note; the nearest first."""
        whole, strokes, tempo = self._engraver.whole, self._engraver.strokes, self._score.tempo_map
        own = np.flatnonzero(~self._score.whole[1])  # the player's rows of the whole, in their order
        beside, bar_of = heads_x(whole), tempo.bars_at(strokes.tick[own])
        by_bar = {place.bar: place for place in places}
        leads = whole.notes["lead_ms"][own]
        for written in np.lexsort((leads, strokes.tick[own])).tolist():
            row, place = int(own[written]), by_bar.get(int(bar_of[written]))
            if place is None:
                continue
            x = place.x_at(float(strokes.tick[row] - tempo.bar_start(place.bar)))
            is_grace = bool(leads[written] > 0)
            x += 0.0 if is_grace else float(beside[row])
            yield written, x, height(step_of(whole[row].piece)), is_grace

    # --- time ---------------------------------------------------------------------------------------------------------

    def _time(self, places: Sequence[BarPlace]) -> tuple[tuple[int, float], ...]:
        """Ticks as they sound, and where they stand: a swung stroke where it is written."""
        late = dict(zip(self._engraver.score.notes["tick"].tolist(), self._swing.tolist(), strict=True))
        found: list[tuple[int, float]] = []
        for place in places:
            start = self._score.tempo_map.bar_start(place.bar)
            for tick, x in zip((place.ticks + start).tolist(), place.xs.tolist(), strict=True):
                sounding = tick + late.get(tick, 0)
                if found and sounding == found[-1][0] and x > found[-1][1]:
                    found.pop()  # where a bar begins is its first note's place, not the bar line before it
                if not found or (sounding > found[-1][0] and x > found[-1][1]):
                    found.append((sounding, round(x, 3)))
        return tuple(found)


def _written_order(section: Score) -> NDArray[np.intp]:
    """Which row of the section each row is once it is written straight: as `Score.from_array` orders them."""
    notes = section.notes
    ticks = notes["tick"] - notes["swing_ticks"]
    return np.lexsort((notes["piece"], -notes["lead_ms"], ticks))


def _middle(shape: np.void) -> tuple[float, float]:
    x, y = shape["centre"].tolist()
    return float(x), float(y)


def _head(shapes: Shapes, free: dict[int, None], x: float, y: float) -> int | None:
    """The head that stands at a place."""
    for row in free:
        at_x, at_y = shapes["centre"][row].tolist()
        if abs(at_x - x) < _NEAR and abs(at_y - y) < _NEAR:
            return row
    return None


def _grace_head(shapes: Shapes, free: dict[int, None], x: float, y: float) -> int | None:
    """The last small head before a place, of the same height."""
    there = [
        (float(shapes["centre"][row][0]), row)
        for row in free
        if abs(float(shapes["centre"][row][1]) - y) < _NEAR and 0 < x - float(shapes["centre"][row][0]) < _GRACES_REACH
    ]
    return max(there)[1] if there else None
