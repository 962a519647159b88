"""What a text means while it is written: its grids, its lesson or its faults, and where in it the music is played."""

from dataclasses import dataclass, replace

from station.core.toml.toml_faults import Fault
from station.drills.editing.grid_cursor import BarRange, Place
from station.drills.editing.grid_page import GridPage
from station.drills.editing.page_reader import page_of
from station.drills.editing.words.fault_cells import FaultCell, fault_cells
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.music.score import Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

NEW_LESSON = """\
title = "New lesson"
tempo_bpm = 80

[grid]
#           1& 2& 3& 4&
hihat  = "| -- -- -- -- |"
snare  = "| -- -- -- -- |"
kick   = "| -- -- -- -- |"
"""
"""What one begins with: a bar of the three pieces that most grooves are made of (our choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class ReadDraft:
    """A text as it was read: `lesson` None where there are `faults`, which are about `fault_cells` of its page."""

    text: str
    page: GridPage
    lesson: Lesson | None
    faults: tuple[Fault, ...] = ()
    fault_cells: tuple[FaultCell, ...] = ()


def read_draft(text: str, name: str) -> ReadDraft:
    """What the text of the lesson called `name` means; nothing is raised, whatever it is."""
    reading = parse_lesson(text, f"{name}.toml", name)
    faults = tuple(reading.faults)
    return ReadDraft(text, page_of(text), reading.lesson, faults, fault_cells(text, faults))


def place_of_played(lesson: Lesson, page: GridPage, bar: int, tick: int) -> Place | None:
    """Where in the text `bar` (from 0) of the lesson as it is played stands; None behind its end."""
    section = next((each for each in lesson.sections if each.first_bar <= bar <= each.last_bar), None)
    if section is None or section.grid >= len(page.grids):
        return None
    return Place(section.grid, (bar - section.first_bar) % max(page.grids[section.grid].bar_count, 1), tick)


def played_bars(lesson: Lesson, bars: BarRange) -> tuple[int, int] | None:
    """First and last bar, from 0, of bars of the text where they are played first; None where they never are."""
    section = next((each for each in lesson.sections if each.grid == bars.grid), None)
    if section is None:
        return None
    first, last = section.first_bar + bars.first, section.first_bar + bars.last
    return (first, min(last, section.last_bar)) if first <= section.last_bar else None


def loop_of(draft: ReadDraft, bars: BarRange) -> Score:
    """The music of some bars of a text, at their tempo: silent bars where the text has none that could be read."""
    played = None if draft.lesson is None else played_bars(draft.lesson, bars)
    if draft.lesson is not None and played is not None:
        return draft.lesson.score.bars(*played)
    grid, meters, tick = draft.page.grids[bars.grid], list[MeterChange](), 0
    for frame in grid.frames[bars.first : bars.last + 1]:
        meters.append(replace(frame.meter, tick=tick))
        tick += frame.meter.bar_ticks
    tempo = TempoChange.from_bpm(0, grid.tempo_bpm)
    return Score.from_notes([], TempoMap.build([tempo], meters), tick)
