"""Engraves bars of drum notation as flat shapes, anchored in time so that the score can scroll.

Units are staff spaces, y down, 0 on the staff's middle line. The horizontal place of everything is its time; only what
hangs on a note (stems, brackets, grace notes) is shifted by spaces. A bar is laid out once and kept by the caller.
Proportions follow Gould, "Behind Bars" (2011): stems 3½ spaces, beams half a space, stem right of the head when up.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.score import Score
from station.music.tempo_words import TempoWord, tempo_words
from station.render.notation.beams import FEET, HANDS, Anchor
from station.render.notation.beat_note import draw_beat_note
from station.render.notation.chord_pen import Chord, ChordPen
from station.render.notation.loudness_row import draw_loudness
from station.render.notation.note_values import Value
from station.render.notation.rests import draw_rest
from station.render.notation.staff import FOOT_PIECES
from station.render.notation.staff_rows import closing_hats, shown_limbs, staff_rows
from station.render.notation.swing_words import swing_words
from station.render.notation.voice_pen import BarSpan, VoicePen
from station.render.notation.written_strokes import written_strokes
from station.render.palette import BRAND, INK_SOFT
from station.render.snapshot import BarNumbers
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

STAFF_TOP, STAFF_BOTTOM = -2.0, 2.0
_NUMBER_X = 0.35
"""A bar's number begins so far left of its line: clear of what stands over the first beat."""

_WORD, _WORD_GAP = TypeStyle(1.5, BRAND, Face.BOLD), 0.9
"""Meters and tempi stand above the staff beside the bar's number, so far apart: time leaves no room between notes."""
_RAMPS = {1: "accel. to", -1: "rit. to"}


class Engraver:
    """Engraves the bars of one score; `limbs` (n,) of `Limb` writes the sticking, None that of the score itself.

    Tempi count beats of `beat_ticks`. `meter_words`: new meters stand above the staff; a sheet has room for them
    within.
    """

    def __init__(
        self,
        score: Score,
        atlas: Atlas,
        limbs: NDArray[np.int8] | None = None,
        numbers: BarNumbers | None = None,
        beat_ticks: int = PPQ,
        meter_words: bool = True,
    ) -> None:
        self.score = score
        self.numbers = numbers or BarNumbers()
        self.beat_ticks = beat_ticks
        self._atlas = atlas
        self._limbs = shown_limbs(score, score.notes["limb"] if limbs is None else limbs)
        self.rows_y = staff_rows(score, self._limbs)
        self._closing = closing_hats(score)
        self._tempo_words = tempo_words(score.tempo_map)
        self._new_meters = {meter.tick for meter in score.tempo_map.meters if meter_words and meter.tick > 0}
        self._swing_words = swing_words(score)
        feet = [int(p) for p in FOOT_PIECES]
        self.strokes = written_strokes(score, np.isin(score.notes["piece"], feet))
        self._order = np.argsort(self.strokes.tick, kind="stable")

    def bar(self, bar: int, with_line: bool = True, opens_line: bool = False) -> NDArray[np.void]:
        """The shapes of one bar, `with_line` the bar line on its left, dtype `draw_list.SHAPE_DTYPE`.

        `opens_line`: it is the first of its line on paper, where ties from the line before begin anew.
        """
        return _BarEngraver(self, bar, with_line, opens_line).shapes()

    # --- what a bar asks ------------------------------------------------------------------------------------------

    def rows(self, start: int, end: int) -> list[int]:
        """Indices of the strokes that are written in [start, end) ticks, but the second ones of diddles."""
        first, last = np.searchsorted(self.strokes.tick[self._order], [start, end])
        rows = self._order[first:last]
        return [int(i) for i in rows[~self.strokes.is_hidden[rows]]]

    def chords(self, rows: Sequence[int], feet: bool) -> list[Chord]:
        """The strokes of one voice, gathered by where they are written."""
        notes = self.score.notes
        places: dict[int, tuple[list[int], list[int]]] = {}
        for i in rows:
            if self.strokes.is_foot[i] == feet:
                mains, graces = places.setdefault(int(self.strokes.tick[i]), ([], []))
                (graces if notes["lead_ms"][i] > 0 else mains).append(i)
        return [
            Chord(int(notes["tick"][[*mains, *graces]].min()), written, tuple(mains), tuple(graces))
            for written, (mains, graces) in sorted(places.items())
        ]

    def pen(self, anchor: Anchor) -> ChordPen:
        """What draws the score's chords at `anchor`."""
        return ChordPen(self.score, self._limbs, self._closing, anchor, self.rows_y)

    def tempo_words(self, start: int, end: int) -> list[TempoWord]:
        """What is written of the tempo in [start, end) ticks."""
        return [word for word in self._tempo_words if start <= word.tick < end]

    def meter_word(self, start: int) -> str:
        """The new meter of the bar that starts at tick `start`; empty where there is none, or no word for it."""
        return str(self.score.tempo_map.meter_at(start)) if start in self._new_meters else ""

    def swing_word(self, bar: int) -> str:
        """The feel that begins with the bar; empty where none does."""
        return self._swing_words.get(bar, "")

    def draw_list(self) -> DrawList:
        """An empty sheet on the common letters."""
        return DrawList(self._atlas)


