"""One `<note>` of a percussion part: which strike it is, how loud, by which hand, and with which signs."""

import re
from collections.abc import Sequence
from fractions import Fraction
from xml.etree.ElementTree import Element

from station.core.note_map import NoteMeaning
from station.core.pieces import (
    CHOKEABLE,
    CLOSED,
    HALF_OPEN,
    HAND_PIECES,
    OPEN,
    Articulation,
    Dynamic,
    Limb,
    Piece,
    Zone,
)
from station.core.units import PPQ
from station.music.formats.music_xml.reading.part_choice import FilePart
from station.music.formats.music_xml.written_bars import LostMarks, WrittenNote
from station.music.formats.music_xml.xml_instruments import XmlInstrument, instrument_id, pitch_number, placed_strike
from station.music.formats.safe_xml import text_of
from station.music.grace_strokes import MAX_VELOCITY, MIN_VELOCITY

FULL_VELOCITY = 90
"""The MIDI velocity that `dynamics` are a percentage of (MusicXML 4.0, `note` and `sound`)."""
_FLAGS = {name: flags for flags, name in enumerate(("quarter", "eighth", "16th", "32nd", "64th", "128th", "256th"))}
_OPENNESS = {"open": OPEN, "open-string": OPEN, "harmonic": OPEN, "stopped": CLOSED, "half-muted": HALF_OPEN}
"""Over a hi-hat every small circle says that it is open; MuseScore has them as `open-string` and `harmonic`."""
_PICTURED = {
    "pictOpen": OPEN,
    **dict.fromkeys(("pictHalfOpen1", "pictHalfOpen2", "pictHalfOpen3"), HALF_OPEN),
    "guitarOpenPedal": OPEN,
    "guitarHalfOpenPedal": HALF_OPEN,
    "guitarClosePedal": CLOSED,
}
"""Signs of SMuFL for which MusicXML has no element."""
_CHOKE = re.compile("choke", re.IGNORECASE)
_READ_ARTICULATIONS = {"accent": Dynamic.ACCENT, "strong-accent": Dynamic.ACCENT}
_READ_TECHNICAL = {"fingering", *_OPENNESS}
_HANDS = {"R": Limb.RIGHT_HAND, "L": Limb.LEFT_HAND}
_FEET = {"R": Limb.RIGHT_FOOT, "L": Limb.LEFT_FOOT}
_MOST_SLASHES = 8


class NoteReader:
    """Reads the notes of one part; what it does not read `lost` counts."""

    def __init__(self, part: FilePart, lost: LostMarks) -> None:
        self._instruments, self._lost = part.instruments, lost
        self._numbered = not part.pitches_are_places
        self._strikes: dict[tuple[str, ...], tuple[NoteMeaning, int]] = {}

    def read(self, note: Element, start: Fraction, length: Fraction, bar: str) -> WrittenNote:
        """The written note, without its grace strokes."""
        strike, midi_note = self._strike(note, bar)
        head = note.find("notehead")
        is_ghost = head is not None and head.get("parentheses") == "yes"
        found = WrittenNote(start, length, strike, text_of(note, "voice"), midi_note)
        found.dynamic = Dynamic.GHOST if is_ghost else Dynamic.NORMAL
        found.is_tied = any(tie.get("type") == "stop" for tie in (*note.iter("tie"), *note.iter("tied")))
        found.in_tuplet = note.find("time-modification") is not None
        found.velocity = velocity_of(note.get("dynamics"))
        self._read_notations(note, found, bar)
        found.limb = _limb(note, found.strike.piece)
        return found

    def is_slash(self, note: Element) -> bool:
        """Whether it only says that the drummer plays as they like: a slash of no instrument that is known."""
        return text_of(note, "notehead") == "slash" and not self._is_known(note)

    # --- which strike -------------------------------------------------------------------------------------------------

    def _strike(self, note: Element, bar: str) -> tuple[NoteMeaning, int]:
        name = instrument_id(note)
        head = text_of(note, "notehead", "normal")
        step, octave = _line(note)
        key = (name, head, step, octave)
        if key not in self._strikes:
            self._strikes[key] = self._looked_up(note, *key, bar)
        return self._strikes[key]

    def _looked_up(
        self, note: Element, name: str, head: str, step: str, octave: str, bar: str
    ) -> tuple[NoteMeaning, int]:
        instrument = self._instrument(note, name)
        strike = instrument.meaning() if instrument is not None else None
        strike = strike or placed_strike(step, octave, head)
        if strike is None:
            self._lost.add("notes of no known instrument, now percussion", bar)
            strike = NoteMeaning(Piece.PERCUSSION)
        if strike.piece is Piece.RIDE and head == "diamond":
            strike = NoteMeaning(Piece.RIDE, Zone.BELL)
        return strike, (instrument.midi if instrument is not None else None) or 0

    def _is_known(self, note: Element) -> bool:
        instrument = self._instrument(note, instrument_id(note))
        return instrument is not None and instrument.meaning() is not None

    def _instrument(self, note: Element, name: str) -> XmlInstrument | None:
        instrument = self._instruments.get(name)
        if instrument is None and len(self._instruments) == 1:
            instrument = next(iter(self._instruments.values()))
        has_number = instrument is not None and instrument.midi is not None
        if not has_number and self._numbered and (number := pitch_number(note)) is not None:
            return XmlInstrument(midi=number)
        return instrument

    # --- its signs ----------------------------------------------------------------------------------------------------

    def _read_notations(self, note: Element, found: WrittenNote, bar: str) -> None:
        for notations in note.iter("notations"):
            for group in notations:
                for sign in group:
                    self._read_sign(group.tag, sign, note, found, bar)

    def _read_sign(self, group: str, sign: Element, note: Element, found: WrittenNote, bar: str) -> None:
        if group == "articulations" and sign.tag in _READ_ARTICULATIONS:
            found.dynamic = _READ_ARTICULATIONS[sign.tag]
        elif _CHOKE.search(sign.get("smufl", "")) or _CHOKE.search(sign.text or ""):
            found.is_choked = found.strike.piece in CHOKEABLE
        elif (openness := _openness_of(group, sign)) is not None and _is_opened(found, openness):
            pass
        elif group == "ornaments" and sign.tag == "tremolo" and sign.get("type", "single") in ("single", "unmeasured"):
            _tremble(sign, note, found)
        elif group in ("articulations", "ornaments", "technical") and sign.tag not in _READ_TECHNICAL:
            self._lost.add(f"{sign.tag} signs", bar)


