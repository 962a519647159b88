"""The XML elements of notes and directions, in the order that the MusicXML 4.0 schema asks for."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from xml.etree.ElementTree import Element, SubElement

from station.core.note_map import NoteMeaning
from station.core.pieces import HALF_OPEN, OPEN, USUAL_FEET, Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.formats.music_xml.reading.note_reading import FULL_VELOCITY
from station.music.formats.music_xml.writing.bar_writing import Chord
from station.music.formats.music_xml.writing.stroke_cells import StrokeCell
from station.music.formats.music_xml.xml_instruments import (
    PIECES,
    XmlInstrument,
    instrument_of,
    nearest_openness,
    plain_strike,
)
from station.music.grace_strokes import OTHER_HAND
from station.music.score import Note

TYPES: Mapping[int, str] = MappingProxyType(
    {1: "whole", 2: "half", 4: "quarter", 8: "eighth", **{2**k: f"{2**k}th" for k in range(4, 9)}, 32: "32nd"}
)
_GRACE_TYPES = {Ornament.FLAM: "eighth", Ornament.DRAG: "16th"}
_LETTERS = {Limb.RIGHT_HAND: "R", Limb.LEFT_HAND: "L", Limb.RIGHT_FOOT: "R", Limb.LEFT_FOOT: "L"}


@dataclass(frozen=True, slots=True)
class VoiceSetting:
    """How a voice is written: its number, where its stems point, the divisions of a quarter, instruments' ids."""

    number: int
    stem: str
    divisions: int
    ids: Mapping[XmlInstrument, str]


def child(parent: Element, tag: str, text: object = None, **attributes: str) -> Element:
    """A new child of `parent`."""
    found = SubElement(parent, tag, {name.replace("_", "-"): value for name, value in attributes.items()})
    if text is not None:
        found.text = str(text)
    return found


def number_text(value: Fraction) -> str:
    """`value` as decimals, six of them at most."""
    return f"{float(value):.6f}".rstrip("0").rstrip(".") if value.denominator > 1 else str(value.numerator)


def xml_text(text: str) -> str:
    """`text` without the characters that XML 1.0 does not allow."""
    return "".join(
        c for c in text if c in "\t\n" or "\x20" <= c <= "\ud7ff" or "\ue000" <= c <= "\ufffd" or c > "\uffff"
    )


def strike_of_note(note: Note) -> NoteMeaning:
    """What instruments have to say of a stroke: a buzz is a tremolo, a hi-hat one of three openings."""
    plain = plain_strike(note.piece)
    articulation = plain.articulation if note.articulation in _BY_SIGN else note.articulation
    openness = plain.openness
    if note.piece is Piece.HIHAT and note.openness is not None:
        openness = nearest_openness(note.openness)
    return NoteMeaning(note.piece, note.zone, articulation, openness)


_BY_SIGN = (Articulation.BUZZ, Articulation.SPLASH, Articulation.NORMAL)


def add_chord(measure: Element, chord: Chord, setting: VoiceSetting) -> None:
    """The notes of a chord, or a rest, with the grace notes before it."""
    if chord.is_rest:
        _add_rest(measure, chord, setting)
        return
    for cell in chord.struck:
        for grace in cell.graces:
            _add_grace(measure, grace, cell, setting)
    cells = sorted((*chord.struck, *chord.held), key=lambda cell: (-_height(cell.note.piece), not cell.graces))
    for i, cell in enumerate(cells):
        _add_note(measure, chord, cell, setting, is_first=i == 0)


def _height(piece: Piece) -> int:
    return 7 * PIECES[piece].octave + "CDEFGAB".index(PIECES[piece].step)


def _duration(chord: Chord, setting: VoiceSetting) -> str:
    return number_text(chord.value.length * setting.divisions / PPQ)


def _add_rest(measure: Element, chord: Chord, setting: VoiceSetting) -> None:
    note = child(measure, "note")
    child(note, "rest")
    child(note, "duration", _duration(chord, setting))
    child(note, "voice", setting.number)
    _add_value(note, chord)
    if chord.tuplet:
        _add_tuplet(child(note, "notations"), chord)


def add_bar_rest(measure: Element, length: Fraction, setting: VoiceSetting) -> None:
    """A rest for the whole bar."""
    note = child(measure, "note")
    child(note, "rest", measure="yes")
    child(note, "duration", number_text(length * setting.divisions / PPQ))
    child(note, "voice", setting.number)


def _add_value(note: Element, chord: Chord) -> None:
    child(note, "type", TYPES[chord.value.base])
    for _ in range(chord.value.dots):
        child(note, "dot")
    span = chord.value.span
    if span.actual > 1:
        modification = child(note, "time-modification")
        child(modification, "actual-notes", span.actual)
        child(modification, "normal-notes", span.normal)


def _add_tuplet(notations: Element, chord: Chord) -> None:
    for kind in chord.tuplet:
        child(notations, "tuplet", type=kind, bracket="yes") if kind == "start" else child(
            notations, "tuplet", type=kind
        )


