"""The text of a lesson from its lines, four bars a grid; `lesson_text` lays it out.

A bar of a line is written as beats with blanks between them, `"o--o (ooo) oo x"`, as in a lesson file.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from textwrap import fill

from station.drills.lesson import LEVELS
from station.drills.writing.lesson_text import show

BARS_A_GRID = 4
"""Bars that stand beside each other: a phrase, and as wide as a screen is (our choice)."""
ABOUT_WIDTH = 112
"""Columns of the text about a lesson: what an editor shows (our choice)."""


@dataclass(frozen=True, slots=True)
class Page:
    """One lesson's words and `lines`: each line's bars in order, all lines with as many bars.

    `tempo_bpm` and `target_tempo_bpm` count beats a minute; `extra` are further lines of the file's head; `landing` is
    what is struck where the last loop ends.
    """

    title: str
    level: int
    tags: Sequence[str]
    about: str
    tempo_bpm: int
    target_tempo_bpm: int
    lines: Mapping[str, Sequence[str]]
    meter: str = "4/4"
    passes: int = 8
    extra: Sequence[str] = ()
    landing: Mapping[str, str] = field(default_factory=lambda: {"snare": "O"})

    @property
    def text(self) -> str:
        """The file, ready to be read."""
        tags = ", ".join(f'"{tag}"' for tag in self.tags)
        head = [
            f'title = "{self.title}"',
            'author = "The drum station"',
            f"level = {self.level}",
            f"tags = [{tags}]",
            f'about = """\n{fill(self.about, ABOUT_WIDTH)}\n"""',
            f"tempo_bpm = {self.tempo_bpm}",
            f'meter = "{self.meter}"',
            f"passes = {self.passes}",
            *self.extra,
            "",
            "[goals]",
            f"target_tempo_bpm = {self.target_tempo_bpm}",
        ]
        landing = ["", "[landing]", *(f'{line} = "{letter}"' for line, letter in self.landing.items())]
        return show("\n".join([*head, *self._grids(), *landing]) + "\n")

    def _grids(self) -> list[str]:
        bars = len(next(iter(self.lines.values())))
        starts = range(0, bars, BARS_A_GRID)
        rows: list[str] = []
        for start in starts:
            part = {name: " | ".join(line[start : start + BARS_A_GRID]) for name, line in self.lines.items()}
            rows += ["", "[[grid]]" if len(starts) > 1 else "[grid]"]
            rows += [f'{name} = "| {line} |"' for name, line in part.items()]
        return rows


def level_word(level: int) -> str:
    """A level in words, for a title."""
    return LEVELS[level]
