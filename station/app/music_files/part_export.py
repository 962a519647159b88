"""Writes music in the format that a file's ending names, and says in sentences what the file has not."""

from dataclasses import replace
from pathlib import Path

from station.core.disk.files import write_whole
from station.drills.lesson import Lesson
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.format_table import FORMATS, writer_for
from station.music.formats.music_format import MusicFormat
from station.music.formats.part_features import without_a_word

WRITTEN: tuple[MusicFormat, ...] = tuple(known for known in FORMATS if known.write is not None)
"""The formats that music is written in, each by its first ending."""


def write_part(part: DrumPart, out: Path) -> tuple[str, ...]:
    """Write `part` at `out`; returns what is lost, a line each. Raises `BadInput`, `DeviceError`."""
    known = writer_for(out)
    assert known.write is not None, "writer_for finds those that write"
    written = known.write(part)
    write_whole(out, written.data)
    lost = [*dict.fromkeys(loss.text for loss in written.lost)]
    if wordless := without_a_word(known, part, written):
        lost.append(f"{known.name} has no word for: {', '.join(wordless)}")
    return tuple(lost)


def bars_of(lesson: Lesson, bars: tuple[int, int]) -> DrumPart:
    """Bars first to last, from 0, of a lesson; all of them with its landing, as the command line writes them."""
    part, (first, last) = part_of(lesson), bars
    if (first, last) == (0, lesson.score.bar_count - 1):
        return part
    sections = (_within(section, first, last) for section in part.sections)
    return replace(part, score=part.score.bars(first, last), sections=tuple(s for s in sections if s is not None))


def _within(section: PartSection, first: int, last: int) -> PartSection | None:
    """What bars first to last have of a section, counted from the first; None for nothing."""
    begin, end = max(section.first_bar, first), min(section.last_bar, last)
    return PartSection(section.name, begin - first, end - first) if begin <= end else None
