"""A score as a sheet for the music stand: title, author, lines of engraved bars, and a key of what is used.

Lengths are points (1/72 inch) where no other unit is named, y down; the staff's are staff spaces, as in `engraving`.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from station.core.pieces import Limb
from station.core.units import PPQ
from station.music.score import Score
from station.music.tempo_words import read_tempo_words
from station.render.notation.engraving import Engraver
from station.render.notation.page.line_breaks import line_count, lines
from station.render.notation.page.sheet_bars import sheet_bars
from station.render.notation.page.sheet_key import draw_key
from station.render.notation.page.sheet_line import LineInk, LineSetter
from station.render.notation.sheet_words import LineWord, TempoSign
from station.render.notation.swing_words import SwingMark, swing_marks
from station.render.palette import INK, INK_SOFT
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face
from station.render.text.paper import Ink, OutlineAtlas, PaperSpot, filled

SPACES = tuple(mm / 25.4 * 72 for mm in (2.5, 2.0, 1.75))
"""Staff spaces: the largest for a loop of few lines, which is read from further off; a staff of 8 mm where all is on
one page (both our choice); else of 7 mm, in which parts are printed (Gould, "Behind Bars", 2011: 6.5 to 7.5 mm)."""
_FEW_LINES = 2
_LEAST_LINE = 8.0
"""No line of a sheet is less high, in staff spaces: a staff, a stem above it and letters below."""
MARGIN = 15 / 25.4 * 72
"""What printers leave free, and a thumb."""
PAPERS = {"a4": (595.28, 841.89), "letter": (612.0, 792.0)}
_TITLE, _TEXT, _SMALL = 22.0, 11.0, 9.5
_ABOUT_LINES = 3
_HEAD_HEIGHT, _RUNNING_HEAD = 50.0, 22.0
"""What the title and the author take on the first page, and the title on the others."""
_BETWEEN, _MOST_BETWEEN = 2.2, 5.0
"""What stands between two lines at the least, and where a full page is spread, at the most, in staff spaces."""


@dataclass(frozen=True, slots=True)
class SheetWords:
    """What stands on a sheet beside its notes.

    `beats_a_minute` of beats `beat_ticks` long; `sections` the names of parts by the bar (from 0) where they begin;
    `repeat` the first and last bar (from 0) of what is to be repeated; `first_bar` what the first bar is called.
    """

    title: str
    author: str = ""
    beats_a_minute: float | None = None
    beat_ticks: int = PPQ
    about: str = ""
    sections: tuple[tuple[int, str], ...] = ()
    repeat: tuple[int, int] | None = None
    first_bar: int = 1


@dataclass(slots=True)
class _Page:
    """A page that fills from `y` down: its lines, each with its middle line's y."""

    y: float
    ink: list[Ink] = field(default_factory=list)
    lines: list[tuple[float, LineInk]] = field(default_factory=list)


def sheet(score: Score, words: SheetWords, size: tuple[float, float], with_sticking: bool = True) -> list[Ink]:
    """The pages of `score`, each of `size` (width, height) points; it swings under marks, straight as it is written."""
    limbs = score.notes["limb"] if with_sticking else np.full_like(score.notes["limb"], Limb.UNKNOWN)
    pages = _SheetPages(score.with_limbs(limbs), words, size, with_sticking)
    for space in SPACES[:-1]:
        if pages.may_be_one(space) and len(found := pages.pages(space)) == 1:
            return found
    return pages.pages(SPACES[-1])


