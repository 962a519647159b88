"""The bars of one MusicXML part: notes at their places, and the bar lines between them."""

import re
from fractions import Fraction
from xml.etree.ElementTree import Element

from station.core.errors import BadInput
from station.core.pieces import HAND_PIECES, Limb
from station.core.units import PPQ
from station.music.formats.music_xml.reading.direction_reading import DirectionReader
from station.music.formats.music_xml.reading.note_reading import NoteReader, accent_whole_chord
from station.music.formats.music_xml.reading.time_reading import meter_of
from station.music.formats.music_xml.written_bars import NUMBER, LostMarks, WrittenBar, WrittenNote
from station.music.formats.playing_order import MOST_BARS
from station.music.formats.safe_xml import text_of
from station.music.stroke_velocities import shaded

MOST_NOTES = 20_000
"""Of a part; two seconds of reading (our choice: a thousand bars of twenty notes)."""
_LONGEST_BAR = 256 * PPQ
_FINEST = 10**6
"""Divisions of a quarter, and the denominator from which on places round: far below what can be heard (our choice)."""
_MOST_TIMES = 1000
_MOST_GRACES = 2
"""A drag has two; of a ruff of more the last two are read."""


class BarReader:
    """Reads the bars of one part in order; `is_drums` False reads all but its notes."""

    def __init__(self, source: str, notes: NoteReader | None, lost: LostMarks) -> None:
        self._source, self._notes, self._lost = source, notes, lost
        self._divisions = Fraction(1)
        self._directions = DirectionReader(lost, notes is not None)
        self._graces: dict[str, list[WrittenNote]] = {}
        self._note_count = 0
        self._copied = 0
        self._endings: frozenset[int] = frozenset()
        self.bars: list[WrittenBar] = []

    def read(self, measure: Element) -> None:
        """Read one more bar; raises `BadInput` that names it."""
        if len(self.bars) >= MOST_BARS:
            raise BadInput(self._source, f"bar {len(self.bars) + 1}", f"more than {MOST_BARS:,} bars")
        name = (measure.get("number") or str(len(self.bars) + 1))[:12]
        bar = WrittenBar(name)
        bar.signs.endings = self._endings
        _BarContent(self, bar).read(measure)
        if self._copied and not bar.notes and len(self.bars) >= self._copied:
            bar.notes = self.bars[-self._copied].notes
        self.bars.append(bar)

    @property
    def last_graces(self) -> int:
        """How many grace notes wait for a note still."""
        return sum(map(len, self._graces.values()))


