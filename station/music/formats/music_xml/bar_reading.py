"""The bars of one MusicXML part: notes at their places, and all that stands between them."""

import re
from collections.abc import Mapping
from fractions import Fraction
from math import lcm
from xml.etree.ElementTree import Element

from station.core.errors import BadInput
from station.core.pieces import HAND_PIECES, Limb
from station.core.units import PPQ
from station.music.formats.music_xml.note_reading import (
    SHARE_OF_NORMAL,
    NoteReader,
    accent_whole_chord,
    velocity_of,
)
from station.music.formats.music_xml.words_of_swing import swing_in_words
from station.music.formats.music_xml.written_bars import STOP, LostMarks, WrittenBar, WrittenNote
from station.music.formats.playing_order import MOST_BARS
from station.music.formats.safe_xml import text_of
from station.music.loudness_marks import FADE, GROW
from station.music.swing import MAX_RATIO, MIN_RATIO, STRAIGHT, Swing
from station.music.tempo import MeterChange

VELOCITY_OF_MARK: Mapping[str, int] = {
    "ppp": 16, "pp": 33, "p": 49, "mp": 64, "mf": 80, "f": 96, "ff": 112, "fff": 126
}  # fmt: skip
"""What MuseScore and others play a mark with; ours are the words of this table."""
_LOUDER_WORDS = {"pppp": "ppp", "ffff": "fff", "sf": "f", "sfz": "f", "fz": "f", "fp": "p", "sfp": "p", "rfz": "f"}
_WEDGES = {"crescendo": GROW, "diminuendo": FADE, "stop": STOP}
_BEAT_UNITS = {
    name: Fraction(4 * PPQ, 2**k) for k, name in enumerate(("whole", "half", "quarter", "eighth", "16th", "32nd"))
}
_SWING_UNITS = {"eighth": PPQ // 2, "16th": PPQ // 4}
MOST_NOTES = 20_000
"""Of a part; two seconds of reading (our choice: a thousand bars of twenty notes)."""
_LONGEST_BAR = 256 * PPQ
_FINEST = 10**6
"""Divisions of a quarter, and the denominator from which on places round: far below what can be heard (our choice)."""
MOST_BEATS, MOST_UNIT = 128, 128
_NUMBER = re.compile(r"\s*([+-]?\d{1,9}(?:\.\d{1,12})?)\s*")
_MOST_TIMES = 1000
_MOST_GRACES = 2
"""A drag has two; of a ruff of more the last two are read."""
_STICK = re.compile(r"\s*([RL])\s*")


class BarReader:
    """Reads the bars of one part in order; `is_drums` False reads all but its notes."""

    def __init__(self, source: str, notes: NoteReader | None, lost: LostMarks) -> None:
        self._source, self._notes, self._lost = source, notes, lost
        self._divisions = Fraction(1)
        self._base = VELOCITY_OF_MARK["mf"]
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
        bar = WrittenBar(name, is_implicit=measure.get("implicit") == "yes")
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
        self._sticks: list[tuple[Fraction, Limb]] = []

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
        for place, limb in self._sticks:
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
        found.usual_velocity = min(max(round(self._reader._base * SHARE_OF_NORMAL[found.dynamic]), 1), 127)
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
        found = _NUMBER.fullmatch(text)
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
            found = _NUMBER.fullmatch(divisions)
            if found is None or not 0 < Fraction(found[1]) <= _FINEST:
                raise self._fault(f"{divisions[:20]!r} is no number of divisions; expected 1 to {_FINEST:,}")
            self._reader._divisions = Fraction(found[1])
        time = element.find("time")
        if time is not None and time.find("senza-misura") is not None:
            self._reader._lost.add("music without a meter, each bar as long as what stands in it", self._bar.name)
        elif time is not None:
            self._bar.meter = self._meter(time)
        for style in element.iter("measure-repeat"):
            text = (style.text or "1").strip()
            is_start = style.get("type") == "start" and re.fullmatch(r"[1-8]", text)
            self._reader._copied = int(text) if is_start else 0
        for style in element.iter("slash"):
            if style.get("type") == "start":
                self._reader._lost.add("bars of slashes", self._bar.name)

    def _meter(self, time: Element) -> MeterChange:
        beats = [(element.text or "").replace(" ", "") for element in time.findall("beats")]
        units = [(element.text or "").strip() for element in time.findall("beat-type")]
        are_sound = all(re.fullmatch(r"\d{1,3}(\+\d{1,3}){0,31}", text) for text in beats)
        if not beats or len(beats) != len(units) or not are_sound or not all(u in _UNITS for u in units):
            raise self._fault(f"{'+'.join(beats)[:20]}/{'+'.join(units)[:20]} is no time signature")
        unit = lcm(*map(int, units))
        groups = [
            int(count) * (unit // int(of)) for text, of in zip(beats, units, strict=True) for count in text.split("+")
        ]
        if not all(groups) or sum(groups) > MOST_BEATS:
            raise self._fault(f"a bar of {sum(groups)} beats")
        return MeterChange(0, sum(groups), unit, tuple(groups) if len(groups) > 1 else ())

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
        place = self._offset_place(element)
        sound = element.find("sound")
        for kind in element.iter("direction-type"):
            for sign in kind:
                self._read_sign(sign, place, sound)
        if sound is not None:
            self._read_sound(sound, place)

    def _sound(self, element: Element) -> None:
        self._read_sound(element, self._offset_place(element))

    def _offset_place(self, element: Element) -> Fraction:
        offset = text_of(element, "offset")
        return max(self._place + self._ticks(offset), Fraction(0)) if offset else self._place

    def _read_sign(self, sign: Element, place: Fraction, sound: Element | None) -> None:
        bar = self._bar
        if sign.tag == "dynamics":
            self._read_dynamics(sign, place, sound)
        elif sign.tag == "wedge" and sign.get("type") in _WEDGES:
            bar.loudness.append((place, _WEDGES[sign.get("type", "")]))
        elif sign.tag == "metronome":
            self._read_metronome(sign, place, sound)
        elif sign.tag == "rehearsal":
            bar.section = " ".join((sign.text or "").split())[:100]
        elif sign.tag == "segno" and sound is None:
            bar.signs.segno = ""
        elif sign.tag == "coda" and sound is None:
            bar.signs.coda = ""
        elif sign.tag == "words" and (stick := _STICK.fullmatch(sign.text or "")):
            self._sticks.append((place, Limb.RIGHT_HAND if stick[1] == "R" else Limb.LEFT_HAND))
        elif sign.tag == "words":
            self._read_words(" ".join((sign.text or "").lower().split()), place, sound)
        elif sign.tag in ("octave-shift", "pedal", "damp", "damp-all", "percussion"):
            self._reader._lost.add(f"{sign.tag} signs", bar.name)

    def _read_words(self, words: str, place: Fraction, sound: Element | None) -> None:
        """What words say of swing and of the order where no `sound` does; all others are only words."""
        signs = self._bar.signs
        if (swing := swing_in_words(words)) is not None and (sound is None or sound.find("swing") is None):
            self._bar.swings.append((place, swing))
            return
        if sound is not None and set(sound.attrib) & _ORDER:
            return
        if re.match(r"d\. ?c\.|da capo", words):
            signs.da_capo = True
        elif re.match(r"d\. ?s\.|dal segno", words):
            signs.dal_segno = ""
        elif re.match(r"to coda", words):
            signs.to_coda = ""
        elif words == "fine":
            signs.fine = True
        elif words and sound is None and not _TEMPO_WORDS.match(words) and self._reader._notes is not None:
            self._reader._lost.add("words", self._bar.name)

    def _read_dynamics(self, sign: Element, place: Fraction, sound: Element | None) -> None:
        for each in sign:
            word = _LOUDER_WORDS.get(each.tag, each.tag)
            if word not in VELOCITY_OF_MARK:
                self._reader._lost.add("loudness marks of other words", self._bar.name)
                continue
            self._bar.loudness.append((place, word))
            self._reader._base = VELOCITY_OF_MARK[word]

    def _read_metronome(self, sign: Element, place: Fraction, sound: Element | None) -> None:
        unit = _BEAT_UNITS.get(text_of(sign, "beat-unit"))
        number = re.search(r"\d{1,4}(?:\.\d{1,6})?", sign.findtext("per-minute") or "")
        if unit is None or number is None or len(sign.findall("beat-unit")) > 1:
            self._reader._lost.add("metronome marks without a number", self._bar.name)
            return
        dots = len(sign.findall("beat-unit-dot"))
        beat = unit * (2 - Fraction(1, 2 ** min(dots, 2)))
        self._bar.beat_ticks = int(beat)
        if sound is None or sound.get("tempo") is None:
            self._add_tempo(float(number[0]) * float(beat / PPQ), place)

    def _add_tempo(self, tempo_bpm: float, place: Fraction) -> None:
        if not _SLOWEST_BPM <= tempo_bpm <= _FASTEST_BPM:
            self._reader._lost.add("tempos that are none", self._bar.name)
            return
        self._bar.tempos.append((place, round(60e6 / tempo_bpm)))

    def _read_sound(self, sound: Element, place: Fraction) -> None:
        signs = self._bar.signs
        if (tempo := _NUMBER.fullmatch(sound.get("tempo", ""))) is not None:
            self._add_tempo(float(tempo[1]), place)
        if (velocity := velocity_of(sound.get("dynamics"))) is not None:
            self._reader._base = velocity
        signs.da_capo |= sound.get("dacapo") == "yes"
        signs.fine |= sound.get("fine") not in (None, "no")
        signs.repeat_from |= sound.get("forward-repeat") == "yes"
        signs.segno = signs.segno if (label := sound.get("segno")) is None else label[:20]
        signs.coda = signs.coda if (label := sound.get("coda")) is None else label[:20]
        signs.dal_segno = signs.dal_segno if (label := sound.get("dalsegno")) is None else label[:20]
        signs.to_coda = signs.to_coda if (label := sound.get("tocoda")) is None else label[:20]
        swing = sound.find("swing")
        if swing is not None:
            self._read_swing(swing, place)

    def _read_swing(self, swing: Element, place: Fraction) -> None:
        if swing.find("straight") is not None:
            self._bar.swings.append((place, Swing()))
            return
        first, second = text_of(swing, "first"), text_of(swing, "second")
        unit = _SWING_UNITS.get(text_of(swing, "swing-type", "eighth"))
        are_numbers = re.fullmatch(r"[1-9]\d{0,5}", first) and re.fullmatch(r"[1-9]\d{0,5}", second)
        ratio = int(first) / int(second) if are_numbers else 0.0
        if unit is None or not MIN_RATIO <= ratio <= MAX_RATIO:
            self._reader._lost.add("swings that nobody plays", self._bar.name)
            return
        self._bar.swings.append((place, Swing(ratio, unit) if ratio != STRAIGHT else Swing()))


_SLOWEST_BPM, _FASTEST_BPM = 0.1, 10_000.0
"""What is outside is no tempo (our choice)."""
_TEMPO_WORDS = re.compile(r"rit|rall|accel|a tempo")
"""What these ask for the tempos of the file say."""
_ORDER = {"dacapo", "dalsegno", "tocoda", "fine", "segno", "coda"}
_UNITS = {str(2**k) for k in range(MOST_UNIT.bit_length())}
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
