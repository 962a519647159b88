"""Draws one voice of a bar: its rests, chords, flags and beams, tuplets, tremolo slashes, rolls and ties.

Units are staff spaces, y down, 0 on the staff's middle line; everything hangs on its time.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from station.music.tempo import MeterChange
from station.render.notation.beams import (
    FEET,
    STEM_X,
    Anchor,
    StaffVoice,
    draw_beams,
    draw_flags,
    draw_tuplet,
)
from station.render.notation.rests import draw_rest, rest_edge
from station.render.notation.spelling.bar_spelling import spell_bar
from station.render.notation.spelling.beaming import beam_runs, beam_spans
from station.render.notation.spelling.note_values import BeatGroup, Stroke, TimedValue, Tuplet
from station.render.notation.staff import height
from station.render.notation.staff_rows import flag_room, stem_end
from station.render.notation.voice.chord_pen import Chord, ChordPen
from station.render.notation.voice.held_rolls import draw_tie, tie_way
from station.render.notation.voice.tremolo import draw_slashes
from station.render.notation.voice.written_strokes import WrittenStrokes

_TUPLET_OFF = {-1: 0.4, 1: 1.4}
"""How far a tuplet's number has its baseline from what its chords reach to."""
_INCOMING, _OVER_LINE = 1.7, 0.9
"""A tie from the line before begins so far left of its head, one over a bar line on paper ends so far right of it."""


_LEAN, _LEANS_FROM = -1.0, 16
"""So far left of its time stands a sixteenth rest, or a shorter one, before a grace note where time rolls: strokes are
1.6 spaces apart there, of which the grace note takes 1.9 and half the rest 0.6 (our choice)."""


@dataclass(frozen=True, slots=True)
class BarSpan:
    """A bar from tick `start` to `end`; `with_line`: its line is drawn, `opens_line`: it is the first on its line."""

    start: int
    end: int
    meter: MeterChange
    with_line: bool = True
    opens_line: bool = False


