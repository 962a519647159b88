"""Engraves bars of drum notation as flat shapes, anchored in time so that the score can scroll.

Units are staff spaces, y down, 0 on the staff's middle line. The horizontal place of everything is its time; only what
hangs on a note (stems, brackets, grace notes) is shifted by spaces. A bar is laid out once and kept by the caller.
Proportions follow Gould, "Behind Bars" (2011): stems 3½ spaces, beams half a space, stem right of the head when up.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.score import Score
from station.music.tempo_words import TempoWord, tempo_words
from station.render.notation.beams import (
    STEM_X,
    Anchor,
    StaffVoice,
    draw_beams,
    draw_flags,
    draw_tuplet,
)
from station.render.notation.beat_note import draw_beat_note
from station.render.notation.chord_pen import Chord, ChordPen
from station.render.notation.held_rolls import draw_tie, held_until, long_groups, spelled, tie_way
from station.render.notation.loudness_row import draw_loudness
from station.render.notation.rests import draw_rest
from station.render.notation.rhythm import BeatGroup, Value, beat_groups
from station.render.notation.staff import FOOT_PIECES, height
from station.render.notation.staff_rows import (
    closing_hats,
    shown_limbs,
    staff_rows,
    stem_end,
)
from station.render.notation.swing_words import swing_words
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

_TUPLET_OFF = {-1: 0.4, 1: 1.4}
"""How far a tuplet's number has its baseline from what its chords reach to."""
_INCOMING, _OVER_LINE = 1.7, 0.9
"""A tie from the line before begins so far left of its head, one over a bar line on paper ends so far right of it."""
_HANDS, _FEET = StaffVoice(-1, 0.0), StaffVoice(1, 2.5)


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
        self._is_foot = np.isin(score.notes["piece"], feet)
        self.written = score.notes["tick"] - score.notes["swing_ticks"]
        self.until = held_until(score, self._is_foot)

    def bar(self, bar: int, with_line: bool = True, opens_line: bool = False) -> NDArray[np.void]:
        """The shapes of one bar, `with_line` the bar line on its left, dtype `draw_list.SHAPE_DTYPE`.

        `opens_line`: it is the first of its line on paper, where ties from the line before begin anew.
        """
        return _BarEngraver(self, bar, with_line, opens_line).shapes()

    # --- what a bar asks ------------------------------------------------------------------------------------------

    def rows(self, start: int, end: int) -> range:
        """Indices of the strokes in [start, end) ticks."""
        first, last = np.searchsorted(self.score.notes["tick"], [start, end])
        return range(int(first), int(last))

    def chords(self, rows: range, feet: bool) -> list[Chord]:
        """The strokes of one voice, gathered by where they are written."""
        notes = self.score.notes
        places: dict[int, tuple[list[int], list[int]]] = {}
        for i in rows:
            if self._is_foot[i] == feet:
                mains, graces = places.setdefault(int(notes["tick"][i] - notes["swing_ticks"][i]), ([], []))
                (graces if notes["lead_ms"][i] > 0 else mains).append(i)
        return [
            Chord(int(notes["tick"][[*mains, *graces]].min()), written, tuple(mains), tuple(graces))
            for written, (mains, graces) in sorted(places.items())
        ]

    def held_into(self, start: int, feet: bool) -> tuple[int, ...]:
        """The rolls of one voice that were struck before tick `start` and are still held there."""
        held = (self.written < start) & (self.until > start) & (self._is_foot == feet)
        return tuple(np.flatnonzero(held).tolist())

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
        self._last: int | None = None
        """Where the voice in work has its last note."""

    def shapes(self) -> NDArray[np.void]:
        self._bar_line()
        rows = self._e.rows(self._start, self._end)
        hands, feet = self._e.chords(rows, feet=False), self._e.chords(rows, feet=True)
        if not hands and not feet and not self._e.held_into(self._start, feet=False):
            self._silent_bar()
        else:
            self._voice(hands, _HANDS, beside=bool(feet))
            if feet:
                self._voice(feet, _FEET, beside=True)
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

    def _silent_bar(self) -> None:
        if self._start < self._e.score.end_tick:
            self._anchor.at((self._start + self._end) // 2)
            draw_rest(self._draw_list, Value(1), True, None)

    # --- a voice ------------------------------------------------------------------------------------------------------

    def _voice(self, chords: Sequence[Chord], voice: StaffVoice, beside: bool) -> None:
        mains = [c for c in chords if c.mains]
        self._last = None
        groups = beat_groups(self._tempo.meter_at(self._start), self._end - self._start)
        for group in long_groups(groups, self._holds(mains, voice)):
            inside = [c for c in mains if group[0] <= c.written - self._start < group[1]]
            held = self._held_at(self._start + group[0], voice)
            inside = [*held, *inside]
            until = max((int(self._e.until[i]) - self._start for c in held for i in c.mains), default=None)
            spelling = spelled([c.written - self._start for c in inside], group, until)
            if inside or voice is _HANDS:
                self._rests(spelling, voice, beside)
            self._group(spelling, self._with_tied(inside, spelling), voice)
        if tied := self._e.held_into(self._end, voice is _FEET):
            over = 0.0 if self._with_line else _OVER_LINE
            self._tie(tied, (self._last, self._end), (STEM_X, over - STEM_X), voice)
        for chord in chords:
            self._pen.draw_graces(chord)

    def _tie(
        self, rows: Sequence[int], ticks: tuple[int | None, int], ends_x: tuple[float, float], voice: StaffVoice
    ) -> None:
        """Ties of these strokes' heads; where a bar has nothing before them, the bar before drew what leads here."""
        first, last = ticks
        if first is None:
            first, ends_x = last, (-_INCOMING, ends_x[1])
            if not self._opens_line:
                return
        for i in rows:
            draw_tie(self._anchor, (first, last), ends_x, height(self._pen.step(i)), tie_way(voice))

    def _holds(self, mains: Sequence[Chord], voice: StaffVoice) -> list[tuple[int, int]]:
        """From where and up to where in the bar rolls are held, in ticks from its start."""
        rows = [*self._e.held_into(self._start, voice is _FEET), *(i for c in mains for i in c.mains)]
        last = self._end - self._start
        spans = [(int(self._e.written[i]) - self._start, int(self._e.until[i]) - self._start) for i in rows]
        return [(max(begin, 0), min(end, last)) for begin, end in spans if end > begin]

    def _held_at(self, tick: int, voice: StaffVoice) -> list[Chord]:
        """What is held at `tick` and was struck before, as one chord."""
        rows = self._e.held_into(tick, voice is _FEET)
        return [Chord(tick, tick, rows, (), is_tied=True)] if rows else []

    def _with_tied(self, chords: Sequence[Chord], group: BeatGroup) -> list[Chord]:
        """A chord for each of the group's notes: those that go on with the one before it are tied to it."""
        coming, found = iter(chords), list[Chord]()
        for stroke in group.strokes:
            tick = self._start + stroke.tick
            found.append(replace(found[-1], tick=tick, graces=(), is_tied=True) if stroke.is_tied else next(coming))
        return found

    def _rests(self, group: BeatGroup, voice: StaffVoice, beside: bool) -> None:
        for rest in group.rests:
            self._anchor.at(self._start + rest.tick)
            draw_rest(
                self._draw_list,
                rest.value,
                voice.is_up,
                self._pen.heads_at(self._start + rest.tick, voice) if beside else None,
            )

    def _group(self, group: BeatGroup, chords: Sequence[Chord], voice: StaffVoice) -> None:
        if not chords:
            return
        flagged = [(c, s) for c, s in zip(chords, group.strokes, strict=True) if s.value.beams]
        beam_y = self._beam_y(chords, voice, len(flagged) == 1)
        for chord, stroke in zip(chords, group.strokes, strict=True):
            if chord.is_tied:
                self._tie(chord.mains, (self._last, chord.tick), (STEM_X, -STEM_X), voice)
            self._anchor.at(chord.tick)
            self._pen.draw(chord, stroke, voice, beam_y)
            if self._pen.is_buzz(chord):
                self._pen.draw_buzz(chord, stroke.value, voice, (beam_y, len(flagged) == 1))
            self._last = chord.tick
        if len(flagged) == 1:
            draw_flags(self._anchor, flagged[0][0].tick, flagged[0][1].value.beams, voice, beam_y)
        elif flagged:
            draw_beams(self._anchor, [(c.tick, s.value.beams) for c, s in flagged], voice, beam_y)
        if group.tuplet:
            self._tuplet(group, chords, voice, beam_y, len(flagged) == len(chords) > 1 and not group.rests)

    def _beam_y(self, chords: Sequence[Chord], voice: StaffVoice, has_flag: bool) -> float:
        """Where the stems of a group end: level, clear of every head."""
        return stem_end([height(self._pen.step(i)) for c in chords for i in c.mains], voice.is_up, has_flag)

    # --- tuplets ------------------------------------------------------------------------------------------------------

    def _tuplet(
        self, group: BeatGroup, chords: Sequence[Chord], voice: StaffVoice, beam_y: float, beamed: bool
    ) -> None:
        reaches = [self._pen.reach(c, s.value, voice, beam_y) for c, s in zip(chords, group.strokes, strict=True)]
        y = (min(reaches) if voice.is_up else max(reaches)) + voice.way * _TUPLET_OFF[voice.way]
        start = self._start + group.start if not beamed else chords[0].tick
        end = max(chords[-1].tick, self._start + group.start + (group.end - group.start) * 2 // 3)
        draw_tuplet(self._anchor, group.tuplet, (start, end), voice, y, with_bracket=not beamed)
