"""The text of a `.chart` file to a `DrumChart`.

A file has sections, `[Name]` and lines in braces; a line is `key = value`, in tracks `tick = TYPE values`. Files come
from many editors and hands: lines that say nothing are skipped and counted, sections of other instruments are not
looked at, and text is UTF-8 or UTF-16 with its mark, else Windows-1252. Of several difficulties the fullest is read.
"""

import codecs
import re
from collections.abc import Iterator
from dataclasses import dataclass

from station.core.errors import BadInput
from station.core.pieces import Dynamic
from station.music.formats.clone_hero.drum_chart import (
    MOST_CHART_NOTES,
    ChartNote,
    Difficulty,
    DrumChart,
    Lane,
    Span,
)
from station.music.formats.clone_hero.mix_events import flips_of

MOST_CHART_BYTES = 8 << 20
_MOST_LINES = 300_000
"""Our choice: YARG's check of all instruments in all difficulties has half a megabyte and 37,000 lines."""
_MOST_DIGITS = 12
_DEFAULT_RESOLUTION = 192
"""What Feedback's charts had before the entry (Moonscraper's default)."""
US_TIMES_MILLI_BPM = 60_000_000_000
_SLOWEST, _FASTEST = 1_000, 1_000_000_000
"""Thousandths of a beat a minute that are read: 1 to 1,000,000 (our choice; songs end with tempos beyond music)."""
MOST_METER_BEATS = 64
_MOST_UNIT_EXPONENT = 7

ACCENT_MARK, GHOST_MARK, CYMBAL_MARK = 33, 39, 64
"""What is added to a lane's number for its marks."""
SECOND_KICK, FLAM_MARK = 32, 109
ROLL_LANE, _TWO_LANES = 65, 66
_HEAD = re.compile(r"\[(.*)\]")
_NAMES = tuple((d, f"{d.name.title()}Drums") for d in reversed(Difficulty))


@dataclass(frozen=True, slots=True)
class _Line:
    """An event of a track, what stands after its type as it is written."""

    tick: int
    kind: str
    value: str
    number: int

    def numbers(self) -> list[int]:
        """Its values as whole numbers; empty where they are none."""
        words = self.value.split()
        return [int(w) for w in words] if all(_is_number(w) for w in words) else []


def read_chart(data: bytes, source: str) -> DrumChart:
    """The drums of a `.chart` file; raises `BadInput` with the line of a fault."""
    if data.count(b"\n") + data.count(b"\r") > 2 * _MOST_LINES:
        raise BadInput(source, "", f"more than {_MOST_LINES} lines")
    sections = _sections(_text(data))
    if not any(name in sections for name in ("Song", "SyncTrack")):
        raise BadInput(source, "line 1", "not a .chart file: it has neither [Song] nor [SyncTrack]")
    difficulty, name = _fullest(sections, source)
    song = dict(_entry(line) for _, line in sections.get("Song", []))
    track, sync, events = (list(_events(sections.get(n, []))) for n in (name, "SyncTrack", "Events"))
    notes = _notes(track, source)
    is_pro = any(n.is_cymbal for n in notes)
    has_five = not is_pro and any(n.lane is Lane.FIFTH or (n.length and n.lane is not Lane.KICK) for n in notes)
    end = max([line.tick for line in events if _event(line) == "end"], default=0)
    last = max((n.tick for n in notes), default=0)
    return DrumChart(
        _resolution(song, source),
        notes,
        tuple(_tempos(sync, source)),
        tuple(_meters(sync, source)),
        tuple((line.tick, text) for line in events if (text := _section_name(_event(line))) is not None),
        has_five,
        flips_of([(line.tick, line.value) for line in track if line.kind == "E"], difficulty, last) if is_pro else (),
        tuple(_rolls(track, ROLL_LANE)),
        title=song.get("Name", ""),
        author=song.get("Artist", ""),
        about=f"Charted by {song['Charter']}." if song.get("Charter") else "",
        end=end,
        lost=tuple(_lost(sections[name], difficulty, is_pro or has_five, notes)),
        double_rolls=tuple(_rolls(track, _TWO_LANES)),
    )


# --- text ------------------------------------------------------------------------------------------------------------


def _text(data: bytes) -> str:
    for mark, encoding in (
        (codecs.BOM_UTF8, "utf-8-sig"),
        (codecs.BOM_UTF16_LE, "utf-16"),
        (codecs.BOM_UTF16_BE, "utf-16"),
    ):
        if data.startswith(mark):
            return data.decode(encoding, "replace")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def _sections(text: str) -> dict[str, list[tuple[int, str]]]:
    """The lines of each section with their numbers from 1; of two sections of one name the first counts."""
    found: dict[str, list[tuple[int, str]]] = {}
    lines: list[tuple[int, str]] = []
    for number, row in enumerate(re.split(r"\r\n|\n|\r", text), 1):
        line = row.strip().strip("\0")
        head = _HEAD.fullmatch(line)
        if head:
            lines = []
            found.setdefault(head[1].strip(), lines)
        elif line and line not in "{}":
            lines.append((number, line))
    return found


def _entry(line: str) -> tuple[str, str]:
    key, _, value = line.partition("=")
    text = value.strip()
    quoted = len(text) >= 2 and text[0] == text[-1] == '"'
    return key.strip(), text[1:-1] if quoted else text


