"""XML of Hydrogen's songs and patterns, from 0.9 on, as `HydrogenSong`; a fault is told with its line.

Elements may bear Hydrogen's namespaces or none. Notes lie in the pattern's `noteList`, before 0.9.4 in one list an
instrument; the kit's instruments in the song, from 1.3 on in its `drumkit_info`.
"""

from collections.abc import Iterator
from math import isfinite
from xml.etree.ElementTree import Element

from station.core.errors import BadInput
from station.music.formats.hydrogen.song_contents import (
    DEFAULT_BPM,
    ENTIRE_SAMPLE,
    HydrogenSong,
    Instrument,
    Pattern,
    PatternNote,
)
from station.music.formats.safe_xml import XmlElement, parse_xml, text_of

SONG_ROOTS = ("song",)
PATTERN_ROOTS = ("drumkit_pattern",)
_MOST_SIZE = 1 << 20
"""Ticks of a pattern: 5,000 bars (our choice)."""
_SLOWEST, _FASTEST = 1.0, 10_000.0
"""Quarters a minute; Hydrogen itself plays 10 to 400 (our choice)."""
_NO_ID = -1


def parse_song(data: bytes, source: str) -> HydrogenSong:
    """The song in an `.h2song`; raises `BadInput`."""
    root = parse_xml(data, source, SONG_ROOTS)
    read = _Reader(source)
    kit = root.find("drumkit_info")
    instruments = tuple(map(read.instrument, (root if kit is None else kit).iterfind("instrumentList/instrument")))
    if any(_flag(one, "isSoloed") for one in (root if kit is None else kit).iterfind("instrumentList/instrument")):
        instruments = tuple(read.soloed(kit if kit is not None else root))
    patterns = tuple(map(read.pattern, root.iterfind("patternList/pattern")))
    return HydrogenSong(
        text_of(root, "name"),
        text_of(root, "author"),
        text_of(root, "notes"),
        read.number(root, "bpm", DEFAULT_BPM, _SLOWEST, _FASTEST),
        read.number(root, "swing_factor", 0.0, 0.0, 1.0),
        instruments,
        patterns,
        tuple(_columns(root)),
        _virtual(root),
        tuple(read.timeline(root)) if text_of(root, "isTimelineActivated", "true") != "false" else (),
        tuple((read.whole(tag, "BAR", 0, 0), text_of(tag, "TAG")) for tag in root.iterfind("timeLineTag/newTAG")),
        tuple(read.automation(root)),
        tuple(_lost(root)),
    )


def parse_pattern(data: bytes, source: str) -> tuple[HydrogenSong, str]:
    """The pattern in an `.h2pattern` as a song of one column, and the name of its kit; raises `BadInput`."""
    root = parse_xml(data, source, PATTERN_ROOTS)
    found = root.find("pattern")
    if not isinstance(found, XmlElement):
        raise BadInput(source, f"line {root.line}", "there is no pattern in it")
    pattern = _Reader(source).pattern(found)
    author = text_of(root, "author") or text_of(found, "author")
    song = HydrogenSong(pattern.name, author, text_of(found, "info"), patterns=(pattern,), columns=((pattern.name,),))
    return song, text_of(root, "drumkit_name") or text_of(root, "pattern_for_drumkit")


