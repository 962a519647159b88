"""A score as a sheet for the music stand: title, tempo, author, lines of engraved bars, and a key of what is used.

Lengths are points (1/72 inch) where no other unit is named, y down; the staff's are staff spaces, as in `engraving`.
"""

from dataclasses import dataclass, field

import numpy as np

from station.core.pieces import Limb
from station.core.units import PPQ
from station.music.score import Score
from station.render.notation import note_shapes
from station.render.notation.beat_note import draw_beat_note
from station.render.notation.engraving import Engraver
from station.render.notation.line_breaks import REPEAT, BarBox, ruler, systems
from station.render.notation.sheet_key import KEY_HEIGHT, draw_key
from station.render.palette import INK, INK_SOFT
from station.render.snapshot import BarNumbers
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face
from station.render.text.paper import Filled, OutlineAtlas, PaperSpot, filled

SPACES = tuple(mm / 25.4 * 72 for mm in (2.75, 2.25, 1.75))
"""Staff spaces: the largest with which all is on one page, else the least, a staff of 7 mm, which parts are printed in
(Gould, "Behind Bars", 2011: 6.5 to 7.5 mm); a short loop is read from further off (our choice)."""
MARGIN = 15 / 25.4 * 72
"""What printers leave free, and a thumb."""
PAPERS = {"a4": (595.28, 841.89), "letter": (612.0, 792.0)}
LEAD = 6.2
"""What clef and meter take of a line, in staff spaces, at the least."""
_CLEF_X, _SIGNATURE_X = 0.8, 0.8 + note_shapes.CLEF_WIDTH + note_shapes.SIGNATURE_GAP
_ABOVE, _BELOW = 0.6, 0.4
_TITLE, _TEXT, _SMALL = 22.0, 11.0, 9.5
_BEAT_NOTE = 9.2
"""The unit of the note before the tempo: a little taller than its figures (our choice)."""
_ABOUT_LINES = 3
_HEAD_HEIGHT = 62.0


@dataclass(frozen=True, slots=True)
class SheetWords:
    """What stands on a sheet beside its notes.

    `beats_a_minute` of beats `beat_ticks` long; `feel` such as "swing 2 : 1"; `sections` the names of parts by the bar
    (from 0) where they begin; `repeat` the first and last bar (from 0) of what is to be repeated; `first_bar` what the
    first bar is called.
    """

    title: str
    author: str = ""
    beats_a_minute: float | None = None
    beat_ticks: int = PPQ
    feel: str = ""
    about: str = ""
    sections: tuple[tuple[int, str], ...] = ()
    repeat: tuple[int, int] | None = None
    first_bar: int = 1


@dataclass(frozen=True, slots=True)
class SheetSetting:
    """How a sheet is set: the paper's `size` and the staff `space` in points, and whether the hands are written."""

    size: tuple[float, float]
    space: float
    with_sticking: bool


@dataclass(slots=True)
class _Page:
    """A page that fills from `y` down."""

    y: float = MARGIN
    areas: list[Filled] = field(default_factory=list)


def sheet(score: Score, words: SheetWords, size: tuple[float, float], with_sticking: bool = True) -> list[list[Filled]]:
    """The pages of `score`, each of `size` (width, height) points."""
    for space in SPACES:
        pages = _SheetPage(score, words, SheetSetting(size, space, with_sticking)).pages()
        if len(pages) == 1:
            break
    return pages


