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
from station.render.notation.page.page_places import BarPlace
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
class LineShapes:
    """A line's shapes in staff spaces from its left end and its middle line, and how far up and down it reaches."""

    shapes: NDArray[np.void]
    top: float
    bottom: float


@dataclass(frozen=True, slots=True, eq=False)
class LineInk:
    """A line in points, its middle line at y = 0, and how far it reaches: `top` is negative."""

    ink: Ink
    top: float
    bottom: float


class KeptBars:
    """The bars that were engraved for one score and another, all with one atlas: those that are alike are set once."""

    MOST = 4000
    """Twice the longest lesson (our choice)."""

    def __init__(self) -> None:
        self.forms: dict[object, int] = {}
        self.engraved: dict[object, NDArray[np.void]] = {}
        self.columns: dict[object, BarColumns] = {}

    def forget_many(self) -> None:
        """Forget all where there are more than are worth keeping."""
        if len(self.engraved) > self.MOST:
            for table in (self.forms, self.engraved, self.columns):
                table.clear()


class LineSetter:
    """Sets the lines of a sheet whose `bars` are those of the score that `engraver` has, as notation writes it.

    `words` stand above the bars of the score, each with the seconds from the bar's start. Where `step_ticks` are said
    a bar has a column at every such step, though nothing stands there: room for what may be written. `kept` has the
    bars of other scores that were set with the same atlas and steps.
    """

    def __init__(
        self,
        engraver: Engraver,
        bars: Sequence[SheetBar],
        words: Mapping[int, Sequence[tuple[float, LineWord]]],
        atlas: OutlineAtlas,
        step_ticks: int = 0,
        kept: KeptBars | None = None,
    ) -> None:
        self._engraver, self._bars, self._words, self._atlas = engraver, bars, words, atlas
        self._step_ticks = step_ticks
        self._score: Score = engraver.score
        self._kept = KeptBars() if kept is None else kept
        self._kept.forget_many()
        self._forms = written_forms(self._score, self._kept.forms)
        self._contexts = {bar.bar: engraver.context(bar.bar) for bar in bars}

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
        key = (self._form(bar.bar), bar.opens_repeat, bar.line, self._step_ticks)
        if key not in self._kept.columns:
            tempo = self._score.tempo_map
            ends = [tempo.bar_start(bar.bar), tempo.bar_start(bar.bar + 1)]
            start_s, end_s = tempo.seconds_at(ends).tolist()
            steps = range(ends[0], ends[1], self._step_ticks) if self._step_ticks else ()
            self._kept.columns[key] = bar_columns(
                self._shapes(bar.bar, opens_line=False),
                end_s - start_s,
                lambda times_s: tempo.ticks_at(times_s + start_s),
                (REPEAT_WIDTH if bar.opens_repeat else 0.0, line_width(bar.line)),
                tempo.seconds_at(list(steps)) - start_s,
            )
        return self._kept.columns[key]

    def _form(self, bar: int) -> object:
        """What tells bars apart that are engraved differently."""
        return self._forms[bar], self._contexts[bar], self._engraver.rows_y

    def _shapes(self, bar: int, opens_line: bool) -> NDArray[np.void]:
        """A bar's engraved shapes, their times counted from its start."""
        opens_line = opens_line and self._engraver.is_held_into(bar)  # else it looks the same
        key = (self._form(bar), opens_line)
        if key not in self._kept.engraved:
            shapes = self._engraver.bar(bar, with_line=False, opens_line=opens_line).copy()
            shapes["time_s"][:, 0] -= np.float32(self._score.tempo_map.seconds_at(self._score.tempo_map.bar_start(bar)))
            self._kept.engraved[key] = shapes
        return self._kept.engraved[key]

    # --- drawing ------------------------------------------------------------------------------------------------------

    def line(self, boxes: Sequence[BarBox], set_bars: Sequence[SetBar], left: float, space: float) -> LineInk:
        """The line that `boxes` share, its staff beginning at `left`, with staff spaces of `space` points."""
        line = self.shapes_of(boxes, set_bars)
        ink = filled(line.shapes, self._atlas, PaperSpot((left, 0.0), space))
        return LineInk(ink, line.top * space, line.bottom * space)

    def shapes_of(self, boxes: Sequence[BarBox], set_bars: Sequence[SetBar]) -> LineShapes:
        """The line that `boxes` share."""
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
        return LineShapes(np.concatenate([staff.shapes(), *bars]), skyline.top, skyline.bottom)

    def place(self, box: BarBox, set_bars: Sequence[SetBar], first: int) -> BarPlace:
        """Where the moments of the bar of `box` stand in the line that begins with bar number `first` of the sheet."""
        lead, bar = set_bars[first].lead, self._bars[box.index].bar
        tempo = self._score.tempo_map
        start = tempo.bar_start(bar)
        times_s = self._columns_of(self._bars[box.index]).times_s + float(tempo.seconds_at(start))
        ticks = np.append(tempo.ticks_at(times_s), tempo.bar_start(bar + 1)) - start
        edge = 0.0 if box.index == first else lead + box.left
        return BarPlace(bar, edge, lead + box.right, ticks, lead + np.append(box.places, box.right))

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