def accent_whole_chord(chord: Sequence[WrittenNote]) -> None:
    """An accent on a chord's first note is the whole chord's, as programs write it that give no note a velocity."""
    first = chord[0]
    if first.dynamic is Dynamic.ACCENT and all(note.velocity is None for note in chord):
        for note in chord:
            if note.dynamic is Dynamic.NORMAL:
                note.dynamic, note.usual_velocity = first.dynamic, first.usual_velocity


def velocity_of(dynamics: str | None) -> int | None:
    """The velocity 1–127 of a percentage of 90, None where it is no number."""
    found = re.fullmatch(r"\s*(\d{1,6}(?:\.\d{1,12})?)\s*", dynamics or "")
    if found is None:
        return None
    return min(max(round(float(found[1]) * FULL_VELOCITY / 100), MIN_VELOCITY), MAX_VELOCITY)


def _line(note: Element) -> tuple[str, str]:
    step = note.findtext("unpitched/display-step") or note.findtext("pitch/step") or ""
    octave = note.findtext("unpitched/display-octave") or note.findtext("pitch/octave") or ""
    return step.strip().upper()[:1], octave.strip()[:2]


def _openness_of(group: str, sign: Element) -> float | None:
    """How open a hi-hat is that has this sign; None where it says nothing of that."""
    pictured = _PICTURED.get(sign.get("smufl", ""))
    return _OPENNESS.get(sign.tag) if pictured is None and group == "technical" else pictured


def _is_opened(found: WrittenNote, openness: float) -> bool:
    """Whether the sign says something of this piece: how open a hi-hat is, or that the foot lets it splash."""
    strike = found.strike
    if strike.piece is Piece.HIHAT:
        found.strike = NoteMeaning(strike.piece, strike.zone, strike.articulation, openness)
    elif strike.piece is Piece.HIHAT_PEDAL and openness == OPEN:
        found.strike = NoteMeaning(strike.piece, strike.zone, Articulation.SPLASH, OPEN)
    else:
        return strike.piece is Piece.HIHAT_PEDAL
    return True


def _tremble(tremolo: Element, note: Element, found: WrittenNote) -> None:
    """A buzz where it is unmeasured, else strokes by its slashes and the flags of the note."""
    slashes = (tremolo.text or "").strip()
    if tremolo.get("type") == "unmeasured" or slashes in ("", "0"):
        found.is_buzz = True
        return
    count = int(slashes) if re.fullmatch(r"[1-8]", slashes) else _MOST_SLASHES
    flags = _FLAGS.get(text_of(note, "type"), 0)
    found.stroke_ticks = Fraction(PPQ, 2 ** (flags + count)) * tuplet_ratio(note)


def tuplet_ratio(note: Element) -> Fraction:
    """How long a note of a tuplet lasts, as a share of its value."""
    actual, normal = (text_of(note, f"time-modification/{name}-notes") for name in ("actual", "normal"))
    if not re.fullmatch(r"[1-9]\d{0,2}", actual) or not re.fullmatch(r"[1-9]\d{0,2}", normal):
        return Fraction(1)
    return Fraction(int(normal), int(actual))


def _limb(note: Element, piece: Piece) -> Limb:
    """The hand or foot by a fingering or a syllable R or L."""
    signs = [*note.iter("fingering"), *(lyric for syllable in note.iter("lyric") for lyric in syllable.iter("text"))]
    limbs = _HANDS if piece in HAND_PIECES else _FEET
    return next((limbs[word] for sign in signs if (word := (sign.text or "").strip().upper()) in limbs), Limb.UNKNOWN)
