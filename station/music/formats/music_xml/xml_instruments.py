"""Which strike a MusicXML instrument is, and how the station's strikes are written: name, MIDI number, staff place.

A part's instruments have ids; each has a name, and may have a standard sound and a number of General MIDI's drums
(`midi-unpitched`, which counts from 1). The number says the piece, the words of the name its zone; without a number
the name says the piece, then the sound, then where the note stands on the staff.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from types import MappingProxyType
from xml.etree.ElementTree import Element

from station.core.note_map import GENERAL_MIDI, NoteMeaning, general_midi_note
from station.core.pieces import CHOKEABLE, CLOSED, DRUMS, HALF_OPEN, OPEN, Articulation, Piece, Zone
from station.music.formats.safe_xml import text_of

_DRUMS = DRUMS | {Piece.KICK}


@dataclass(frozen=True, slots=True)
class WrittenPiece:
    """How a piece is written: its name, its standard sound, the step and octave of its line, and its note head."""

    name: str
    sound: str
    step: str
    octave: int
    head: str = "normal"


PIECES: Mapping[Piece, WrittenPiece] = MappingProxyType(
    {
        Piece.KICK: WrittenPiece("Bass drum", "drum.bass-drum", "F", 4),
        Piece.SNARE: WrittenPiece("Snare drum", "drum.snare-drum", "C", 5),
        Piece.HIHAT: WrittenPiece("Hi-hat", "metal.hi-hat", "G", 5, "x"),
        Piece.HIHAT_PEDAL: WrittenPiece("Hi-hat foot", "metal.hi-hat", "D", 4, "x"),
        Piece.RIDE: WrittenPiece("Ride", "metal.cymbal.ride", "F", 5, "x"),
        Piece.RIDE_2: WrittenPiece("Ride 2", "metal.cymbal.ride", "F", 5, "circle-x"),
        Piece.CRASH_1: WrittenPiece("Crash 1", "metal.cymbal.crash", "A", 5, "x"),
        Piece.CRASH_2: WrittenPiece("Crash 2", "metal.cymbal.crash", "B", 5, "x"),
        Piece.SPLASH: WrittenPiece("Splash", "metal.cymbal.splash", "C", 6, "x"),
        Piece.CHINA: WrittenPiece("China", "metal.cymbal.chinese", "B", 5, "circle-x"),
        Piece.TOM_1: WrittenPiece("Tom 1", "drum.tom-tom", "E", 5),
        Piece.TOM_2: WrittenPiece("Tom 2", "drum.tom-tom", "D", 5),
        Piece.TOM_3: WrittenPiece("Tom 3", "drum.tom-tom", "B", 4),
        Piece.TOM_4: WrittenPiece("Tom 4", "drum.tom-tom", "G", 4),
        Piece.FLOOR_TOM_1: WrittenPiece("Floor tom 1", "drum.tom-tom", "A", 4),
        Piece.FLOOR_TOM_2: WrittenPiece("Floor tom 2", "drum.tom-tom", "E", 4),
        Piece.COWBELL: WrittenPiece("Cowbell", "metal.bells.cowbell", "G", 5, "triangle"),
        Piece.TAMBOURINE: WrittenPiece("Tambourine", "drum.tambourine", "A", 5, "triangle"),
        Piece.CLAP: WrittenPiece("Hand clap", "effect.hand-clap", "C", 5, "triangle"),
        Piece.PERCUSSION: WrittenPiece("Percussion", "wood.claves", "C", 6, "triangle"),
    }
)
"""Lines and heads after Weinberg, Guidelines for Drumset Notation (1994); what it leaves open is our choice."""

_USUAL_ZONE: Mapping[Piece, Zone] = MappingProxyType(
    {
        **dict.fromkeys(Piece, Zone.HEAD),
        **dict.fromkeys((Piece.HIHAT, Piece.RIDE, Piece.RIDE_2), Zone.BOW),
        **dict.fromkeys((Piece.CRASH_1, Piece.CRASH_2, Piece.SPLASH, Piece.CHINA), Zone.EDGE),
        Piece.HIHAT_PEDAL: Zone.PEDAL,
    }
)
_ZONE_WORDS = ((Zone.RIM, r"rim"), (Zone.BELL, r"bell|cup"), (Zone.EDGE, r"edge"), (Zone.BOW, r"bow|tip"))
_ZONE_NAMES = {Zone.RIM: "rim", Zone.BELL: "bell", Zone.EDGE: "edge", Zone.BOW: "bow"}
_OPENNESS_NAMES = {CLOSED: "closed", HALF_OPEN: "half-open", OPEN: "open"}
_OF_DRUMS, _OF_CYMBALS = frozenset({Zone.RIM}), frozenset({Zone.BELL, Zone.EDGE, Zone.BOW})
_ARTICULATION_PIECES = {Articulation.CROSS_STICK: frozenset({Piece.SNARE}), Articulation.RIM_SHOT: _DRUMS}
_ARTICULATION_NAMES = {Articulation.CROSS_STICK: "cross-stick", Articulation.RIM_SHOT: "rim shot"}

_PIECE_WORDS: tuple[tuple[str, Piece], ...] = (
    (r"hi-? ?hat.*(foot|pedal)|(foot|pedal).*hi-? ?hat", Piece.HIHAT_PEDAL),
    (r"hi-? ?hat|hihat", Piece.HIHAT),
    (r"bass drum|kick|bombo|grosse caisse", Piece.KICK),
    (r"snare|(side|cross)[- ]?stick|rim ?shot", Piece.SNARE),
    (r"(low|2).*floor.*tom|floor.*tom.*(low|2)", Piece.FLOOR_TOM_2),
    (r"floor.*tom", Piece.FLOOR_TOM_1),
    (r"(hi(gh)?|alto)[- ]mid.*tom|tom.*\b2", Piece.TOM_2),
    (r"low[- ]mid.*tom|tom.*\b3", Piece.TOM_3),
    (r"\bmid(dle)?[- ]?tom|\bmedium[- ]?tom|tom.*\b(mid(dle)?|medium)\b", Piece.TOM_2),
    (r"low.*tom|tom.*\b4", Piece.TOM_4),
    (r"\btoms?\b|tom-tom", Piece.TOM_1),
    (r"ride.*2", Piece.RIDE_2),
    (r"ride", Piece.RIDE),
    (r"splash", Piece.SPLASH),
    (r"chin", Piece.CHINA),
    (r"crash.*2", Piece.CRASH_2),
    (r"crash|cymbal", Piece.CRASH_1),
    (r"cow ?-?bell", Piece.COWBELL),
    (r"tambourine", Piece.TAMBOURINE),
    (r"clap", Piece.CLAP),
    (
        r"triangle|timpani|bongo|conga|timbale|guiro|clave|block|agogo|cabasa|maraca|shaker|cuica|gong|tam-tam|chime"
        r"|castanet|whistle|vibraslap|surdo|glockenspiel|xylophone|marimba|bell",
        Piece.PERCUSSION,
    ),
)
"""What names call the pieces, the narrower words first."""

_ROUND_PLACES = {
    "D4": Piece.KICK,
    "E4": Piece.KICK,
    "F4": Piece.KICK,
    "G4": Piece.TOM_4,
    "A4": Piece.FLOOR_TOM_1,
    "B4": Piece.TOM_3,
    "C5": Piece.SNARE,
    "D5": Piece.TOM_2,
    "E5": Piece.TOM_1,
    "F5": Piece.TOM_1,
}
_CROSS_PLACES = {
    "D4": Piece.HIHAT_PEDAL,
    "E4": Piece.HIHAT_PEDAL,
    "F4": Piece.HIHAT_PEDAL,
    "F5": Piece.RIDE,
    "G5": Piece.HIHAT,
    "A5": Piece.CRASH_1,
    "B5": Piece.CRASH_2,
    "C6": Piece.SPLASH,
    "D6": Piece.CHINA,
}
"""Where drum parts that name no instrument put round and crossed heads: Weinberg's, and MuseScore's drum set."""
_CROSSES = frozenset({"x", "cross", "circle-x", "diamond"})
_CROSS_STICKS = _CROSSES | {"slashed", "back slashed"}
"""Heads on the snare's line; MuseScore 4 has slashed ones there."""

