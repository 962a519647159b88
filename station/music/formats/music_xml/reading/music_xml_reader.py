"""A drum part of a MusicXML file: its bars as they are played, with what stands beside the notes."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest
from xml.etree.ElementTree import Element

from station.core.errors import BadInput
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.music_xml.mxl_container import score_text
from station.music.formats.music_xml.reading.bar_reading import BarReader
from station.music.formats.music_xml.reading.direction_reading import VELOCITY_OF_MARK
from station.music.formats.music_xml.reading.note_reading import NoteReader
from station.music.formats.music_xml.reading.part_choice import FilePart, drum_parts, parts_of
from station.music.formats.music_xml.reading.strokes_reading import PlayedBar, strokes_of
from station.music.formats.music_xml.written_bars import STOP, LostMarks, WrittenBar, short_meter
from station.music.formats.playing_order import playing_order
from station.music.formats.safe_xml import parse_xml, text_of
from station.music.loudness_marks import GROW, USUAL, LoudnessMark
from station.music.score import Score
from station.music.swing import STRAIGHT, Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap

ROOTS = ("score-partwise", "score-timewise")
_MARKS = tuple(VELOCITY_OF_MARK)
_WRITERS = ("composer", "arranger", "transcriber", "lyricist")
_MOST_STROKES = 50_000
"""As played, of repeats that multiply (our choice)."""


def read_music_xml(data: bytes, source: str) -> DrumPart:
    """The drum part in `data`, plain or compressed; raises `BadInput` with the line or bar of the first fault."""
    root = parse_xml(score_text(data, source), source, ROOTS)
    parts = parts_of(root, source)
    drums = drum_parts(parts, source)
    lost = LostMarks()
    bars = _written_bars(parts, drums, source, lost)
    played = [bars[i] for i in playing_order([bar.signs for bar in bars], source)]
    if sum(len(bar.notes) for bar in played) > _MOST_STROKES:
        raise BadInput(source, "", f"with its repeats the part has more than {_MOST_STROKES:,} notes")
    unread = [part.name for part in parts if not any(part is drum for drum in drums)]
    not_read = (f"the other parts: {', '.join(unread)}"[:300],) if unread else ()
    return _assembled(root, played, (*not_read, *lost.lines()))


# --- bars of all parts as one -----------------------------------------------------------------------------------------


def _written_bars(
    parts: Sequence[FilePart], drums: Sequence[FilePart], source: str, lost: LostMarks
) -> list[WrittenBar]:
    """The bars of the drum parts together; of the others what holds for all: tempo, meter, order, sections."""
    readers = []
    for part in sorted(parts, key=lambda p: not any(p is drum for drum in drums)):
        is_drums = any(part is drum for drum in drums)
        notes = NoteReader(part, lost) if is_drums else None
        reader = BarReader(source, notes, lost if is_drums else LostMarks())
        for measure in part.measures:
            reader.read(measure)
        if is_drums and reader.last_graces:
            lost.add("grace notes after the last note", reader.bars[-1].name)
        readers.append(reader)
    count = max(len(reader.bars) for reader in readers)
    bars = [_merged([reader.bars[i] for reader in readers if i < len(reader.bars)], len(drums)) for i in range(count)]
    _tell_codas_apart(bars)
    return bars


def _tell_codas_apart(bars: Sequence[WrittenBar]) -> None:
    """Of two bare coda signs, without a word where to go on, the first is left and the second is gone to."""
    codas = [bar.signs for bar in bars if bar.signs.coda is not None]
    if len(codas) > 1 and not any(bar.signs.to_coda is not None for bar in bars):
        codas[0].to_coda, codas[0].coda = codas[-1].coda, None


def _merged(bars: Sequence[WrittenBar], drum_count: int) -> WrittenBar:
    """One bar of what several parts have there, the drum parts first."""
    whole = bars[0]
    for at, other in enumerate(bars[1:], 1):
        whole.length = max(whole.length, other.length)
        whole.meter = whole.meter or other.meter
        whole.beat_ticks = whole.beat_ticks or other.beat_ticks
        whole.section = whole.section or other.section
        whole.tempos = whole.tempos or other.tempos
        whole.swings = whole.swings or other.swings
        if at < drum_count:
            whole.notes = whole.notes + other.notes
            whole.loudness = whole.loudness or other.loudness
        ours, theirs = whole.signs, other.signs
        ours.repeat_from |= theirs.repeat_from
        ours.repeat_times = max(ours.repeat_times, theirs.repeat_times)
        ours.endings = ours.endings or theirs.endings
        ours.da_capo |= theirs.da_capo
        ours.fine |= theirs.fine
        for name in ("segno", "coda", "to_coda", "dal_segno"):
            if getattr(ours, name) is None:
                setattr(ours, name, getattr(theirs, name))
    return whole


# --- bars as they are played ------------------------------------------------------------------------------------------


@dataclass(slots=True)
class _Timeline:
    """The bars laid one after the other; `ticks` where each begins, and where the last ends."""

    bars: list[PlayedBar]
    ticks: list[int]
    meters: list[MeterChange]


def _timeline(bars: Sequence[WrittenBar]) -> _Timeline:
    """Each bar as long as what stands in it, in a meter of its own where that is not the meter's."""
    line = _Timeline([], [0], [])
    meter, swing = MeterChange(0, 4, 4), Swing()
    for bar in bars:
        meter = bar.meter or meter
        start, length = line.ticks[-1], round(bar.length) or meter.bar_ticks
        own = meter if length == meter.bar_ticks else short_meter(length, meter)
        swings = [(0, swing), *((round(at), each) for at, each in bar.swings)]
        swing = swings[-1][1]
        line.bars.append(PlayedBar(own, start, tuple(swings)))
        line.meters.append(replace(own, tick=start))
        line.ticks.append(start + length)
    return line


