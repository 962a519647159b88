"""A drum part as MusicXML 4.0: one part of two voices, hands with stems up and feet with stems down.

All that is said is said by the format's own elements: velocities are the notes' `dynamics`, hands are fingerings, the
strokes of a diddle a slash, a section a rehearsal mark that holds to the next or to a double bar line.
"""

from collections.abc import Sequence
from fractions import Fraction
from math import lcm
from xml.etree.ElementTree import Element, indent, tostring

from station.core.errors import BadInput
from station.core.pieces import HAND_PIECES, Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.music_format import WrittenFile
from station.music.formats.music_xml.reading.time_reading import MOST_BEATS, MOST_UNIT
from station.music.formats.music_xml.writing.bar_writing import SpelledBar
from station.music.formats.music_xml.writing.direction_writing import Direction, directions_of
from station.music.formats.music_xml.writing.element_writing import (
    VoiceSetting,
    add_bar_rest,
    add_chord,
    child,
    number_text,
    strike_of_note,
    xml_text,
)
from station.music.formats.music_xml.writing.part_losses import losses_of
from station.music.formats.music_xml.writing.swung_bars import BarFrame, WrittenVoices, can_be_said, written_voices
from station.music.formats.music_xml.written_bars import short_meter
from station.music.formats.music_xml.xml_instruments import XmlInstrument, instrument_of
from station.music.formats.playing_order import MOST_BARS
from station.music.score import Score
from station.music.swing import Swing
from station.music.tempo import MeterChange

_HEAD = (
    '<?xml version="1.0" encoding="UTF-8"?>\n<!DOCTYPE score-partwise PUBLIC "-//Recordare//DTD MusicXML 4.0 Partwise'
    '//EN" "http://www.musicxml.org/dtds/partwise.dtd">\n'
)
_MOST_DIVISIONS = 100_000
"""Rarer tuplets together may need more; then lengths are written as decimals of a tick (our choice)."""
_VOICES = (frozenset(HAND_PIECES), frozenset(Piece) - HAND_PIECES)
_STEMS = ("up", "down")
_PART = "P1"


def write_music_xml(part: DrumPart) -> WrittenFile:
    """`part` as an uncompressed MusicXML file; raises `BadInput` for a meter or a length that it does not have."""
    _check(part)
    written = written_voices(part.score, part.swing, _VOICES)
    root = Element("score-partwise", version="4.0")
    _add_head(root, part)
    ids = _instrument_ids(part)
    _add_part_list(root, ids)
    _add_measures(child(root, "part", id=_PART), part, written, ids)
    indent(root)
    return WrittenFile(_HEAD.encode() + tostring(root, encoding="utf-8") + b"\n", losses_of(part, written))


def _check(part: DrumPart) -> None:
    title = part.score.title or "part"
    for meter in part.score.tempo_map.meters:
        if meter.unit & (meter.unit - 1) or meter.unit > MOST_UNIT or meter.beats > MOST_BEATS:
            raise BadInput(title, "", f"MusicXML has no meter {meter}")
    if part.score.bar_count > MOST_BARS:
        raise BadInput(title, "", f"has more than {MOST_BARS:,} bars")


# --- head -------------------------------------------------------------------------------------------------------------


def _add_head(root: Element, part: DrumPart) -> None:
    title, author, about = (xml_text(text) for text in (part.score.title, part.author, part.about))
    if title:
        child(child(root, "work"), "work-title", title)
    if author:
        child(child(root, "identification"), "creator", author, type="composer")
    for kind, text in (("title", title), ("composer", author), ("subtitle", about)):
        if text:
            credit = child(root, "credit", page="1")
            child(credit, "credit-type", kind)
            child(credit, "credit-words", text)


def _instrument_ids(part: DrumPart) -> dict[XmlInstrument, str]:
    """An id for every instrument that the part uses, in the order of their numbers."""
    used = {instrument_of(strike_of_note(note)) for note in part.score}
    ordered = sorted(used, key=lambda each: (each.midi or 0, each.name))
    return {instrument: f"{_PART}-I{i}" for i, instrument in enumerate(ordered, 1)}


def _add_part_list(root: Element, ids: dict[XmlInstrument, str]) -> None:
    score_part = child(child(root, "part-list"), "score-part", id=_PART)
    child(score_part, "part-name", "Drumset")
    for instrument, name in ids.items():
        element = child(score_part, "score-instrument", id=name)
        child(element, "instrument-name", instrument.name)
        child(element, "instrument-sound", instrument.sound)
    for instrument, name in ids.items():
        midi = child(score_part, "midi-instrument", id=name)
        child(midi, "midi-channel", 10)
        child(midi, "midi-unpitched", (instrument.midi or 0) + 1)


