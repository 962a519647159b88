"""One line of a sheet: staff, clef, meters, bar lines, the engraved bars, and what stands above them.

Units are staff spaces, y down, x from the staff's left end, y from its middle line; the line's ink is in points.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.music.repeats import written_forms
from station.music.score import Score
from station.render.notation import note_shapes
from station.render.notation.bar_lines import REPEAT_WIDTH, THIN, BarLine, Volta, draw_bar_line, line_width
from station.render.notation.engraving import Engraver
from station.render.notation.page.bar_columns import BarColumns, bar_columns
from station.render.notation.page.line_breaks import BarBox, SetBar
from station.render.notation.page.sheet_bars import SheetBar
from station.render.notation.sheet_words import LineWord, draw_number, draw_times, draw_voltas, draw_words
from station.render.notation.skyline import Skyline
from station.render.text.draw_list import DrawList
from station.render.text.paper import Ink, OutlineAtlas, PaperSpot, filled, placed

Floats = NDArray[np.float64]

_CLEF_X, _AFTER_CLEF = 0.8, 0.5
_CLEF_END = _CLEF_X + note_shapes.CLEF_WIDTH
_BEFORE_DUE = 0.6
_OVER_LINE_S = 1e-4
"""What begins so long before its bar, or longer, comes over the bar line and begins there."""
_SIGNATURE_X = _CLEF_END + note_shapes.SIGNATURE_GAP


@dataclass(frozen=True, slots=True, eq=False)
class LineInk:
    """A line in points, its middle line at y = 0, and how far it reaches: `top` is negative."""

    ink: Ink
    top: float
    bottom: float


class LineSetter:
    """Sets the lines of a sheet whose `bars` are those of the score that `engraver` has, as notation writes it.

    `words` stand above the bars of the score, each with the seconds from the bar's start.
    """

    def __init__(
        self,
        engraver: Engraver,
        bars: Sequence[SheetBar],
        words: Mapping[int, Sequence[tuple[float, LineWord]]],
        atlas: OutlineAtlas,
    ) -> None:
        self._engraver, self._bars, self._words, self._atlas = engraver, bars, words, atlas
        self._score: Score = engraver.score
        self._forms = written_forms(self._score)
        self._contexts = {bar.bar: engraver.context(bar.bar) for bar in bars}
        self._engraved: dict[object, NDArray[np.void]] = {}
        self._columns: dict[object, BarColumns] = {}

    def set_bars(self) -> list[SetBar]:
        """The bars as line breaks ask for them."""
        return [self._set_bar(bar, is_first=k == 0) for k, bar in enumerate(self._bars)]

    def _set_bar(self, bar: SheetBar, is_first: bool) -> SetBar:
        width = note_shapes.signature_width(bar.meter) if bar.meter else 0.0
        gap = note_shapes.SIGNATURE_GAP
        return SetBar(
            self._columns_of(bar),
            lead=_SIGNATURE_X + width + _AFTER_CLEF if bar.meter else _CLEF_END + _AFTER_CLEF,
            signature=gap + width if bar.meter and not is_first else 0.0,
            courtesy=2 * gap + width if bar.meter else 0.0,
            in_phrase=bar.in_phrase,
            within_ending=bar.volta is not None and not bar.volta.opens,
        )

    def _columns_of(self, bar: SheetBar) -> BarColumns:
        key = (self._form(bar.bar), bar.opens_repeat, bar.line)
        if key not in self._columns:
            tempo = self._score.tempo_map
            ends = [tempo.bar_start(bar.bar), tempo.bar_start(bar.bar + 1)]
            start_s, end_s = tempo.seconds_at(ends).tolist()
            self._columns[key] = bar_columns(
                self._shapes(bar.bar, opens_line=False),
                end_s - start_s,
                lambda times_s: tempo.ticks_at(times_s + start_s),
                (REPEAT_WIDTH if bar.opens_repeat else 0.0, line_width(bar.line)),
            )
        return self._columns[key]

    def _form(self, bar: int) -> object:
        """What tells bars apart that are engraved differently."""
        return self._forms[bar], self._contexts[bar]

    def _shapes(self, bar: int, opens_line: bool) -> NDArray[np.void]:
        """A bar's engraved shapes, their times counted from its start."""
        opens_line = opens_line and self._engraver.is_held_into(bar)  # else it looks the same
        key = (self._form(bar), opens_line)
        if key not in self._engraved:
            shapes = self._engraver.bar(bar, with_line=False, opens_line=opens_line).copy()
            shapes["time_s"][:, 0] -= np.float32(self._score.tempo_map.seconds_at(self._score.tempo_map.bar_start(bar)))
            self._engraved[key] = shapes
        return self._engraved[key]

    # --- drawing ------------------------------------------------------------------------------------------------------

    def line(self, boxes: Sequence[BarBox], set_bars: Sequence[SetBar], left: float, space: float) -> LineInk:
        """The line that `boxes` share, its staff beginning at `left`, with staff spaces of `space` points."""
        first, after = boxes[0].index, boxes[-1].index + 1
        lead = set_bars[first].lead
        courtesy = self._bars[after].meter if after < len(self._bars) else None
        staff = DrawList(self._atlas)
        end = lead + boxes[-1].right
        width = end + (set_bars[after].courtesy if courtesy else 0.0)
        skyline = Skyline(width)
        note_shapes.staff_lines(staff, width)
        note_shapes.clef(staff, _CLEF_X)
        self._signatures(staff, boxes, lead)
        if courtesy:
            note_shapes.time_signature(staff, courtesy, end + note_shapes.SIGNATURE_GAP)
        self._bar_lines(staff, boxes, lead)
        bars = [self._bar(box, lead, opens_line=box is boxes[0]) for box in boxes]
        for shapes in bars:
            skyline.add_shapes(shapes)
        self._above(staff, skyline, boxes, lead)
        shapes = np.concatenate([staff.shapes(), *bars])
        ink = filled(shapes, self._atlas, PaperSpot((left, 0.0), space))
        return LineInk(ink, skyline.top * space, skyline.bottom * space)

    def _bar(self, box: BarBox, lead: float, opens_line: bool) -> NDArray[np.void]:
        return placed(self._shapes(self._bars[box.index].bar, opens_line), self._ruler(box, lead))

    def _ruler(self, box: BarBox, lead: float) -> "Ruler":
        bar = self._bars[box.index]
        tempo = self._score.tempo_map
        ends = tempo.seconds_at([tempo.bar_start(bar.bar), tempo.bar_start(bar.bar + 1)])
        times_s = [-_OVER_LINE_S, *self._columns_of(bar).times_s, ends[1] - ends[0]]
        return Ruler(np.array(times_s), lead + np.array([box.left, *box.places, box.right]))

    def _signatures(self, staff: DrawList, boxes: Sequence[BarBox], lead: float) -> None:
        for box in boxes:
            if (meter := self._bars[box.index].meter) is not None:
                note_shapes.time_signature(staff, meter, self._signature_x(box, lead, opens_line=box is boxes[0]))

    def _signature_x(self, box: BarBox, lead: float, opens_line: bool) -> float:
        if opens_line:
            return _SIGNATURE_X
        repeat = REPEAT_WIDTH if self._bars[box.index].opens_repeat else 0.0
        return lead + box.left + repeat + note_shapes.SIGNATURE_GAP

    def _bar_lines(self, staff: DrawList, boxes: Sequence[BarBox], lead: float) -> None:
        for box in boxes:
            bar, is_last = self._bars[box.index], box is boxes[-1]
            right = lead + box.right
            opens = not is_last and self._bars[box.index + 1].opens_repeat
            if bar.opens_repeat:
                draw_bar_line(staff, lead + box.left, BarLine.REPEAT_START)
            if bar.line in (BarLine.PLAIN, BarLine.DOUBLE):
                if not opens:
                    draw_bar_line(staff, right - (THIN / 2 if is_last else 0.0), bar.line)
            else:
                draw_bar_line(staff, right, bar.line)

    def _above(self, staff: DrawList, skyline: Skyline, boxes: Sequence[BarBox], lead: float) -> None:
        voltas: list[tuple[float, float, Volta]] = []
        words: list[LineWord] = []
        for box in boxes:
            bar, left, right = self._bars[box.index], lead + box.left, lead + box.right
            edge = 0.0 if box is boxes[0] else left
            if bar.number:
                draw_number(staff, skyline, edge, bar.number)
            if bar.times:
                draw_times(staff, skyline, right, bar.times)
            if bar.volta is not None:
                voltas.append((left + 0.2, right - 0.2 * bar.volta.closes, bar.volta))
            words += self._words_of(bar.bar, box, lead, edge)
        draw_voltas(staff, skyline, voltas)
        draw_words(staff, skyline, words)

    def _words_of(self, bar: int, box: BarBox, lead: float, edge: float) -> list[LineWord]:
        """The words of a bar, those that come with it at its left `edge`, others a little before they are due."""
        ruler = self._ruler(box, lead)
        return [
            replace(word, x=float(ruler(np.array([at_s]))[0]) - _BEFORE_DUE if at_s else edge)
            for at_s, word in self._words.get(bar, ())
        ]


class Ruler:
    """Where times of a bar, from its start, stand in its line."""

    def __init__(self, times_s: Floats, places: Floats) -> None:
        self._times_s, self._places = times_s, places

    def __call__(self, times_s: Floats) -> Floats:
        """The places (n,) of `times_s` (n,)."""
        places: Floats = np.interp(times_s, self._times_s, self._places)
        return places
