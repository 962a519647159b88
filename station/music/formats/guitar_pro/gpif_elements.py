"""What single elements of a `score.gpif` say: numbers of notes, a master bar's signs, tuplets, numbers in words."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from xml.etree.ElementTree import Element

from station.core.note_map import strike_of
from station.music.formats.guitar_pro.tab_kit import OF_ELEMENT, TAB_KIT
from station.music.formats.guitar_pro.tab_song import TabBar, TabNote
from station.music.formats.guitar_pro.tab_words import FEEL_OF, STRAIGHT_FEEL, signs_of
from station.music.formats.safe_xml import text_of
from station.music.tempo import MeterChange

_DRUM_CHANNEL = 9
_MOST_NUMBER = 127
"""Of a MIDI note."""
_MOST_DIGITS, _MOST_PASSES = 6, 32
"""Our choice: no count of a song is longer, no repeat has more endings."""
_MOST_IN_TUPLET = 64
"""Our choice; sums of fractions stay short."""


@dataclass(frozen=True, slots=True)
class DrumTrack:
    """A drum track: its `column` among the bars of a master bar, and what number each articulation is."""

    name: str
    column: int
    numbers: tuple[int, ...]


def is_for_drums(track: Element) -> bool:
    """Whether a track is: by its kind of instrument, by General MIDI's table (GP 6), or by its channel."""
    general_midi = track.find("GeneralMidi")
    table = "" if general_midi is None else general_midi.get("table", "")
    channels = {text_of(track, f"{kind}/PrimaryChannel") for kind in ("MidiConnection", "GeneralMidi")}
    kind = text_of(track, "InstrumentSet/Type")
    return kind == "drumKit" or table == "Percussion" or str(_DRUM_CHANNEL) in channels


def number_of_articulation(articulation: Element) -> int:
    """The percussion number of an articulation: its first input number, which tells a rim shot from a stroke.

    Where that is of another piece than its output number, as in kits of the user's own, the output counts.
    """
    output = whole(text_of(articulation, "OutputMidiNumber"))
    first = whole((text_of(articulation, "InputMidiNumbers").split() or [""])[0])
    if 0 < first <= _MOST_NUMBER and strike_of(first, TAB_KIT).piece is strike_of(output, TAB_KIT).piece:
        return first
    return min(output, _MOST_NUMBER)


def number_of_note(track: DrumTrack, note: Element) -> int:
    """The percussion number, 0–127, that a note of `track` has in any of the program's versions."""
    properties = {p.get("name", ""): p for p in note.findall("Properties/Property")}
    values = {
        name: whole(text_of(properties[name], child)) if name in properties else None
        for name, child in (("Element", "Element"), ("Variation", "Variation"), ("Midi", "Number"), ("Fret", "Fret"))
    }
    index = text_of(note, "InstrumentArticulation")
    if index:
        place = whole(index)
        return track.numbers[place] if place < len(track.numbers) else min(place, _MOST_NUMBER)
    if values["Element"] is not None:
        pair = (values["Element"], values["Variation"] or 0)
        return OF_ELEMENT.get(pair, OF_ELEMENT.get((pair[0], 0), 0))
    return min(values["Midi"] or values["Fret"] or 0, _MOST_NUMBER)


def master_bar(master: Element, meter: MeterChange) -> TabBar:
    """What a master bar says of repeats, jumps, feel and section."""
    repeat = master.find("Repeat")
    closes = repeat is not None and repeat.get("end", "").lower() == "true"
    passes = [whole(word) for word in text_of(master, "AlternateEndings").split()]
    directions = [e.text or "" for kind in ("Target", "Jump") for e in master.findall(f"Directions/{kind}")]
    name = " ".join(filter(None, (text_of(master, "Section/Letter"), text_of(master, "Section/Text"))))
    return TabBar(
        meter,
        signs=signs_of(
            directions,
            repeat_from=repeat is not None and repeat.get("start", "").lower() == "true",
            repeat_times=min(max(whole(repeat.get("count", "2")), 2), 255) if closes and repeat is not None else 0,
            endings=frozenset(n for n in passes if 1 <= n <= _MOST_PASSES),
        ),
        feel=FEEL_OF.get(_small(text_of(master, "TripletFeel")), STRAIGHT_FEEL),
        section=" ".join(name.split()),
    )


def with_graces(notes: Sequence[TabNote], graces: Sequence[int]) -> Iterator[TabNote]:
    """The notes of a beat, each grace note with the note of its own drum, else with the first."""
    pieces = [strike_of(note.number, TAB_KIT).piece for note in notes]
    of_note: list[list[int]] = [[] for _ in notes]
    for number in graces:
        piece = strike_of(number, TAB_KIT).piece
        of_note[pieces.index(piece) if piece in pieces else 0].append(number)
    return (replace(note, graces=tuple(own)) for note, own in zip(notes, of_note, strict=True))


def tuplet_of(tuplet: Element | None) -> Fraction:
    """How much shorter a tuplet's notes are; it stands in attributes or in elements."""
    if tuplet is None:
        return Fraction(1)
    enters, times = (whole(tuplet.get(name.lower(), "") or text_of(tuplet, name)) for name in ("Num", "Den"))
    return Fraction(times, enters) if all(1 <= n <= _MOST_IN_TUPLET for n in (enters, times)) else Fraction(1)


def _small(text: str | None) -> str:
    return "".join((text or "").split()).lower()


def whole(word: str) -> int:
    """A whole number, 0 where there is none."""
    return int(word) if word.isascii() and word.isdigit() and len(word) <= _MOST_DIGITS else 0


def decimal(word: str) -> float:
    """A number, 0 where there is none."""
    try:
        return float(word) if len(word) <= 24 else 0.0
    except ValueError:
        return 0.0