class _Reader:
    """Reads numbers of elements, each in its range."""

    def __init__(self, source: str) -> None:
        self.source = source

    def number(self, element: Element, path: str, default: float, least: float, most: float) -> float:
        """The number at `path` drawn into its range; raises `BadInput` for what is no number."""
        text = text_of(element, path)
        if not text:
            return default
        try:
            number = float(text)
        except ValueError:
            number = float("nan")
        if not isfinite(number):
            raise self._fault(element, path, "expected a number", text)
        return min(max(number, least), most)

    def whole(self, element: Element, path: str, default: int, least: int, most: int = 10**9) -> int:
        """The whole number at `path`; raises `BadInput` for one out of its range."""
        number = self.number(element, path, default, -(10.0**9), 10.0**9)
        if not least <= number <= most or number != int(number):
            expected = f"expected a whole number from {least} to {most}"
            raise self._fault(element, path, expected, text_of(element, path))
        return int(number)

    def _fault(self, element: Element, path: str, expected: str, found: str) -> BadInput:
        line = element.line if isinstance(element, XmlElement) else 0
        return BadInput(self.source, f"line {line}", f"{path}: {expected}, found {found[:30]!r}")

    def instrument(self, element: Element) -> Instrument:
        has_note = bool(text_of(element, "midiOutNote"))
        return Instrument(
            self.whole(element, "id", _NO_ID, _NO_ID),
            text_of(element, "name"),
            text_of(element, "type"),
            self.whole(element, "midiOutNote", 0, 0, 127) if has_note else None,
            _flag(element, "isMuted"),
        )

    def soloed(self, kit: Element) -> Iterator[Instrument]:
        """The instruments of a kit where some play alone."""
        for element in kit.iterfind("instrumentList/instrument"):
            one = self.instrument(element)
            yield Instrument(one.id, one.name, one.kind, one.midi_note, not _flag(element, "isSoloed"))

    def pattern(self, element: Element) -> Pattern:
        lists = [*element.iterfind("noteList"), *element.iterfind("sequenceList/sequence/noteList")]
        return Pattern(
            text_of(element, "name") or text_of(element, "pattern_name"),
            self.whole(element, "size", 192, 1, _MOST_SIZE),
            self.whole(element, "denominator", 4, 1, 192),
            tuple(self.note(note) for each in lists for note in each.iterfind("note")),
        )

    def note(self, element: Element) -> PatternNote:
        return PatternNote(
            self.whole(element, "position", 0, 0, _MOST_SIZE),
            self.whole(element, "instrument", _NO_ID, _NO_ID),
            self.number(element, "velocity", 0.8, 0.0, 1.0),
            self.number(element, "leadlag", 0.0, -1.0, 1.0),
            self.number(element, "probability", 1.0, 0.0, 1.0),
            text_of(element, "type"),
            self.whole(element, "length", ENTIRE_SAMPLE, ENTIRE_SAMPLE),
            _flag(element, "note_off"),
        )

    def timeline(self, root: Element) -> Iterator[tuple[int, float]]:
        for change in root.iterfind("BPMTimeLine/newBPM"):
            yield self.whole(change, "BAR", 0, 0), self.number(change, "BPM", DEFAULT_BPM, _SLOWEST, _FASTEST)

    def automation(self, root: Element) -> Iterator[tuple[float, float]]:
        for path in root.iterfind("automationPaths/path"):
            for point in path.iterfind("point") if path.get("adjust") == "velocity" else ():
                try:
                    x, y = float(point.get("x", "")), float(point.get("y", ""))
                except ValueError:
                    x = y = float("nan")
                if not (isfinite(x) and isfinite(y)):
                    raise self._fault(point, "point", "expected x and y as numbers", f"{point.get('x')}")
                yield x, min(max(y, 0.0), 1.5)


def _flag(element: Element, path: str) -> bool:
    return text_of(element, path).lower() in ("true", "1")


def _columns(root: Element) -> Iterator[tuple[str, ...]]:
    for group in root.iterfind("patternSequence/group"):
        yield tuple((name.text or "").strip() for name in group.iterfind("patternID"))
    for name in root.iterfind("patternSequence/patternID"):  # before there were several patterns a column
        yield ((name.text or "").strip(),)


def _virtual(root: Element) -> dict[str, tuple[str, ...]]:
    return {
        text_of(pattern, "name"): tuple((name.text or "").strip() for name in pattern.iterfind("virtual"))
        for pattern in root.iterfind("virtualPatternList/pattern")
    }


_CHANCE = ("humanize_time", "humanize_velocity")


def _lost(root: Element) -> Iterator[str]:
    if any(text_of(root, field, "0") not in ("0", "0.0", "") for field in _CHANCE):
        yield "Hydrogen humanizes this song by chance; it is read as it is written"
    if _flag(root, "playbackTrackEnabled"):
        yield "the song's playback track"
