"""Lesson files: TOML read into a `Lesson`, with every fault named by line and column.

The format is described for teachers in docs/lessons.md, and key by key in docs/lesson-format.md. Faults of all kinds
are collected in one reading: syntax, values, letters of the grid, bars that do not fit, stickings that do not match,
and music that two hands and two feet cannot play. `lesson_fields` has the top table's schema, `form` says what is
played, `grid` reads it, `played` lays it out; here it is put together.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import read_regular
from station.core.errors import BadInput
from station.core.labels import limb_name
from station.core.pieces import Limb, word
from station.core.toml.schema import Reader, checked_values, read, reading, row_of, whole
from station.core.toml.toml_faults import Fault, Faults, Wrong, wrong
from station.core.toml.toml_source import MAX_FILE_BYTES, Source, source_of, text_source
from station.core.units import PPQ
from station.drills.grid.cell_strokes import Origin, parted
from station.drills.grid.grid_timing import GridTiming, timing_of
from station.drills.grid.landing import read_landing
from station.drills.grid.line_group import MAX_BARS
from station.drills.lesson import Goals, Lesson
from station.drills.reading.form import WrittenGrid
from station.drills.reading.form_order import played_order
from station.drills.reading.lesson_fields import AS_THEY_ARE, DEFAULT_TIMING, FIELDS
from station.drills.reading.lesson_music import note_silence, read_grids, score_of, written_of
from station.drills.reading.misplaced_keys import sent_home
from station.drills.reading.played_grids import (
    PlayedGrid,
    ReadGrid,
    cues_of,
    laid_out,
    sections_of,
)
from station.drills.reading.unplayable import note_unplayable
from station.music.formats.format_table import is_music_file
from station.music.formats.text_score import TEXT_ENDING
from station.music.score import NOTE_DTYPE
from station.music.swing import triplets_spelled_out

LANDING = "landing"
_MIDI = b"MThd"
"""How a MIDI file begins."""


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
    is_music = is_music_file(path.name) and path.suffix.lower() != TEXT_ENDING  # a lesson may be a text
    if is_music or data.startswith(_MIDI):
        way = f"`station lesson import {path} --out {path.stem}.toml`"
        raise BadInput(path, "", f"a music file, not a lesson; {way} makes a lesson of it")
    return source_of(data, str(path))


def parse_lesson(text: str, source: str, name: str) -> Reading:
    """Read a lesson's text; `source` names it in faults, `name` becomes the lesson's."""
    found = text_source(text, source)
    lesson, faults = reading(found, lesson_reader(name))
    return Reading(lesson and replace(lesson, text=found.text), faults)


def lesson_reader(name: str) -> Reader[Lesson]:
    """The schema of the file of the lesson called `name`."""

    def read_file(raw: object) -> Lesson:
        try:
            return _lesson(name, *checked_values(raw, FIELDS))
        except Wrong as found:
            raise Wrong(*sent_home(found.faults)) from None

    return read_file


def _lesson(name: str, values: Mapping[str, Any], faults: Faults) -> Lesson:
    """The lesson that these values make; raises `Wrong` for their `faults` and all that is found on the way."""
    timing = timing_of(values, DEFAULT_TIMING, faults)
    before = len(faults)
    written = [] if values["grid"] is None else written_of(values["grid"], faults)
    no_grids: list[ReadGrid] = []
    grids = faults.attempt(lambda _: _grids(written, timing, faults), written, no_grids)
    order = played_order(values["form"], written, faults) if written else []
    nothing: list[PlayedGrid] = []
    played = faults.attempt(lambda _: laid_out(order, grids), grids, nothing) if grids else nothing
    are_sure = timing.is_sure and len(faults) == before  # else there may be more bars than could be read
    asked, beyond = parted(stroke for each in played for stroke in each.strokes)
    score, origins = score_of((asked, beyond), played, written, faults)
    landing, landing_origins = _landing(values[LANDING], timing, faults)
    lesson = Lesson(
        name=name,
        score=replace(triplets_spelled_out(score), title=values["title"]),
        loop=_loop(values["loop"], score.bar_count if are_sure else MAX_BARS, faults),
        swing=played[0].grid.section.timing.swing if played else timing.swing,
        beat_ticks=timing.beat_ticks,
        sections=sections_of(played),
        velocities=timing.velocities,
        cues=faults.attempt(lambda _: cues_of(played), None, ()),
        landing=landing,
        **{key: values[key] for key in AS_THEY_ARE},
    )
    lesson = replace(lesson, goals=_goals(values["goals"], lesson, faults))
    _check_prerequisites(lesson, faults)
    beats = _Beats(played, lesson.beat_ticks)
    note_unplayable(lesson, [*origins, *landing_origins], beats.ticks_at, faults)
    faults.check()
    return lesson


# --- the grids --------------------------------------------------------------------------------------------------------


def _grids(written: Sequence[WrittenGrid], timing: GridTiming, faults: Faults) -> list[ReadGrid]:
    """The grids, read; notes that nothing is to play in them."""
    grids = read_grids(written, timing, faults)
    note_silence(grids, faults)
    return grids


@dataclass(frozen=True, slots=True)
class _Beats:
    """The beat that a teacher counts at each place: that of its grid, `usual` where there is none."""

    played: Sequence[PlayedGrid]
    usual: int

    def ticks_at(self, tick: int) -> int:
        """Length of the beat at `tick`."""
        here = (s for s in reversed(self.played) if s.start_tick <= tick)
        found = next(here, None)
        return self.usual if found is None else found.grid.section.timing.beat_ticks


def _landing(raw: object, timing: GridTiming, faults: Faults) -> tuple[NDArray[np.void], list[Origin]]:
    """The strokes of the landing and the letter of each; none where the file has none."""
    return (np.zeros(0, NOTE_DTYPE), []) if raw is None else read_landing(raw, timing, faults, (LANDING,))


# --- how it is practised ----------------------------------------------------------------------------------------------


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


def _goals(goals: Goals, lesson: Lesson, faults: Faults) -> Goals:
    """The goals with their tempo in quarter notes a minute; notes what does not suit the lesson."""
    for i, part in enumerate(goals.bars):
        if part.last_bar >= lesson.score.bar_count and not faults:
            bars = lesson.score.bar_count
            text = f"expected a whole number from 1 to {bars}, for so many bars are played; found {part.last_bar + 1}"
            faults.add(("goals", "bars", i, "bars", 1), text)
    limbs = np.concatenate([lesson.score.notes["limb"], lesson.landing["limb"]])
    for limb in goals.limbs:
        if not faults and not np.isin(limbs, _who_may_be(limb)).any():
            faults.add(("goals", word(limb)), f"the {limb_name(limb)} plays nothing in this lesson", at_key=True)
    target = goals.target_tempo_bpm
    if target is None:
        return goals
    target_bpm = target * lesson.beat_ticks / PPQ
    if target_bpm < lesson.tempo_bpm:
        text = f"{target:g} is below the tempo, {lesson.beats_a_minute:g}; expected that or more, or a slower tempo_bpm"
        faults.add(("goals", "target_tempo_bpm"), text)
    return replace(goals, target_tempo_bpm=target_bpm)


def _who_may_be(limb: Limb) -> list[Limb]:
    """What a note's limb is where `limb` may play it: nobody's notes are the hands'."""
    return [limb, Limb.UNKNOWN] if limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND) else [limb]


def _check_prerequisites(lesson: Lesson, faults: Faults) -> None:
    earlier: set[str] = set()
    for i, name in enumerate(lesson.prerequisites):
        if name == lesson.name:
            faults.add(("prerequisites", i), f"{name} is this lesson itself; expected another")
        elif name in earlier:
            faults.add(("prerequisites", i), f"{name} stands here twice")
        earlier.add(name)