class _BarContent:
    """Reads into one bar, with a place that moves as the file goes on."""

    def __init__(self, reader: BarReader, bar: WrittenBar) -> None:
        self._reader, self._bar = reader, bar
        self._place = self._chord_start = self._end = Fraction(0)
        self._chords: list[tuple[list[WrittenNote], list[WrittenNote]]] = []

    def read(self, measure: Element) -> None:
        for element in measure:
            if (handler := _HANDLERS.get(element.tag)) is not None:
                handler(self, element)
        self._bar.length = self._end
        for notes, graces in self._chords:
            accent_whole_chord(notes)
            self._attach(notes, graces)
        free = {
            note.start: note
            for note in reversed(self._bar.notes)
            if note.strike.piece in HAND_PIECES and note.limb is Limb.UNKNOWN
        }
        for place, limb in self._bar.letters:
            if place in free:
                free[place].limb = limb

    def _fault(self, fault: str) -> BadInput:
        return BadInput(self._reader._source, f"bar {self._bar.name}", fault)

    # --- notes and time -----------------------------------------------------------------------------------------------

    def _note(self, note: Element) -> None:
        is_grace, is_chord = note.find("grace") is not None, note.find("chord") is not None
        length = Fraction(0) if is_grace else self._length(note)
        start = self._chord_start if is_chord and not is_grace else self._place
        if not is_grace and not is_chord:
            self._chord_start = self._place
            self._move(length)
        if note.find("rest") is not None or self._reader._notes is None:
            return
        if note.find("cue") is not None:
            self._reader._lost.add("cue notes", self._bar.name)
            return
        if self._reader._notes.is_slash(note):
            self._reader._lost.add("slashes, where drummers play as they like", self._bar.name)
            return
        self._reader._note_count += 1
        if self._reader._note_count > MOST_NOTES:
            raise self._fault(f"more than {MOST_NOTES:,} notes")
        found = self._reader._notes.read(note, start, length, self._bar.name)
        found.usual_velocity = shaded(self._reader._directions.base_velocity, found.dynamic)
        waiting = self._reader._graces
        if is_grace:
            waiting.setdefault(found.voice, []).append(found)
            return
        self._bar.notes.append(found)
        if is_chord and self._chords:
            self._chords[-1][0].append(found)
        else:
            self._chords.append(([found], waiting.pop(found.voice, [])))

    def _attach(self, notes: list[WrittenNote], graces: list[WrittenNote]) -> None:
        """Each grace stroke to the note of its own piece, else to the first that a hand plays."""
        by_hand = [note for note in notes if note.strike.piece in HAND_PIECES] or notes
        if len(graces) > _MOST_GRACES:
            self._reader._lost.add("grace notes beyond two", self._bar.name)
        for grace in graces[-_MOST_GRACES:]:
            same = [note for note in notes if note.strike.piece is grace.strike.piece]
            (same or by_hand)[0].graces.append(grace)

    def _length(self, element: Element) -> Fraction:
        length = self._ticks(element.findtext("duration") or "0")
        if length < 0:
            raise self._fault("a duration below 0")
        return length

    def _ticks(self, text: str) -> Fraction:
        found = NUMBER.fullmatch(text)
        if found is None:
            raise self._fault(f"{text.strip()[:20]!r} is no duration")
        return _tidy(Fraction(found[1]) * PPQ / self._reader._divisions)

    def _move(self, ticks: Fraction) -> None:
        self._place = _tidy(max(self._place + ticks, Fraction(0)))
        self._end = max(self._end, self._place)
        if self._end > _LONGEST_BAR:
            raise self._fault(f"longer than {_LONGEST_BAR // PPQ} quarter notes")

    def _backup(self, element: Element) -> None:
        self._move(-self._length(element))

    def _forward(self, element: Element) -> None:
        self._move(self._length(element))

    # --- attributes ---------------------------------------------------------------------------------------------------

    def _attributes(self, element: Element) -> None:
        if divisions := text_of(element, "divisions"):
            found = NUMBER.fullmatch(divisions)
            if found is None or not 0 < Fraction(found[1]) <= _FINEST:
                raise self._fault(f"{divisions[:20]!r} is no number of divisions; expected 1 to {_FINEST:,}")
            self._reader._divisions = Fraction(found[1])
        time = element.find("time")
        if time is not None and time.find("senza-misura") is not None:
            self._reader._lost.add("music without a meter, each bar as long as what stands in it", self._bar.name)
        elif time is not None:
            self._bar.meter = meter_of(time, self._reader._source, f"bar {self._bar.name}")
        for style in element.iter("measure-repeat"):
            text = (style.text or "1").strip()
            is_start = style.get("type") == "start" and re.fullmatch(r"[1-8]", text)
            self._reader._copied = int(text) if is_start else 0
        for style in element.iter("slash"):
            if style.get("type") == "start":
                self._reader._lost.add("bars of slashes", self._bar.name)

    # --- bar lines ----------------------------------------------------------------------------------------------------

    def _barline(self, element: Element) -> None:
        signs, repeat, ending = self._bar.signs, element.find("repeat"), element.find("ending")
        if repeat is not None and repeat.get("direction") == "forward":
            signs.repeat_from = True
        elif repeat is not None:
            times = repeat.get("times", "2")
            signs.repeat_times = min(int(times), _MOST_TIMES) if re.fullmatch(r"\d{1,4}", times) else 2
        if ending is not None and ending.get("type") == "start":
            numbers = [int(n) for n in re.findall(r"\d{1,3}", ending.get("number", "1"))]
            signs.endings = self._reader._endings = frozenset(n for n in numbers if n) or frozenset({1})
        elif ending is not None:
            self._reader._endings = frozenset()
        is_right = element.get("location", "right") == "right"
        self._bar.ends_section |= is_right and text_of(element, "bar-style") == "light-light"

    # --- directions ---------------------------------------------------------------------------------------------------

    def _direction(self, element: Element) -> None:
        self._reader._directions.read(element, self._offset_place(element), self._bar)

    def _sound(self, element: Element) -> None:
        self._reader._directions.read_sound(element, self._offset_place(element), self._bar)

    def _offset_place(self, element: Element) -> Fraction:
        offset = text_of(element, "offset")
        return max(self._place + self._ticks(offset), Fraction(0)) if offset else self._place


_HANDLERS = {
    "note": _BarContent._note,
    "backup": _BarContent._backup,
    "forward": _BarContent._forward,
    "attributes": _BarContent._attributes,
    "barline": _BarContent._barline,
    "direction": _BarContent._direction,
    "sound": _BarContent._sound,
}


def _tidy(place: Fraction) -> Fraction:
    """`place`, rounded where divisions that change again and again have made a fraction of it that nobody can hear."""
    return place if place.denominator <= _FINEST else place.limit_denominator(_FINEST)
