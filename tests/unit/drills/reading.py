"""Small words that the tests of lessons share."""

from station.core.toml.toml_faults import Fault
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.music.score import Note

QUARTER = PPQ
EIGHTH, SIXTEENTH, THIRTY_SECOND = PPQ // 2, PPQ // 4, PPQ // 8
TRIPLET = PPQ // 3
WHOLE = 4 * PPQ


def text_of(grid: str, head: str = "tempo_bpm = 60") -> str:
    return f'title = "T"\n{head}\n[grid]\n{grid}\n'


def read(grid: str, head: str = "tempo_bpm = 60") -> Lesson:
    """The lesson of these grid lines; fails where it has a fault."""
    reading = parse_lesson(text_of(grid, head), "test.toml", "test")
    assert reading.faults == []
    assert reading.lesson
    return reading.lesson


def notes(grid: str, head: str = "tempo_bpm = 60") -> list[Note]:
    return list(read(grid, head).score)


def ticks(grid: str, head: str = "tempo_bpm = 60") -> list[int]:
    return [n.tick for n in notes(grid, head)]


def faults(text: str) -> list[Fault]:
    return parse_lesson(text, "test.toml", "test").faults