class _SheetPages:
    """The work of one sheet; `space` is a staff space in points throughout."""

    def __init__(self, score: Score, words: SheetWords, size: tuple[float, float], with_sticking: bool) -> None:
        swing, score = swing_marks(score), score.as_written
        self._score, self._words, self._size, self._with_sticking = score, words, size, with_sticking
        self._atlas = OutlineAtlas()
        bars = sheet_bars(score, _starts(words, swing), words.repeat, words.first_bar)
        self._written = frozenset(bar.bar for bar in bars)
        above = line_words(score, words, swing)
        self._setter = LineSetter(Engraver(score, self._atlas, as_written=True), bars, above, self._atlas)
        self._bars = self._setter.set_bars()

    @property
    def _width(self) -> float:
        return self._size[0] - 2 * MARGIN

    def may_be_one(self, space: float) -> bool:
        """Whether all may be on one page, and of the largest size on few lines of several bars each."""
        count = line_count(self._bars, self._width / space)
        few = max(min(_FEW_LINES, len(self._bars) // 2), 1)
        return count * _LEAST_LINE * space < self._size[1] and (space < SPACES[0] or count <= few)

    def pages(self, space: float) -> list[Ink]:
        """Lay out everything."""
        found = [
            self._setter.line(boxes, self._bars, MARGIN, space) for boxes in lines(self._bars, self._width / space)
        ]
        key, key_height = self._key(space)
        pages = self._filled(found, space, key_height)
        self._heads(pages)
        for page in pages:
            page.ink += [line.ink.moved(y) for y, line in page.lines]
        pages[-1].ink.append(key)
        return [Ink.joined(page.ink) for page in pages]

    # --- lines on pages -----------------------------------------------------------------------------------------------

    def _filled(self, found: Sequence[LineInk], space: float, key_height: float) -> list[_Page]:
        """The lines from the top of the first page down, on as many pages as they need with the key below the last."""
        pages, bottom = [_Page(MARGIN + self._head_height())], self._size[1] - MARGIN
        gap = _BETWEEN * space
        for k, line in enumerate(found):
            key = key_height if k == len(found) - 1 else 0.0
            if pages[-1].y + line.bottom - line.top + key > bottom:
                self._spread(pages[-1], space)
                pages.append(_Page(MARGIN + _RUNNING_HEAD))
            page = pages[-1]
            page.lines.append((page.y - line.top, line))
            page.y += line.bottom - line.top + gap
        return pages

    def _spread(self, page: _Page, space: float) -> None:
        """Share out over a full page what is left of it."""
        if len(page.lines) < 2:
            return
        left = self._size[1] - MARGIN - (page.y - _BETWEEN * space)
        more = min(left / (len(page.lines) - 1), (_MOST_BETWEEN - _BETWEEN) * space)
        page.lines = [(y + k * more, line) for k, (y, line) in enumerate(page.lines)]

    def _key(self, space: float) -> tuple[Ink, float]:
        """The key at the foot of a page, and how high it is."""
        draw_list = DrawList(self._atlas)
        key_height = space * draw_key(draw_list, self._score, self._written, self._width / space, self._with_sticking)
        spot = PaperSpot((MARGIN, self._size[1] - MARGIN - key_height), space)
        return filled(draw_list.shapes(), self._atlas, spot), key_height

    # --- heads and feet -----------------------------------------------------------------------------------------------

    def _head_height(self) -> float:
        """What stands above the first line."""
        count = len(self._about(DrawList(self._atlas)))
        return _HEAD_HEIGHT + (13.0 * count + 6.0 if count else 0.0)

    def _about(self, draw_list: DrawList) -> list[str]:
        """What the sheet says of itself, in at most so many lines."""
        if not self._words.about:
            return []
        broken = draw_list.broken(self._words.about, TypeStyle(_SMALL, INK_SOFT), self._width)
        return broken if len(broken) <= _ABOUT_LINES else [*broken[: _ABOUT_LINES - 1], f"{broken[_ABOUT_LINES - 1]} …"]

    def _heads(self, pages: Sequence[_Page]) -> None:
        """The title above the first page, smaller above the others, and which page of how many where there are more."""
        for number, page in enumerate(pages, 1):
            draw_list = DrawList(self._atlas)
            if number == 1:
                self._title(draw_list)
            else:
                draw_list.text(self._words.title, (0.0, 4.0), TypeStyle(_SMALL, INK_SOFT))
                draw_list.text(self._words.author, (self._width, 4.0), TypeStyle(_SMALL, INK_SOFT, align=1.0))
            if len(pages) > 1:
                foot = self._size[1] - 1.5 * MARGIN
                text = f"{number} / {len(pages)}"
                draw_list.text(text, (self._width / 2, foot), TypeStyle(_SMALL, INK_SOFT, align=0.5))
            page.ink.append(filled(draw_list.shapes(), self._atlas, PaperSpot((MARGIN, MARGIN), 1.0)))

    def _title(self, draw_list: DrawList) -> None:
        words, middle, right = self._words, self._width / 2, self._width
        title = TypeStyle(_TITLE, INK, Face.BOLD, 0.5)
        size = min(_TITLE, _TITLE * right / max(draw_list.width(words.title, title), 1.0))
        draw_list.text(words.title, (middle, 22.0), TypeStyle(size, INK, Face.BOLD, 0.5))
        draw_list.text(words.author, (right, 40.0), TypeStyle(_TEXT, INK_SOFT, Face.REGULAR, 1.0))
        for k, line in enumerate(self._about(draw_list)):
            draw_list.text(line, (0.0, _HEAD_HEIGHT + 4.0 + 13.0 * k), TypeStyle(_SMALL, INK_SOFT))


def _starts(words: SheetWords, swing: Mapping[int, SwingMark]) -> dict[int, str]:
    """The bars where something new begins, with what tells it apart: a section's name and how it swings."""
    names, starts, holds = dict(words.sections), dict[int, str](), swing.get(0)
    for bar in sorted(names.keys() | swing.keys() - {0}):
        holds = swing.get(bar, holds)
        starts[bar] = f"{names.get(bar, '')} {holds}"
    return starts


def line_words(
    score: Score, words: SheetWords, swing: Mapping[int, SwingMark]
) -> dict[int, list[tuple[float, LineWord]]]:
    """What stands above the bars, by bar: how many seconds after its start, and the words."""
    found: dict[int, list[tuple[float, LineWord]]] = {}
    for bar, at_s, word in _words_in_order(score, words, swing):
        before = found.setdefault(bar, [])
        is_beside = bool(before) and before[-1][0] == at_s
        before.append((at_s, _joined(before.pop()[1], word) if is_beside else word))
    return found


def _words_in_order(
    score: Score, words: SheetWords, swing: Mapping[int, SwingMark]
) -> Iterator[tuple[int, float, LineWord]]:
    """Bar, seconds from its start, and word, by time."""
    tempo, found = score.tempo_map, list[tuple[int, float, LineWord]]()
    first = None if words.beats_a_minute is None else TempoSign(words.beats_a_minute, words.beat_ticks)
    if first:
        found.append((0, 0.0, LineWord(0.0, tempo=first)))
    found += [(bar, 0.0, LineWord(0.0, section=name)) for bar, name in words.sections]
    found += [(bar, 0.0, LineWord(0.0, swing=mark)) for bar, mark in swing.items()]
    for change in read_tempo_words(tempo):
        if change.tick < score.end_tick:
            bar = int(tempo.bars_at(change.tick))
            at_s, start_s = tempo.seconds_at([change.tick, tempo.bar_start(bar)]).tolist()
            beats = round(change.tempo_bpm * PPQ / words.beat_ticks, 1)
            sign = TempoSign(beats, words.beat_ticks, change.way)
            word = LineWord(0.0, ramp=sign) if change.way else LineWord(0.0, tempo=sign)
            found.append((bar, at_s - start_s, word))
    yield from sorted(found, key=lambda item: item[:2])


def _joined(one: LineWord, other: LineWord) -> LineWord:
    """Two words for one place as one."""
    return LineWord(
        one.x,
        one.section or other.section,
        other.tempo or one.tempo,
        other.ramp or one.ramp,
        other.swing or one.swing,
    )