class _SheetPage:
    """The work of one sheet."""

    def __init__(self, score: Score, words: SheetWords, setting: SheetSetting) -> None:
        self._score, self._words, self._size = score, words, setting.size
        self._space, self._with_sticking = setting.space, setting.with_sticking
        self._atlas = OutlineAtlas()
        limbs = score.notes["limb"]
        shown = limbs if setting.with_sticking else np.full_like(limbs, Limb.UNKNOWN)
        self._engraver = Engraver(
            score, self._atlas, shown, BarNumbers(words.first_bar - 1), words.beat_ticks, meter_words=False
        )
        self._pages = [_Page()]
        tempo = score.tempo_map
        self._new_meters = {
            int(tempo.bars_at(meter.tick)): meter for meter in tempo.meters if 0 < meter.tick < score.end_tick
        }
        self._top, self._bottom = self._engraver.rows_y.top - _ABOVE, self._engraver.rows_y.bottom + _BELOW
        widest = note_shapes.signature_width(DrawList(self._atlas), score.tempo_map.meter_at(0))
        self._lead = max(LEAD, _SIGNATURE_X + widest + note_shapes.SIGNATURE_GAP)

    def pages(self) -> list[list[Filled]]:
        """Lay out everything."""
        self._head()
        named = {bar for bar, _ in self._words.sections}
        for boxes in systems(self._score, self._width / self._space - self._lead, self._before()):
            top = self._top - (2.0 if any(box.bar in named for box in boxes) else 0.0)
            page = self._room((self._bottom - top) * self._space)
            self._system(boxes, page, page.y - top * self._space)
            page.y += (self._bottom - top) * self._space
        page = self._room(KEY_HEIGHT * self._space)
        spot = PaperSpot((MARGIN, self._size[1] - MARGIN - KEY_HEIGHT * self._space), self._space)
        draw_list = DrawList(self._atlas)
        draw_key(draw_list, self._score, self._width / self._space, self._with_sticking)
        page.areas += filled(draw_list.shapes(), self._atlas, spot)
        self._feet()
        return [page.areas for page in self._pages]

    @property
    def _width(self) -> float:
        return self._size[0] - 2 * MARGIN

    def _before(self) -> dict[int, float]:
        """What stands between a bar line and the notes: repeat signs and new meters, by their bars."""
        letters, found = DrawList(self._atlas), {}
        if self._words.repeat is not None:
            found[self._words.repeat[0]] = REPEAT
        for bar, meter in self._new_meters.items():
            width = note_shapes.signature_width(letters, meter)
            found[bar] = found.get(bar, 0.0) + width + note_shapes.SIGNATURE_GAP
        return found

    def _room(self, height: float) -> _Page:
        """A page that has so much left."""
        if self._pages[-1].y + height > self._size[1] - MARGIN:
            self._pages.append(_Page())
        return self._pages[-1]

    def _print(self, page: _Page, draw_list: DrawList, spot: PaperSpot) -> None:
        page.areas += filled(draw_list.shapes(), self._atlas, spot)

    # --- head and feet ------------------------------------------------------------------------------------------------

    def _head(self) -> None:
        words, page, draw_list = self._words, self._pages[0], DrawList(self._atlas)
        middle, right = self._width / 2, self._width
        title = TypeStyle(_TITLE, INK, Face.BOLD, 0.5)
        size = min(_TITLE, _TITLE * right / max(draw_list.width(words.title, title), 1.0))
        draw_list.text(words.title, (middle, 22.0), TypeStyle(size, INK, Face.BOLD, 0.5))
        y = 46.0
        draw_list.text(words.author, (right, y), TypeStyle(_TEXT, INK_SOFT, Face.REGULAR, 1.0))
        x = self._tempo(draw_list, y) if words.beats_a_minute is not None else 0.0
        draw_list.text(words.feel, (x, y), TypeStyle(_TEXT, INK))
        height = _HEAD_HEIGHT
        about = TypeStyle(_SMALL, INK_SOFT)
        lines = draw_list.broken(words.about, about, right)
        if words.about:
            more = len(lines) > _ABOUT_LINES
            for k, line in enumerate(lines[:_ABOUT_LINES]):
                text = f"{line} …" if more and k == _ABOUT_LINES - 1 else line
                draw_list.text(text, (0.0, height + 2.0 + 13.0 * k), about)
            height += 13.0 * min(len(lines), _ABOUT_LINES) + 6.0
        self._print(page, draw_list, PaperSpot((MARGIN, MARGIN), 1.0))
        page.y += height

    def _tempo(self, draw_list: DrawList, y: float) -> float:
        """The beat as a note, and how many a minute; returns where it ends."""
        words = self._words
        x = draw_beat_note(draw_list, (0.0, y), _BEAT_NOTE, words.beat_ticks, INK)
        return x + draw_list.text(f"= {words.beats_a_minute:g}", (x, y), TypeStyle(_TEXT, INK, Face.BOLD)) + 16.0

    def _feet(self) -> None:
        """Which page of how many, where there are more."""
        if len(self._pages) == 1:
            return
        for number, page in enumerate(self._pages, 1):
            draw_list = DrawList(self._atlas)
            draw_list.text(self._words.title, (0.0, 0.0), TypeStyle(_SMALL, INK_SOFT))
            draw_list.text(
                f"{number} / {len(self._pages)}", (self._width, 0.0), TypeStyle(_SMALL, INK_SOFT, Face.REGULAR, 1.0)
            )
            self._print(page, draw_list, PaperSpot((MARGIN, self._size[1] - MARGIN * 0.5), 1.0))

    # --- a line of bars -----------------------------------------------------------------------------------------------

    def _system(self, boxes: list[BarBox], page: _Page, middle_y: float) -> None:
        draw_list, end = DrawList(self._atlas), self._lead + boxes[-1].right
        note_shapes.staff_lines(draw_list, end)
        note_shapes.clef(draw_list, _CLEF_X)
        if boxes[0].bar == 0:
            note_shapes.time_signature(draw_list, self._score.tempo_map.meter_at(0), _SIGNATURE_X)
        names = dict(self._words.sections)
        first, last = self._words.repeat or (None, None)
        for box in boxes:
            x = self._lead + box.left
            if box.bar in names:
                draw_list.text(names[box.bar], (x, self._top), TypeStyle(1.9, INK, Face.BOLD))
            if box.bar == first:
                _repeat(draw_list, x, 1)
            elif box is not boxes[0] and box.bar - 1 != last:
                _bar_line(draw_list, x)
            if box.bar in self._new_meters:
                left = x + note_shapes.SIGNATURE_GAP + (REPEAT if box.bar == first else 0.0)
                note_shapes.time_signature(draw_list, self._new_meters[box.bar], left)
            if box.bar == last:
                _repeat(draw_list, self._lead + box.right, -1)
        if boxes[-1].bar != last:
            is_end = boxes[-1].bar == self._score.bar_count - 1
            _last_line(draw_list, end) if is_end else _bar_line(draw_list, end - 0.08)
        self._print(page, draw_list, PaperSpot((MARGIN, middle_y), self._space))
        for box in boxes:
            spot = PaperSpot((MARGIN + self._lead * self._space, middle_y), self._space, ruler(self._score, box))
            bar = self._engraver.bar(box.bar, with_line=False, opens_line=box is boxes[0])
            page.areas += filled(bar, self._atlas, spot)


def _bar_line(draw_list: DrawList, x: float, width: float = 0.16) -> None:
    draw_list.line((x, -2.0), (x, 2.0), width, INK)


def _last_line(draw_list: DrawList, x: float) -> None:
    """A thin and a thick line, the thick one ending at `x`."""
    _bar_line(draw_list, x - 0.25, 0.5)
    _bar_line(draw_list, x - 0.85)


def _repeat(draw_list: DrawList, x: float, way: int) -> None:
    """A repeat sign whose thick line begins at `x` and whose dots stand on its right (1) or left (−1)."""
    _bar_line(draw_list, x + 0.25 * way, 0.5)
    _bar_line(draw_list, x + 0.85 * way)
    for y in (-0.5, 0.5):
        draw_list.ellipse((x + 1.45 * way, y), (0.2, 0.2), INK)
