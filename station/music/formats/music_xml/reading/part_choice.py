"""Which parts of a MusicXML score are drums, and their bars one by one, whichever way round the file has them.

A part has drums where it has unpitched notes, or where an instrument of it plays on MIDI channel 10; where no part has,
one with a percussion clef, or called drums, is taken for them. Of several the one with the most different pieces of a
kit is taken; if that is a single piece, the kit is spread over several staves and all of them are read together.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from xml.etree.ElementTree import Element

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.music.formats.music_xml.xml_instruments import LOWEST_PLACE, XmlInstrument, instrument_id, pitch_number
from station.music.formats.safe_xml import text_of

_DRUM_CHANNEL = "10"
_DRUMS = re.compile(r"(?<!steel )\bdrum(s\b|[ -]?(set|kit))", re.IGNORECASE)
_MOST_PARTS = 500
"""Our choice: an orchestra has a tenth of it."""


@dataclass
class FilePart:
    """One part: its `name`, its `instruments` by id, whether any is on channel 10, and its `measures` in order."""

    name: str
    instruments: dict[str, XmlInstrument] = field(default_factory=dict)
    is_on_drum_channel: bool = False
    measures: list[Element] = field(default_factory=list)

    @cached_property
    def drum_notes(self) -> list[Element]:
        """The notes that are drums."""
        notes = [note for measure in self.measures for note in measure.iter("note")]
        return [note for note in notes if note.find("unpitched") is not None or self._is_drum(note)]

    @property
    def has_percussion_clef(self) -> bool:
        """Whether it is a part for drums even where it rests."""
        return any((sign.text or "").strip() == "percussion" for bar in self.measures for sign in bar.iter("sign"))

    @property
    def is_called_drums(self) -> bool:
        """Whether its name is that of a kit, and it has notes."""
        return _DRUMS.search(self.name) is not None and any(bar.find("note/pitch") is not None for bar in self.measures)

    @cached_property
    def pitches_are_places(self) -> bool:
        """Whether its pitches are lines of the staff, and no numbers of General MIDI's drums, which lie below it."""
        numbers = [pitch_number(note) for measure in self.measures for note in measure.iter("note")]
        return all(number is None or number >= LOWEST_PLACE for number in numbers)

    def _is_drum(self, note: Element) -> bool:
        return self.is_on_drum_channel and note.find("pitch") is not None


def parts_of(root: Element, source: str) -> list[FilePart]:
    """All parts in the order of the part list; raises `BadInput` where there are none."""
    parts: dict[str, FilePart] = {}
    for score_part in root.iter("score-part"):
        parts[score_part.get("id", "")] = _described(score_part)
    for block in root:
        if block.tag == "part":
            part = parts.setdefault(block.get("id", ""), FilePart(block.get("id", "")))
            part.measures += block.findall("measure")
        elif block.tag == "measure":  # timewise: a bar with all its parts
            for inner in block.findall("part"):
                _add_measure(parts.setdefault(inner.get("id", ""), FilePart(inner.get("id", ""))), inner, block)
    if len(parts) > _MOST_PARTS:
        raise BadInput(source, "", f"more than {_MOST_PARTS} parts")
    found = [part for part in parts.values() if part.measures]
    if not found:
        raise BadInput(source, "", "has no part with bars")
    return found


def _add_measure(part: FilePart, inner: Element, block: Element) -> None:
    inner.tag = "measure"
    inner.attrib.update(block.attrib)
    part.measures.append(inner)


def _described(score_part: Element) -> FilePart:
    part = FilePart(text_of(score_part, "part-name") or score_part.get("id", ""))
    for instrument in score_part.iter("score-instrument"):
        part.instruments[instrument.get("id", "")] = XmlInstrument(
            text_of(instrument, "instrument-name")[:100], text_of(instrument, "instrument-sound")[:100]
        )
    for midi in score_part.iter("midi-instrument"):
        name, number = midi.get("id", ""), text_of(midi, "midi-unpitched")
        part.is_on_drum_channel |= text_of(midi, "midi-channel") == _DRUM_CHANNEL
        if re.fullmatch(r"\d{1,3}", number) and 1 <= int(number) <= 128:
            known = part.instruments.get(name, XmlInstrument())
            part.instruments[name] = XmlInstrument(known.name, known.sound, int(number) - 1)
    return part if part.instruments else replace(part, instruments={"": XmlInstrument(part.name[:100])})


def drum_parts(parts: Sequence[FilePart], source: str) -> list[FilePart]:
    """The parts to be read as one drummer's; raises `BadInput` where no part has drums."""
    drums = [part for part in parts if part.drum_notes] or [
        part for part in parts if part.has_percussion_clef or part.is_called_drums
    ]
    if not drums:
        raise BadInput(source, "", "has no drums: all notes are pitched, and no part plays on MIDI channel 10")
    kits = [_pieces(part) for part in drums]
    best = max(range(len(drums)), key=lambda i: (len(kits[i]), len(drums[i].drum_notes)))
    return [drums[best]] if len(kits[best]) > 1 else drums


def _pieces(part: FilePart) -> set[object]:
    """The different pieces of a kit that the part has: by instrument, else by line."""
    used = {(instrument_id(note), note.findtext("unpitched/display-step")) for note in part.drum_notes}
    strikes = {name: part.instruments[name].meaning() for name, _ in used if name in part.instruments}
    found: set[object] = {step if (strike := strikes.get(name)) is None else strike.piece for name, step in used}
    return found - {Piece.PERCUSSION}
