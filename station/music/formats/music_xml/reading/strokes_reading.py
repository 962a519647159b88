"""From written notes to the strokes that a score holds: ties, rolls, grace strokes, chokes and swing."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from station.core.pieces import USUAL_FEET, Articulation, Dynamic, Limb, Ornament, Piece
from station.music.formats.music_xml.second_strokes import SecondStrokes
from station.music.formats.music_xml.written_bars import WrittenNote
from station.music.grace_strokes import MAX_VELOCITY, MIN_VELOCITY, OTHER_HAND, Graces
from station.music.score import Note
from station.music.swing import STRAIGHT, Swing
from station.music.tempo import MeterChange

_MOST_STROKES = 256
"""Of one measured tremolo (our choice: a long fermata of a roll)."""
_GRACES = Graces()
"""Which foot plays a pedal where the file says nothing."""


@dataclass(frozen=True, slots=True)
class PlayedBar:
    """A bar where it is played: its meter, its tick, and the swings that begin in it (tick in the bar, swing)."""

    meter: MeterChange
    start: int
    swings: tuple[tuple[int, Swing], ...]

    def place(self, tick: int, is_swung: bool) -> tuple[int, int]:
        """Where what is written `tick` ticks into the bar is played, and how much later than written."""
        swing = next((swing for at, swing in reversed(self.swings) if at <= tick), Swing())
        if not is_swung or swing.ratio == STRAIGHT or tick > self.meter.bar_ticks:
            return self.start + tick, 0
        played = swing.swung(tick, self.meter)
        return self.start + played, played - tick if swing.stands_in_words else 0


@dataclass(slots=True)
class _Stroke:
    """A note on its way: where it begins, where it ends so far (bar and tick in it)."""

    note: WrittenNote
    bar: PlayedBar
    end_bar: PlayedBar
    end: Fraction

    def place(self, after: Fraction = Fraction(0)) -> tuple[int, int]:
        return self.bar.place(round(self.note.start + after), not self.note.in_tuplet)

    @property
    def lasts(self) -> Fraction:
        return self.end_bar.start + self.end - (self.bar.start + self.note.start)

    @property
    def until(self) -> int:
        """The tick where its written value ends, played."""
        return self.end_bar.place(round(self.end), not self.note.in_tuplet)[0]


def strokes_of(bars: Iterable[tuple[PlayedBar, Sequence[WrittenNote]]]) -> list[Note]:
    """The strokes of the bars in their order, each with its notes."""
    strokes = _joined(bars)
    plain = [(s.note.strike.piece, s.note.dynamic, _velocity(s.note)) for s in strokes if not _count(s)]
    seconds = SecondStrokes(plain)
    rolls = _touching(strokes)
    return [note for i, stroke in enumerate(strokes) for note in _notes(stroke, i in rolls, seconds)]


def _joined(bars: Iterable[tuple[PlayedBar, Sequence[WrittenNote]]]) -> list[_Stroke]:
    """All notes; a tied one makes the one before it longer, and the same strike written twice is one."""
    found: list[_Stroke] = []
    last: dict[tuple[Piece, Limb], _Stroke] = {}
    for bar, notes in bars:
        seen: dict[tuple[object, ...], str] = {}
        for note in sorted(notes, key=lambda n: n.start):
            key = (note.strike.piece, Limb.UNKNOWN)
            before = last.get(key)
            if note.is_tied and before is not None and _meets(before, bar, note):
                before.end_bar, before.end = bar, note.start + note.length
                continue
            strike = (note.start, note.strike, note.limb)
            if seen.setdefault(strike, note.voice) != note.voice:
                continue
            last[key] = _Stroke(note, bar, bar, note.start + note.length)
            found.append(last[key])
    return found


def _meets(before: _Stroke, bar: PlayedBar, note: WrittenNote) -> bool:
    return abs(before.end_bar.start + before.end - (bar.start + note.start)) <= 1


def _count(stroke: _Stroke) -> int:
    """How many strokes a measured tremolo has, 0 for a note that is none."""
    step = stroke.note.stroke_ticks
    count = min(round(stroke.lasts / step), _MOST_STROKES) if step else 0
    return count if count > 1 else 0


def _touching(strokes: Sequence[_Stroke]) -> set[int]:
    """Indices of the tremolos that touch another of the same piece, or have more than two strokes: they are rolls."""
    by_piece: dict[Piece, list[int]] = {}
    for i, stroke in enumerate(strokes):
        if _count(stroke):
            by_piece.setdefault(stroke.note.strike.piece, []).append(i)
    found = {i for places in by_piece.values() for i in places if _count(strokes[i]) > 2}
    for places in by_piece.values():
        for a, b in pairwise(places):
            if _meets(strokes[a], strokes[b].bar, strokes[b].note):
                found |= {a, b}
    return found


def _velocity(note: WrittenNote) -> int:
    return note.usual_velocity if note.velocity is None else note.velocity


def _notes(stroke: _Stroke, is_roll: bool, seconds: SecondStrokes) -> Iterator[Note]:
    note, strike = stroke.note, stroke.note.strike
    tick, swing_ticks = stroke.place()
    count, graces = _count(stroke), len(note.graces)
    main = Note(
        tick=tick,
        piece=strike.piece,
        zone=strike.zone,
        velocity=_velocity(note),
        articulation=Articulation.BUZZ if note.is_buzz else strike.articulation,
        dynamic=note.dynamic,
        limb=USUAL_FEET.get(strike.piece, Limb.UNKNOWN) if note.limb is Limb.UNKNOWN else note.limb,
        openness=strike.openness,
        ornament=(Ornament.NONE, Ornament.FLAM, Ornament.DRAG)[min(graces, 2)],
        duration_ticks=stroke.until - tick if note.is_buzz else 0,
        choke_ticks=stroke.until - tick if note.is_choked else 0,
        midi_note=note.midi_note,
        swing_ticks=swing_ticks,
    )
    if note.is_buzz and not graces:
        main = replace(main, ornament=Ornament.ROLL)
    yield from _grace_notes(note, main)
    if not count:
        yield main
        return
    ornament = Ornament.ROLL if is_roll else Ornament.DIDDLE
    yield main if graces else replace(main, ornament=ornament)
    velocity = seconds.velocity(strike.piece, note.dynamic, main.velocity)
    for k in range(1, count):
        tick, swing_ticks = stroke.place(k * note.stroke_ticks)
        limb = main.limb if k // 2 % 2 == 0 else OTHER_HAND.get(main.limb, main.limb)
        again = replace(main, tick=tick, swing_ticks=swing_ticks, velocity=velocity, limb=limb)
        yield replace(again, dynamic=min(note.dynamic, Dynamic.NORMAL), ornament=ornament)


def _grace_notes(note: WrittenNote, main: Note) -> Iterator[Note]:
    leads = _GRACES.leads_ms(main.ornament)
    for grace, lead in zip(note.graces, leads, strict=True):
        velocity = _GRACES.velocity(main.velocity) if grace.velocity is None else grace.velocity
        limb = OTHER_HAND.get(main.limb, Limb.UNKNOWN) if grace.limb is Limb.UNKNOWN else grace.limb
        yield Note(
            tick=main.tick,
            piece=grace.strike.piece,
            zone=grace.strike.zone,
            velocity=min(max(velocity, MIN_VELOCITY), MAX_VELOCITY),
            articulation=grace.strike.articulation,
            dynamic=Dynamic.GHOST,
            limb=limb,
            openness=grace.strike.openness,
            ornament=main.ornament,
            lead_ms=lead,
            swing_ticks=main.swing_ticks,
        )