def _assembled(root: Element, bars: Sequence[WrittenBar], lost: tuple[str, ...]) -> DrumPart:
    line = _timeline(bars)
    notes = strokes_of((played, bar.notes) for played, bar in zip(line.bars, bars, strict=True))
    tempos = [TempoChange(start + round(at), us) for start, bar in zip(line.ticks, bars, strict=False)
              for at, us in bar.tempos]  # fmt: skip
    tempo_map = TempoMap.build([t for t in tempos if t.tick < line.ticks[-1]], line.meters)
    score = Score.from_notes(notes, tempo_map, line.ticks[-1], _title(root))
    return DrumPart(
        replace(score, loudness=_loudness(bars, line.ticks)),
        _author(root),
        _about(root),
        next((bar.beat_ticks for bar in bars if bar.beat_ticks), None),
        next((swing for bar in bars for _, swing in bar.swings if swing.ratio != STRAIGHT), Swing()),
        _sections(bars),
        lost=lost,
    )


def _sections(bars: Sequence[WrittenBar]) -> tuple[PartSection, ...]:
    """A section goes from its mark to the next, or to a double bar line."""
    found: list[PartSection] = []
    is_open = False
    for i, bar in enumerate(bars):
        if bar.section:
            found.append(PartSection(bar.section, i, i))
            is_open = True
        elif is_open:
            found[-1] = replace(found[-1], last_bar=i)
        is_open = is_open and not bar.ends_section
    return tuple(found)


def _loudness(bars: Sequence[WrittenBar], ticks: Sequence[int]) -> tuple[LoudnessMark, ...]:
    """The marks where they are played; a hairpin that ends before the next mark ends a step louder or softer."""
    signs = sorted(
        ((start + round(at), sign) for start, bar in zip(ticks, bars, strict=False) for at, sign in bar.loudness),
        key=lambda each: (each[0], each[1] != STOP),
    )
    found: list[LoudnessMark] = []
    level = USUAL
    for (tick, sign), after in zip_longest(signs, signs[1:]):
        if sign != STOP:
            found.append(LoudnessMark(tick, sign))
        elif found and found[-1].is_hairpin and not _is_answered(tick, after) and tick < ticks[-1]:
            found.append(LoudnessMark(tick, _stepped(level, found[-1].sign)))
        level = level if not found or found[-1].is_hairpin else found[-1].sign
    return tuple(mark for i, mark in enumerate(found) if not i or mark != found[i - 1])


def _is_answered(tick: int, after: tuple[int, str] | None) -> bool:
    """Whether a mark says soon after a hairpin's end at `tick` how loud it is now."""
    return after is not None and after[0] - tick <= PPQ and after[1] != STOP


def _stepped(level: str, hairpin: str) -> str:
    """The mark one step beyond `level`, the way that the hairpin goes."""
    at = _MARKS.index(level) + (1 if hairpin == GROW else -1)
    return _MARKS[min(max(at, 0), len(_MARKS) - 1)]


# --- words ------------------------------------------------------------------------------------------------------------


def _title(root: Element) -> str:
    title = text_of(root, "work/work-title") or text_of(root, "movement-title") or _credit(root, "title")
    return " ".join(title.split())[:500]


def _author(root: Element) -> str:
    creators = {c.get("type", ""): " ".join((c.text or "").split()) for c in root.iterfind("identification/creator")}
    found = next((creators[kind] for kind in _WRITERS if creators.get(kind)), "")
    return (found or _credit(root, "composer"))[:500]


def _about(root: Element) -> str:
    return _credit(root, "subtitle")[:5000]


def _credit(root: Element, kind: str) -> str:
    for credit in root.iterfind("credit"):
        if text_of(credit, "credit-type") == kind:
            return re.sub(r"\s+", " ", " ".join(words.text or "" for words in credit.iter("credit-words"))).strip()
    return ""
