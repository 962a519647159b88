"""The page of a text: what stands in its grids, and where, against the score that the reader makes of it."""

from pathlib import Path

import pytest

from station.core.pieces import Articulation, Ornament, Piece
from station.core.units import PPQ
from station.drills.editing.grid_page import GridPage, PageGrid, PageLine
from station.drills.editing.lesson_edits import LineAt, TextLine
from station.drills.editing.page_reader import page_of
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson

LESSONS = sorted(p for p in Path("lessons").glob("*/*.toml") if p.parent.name != "courses")
NO_STROKE = "-~#*"


def written(lesson: Lesson) -> set[tuple[int, int, Piece]]:
    """The bar, its tick as notation has it and the piece of each stroke of the score, once for grace strokes."""
    found: set[tuple[int, int, Piece]] = set()
    half: set[Piece] = set()
    score = lesson.score
    for note, bar in zip(score, score.bar.tolist(), strict=True):
        if note.lead_ms:
            continue
        is_double = note.ornament in (Ornament.DIDDLE, Ornament.ROLL) and note.articulation is not Articulation.BUZZ
        if is_double:
            half ^= {note.piece}
            if note.piece not in half:
                continue
        found.add((bar, note.tick - note.swing_ticks - score.tempo_map.bar_start(bar), note.piece))
    return found


def shown(lesson: Lesson, page: GridPage) -> set[tuple[int, int, Piece]]:
    """The same of the page, its grids laid out as the lesson's sections are."""
    by_name = {grid.name: grid for grid in page.grids}
    named = all(grid.name for grid in page.grids)
    found = set()
    for number, section in enumerate(lesson.sections):
        grid = by_name[section.name] if named else page.grids[number]
        for bar in range(section.first_bar, section.last_bar + 1):
            found |= {(bar, *stroke) for stroke in strokes_of(grid, (bar - section.first_bar) % grid.bar_count)}
    return found


def is_in_cycle(line: PageLine) -> bool:
    return isinstance(line.at, LineAt) and line.at.cycle is not None


def strokes_of(grid: PageGrid, bar: int) -> set[tuple[int, Piece]]:
    return {
        (cell.tick, line.piece)
        for line in grid.lines
        if line.piece is not None and not is_in_cycle(line)
        for cell in line.bars[bar].cells
        if cell.letter not in NO_STROKE
    }


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_the_page_of_a_shipped_lesson_has_the_strokes_of_its_score(path: Path) -> None:
    text = path.read_text("utf-8")
    lesson = parse_lesson(text, path.name, path.stem).lesson
    page = page_of(text)
    assert lesson is not None
    assert len(page.grids) == text.count("[[grid]]") + text.count("[grid]\n")
    in_cycles = {line.piece for grid in page.grids for line in grid.lines if is_in_cycle(line)}
    assert shown(lesson, page) == {stroke for stroke in written(lesson) if stroke[2] not in in_cycles}


TWO = """
title = "T"
[[grid]]
name = "A"
hihat = "x-x- x-x- x-x- (xxx) | %"
sticking = "R---------------|%"
loudness = "mf<<<<<<<<<<<<<f | ----"
kick = "o---|%"
[[grid]]
name = "B"
like = "A"
snare = "--o- | %"
left_hand.tom_1 = "-o-|-"
"""


def test_a_page_shows_lines_from_the_top_with_their_cells() -> None:
    """By hand: a 4/4 bar has 4 quarters, its fourth in parentheses is three thirds of one."""
    first, second = page_of(TWO.replace("x-x- x-x- x-x- (xxx)", "x-x-x- (xxx)")).grids
    assert [line.at for line in first.lines] == [
        LineAt(0, Piece.HIHAT),
        TextLine.STICKING,
        TextLine.LOUDNESS,
        LineAt(0, Piece.KICK),
    ]
    hihat, repeat = first.lines[0].bars
    assert [cell.tick for cell in hihat.cells[-4:]] == [
        PPQ * 5 // 2,
        3 * PPQ,
        3 * PPQ + PPQ // 3,
        3 * PPQ + 2 * PPQ // 3,
    ]
    assert [cell.in_tuplet for cell in hihat.cells[-4:]] == [False, True, True, True]
    assert repeat.repeats
    assert repeat.cells == hihat.cells
    marks = [(cell.tick, cell.letter) for cell in first.lines[2].bars[0].cells]
    assert marks[:2] == [(0, "mf"), (PPQ // 2, "<")]
    assert marks[-1] == (4 * PPQ - PPQ // 4, "f")
    assert second.like == 0
    assert [line.is_own for line in second.lines] == [False, True, True, False, False, False]


@pytest.mark.parametrize(
    "text", ["", "grid = 3", "[grid]\nsnare = 1", "= no toml", '[grid]\nsnare = "o"\nmeter = "x"', "[[grid]]"]
)
def test_no_text_is_too_strange_for_a_page(text: str) -> None:
    assert not any(bar.cells for grid in page_of(text).grids for line in grid.lines for bar in line.bars)


def test_a_bar_at_fault_has_no_cells_and_keeps_its_place() -> None:
    (grid,) = page_of('[grid]\nsnare = "o--- | ooooo | -o-- "\nkick = "o|o|o"').grids
    assert [len(bar.cells) for bar in grid.lines[0].bars] == [4, 0, 4]
    assert grid.bar_count == 3