def _add_head(note: Element, played: Note) -> None:
    place = PIECES[played.piece]
    unpitched = child(note, "unpitched")
    child(unpitched, "display-step", place.step)
    child(unpitched, "display-octave", place.octave)


def _dynamics(played: Note) -> dict[str, str]:
    return {"dynamics": number_text(Fraction(round(10_000 * played.velocity / FULL_VELOCITY), 100))}


def _add_note(measure: Element, chord: Chord, cell: StrokeCell, setting: VoiceSetting, is_first: bool) -> None:
    played, is_struck = cell.note, cell in chord.struck
    note = child(measure, "note", **(_dynamics(played) if is_struck else {}))
    if not is_first:
        child(note, "chord")
    _add_head(note, played)
    child(note, "duration", _duration(chord, setting))
    ties = [*(["stop"] if not is_struck else []), *(["start"] if cell in chord.goes_on else [])]
    for tie in ties:
        child(note, "tie", type=tie)
    child(note, "instrument", id=setting.ids[instrument_of(strike_of_note(played))])
    child(note, "voice", setting.number)
    _add_value(note, chord)
    child(note, "stem", setting.stem)
    _add_notehead(note, played)
    if is_first:
        for number, word in enumerate(chord.beams, 1):
            child(note, "beam", word, number=str(number))
    notations = Element("notations")
    for tie in ties:
        child(notations, "tied", type=tie)
    if is_first:
        _add_tuplet(notations, chord)
    _add_signs(notations, chord, cell, is_struck)
    if len(notations):
        note.append(notations)


def _add_notehead(note: Element, played: Note) -> None:
    head = _head(played)
    if played.dynamic is Dynamic.GHOST and played.lead_ms == 0:
        child(note, "notehead", head, parentheses="yes")
    elif head != "normal":
        child(note, "notehead", head)


def _head(played: Note) -> str:
    if played.articulation is Articulation.CROSS_STICK:
        return "x"
    if played.articulation is Articulation.RIM_SHOT:
        return "slashed"
    if played.zone is Zone.BELL:
        return "diamond"
    return "x" if played.zone is Zone.RIM else PIECES[played.piece].head


def _add_signs(notations: Element, chord: Chord, cell: StrokeCell, is_struck: bool) -> None:
    played = cell.note
    if played.articulation is Articulation.BUZZ:
        child(child(notations, "ornaments"), "tremolo", 0, type="unmeasured")
    elif cell.second is not None:
        child(child(notations, "ornaments"), "tremolo", 1, type="single")
    if not is_struck:
        return
    technical, articulations = Element("technical"), Element("articulations")
    if (sign := _openness_sign(played)) is not None:
        child(technical, sign[0], **sign[1])
    if (letter := _letter(played)) is not None:
        child(technical, "fingering", letter, placement="below")
    if played.dynamic is Dynamic.ACCENT:
        child(articulations, "accent", placement="above")
    if played.choke_ticks and cell.lasts:
        child(articulations, "other-articulation", "choke", smufl="pictChokeCymbal")
    for group in (technical, articulations):
        if len(group):
            notations.append(group)


def _openness_sign(played: Note) -> tuple[str, dict[str, str]] | None:
    if played.piece is Piece.HIHAT_PEDAL:
        return ("open", {}) if played.articulation is Articulation.SPLASH else None
    if played.piece is not Piece.HIHAT or played.openness is None:
        return None
    known = nearest_openness(played.openness)
    if known == HALF_OPEN:
        return "half-muted", {"smufl": "guitarHalfOpenPedal"}
    return ("open", {}) if known == OPEN else None


def _letter(played: Note) -> str | None:
    """The letter of the hand, and of a foot where it is not the usual one."""
    return None if USUAL_FEET.get(played.piece) is played.limb else _LETTERS.get(played.limb)


def _add_grace(measure: Element, grace: Note, cell: StrokeCell, setting: VoiceSetting) -> None:
    note = child(measure, "note", **_dynamics(grace))
    child(note, "grace", **({"slash": "yes"} if grace.ornament is Ornament.FLAM else {}))
    _add_head(note, grace)
    child(note, "instrument", id=setting.ids[instrument_of(strike_of_note(grace))])
    child(note, "voice", setting.number)
    child(note, "type", _GRACE_TYPES[grace.ornament])
    child(note, "stem", "up")
    _add_notehead(note, grace)
    if len(cell.graces) > 1:
        at = cell.graces.index(grace)
        for number in ("1", "2"):
            child(note, "beam", "begin" if at == 0 else "end" if at == len(cell.graces) - 1 else "continue",
                  number=number)  # fmt: skip
    if grace.limb is not OTHER_HAND.get(cell.note.limb, Limb.UNKNOWN) and (letter := _letter(grace)):
        child(child(child(note, "notations"), "technical"), "fingering", letter, placement="below")
