"""Engraves bars of drum notation as flat shapes, anchored in time so that the score can scroll.

Units are staff spaces, y down, 0 on the staff's middle line. The horizontal place of everything is its time; only what
hangs on a note (stems, brackets, grace notes) is shifted by spaces. A bar is laid out once and kept by the caller.
Proportions follow Gould, "Behind Bars" (2011): stems 3½ spaces, beams half a space, stem right of the head when up.
"""

from collections.abc import Sequence
from copy import copy
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.score import Score
from station.render.notation.bar_signs import BarSigns
from station.render.notation.beams import FEET, HANDS, Anchor
from station.render.notation.loudness_row import draw_loudness
from station.render.notation.rests import draw_rest
from station.render.notation.spelling.note_values import Value
from station.render.notation.staff_rows import closing_hats, shown_limbs, staff_rows
from station.render.notation.staff_strokes import staff_strokes
from station.render.notation.swing_words import swing_marks
from station.render.notation.voice.chord_pen import Chord, ChordPen
from station.render.notation.voice.voice_pen import BarSpan, VoicePen
from station.render.notation.voice.written_strokes import feet_of, written_strokes
from station.render.notation.whole_score import whole_score
from station.render.snapshot import BarNumbers, TakeSpelling
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList

_DRAWN = ("piece", "zone", "articulation", "dynamic", "ornament", "lead_ms", "choke_ticks", "openness")
"""What of a stroke's row is drawn besides where it stands."""


class Engraver:
    """Engraves the bars of one score; `limbs` (n,) of `Limb` writes the sticking, None that of the score itself.

    What is beyond the player stands among their strokes with small heads.
    Where time rolls, `numbers` tells bars and loops, and tempi count beats of `beat_ticks` (`bar_signs`). Notes hang on
    the time when they sound, or, `as_written`, on that of the place where they are written, as on paper.
    """

    def __init__(
        self,
        score: Score,
        atlas: Atlas,
        limbs: NDArray[np.int8] | None = None,
        numbers: BarNumbers | None = None,
        beat_ticks: int = PPQ,
        as_written: bool = False,
    ) -> None:
        self.score = score
        self._numbers, self._beat_ticks = numbers or BarNumbers(), beat_ticks
        self._as_written = as_written
        self._atlas = atlas
        self.whole, known, self._is_small = whole_score(score, limbs)
        self._limbs = shown_limbs(self.whole, known)
        self.rows_y = staff_rows(self.whole, self._limbs)
        self._closing = closing_hats(self.whole)
        self._staff_strokes = staff_strokes(self.whole, self._limbs, self._is_small, self._closing)
        self._meant = score
        self._write()

    def of_take(self, spelling: TakeSpelling) -> "Engraver":
        """The same of a take, written as `spelling` says; nothing in it is beyond the player."""
        found = copy(self)
        found._meant = spelling.meant
        found._write(spelling.tick)
        return found

    def _write(self, ticks: NDArray[np.int64] | None = None) -> None:
        """Find where strokes are written, or have them at `ticks`."""
        self.strokes = written_strokes(self.whole, feet_of(self.whole), ticks)
        self._order = np.argsort(self.strokes.tick, kind="stable")
        self._in_order = self.strokes.tick[self._order]
        known = np.union1d(self.strokes.tick, self.whole.notes["tick"])
        self._seconds: dict[int, float] = dict(
            zip(known.tolist(), self.score.tempo_map.seconds_at(known).tolist(), strict=True)
        )

    def bar(self, bar: int, with_line: bool = True, opens_line: bool = False) -> NDArray[np.void]:
        """The shapes of one bar, `with_line` with what stands at its left bar line, dtype `draw_list.SHAPE_DTYPE`.

        `opens_line`: it is the first of its line, where ties from the line before begin anew.
        """
        return _BarEngraver(self, bar, with_line, opens_line).shapes()

    @cached_property
    def signs(self) -> BarSigns:
        """What stands at the bar lines."""
        return BarSigns(self.score, self._numbers, self._beat_ticks, swing_marks(self._meant))

    # --- what a bar asks ------------------------------------------------------------------------------------------

    def rows(self, start: int, end: int) -> list[int]:
        """Indices of the strokes that are written in [start, end) ticks, but the second ones of diddles."""
        first, last = np.searchsorted(self._in_order, [start, end])
        rows = self._order[first:last]
        return rows[~self.strokes.is_hidden[rows]].tolist()  # type: ignore[no-any-return]

    def chords(self, rows: Sequence[int], feet: bool) -> list[Chord]:
        """The strokes of one voice, gathered by where they are written."""
        places: dict[int, tuple[list[int], list[int]]] = {}
        for i in rows:
            if self.strokes.is_foot[i] == feet:
                mains, graces = places.setdefault(int(self.strokes.tick[i]), ([], []))
                (mains if self._staff_strokes[i].is_main else graces).append(i)
        return [
            Chord(self._stands(written, [*mains, *graces]), written, tuple(mains), tuple(graces))
            for written, (mains, graces) in sorted(places.items())
        ]

    def _stands(self, written: int, rows: Sequence[int]) -> int:
        """On which tick a chord hangs."""
        return written if self._as_written else min(self._staff_strokes[i].tick for i in rows)

    def anchor(self) -> Anchor:
        """What ties an empty sheet on the common letters to the score's time."""
        return Anchor(DrawList(self._atlas), self.score.tempo_map, self._seconds)

    def is_held_into(self, bar: int) -> bool:
        """Whether a roll of the bar before goes on in it."""
        start = self.score.tempo_map.bar_start(bar)
        return any(self.strokes.held_into(start, is_foot) for is_foot in (False, True))

    def pen(self, anchor: Anchor) -> ChordPen:
        """What draws the score's chords at `anchor`."""
        return ChordPen(self._staff_strokes, anchor, self.rows_y)

    def context(self, bar: int) -> bytes:
        """What of a bar's strokes is engraved as it is for where and beside what they stand."""
        start = self.score.tempo_map.bar_start(bar)
        rows = self.rows(start, self.score.tempo_map.bar_start(bar + 1))
        strokes = self.strokes
        rows += [i for is_foot in (False, True) for i in strokes.held_into(start, is_foot)]
        notes = self.whole.notes[rows]
        parts = [
            strokes.tick[rows] - start,
            strokes.until[rows] - start,
            strokes.is_measured[rows],
            self._closing[rows],
            self._is_small[rows],
        ]
        return b"".join(part.tobytes() for part in (*parts, *(notes[name] for name in _DRAWN), self._limbs[rows]))


class _BarEngraver:
    """The work of one bar."""

    def __init__(self, engraver: Engraver, bar: int, with_line: bool, opens_line: bool) -> None:
        self._with_line, self._opens_line = with_line, opens_line
        self._e = engraver
        self._tempo = engraver.score.tempo_map
        self._bar = bar
        self._start, self._end = self._tempo.bar_start(bar), self._tempo.bar_start(bar + 1)
        self._anchor = engraver.anchor()
        self._draw_list = self._anchor.draw_list
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
        if self._with_line:
            self._e.signs.draw_line(self._draw_list, self._bar, closes=not self._opens_line)
            self._e.signs.draw_words(self._anchor, self._bar, self._e.rows_y.words)

    def _bar_rest(self, beside: bool) -> None:
        """The rest of a bar in which the hands are silent; silent feet are left out."""
        if self._start < self._e.score.end_tick:
            self._anchor.at((self._start + self._end) // 2)
            draw_rest(self._draw_list, Value(1), True, [] if beside else None)
