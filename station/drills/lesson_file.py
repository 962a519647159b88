"""Lesson files: TOML read into a `Lesson`, with every fault named by line and column.

The format is described for teachers in docs/lessons.md. Whatever a file leaves out has a default; a key that nobody
knows is a fault. Faults of all kinds are collected in one reading: syntax, values, letters of the grid, bars that do
not fit, stickings that do not match, and music that two hands and two feet cannot play.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from station.core.errors import BadInput
from station.core.files import read_regular
from station.core.schema import (
    Field,
    Fields,
    Reader,
    anything,
    checked_values,
    choice,
    list_of,
    number,
    optional,
    prose,
    read,
    reading,
    record,
    row_of,
    said,
    title,
    whole,
)
from station.core.toml_faults import Fault, Faults, wrong
from station.core.toml_places import KeyPath
from station.core.toml_source import MAX_FILE_BYTES, Source, source_of, text_source
from station.core.units import PPQ
from station.drills.grid.cell_strokes import Origin, WrittenCell, expand
from station.drills.grid.grid_reader import GridSection, read_grid
from station.drills.grid.grid_timing import TIMING, GridTiming, timing_of
from station.drills.grid.swing import MAX_RATIO
from station.drills.grid.voice import MAX_BARS, MAX_CELLS
from station.drills.lesson import (
    DEFAULT_DEMONSTRATIONS,
    DEFAULT_PASSES,
    LEVELS,
    Goals,
    Lesson,
    Section,
)
from station.motion.feasibility.playable import impossible
from station.music.score import Score
from station.music.tempo import MAX_BPM, MIN_BPM, MeterChange, TempoChange, TempoMap
from station.scoring.analysis.fault_table import MUTE, Asked
from station.scoring.analysis.fault_table import WORDS as FAULT_WORDS
from station.scoring.matching.hit_windows import OUR_LEVELS, Level

_MIDI = b"MThd"
"""How a MIDI file begins."""
MAX_PASSES = 1000
MAX_COUNT_IN_BARS = 8
MAX_DEMONSTRATIONS = 20
MAX_STROKES = 20_000
"""Half an hour at ten strokes a second; a session with more takes longer to prepare than anyone waits (our choice)."""
DEFAULT_TIMING = GridTiming(80.0, (MeterChange(0, 4, 4),), PPQ)
"""Where a file says no tempo: a slow walk, our choice."""


# --- the schema -------------------------------------------------------------------------------------------------------


def _tag(value: object) -> str:
    tag = prose(value)
    if not tag:
        raise wrong('expected a word such as "rock"')
    return tag


_LEVEL = choice(OUR_LEVELS, "level")

_SMALLEST_FAULT, _LARGEST_FAULT = 0.1, 1000.0
"""Bounds of the sizes of faults, in whatever unit: nobody hears less, and nobody plays so far off (our choice)."""


def _fault_size(value: object) -> float | None:
    """From which size a fault counts; None for `MUTE`."""
    if isinstance(value, str) and value != MUTE:
        raise wrong(f'expected a size, or "{MUTE}", found "{value}"')
    return None if value == MUTE else number(_SMALLEST_FAULT, _LARGEST_FAULT)(value)


_FAULT_SIZES: Fields = {word: optional(_fault_size) for word in sorted(FAULT_WORDS)}


def _asked(raw: object) -> Asked:
    return Asked(MappingProxyType(said(_FAULT_SIZES, "fault")(raw)))


_GOALS: Fields = {
    "level": optional(_LEVEL),
    "strictest_level": Field(_LEVEL, Level.STUDIO),
    "min_accuracy": optional(number(0, 1)),
    "max_sd_ms": optional(number(1, 1000)),
    "max_lean_ms": optional(number(0, 1000)),
    "max_swing_error": optional(number(0, MAX_RATIO)),
    "target_tempo_bpm": optional(number(MIN_BPM, MAX_BPM)),
    "min_score": optional(number(0, 100)),
    "faults": Field(_asked, Asked()),
}
FIELDS: Fields = {
    "title": Field(title, "", 'a name such as title = "Rock 1"'),
    "author": Field(prose, ""),
    "level": Field(whole(min(LEVELS), max(LEVELS)), 1),
    "tags": Field(list_of(_tag, 'a list of words, such as ["rock", "groove"]'), ()),
    "about": Field(prose, ""),
    "kit": Field(prose, ""),
    **TIMING,
    "loop": optional(anything),  # read when the bars are known
    "passes": Field(whole(1, MAX_PASSES), DEFAULT_PASSES),
    "count_in_bars": Field(whole(0, MAX_COUNT_IN_BARS), 1),
    "demonstrations": Field(whole(0, MAX_DEMONSTRATIONS), DEFAULT_DEMONSTRATIONS),
    "goals": Field(record(Goals, _GOALS), Goals()),
    "grid": Field(anything, None, "a table [grid] with the lines to play"),
}
"""The schema of the top table, in the order in which a message lists its keys."""
_AS_THEY_ARE = ("title", "author", "level", "tags", "about", "kit", "passes", "count_in_bars", "demonstrations")


# --- reading ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Reading:
    """What came of reading a text: the lesson, or None and the faults that prevented it."""

    lesson: Lesson | None
    faults: list[Fault]


def read_lesson(path: Path) -> Lesson:
    """The lesson in the file at `path`; raises `BadInput` with the place of the first fault."""
    source = lesson_source(path)
    return replace(read(source, lesson_reader(path.stem)), text=source.text)


def lesson_source(path: Path) -> Source:
    """The lesson file at `path`; raises `BadInput` if it cannot be read or is too long."""
    data = read_regular(path, MAX_FILE_BYTES)
    if data.startswith(_MIDI):
        way = f"`station lesson import {path} --out {path.stem}.toml`"
        raise BadInput(path, "", f"a MIDI file, not a lesson; {way} makes a lesson of it")
    return source_of(data, str(path))


def parse_lesson(text: str, source: str, name: str) -> Reading:
    """Read a lesson's text; `source` names it in faults, `name` becomes the lesson's."""
    found = text_source(text, source)
    lesson, faults = reading(found, lesson_reader(name))
    return Reading(lesson and replace(lesson, text=found.text), faults)


def lesson_reader(name: str) -> Reader[Lesson]:
    """The schema of the file of the lesson called `name`."""
    return lambda raw: _lesson(name, *checked_values(raw, FIELDS))


def _lesson(name: str, values: Mapping[str, Any], faults: Faults) -> Lesson:
    """The lesson that these values make; raises `Wrong` for their `faults` and all that is found on the way."""
    timing = timing_of(values, DEFAULT_TIMING, faults)
    nothing: list[GridSection] = []
    sections = faults.attempt(lambda grids: _sections(grids, timing, faults), values["grid"], nothing)
    score, origins = _score(sections)
    goals: Goals = values["goals"]
    if goals.level is not None and goals.level.rank > goals.strictest_level.rank:
        faults.add(("goals", "level"), f"{goals.level} is stricter than the strictest_level, {goals.strictest_level}")
    target = goals.target_tempo_bpm
    lesson = Lesson(
        name=name,
        score=replace(score, title=values["title"]),
        loop=_loop(values["loop"], score.bar_count, faults),
        goals=replace(goals, target_tempo_bpm=None if target is None else target * timing.beat_ticks / PPQ),
        swing=sections[0].timing.swing if sections else timing.swing,
        beat_ticks=timing.beat_ticks,
        sections=_spans(sections),
        velocities=timing.velocities,
        **{key: values[key] for key in _AS_THEY_ARE},
    )
    _note_impossible(lesson, origins, faults)
    faults.check()
    return lesson


def _sections(grids: object, timing: GridTiming, faults: Faults) -> list[GridSection]:
    """The grids of the file, one after the other; there may be one `[grid]` or several `[[grid]]`.

    Raises `Wrong` where there is more than anyone practises, before much time is spent on it.
    """
    if grids is None:
        return []
    several = isinstance(grids, list)
    if grids == []:
        faults.add(("grid",), "no grid to play; expected a table [grid] with lines in it")
    if (cells := _cell_count(grids)) > MAX_CELLS:
        raise wrong(f"{cells} letters; a lesson has at most {MAX_CELLS}", "grid")
    sections: list[GridSection] = []
    bars = strokes = 0
    for i, raw in enumerate(grids if isinstance(grids, list) else [grids]):
        path: KeyPath = ("grid", i) if several else ("grid",)
        sections.append(read_grid(raw, path, sections[-1].timing if sections else timing, faults))
        bars += sections[-1].bar_count * sections[-1].times
        strokes += sum(map(len, sections[-1].parts))
        if bars > MAX_BARS:
            raise wrong(f"{bars} bars up to here; a lesson has at most {MAX_BARS}", *path)
        if strokes > MAX_STROKES:
            raise wrong(f"{strokes} strokes up to here; a lesson has at most {MAX_STROKES}", *path)
    if sections and not any(any(s.parts) for s in sections) and not faults:
        faults.add(("grid",), "nothing to play: every cell is a rest", at_key=True)
    return sections


def _cell_count(raw: object) -> int:
    """The length of all texts in a raw value."""
    if isinstance(raw, str):
        return len(raw)
    parts = raw.values() if isinstance(raw, dict) else raw if isinstance(raw, list) else ()
    return sum(map(_cell_count, parts))


def _loop(raw: object, bar_count: int, faults: Faults) -> tuple[int, int]:
    """First and last bar from 0; the whole lesson where the file does not say."""
    two = row_of([whole(1, bar_count)] * 2, "two bar numbers such as [1, 2]")

    def read_loop(value: object) -> tuple[int, int]:
        first, last = two(value)
        if last < first:
            raise wrong(f"bar {last} comes before bar {first}; expected the first bar first")
        return first - 1, last - 1

    whole_lesson = (0, bar_count - 1)
    return whole_lesson if raw is None else faults.attempt(read_loop, raw, whole_lesson, "loop")


def _note_impossible(lesson: Lesson, origins: Sequence[Origin], faults: Faults) -> None:
    """Note what cannot be played at the faster of written and target tempo, nor as the loop starts again."""
    if not len(lesson.score):
        return
    score = lesson.score.at_speed(max(1.0, lesson.target_tempo_bpm / lesson.tempo_bpm))
    first, last = lesson.loop
    in_loop = np.flatnonzero((score.bar >= first) & (score.bar <= last)).tolist()
    twice = impossible(score.bars(first, last).repeated(2)) if in_loop else []
    found = {(in_loop[i.note], i.text) for i in twice if i.note < len(in_loop)}
    if len(in_loop) < len(score):
        found |= {(i.note, i.text) for i in impossible(score)}
    again = {(in_loop[i.note - len(in_loop)], i.text) for i in twice if i.note >= len(in_loop)} - found
    at_restart = {(note, f"{words} (as the loop starts again)") for note, words in again}
    for note, words in found | at_restart:
        faults.add(origins[note].path, words, origins[note].char)


def _score(sections: Sequence[GridSection]) -> tuple[Score, list[Origin]]:
    """The score of all sections, and the letter that wrote each of its rows."""
    strokes: list[WrittenCell] = []
    tempos: list[TempoChange] = []
    meters: list[MeterChange] = []
    tick = 0
    for section in sections:
        tempos.append(TempoChange.from_bpm(tick, section.timing.tempo_bpm))
        strokes += section.at(tick)
        for _ in range(section.times):
            meters += section.bars_at(tick)
            tick += section.length_ticks
    rows, origins = expand(strokes)
    order = np.lexsort((rows["piece"], -rows["lead_ms"], rows["tick"]))
    tempo_map = TempoMap.build(tempos, meters)
    return Score.from_array(rows[order], tempo_map, tick or tempo_map.bar_start(1)), [origins[i] for i in order]


def _spans(sections: Sequence[GridSection]) -> tuple[Section, ...]:
    spans: list[Section] = []
    for section in sections:
        first = spans[-1].last_bar + 1 if spans else 0
        last = first + section.bar_count * section.times - 1
        spans.append(Section(section.name, first, last, section.timing.swing))
    return tuple(spans)
