"""The text of a lesson from its lines: aligned, with the count above them, four bars a grid.

A bar of a line is written as beats with blanks between them, `"o--o (ooo) oo x"`, as in a lesson file.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from textwrap import fill

from station.drills.lesson import LEVELS

BARS_A_GRID = 4
"""Bars that stand beside each other: a phrase, and as wide as a screen is (our choice)."""
ABOUT_WIDTH = 112
"""Columns of the text about a lesson: what an editor shows (our choice)."""
_COUNTS = {1: "", 2: "&", 3: "ta", 4: "e&a", 5: "2345", 6: "ta&ta.", 7: "234567", 8: ".e.&.a."}
"""What is counted after a beat's number, by how many cells it has."""


@dataclass(frozen=True, slots=True)
class Page:
    """One lesson's words and `lines`: each line's bars in order, all lines with as many bars.

    `tempo_bpm` and `target_tempo_bpm` count beats a minute; `extra` are further lines of the file's head.
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
    extra: Sequence[str] = field(default_factory=tuple)

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
        return "\n".join([*head, *self._grids()]) + "\n"

    def _grids(self) -> list[str]:
        bars = len(next(iter(self.lines.values())))
        starts = range(0, bars, BARS_A_GRID)
        rows: list[str] = []
        for start in starts:
            part = {name: line[start : start + BARS_A_GRID] for name, line in self.lines.items()}
            rows += ["", "[[grid]]" if len(starts) > 1 else "[grid]", *grid_rows(part)]
        return rows


def grid_rows(lines: Mapping[str, Sequence[str]]) -> list[str]:
    """The lines as they stand in a file, aligned beat by beat, under their count."""
    bars = [[bar.split() for bar in line] for line in lines.values()]
    at_once = [list(zip(*beats, strict=True)) for beats in zip(*bars, strict=True)]  # [bar][beat][line]
    widths = [[max(map(len, beat)) for beat in bar] for bar in at_once]
    name = max(map(len, lines))
    rows = [
        f"# {'':{name}}    {'   '.join(_count(bar, wide) for bar, wide in zip(at_once, widths, strict=True))}".rstrip()
    ]
    for key, line in zip(lines, bars, strict=True):
        cells = [
            " ".join(f"{b:{w}}" for b, w in zip(bar, wide, strict=True)) for bar, wide in zip(line, widths, strict=True)
        ]
        rows.append(f'{key:{name}} = "| {" | ".join(cells)} |"')
    return rows


def _count(bar: Sequence[Sequence[str]], widths: Sequence[int]) -> str:
    return " ".join(f"{_counted(i, beat):{width}}" for i, (beat, width) in enumerate(zip(bar, widths, strict=True), 1))


def _counted(number: int, beat: Sequence[str]) -> str:
    """The count of one beat, over the line that divides it most."""
    finest = max(beat, key=len)
    cells = len(finest.strip("()"))
    indent = " " if finest.startswith("(") else ""
    return f"{indent}{str(number)[-1]}{_COUNTS.get(cells, '')}"


def level_word(level: int) -> str:
    """A level in words, for a title."""
    return LEVELS[level]