class VoicePen:
    """Draws the voices of one bar at `anchor`."""

    def __init__(self, strokes: WrittenStrokes, bar: BarSpan, anchor: Anchor, pen: ChordPen) -> None:
        self._strokes, self._bar, self._anchor, self._pen = strokes, bar, anchor, pen
        self._last: int | None = None
        """Where the voice in work has its last note."""

    def draw(self, chords: Sequence[Chord], voice: StaffVoice, beside: bool) -> None:
        """One voice: `chords` struck in the bar, rising; `beside`: the other voice is written too."""
        self._last = None
        mains = [*self._held_at(self._bar.start, voice), *(c for c in chords if c.mains)]
        for group in spell_bar([self._stroke(c) for c in mains], self._bar.meter, self._bar.end - self._bar.start):
            for rest in group.rests:
                self._rest(rest, voice, beside, self._lean(rest, mains))
            self._group(group, [self._chord(mains, value) for value in group.strokes], voice)
        if tied := self._strokes.held_into(self._bar.end, voice is FEET):
            over = 0.0 if self._bar.with_line else _OVER_LINE
            self._tie(tied, (self._last, self._bar.end), (STEM_X, over - STEM_X), voice)
        for chord in chords:
            self._pen.draw_graces(chord)

    def is_silent(self, chords: Sequence[Chord], voice: StaffVoice) -> bool:
        """Whether the voice has nothing to write in the bar."""
        return not any(c.mains for c in chords) and not self._strokes.held_into(self._bar.start, voice is FEET)

    # --- strokes --------------------------------------------------------------------------------------------------

    def _held_at(self, tick: int, voice: StaffVoice) -> list[Chord]:
        """What is held at `tick` and was struck before, as one chord."""
        rows = self._strokes.held_into(tick, voice is FEET)
        return [Chord(tick, tick, rows, (), is_tied=True)] if rows else []

    def _stroke(self, chord: Chord) -> Stroke:
        start, written = self._bar.start, self._strokes
        until = max(int(written.until[i]) for i in chord.mains)
        return Stroke(
            chord.written - start,
            until - start if until > chord.written else None,
            self._pen.is_accented(chord),
            chord.is_tied,
            any(bool(written.is_measured[i]) for i in chord.mains),
        )

    def _chord(self, mains: Sequence[Chord], value: TimedValue) -> Chord:
        """What a value writes: a chord, or how it goes on, tied to the note before."""
        chord = mains[value.source]
        if not value.is_tied:
            return chord
        return replace(chord, tick=self._bar.start + value.tick, graces=(), is_tied=True)

    def _tie(
        self, rows: Sequence[int], ticks: tuple[int | None, int], ends_x: tuple[float, float], voice: StaffVoice
    ) -> None:
        """Ties of these strokes' heads; where a bar has nothing before them, the bar before drew what leads here."""
        first, last = ticks
        if first is None:
            first, ends_x = last, (-_INCOMING, ends_x[1])
            if not self._bar.opens_line:
                return
        for i in rows:
            draw_tie(self._anchor, (first, last), ends_x, height(self._pen.step(i)), tie_way(voice))

    # --- groups ---------------------------------------------------------------------------------------------------

    def _lean(self, rest: TimedValue, mains: Sequence[Chord]) -> float:
        """How far from its time a rest stands: left of it where a short one would touch the grace note after it."""
        tick = self._bar.start + rest.tick
        after = next((chord for chord in mains if chord.written > tick), None)
        is_near = after is not None and bool(after.graces) and after.written - tick <= rest.value.ticks
        return _LEAN if is_near and self._bar.with_line and rest.value.base >= _LEANS_FROM else 0.0

    def _rest(self, rest: TimedValue, voice: StaffVoice, beside: bool, x: float) -> None:
        tick = self._bar.start + rest.tick
        self._anchor.at(tick)
        others = self._pen.heads_at(tick, voice) if beside else None
        draw_rest(self._anchor.draw_list, rest.value, voice.is_up, others, x)

    def _group(self, group: BeatGroup, chords: Sequence[Chord], voice: StaffVoice) -> None:
        if not chords:
            return
        beam_y, ticks = self._beam_y(group, chords, voice), [chord.tick for chord in chords]
        alone = {first for first, last in beam_runs(group) if first == last}
        for k, (chord, value) in enumerate(zip(chords, group.strokes, strict=True)):
            if chord.is_tied:
                self._tie(chord.mains, (self._last, chord.tick), (STEM_X, -STEM_X), voice)
            self._anchor.at(chord.tick)
            self._pen.draw(chord, value, voice, beam_y)
            if self._pen.is_buzz(chord):
                self._pen.draw_buzz(chord, value.value, voice, (beam_y, k in alone))
            if value.slashes:
                heads = [height(self._pen.step(i)) for i in chord.mains]
                draw_slashes(self._anchor, value, voice, (heads, beam_y), has_flags=k in alone)
            if k in alone:
                draw_flags(self._anchor, chord.tick, value.value.beams, voice, beam_y)
            self._last = chord.tick
        draw_beams(self._anchor, list(beam_spans(group)), ticks, voice, beam_y)
        for tuplet in group.tuplets:
            self._tuplet(group, tuplet, chords, voice)

    def _beam_y(self, group: BeatGroup, chords: Sequence[Chord], voice: StaffVoice) -> float:
        """Where the stems of a group end: level, clear of every head and of the rests between them."""
        heights = [height(self._pen.step(i)) for c in chords for i in c.mains]
        beams = max(value.value.beams for value in group.strokes)
        first, last = group.strokes[0].tick, group.strokes[-1].tick
        rests = [self._rest_edge(rest, voice) for rest in group.rests if first < rest.tick < last]
        flagged = [a for a, b in beam_runs(group) if a == b]
        rooms = (self._flag_room(group.strokes[k], chords[k]) for k in flagged)
        has_buzz = any(self._pen.is_buzz(chord) for chord in chords)
        return stem_end(heights, voice.is_up, beams, max(rooms, default=None), rests, has_buzz)

    def _flag_room(self, value: TimedValue, chord: Chord) -> float:
        return flag_room(value.value.dots, self._pen.is_buzz(chord), value.slashes)

    def _rest_edge(self, rest: TimedValue, voice: StaffVoice) -> float:
        others = self._pen.heads_at(self._bar.start + rest.tick, voice)
        return rest_edge(rest.value.base, voice.is_up, others)

    # --- tuplets --------------------------------------------------------------------------------------------------

    def _tuplet(self, group: BeatGroup, tuplet: Tuplet, chords: Sequence[Chord], voice: StaffVoice) -> None:
        """The number in the middle of its values, under a bracket unless one beam joins them and nothing else."""
        inside = [k for k, value in enumerate(group.strokes) if tuplet.start <= value.tick < tuplet.end]
        rests = [rest.tick for rest in group.rests if tuplet.start <= rest.tick < tuplet.end]
        played = [chords[k].tick - self._bar.start for k in inside]
        start, end = min(played + rests), max(played + rests)
        is_beamed = bool(inside) and (inside[0], inside[-1]) in beam_runs(group) and len(inside) > 1
        is_alone = is_beamed and (start, end) == (played[0], played[-1])
        beam_y = self._beam_y(group, chords, voice)
        reaches = [self._pen.reach(chords[k], group.strokes[k].value, voice, beam_y) for k in inside] or [beam_y]
        y = (min(reaches) if voice.is_up else max(reaches)) + voice.way * _TUPLET_OFF[voice.way]
        ends = (self._bar.start + start, self._bar.start + end)
        draw_tuplet(self._anchor, tuplet.number, ends, voice, y, with_bracket=not is_alone)