class _BarEngraver:
    """The work of one bar."""

    def __init__(self, engraver: Engraver, bar: int, with_line: bool, opens_line: bool) -> None:
        self._with_line, self._opens_line = with_line, opens_line
        self._e = engraver
        self._tempo = engraver.score.tempo_map
        self._bar = bar
        self._start, self._end = self._tempo.bar_start(bar), self._tempo.bar_start(bar + 1)
        self._draw_list = engraver.draw_list()
        self._anchor = Anchor(self._draw_list, self._tempo)
        self._pen = engraver.pen(self._anchor)

    def shapes(self) -> NDArray[np.void]:
        self._bar_line()
        rows = self._e.rows(self._start, self._end)
        hands, feet = self._e.chords(rows, feet=False), self._e.chords(rows, feet=True)
        meter = self._tempo.meter_at(self._start)
        bar = BarSpan(self._start, self._end, meter, self._with_line, self._opens_line)
        voices = VoicePen(self._e.strokes, bar, self._anchor, self._pen)
        has_feet = not voices.is_silent(feet, FEET)
        if voices.is_silent(hands, HANDS):
            self._bar_rest(beside=has_feet)
        else:
            voices.draw(hands, HANDS, beside=has_feet)
        if has_feet:
            voices.draw(feet, FEET, beside=True)
        draw_loudness(self._anchor, self._e.score, (self._start, self._end), self._e.rows_y.loudness)
        return self._draw_list.shapes()

    # --- bars ---------------------------------------------------------------------------------------------------------

    def _bar_line(self) -> None:
        self._anchor.at(self._start)
        x = -1.25
        if self._with_line:
            self._draw_list.line((x, STAFF_TOP), (x, STAFF_BOTTOM), 0.16, INK_SOFT)
        if self._start >= self._e.score.end_tick:
            return
        number = str(self._e.numbers.of(self._bar))
        words_y = self._e.rows_y.words
        x += _NUMBER_X + self._draw_list.text(number, (x - _NUMBER_X, words_y), TypeStyle(1.25, INK_SOFT, Face.BOLD))
        for word in filter(None, (self._e.meter_word(self._start), self._e.swing_word(self._bar))):
            x += _WORD_GAP + self._draw_list.text(word, (x, words_y), _WORD)
        self._tempo_words(x)

    def _tempo_words(self, x: float) -> None:
        """New tempi, and where it grows faster or slower; what comes with the bar stands at `x`, beside its number."""
        words_y = self._e.rows_y.words
        for word in self._e.tempo_words(self._start, self._end):
            self._anchor.at(word.tick)
            left = x if word.tick == self._start else -0.6
            if word.way:
                left += _WORD_GAP / 2 + self._draw_list.text(_RAMPS[word.way], (left, words_y), _WORD)
            left = draw_beat_note(self._draw_list, (left, words_y), 1.0, self._e.beat_ticks, BRAND)
            beats = word.tempo_bpm * PPQ / self._e.beat_ticks
            self._draw_list.text(f"= {beats:.0f}", (left, words_y), _WORD)

    def _bar_rest(self, beside: bool) -> None:
        """The rest of a bar in which the hands are silent; silent feet are left out."""
        if self._start < self._e.score.end_tick:
            self._anchor.at((self._start + self._end) // 2)
            draw_rest(self._draw_list, Value(1), True, [] if beside else None)