LOWEST_PLACE = 60
"""Number of the pitch on the line below the staff, C4: the feet of a drum part stand above it."""
_STEPS = {"C": 0, "D": 2, "E": 4, "F": 5, "G": 7, "A": 9, "B": 11}


@dataclass(frozen=True, slots=True)
class XmlInstrument:
    """What a file says of an instrument; `midi` counts from 0, None where nothing does."""

    name: str = ""
    sound: str = ""
    midi: int | None = None

    def meaning(self) -> NoteMeaning | None:
        """The strike that it is; None where neither number nor name nor sound says it."""
        words = self.name.lower()
        known = GENERAL_MIDI.get(self.midi) if self.midi is not None else None
        if known is None:
            piece = _piece_of_name(words) or _piece_of_sound(self.sound)
            if piece is None:
                return NoteMeaning(Piece.PERCUSSION) if self.midi is not None else None
            known = plain_strike(piece)
        return _refined(known, words)


def instrument_id(note: Element) -> str:
    """Of which instrument of its part a note is; "" where it does not say."""
    instrument = note.find("instrument")
    return "" if instrument is None else instrument.get("id", "")


def pitch_number(note: Element) -> int | None:
    """The MIDI number of a pitched note."""
    step, octave, alter = (text_of(note, f"pitch/{name}") for name in ("step", "octave", "alter"))
    if step not in _STEPS or not re.fullmatch(r"[0-9]", octave):
        return None
    return 12 * (int(octave) + 1) + _STEPS[step] + {"1": 1, "-1": -1}.get(alter, 0)