# --- measures ---------------------------------------------------------------------------------------------------------


def _add_measures(element: Element, part: DrumPart, written: WrittenVoices, ids: dict[XmlInstrument, str]) -> None:
    divisions = _divisions(written)
    used = [i for i, heads in enumerate(written.heads) if heads] or [0]
    settings = [VoiceSetting(n + 1, _STEMS[i], divisions, ids) for n, i in enumerate(used)]
    directions = directions_of(part, _swings(part, written))
    last_bars = {section.last_bar for section in part.sections}
    at = 0
    meters = [frame.meter for frame in written.frames]
    has_pickup = _has_pickup(part.score)
    for bar, frame in enumerate(written.frames):
        measure = child(element, "measure", number=str(bar + 1 - has_pickup))
        if has_pickup and not bar:
            measure.set("implicit", "yes")
            meters[0] = meters[1]
        _add_attributes(measure, meters, bar, divisions)
        until = at
        is_last = bar + 1 == len(written.frames)
        while until < len(directions) and (directions[until].tick < frame.end or is_last):
            until += 1
        _add_voices(measure, frame, [written.voices[i][bar] for i in used], settings, directions[at:until])
        at = until
        if is_last or bar in last_bars:
            child(child(measure, "barline", location="right"), "bar-style", "light-heavy" if is_last else "light-light")


def _divisions(written: WrittenVoices) -> int:
    """The fewest divisions of a quarter in which all lengths are whole."""
    found = 1
    for voice in written.voices:
        for bar in voice:
            for chord in bar.chords:
                found = lcm(found, (chord.value.length / PPQ).denominator)
        if found > _MOST_DIVISIONS:
            return PPQ
    for frame in written.frames:
        found = lcm(found, Fraction(frame.length, PPQ).denominator)
    return found if found <= _MOST_DIVISIONS else PPQ


def _swings(part: DrumPart, written: WrittenVoices) -> list[tuple[int, Swing]]:
    """Where the swing begins, is left and comes back."""
    if not can_be_said(part.swing):
        return []
    found = [(0, part.swing)]
    for frame, is_swung in zip(written.frames, written.swings, strict=True):
        now = part.swing if is_swung else Swing()
        if now != found[-1][1]:
            found.append((frame.start, now))
    return found


def _has_pickup(score: Score) -> bool:
    """Whether the first bar is a pick-up that can be written under the meter of the second, and comes back as it is."""
    tempo = score.tempo_map
    length = tempo.pickup_ticks(score.end_tick)
    first, second = tempo.meters[0], tempo.meter_at(length)
    is_cut = (first.beats, first.unit) == (second.beats, second.unit)
    return length > 0 and (is_cut or short_meter(length, second) == first)


def _add_attributes(measure: Element, meters: Sequence[MeterChange], bar: int, divisions: int) -> None:
    meter, before = meters[bar], meters[bar - 1] if bar else None
    if before is not None and (before.beats, before.unit, before.groups) == (meter.beats, meter.unit, meter.groups):
        return
    attributes = child(measure, "attributes")
    if not bar:
        child(attributes, "divisions", divisions)
        child(child(attributes, "key"), "fifths", 0)
    time = child(attributes, "time")
    child(time, "beats", "+".join(map(str, meter.groups)) or meter.beats)
    child(time, "beat-type", meter.unit)
    if not bar:
        clef = child(attributes, "clef")
        child(clef, "sign", "percussion")


def _add_voices(
    measure: Element,
    frame: BarFrame,
    bars: Sequence[SpelledBar],
    settings: Sequence[VoiceSetting],
    directions: Sequence[Direction],
) -> None:
    """The first voice with the directions between its notes, then the others each from the bar's start."""
    length = Fraction(frame.length)
    for i, (bar, setting) in enumerate(zip(bars, settings, strict=True)):
        if i:
            child(child(measure, "backup"), "duration", number_text(length * setting.divisions / PPQ))
        _add_voice(measure, bar, frame, setting, directions if not i else ())


def _add_voice(
    measure: Element, bar: SpelledBar, frame: BarFrame, setting: VoiceSetting, directions: Sequence[Direction]
) -> None:
    starts = [Fraction(0)] if bar.is_silent else [chord.value.start for chord in bar.chords]
    at = 0
    for i, start in enumerate(starts):
        next_start = starts[i + 1] if i + 1 < len(starts) else None
        while at < len(directions) and (next_start is None or directions[at].tick - frame.start < next_start):
            offset = (directions[at].tick - frame.start - start) * setting.divisions / PPQ
            directions[at].add(measure, number_text(Fraction(offset)))
            at += 1
        if bar.is_silent:
            add_bar_rest(measure, Fraction(frame.length), setting)
        else:
            add_chord(measure, bar.chords[i], setting)