def _events(lines: list[tuple[int, str]]) -> Iterator[_Line]:
    for number, line in lines:
        place, _, value = line.partition("=")
        key = place.strip()
        kind, _, rest = value.strip().partition(" ")
        if _is_number(key) and kind:
            yield _Line(int(key), kind, rest.strip(), number)


def _is_number(word: str) -> bool:
    return word.isascii() and word.isdigit() and len(word) <= _MOST_DIGITS


# --- sections --------------------------------------------------------------------------------------------------------


def _fullest(sections: dict[str, list[tuple[int, str]]], source: str) -> tuple[Difficulty, str]:
    for difficulty, name in _NAMES:
        if any(line.kind == "N" for line in _events(sections.get(name, []))):
            return difficulty, name
    others = ", ".join(f"[{name[:30]}]" for name in list(sections)[:4])
    raise BadInput(source, "", f"no drum notes: expected [ExpertDrums] or an easier one, found {others}")


def _resolution(song: dict[str, str], source: str) -> int:
    word = song.get("Resolution", str(_DEFAULT_RESOLUTION))
    if not _is_number(word) or not int(word):
        raise BadInput(source, "[Song]", f"a Resolution of {word[:20]!r}; expected ticks a quarter note")
    return int(word)


def _tempos(sync: list[_Line], source: str) -> Iterator[tuple[int, int]]:
    for line in sync:
        if line.kind != "B":
            continue
        numbers = line.numbers()
        if not numbers or not _SLOWEST <= numbers[0] <= _FASTEST:
            raise BadInput(source, f"line {line.number}", f"a tempo of {line.value[:20]!r} thousandths of a beat")
        yield line.tick, round(US_TIMES_MILLI_BPM / numbers[0])


def _meters(sync: list[_Line], source: str) -> Iterator[tuple[int, int, int]]:
    for line in sync:
        if line.kind != "TS":
            continue
        beats, exponent, *_ = [*line.numbers(), 2, 2] if len(line.numbers()) == 1 else [*line.numbers(), 0, 0]
        if not 1 <= beats <= MOST_METER_BEATS or exponent > _MOST_UNIT_EXPONENT:
            raise BadInput(source, f"line {line.number}", f"a meter of {line.value[:20]!r}")
        yield line.tick, beats, 1 << exponent


def _event(line: _Line) -> str:
    """What a text event says, without the quotes and brackets that some files have."""
    return line.value.strip('"').strip().removeprefix("[").removesuffix("]").strip() if line.kind == "E" else ""


def _section_name(text: str) -> str | None:
    for begin in ("section ", "section_", "prc_", "prc "):
        if text.startswith(begin):
            return text.removeprefix(begin).strip()
    return None


# --- the track -------------------------------------------------------------------------------------------------------


def _notes(track: list[_Line], source: str) -> tuple[ChartNote, ...]:
    """The notes with the marks that stand on their ticks."""
    marks: dict[int, dict[int, int]] = {}
    for line in track:
        numbers = line.numbers() if line.kind == "N" else []
        if numbers:
            marks.setdefault(line.tick, {})[numbers[0]] = numbers[1] if len(numbers) > 1 else 0
        if len(marks) > MOST_CHART_NOTES:
            raise BadInput(source, f"line {line.number}", f"more than {MOST_CHART_NOTES} drum notes")
    return tuple(note for tick in sorted(marks) for note in _notes_at(tick, marks[tick]))


def _notes_at(tick: int, marks: dict[int, int]) -> Iterator[ChartNote]:
    for lane in Lane:
        if lane in marks:
            is_cymbal = lane + CYMBAL_MARK in marks and lane in (Lane.YELLOW, Lane.BLUE, Lane.ORANGE_GREEN)
            is_flam = FLAM_MARK in marks and lane is not Lane.KICK
            yield ChartNote(tick, lane, is_cymbal, _dynamic(lane, marks), is_flam, length=marks[lane])
    if SECOND_KICK in marks:
        yield ChartNote(tick, Lane.KICK, is_second_kick=True, length=marks[SECOND_KICK])


def _dynamic(lane: Lane, marks: dict[int, int]) -> Dynamic:
    if lane is not Lane.KICK and lane + ACCENT_MARK in marks:
        return Dynamic.ACCENT
    return Dynamic.GHOST if lane is not Lane.KICK and lane + GHOST_MARK in marks else Dynamic.NORMAL


def _rolls(track: list[_Line], phrase: int) -> Iterator[Span]:
    for line in track:
        numbers = line.numbers() if line.kind == "S" else []
        if len(numbers) > 1 and numbers[0] == phrase:
            yield Span(line.tick, line.tick + numbers[1])


def _lost(
    lines: list[tuple[int, str]], difficulty: Difficulty, says_cymbals: bool, notes: tuple[ChartNote, ...]
) -> Iterator[str]:
    if difficulty is not Difficulty.EXPERT:
        yield f"no notes for Expert: this is {difficulty.name.title()}"
    if not says_cymbals and any(n.lane not in (Lane.KICK, Lane.RED) for n in notes):
        yield "no cymbal is marked: yellow, blue and green are all toms, as such charts have them"
    known = {line.number for line in _events(lines)}
    strange = [number for number, _ in lines if number not in known]
    if strange:
        yield f"{len(strange)} lines of the drums that say nothing, the first is line {strange[0]}"