def plain_strike(piece: Piece) -> NoteMeaning:
    """`piece` struck as usual: a hi-hat closed, a crash on its edge."""
    if piece is Piece.HIHAT_PEDAL:
        return NoteMeaning(piece, Zone.PEDAL, Articulation.CHICK, CLOSED)
    return NoteMeaning(piece, _USUAL_ZONE[piece], openness=CLOSED if piece is Piece.HIHAT else None)


def placed_strike(step: str, octave: str, head: str) -> NoteMeaning | None:
    """What a note on this line with this head is, by the usual drum maps; None where they have nothing there."""
    place = f"{step}{octave}"
    if place == "C5" and head in _CROSS_STICKS:
        return NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK)
    piece = (_CROSS_PLACES if head in _CROSSES else _ROUND_PLACES).get(place)
    if piece is None:
        return None
    strike = plain_strike(piece)
    if piece is Piece.RIDE and head == "diamond":
        return replace(strike, zone=Zone.BELL)
    return replace(strike, openness=OPEN) if piece is Piece.HIHAT and head == "circle-x" else strike


@cache
def instrument_of(strike: NoteMeaning) -> XmlInstrument:
    """The instrument that `strike` is written with."""
    number = general_midi_note(strike.piece, strike.zone, strike.articulation, strike.openness)
    return XmlInstrument(_name(strike), PIECES[strike.piece].sound, number)


def _name(strike: NoteMeaning) -> str:
    words = [PIECES[strike.piece].name]
    if strike.piece in _ARTICULATION_PIECES.get(strike.articulation, ()):
        words.append(_ARTICULATION_NAMES[strike.articulation])
    elif strike.zone is not _USUAL_ZONE[strike.piece] and strike.zone in _named_zones(strike.piece):
        words.append(_ZONE_NAMES[strike.zone])
    if strike.piece is Piece.HIHAT and strike.openness is not None:
        words.append(_OPENNESS_NAMES[nearest_openness(strike.openness)])
    return " ".join(words)


def nearest_openness(openness: float) -> float:
    """Closed, half open or open: what signs can say."""
    return min((CLOSED, HALF_OPEN, OPEN), key=lambda known: abs(known - openness))


def _piece_of_name(words: str) -> Piece | None:
    return next((piece for pattern, piece in _PIECE_WORDS if re.search(pattern, words)), None)


def _piece_of_sound(sound: str) -> Piece | None:
    """The piece of a standard sound such as `metal.hi-hat` or `drum.snare-drum`."""
    return _piece_of_name(sound.lower().replace("-drum", " drum").replace(".", " ")) if sound else None


def _refined(strike: NoteMeaning, words: str) -> NoteMeaning:
    """What the words of the name say beyond the number: zone, cross-stick, rim shot, half open."""
    piece = strike.piece
    if piece is Piece.SNARE and re.search(r"(side|cross)[- ]?stick", words):
        return replace(strike, zone=Zone.RIM, articulation=Articulation.CROSS_STICK)
    if piece in _DRUMS and re.search(r"rim[- ]?shot", words):
        return replace(strike, zone=Zone.RIM, articulation=Articulation.RIM_SHOT)
    if piece is Piece.SNARE and strike.articulation is Articulation.RIM_SHOT and words and "rim" not in words:
        return plain_strike(piece)  # General MIDI's number of rim shots is its electric snare's
    if piece is Piece.HIHAT:
        strike = replace(strike, openness=_worded_openness(words, strike.openness))
    for zone, pattern in _ZONE_WORDS:
        if zone in _named_zones(piece) and re.search(rf"\b({pattern})\b", words):
            return replace(strike, zone=zone)
    return strike


def _named_zones(piece: Piece) -> frozenset[Zone]:
    """The zones of `piece` that a name may say."""
    return _OF_DRUMS if piece in _DRUMS else _OF_CYMBALS if piece in CHOKEABLE else frozenset()


def _worded_openness(words: str, usual: float | None) -> float | None:
    if "half" in words:
        return HALF_OPEN
    return OPEN if re.search(r"\bopen\b", words) else CLOSED if "closed" in words else usual
