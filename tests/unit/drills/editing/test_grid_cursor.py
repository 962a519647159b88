"""Where keys take the cursor, and which cells there are; places counted by hand."""

from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.editing.edit_lesson import edited
from station.drills.editing.grid_cursor import (
    Cursor,
    GridStep,
    Way,
    cell_ticks,
    letter_at,
    moved,
    nearest_cell,
    shown_bar,
    usual_step,
    within,
    writing,
)
from station.drills.editing.lesson_edits import REST, LineAt, TextLine
from station.drills.editing.letter_palette import line_letters, typed_letter, usual_letter
from station.drills.editing.page_reader import page_of

HIHAT, SNARE, RIDE = (LineAt(0, piece) for piece in (Piece.HIHAT, Piece.SNARE, Piece.RIDE))
PAGE = page_of(
    """
tempo_bpm = 80
[grid]
hihat = "| xx xx xx xx | xx (xxx) xx xx |"
snare = "| - o - o | - o - o |"
"""
)
E8, TRIPLET = PPQ // 2, PPQ // 3


def test_cells_are_those_of_the_step_but_in_a_tuplet_its_own() -> None:
    grid = PAGE.grids[0]
    assert cell_ticks(grid, 0, SNARE, GridStep.QUARTERS) == (0, PPQ, 2 * PPQ, 3 * PPQ)
    tuplet = (PPQ, PPQ + TRIPLET, PPQ + 2 * TRIPLET)
    assert cell_ticks(grid, 1, HIHAT, GridStep.EIGHTHS) == (0, E8, *tuplet, *(2 * PPQ + E8 * i for i in range(4)))
    assert nearest_cell((0, 10, 20), 19.9) == 10


def test_the_usual_step_is_the_coarsest_that_all_strokes_stand_on() -> None:
    assert usual_step(PAGE) is GridStep.EIGHTHS
    assert usual_step(page_of('[grid]\nsnare = "| o--o ---- ---- ---- |"\n')) is GridStep.SIXTEENTHS
    assert usual_step(page_of('[grid]\nsnare = "| o-o o-- --- --- |"\n')) is GridStep.TRIPLETS


def test_arrows_go_cell_by_cell_through_a_tuplet_and_over_bars() -> None:
    at, ticks = Cursor(0, 0, 3 * PPQ + E8, HIHAT), []
    for _ in range(6):
        at = moved(PAGE, at, Way.RIGHT, GridStep.EIGHTHS)
        ticks.append((at.bar, at.tick))
    tuplet = [(1, PPQ), (1, PPQ + TRIPLET), (1, PPQ + 2 * TRIPLET)]
    assert ticks == [(1, 0), (1, E8), *tuplet, (1, 2 * PPQ)]
    back = moved(PAGE, Cursor(0, 1, 0, HIHAT), Way.LEFT, GridStep.EIGHTHS)
    assert (back.bar, back.tick) == (0, 3 * PPQ + E8)


def test_beats_bars_lines_and_ends() -> None:
    at = Cursor(0, 0, PPQ + E8, HIHAT)
    step = GridStep.EIGHTHS
    assert moved(PAGE, at, Way.BEAT_ON, step).tick == 2 * PPQ
    assert moved(PAGE, at, Way.BEAT_BACK, step).tick == PPQ
    assert moved(PAGE, at, Way.BAR_ON, step) == Cursor(0, 1, 0, HIHAT)
    assert moved(PAGE, at, Way.DOWN, step).line == SNARE
    assert moved(PAGE, moved(PAGE, at, Way.UP, step), Way.UP, step).line == HIHAT
    assert moved(PAGE, at, Way.END, step) == Cursor(0, 1, 0, HIHAT)
    last = Cursor(0, 1, 3 * PPQ + E8, HIHAT)
    assert moved(PAGE, last, Way.RIGHT, step) == last, "the music ends there"


def test_a_cursor_is_held_within_what_is_there() -> None:
    assert within(PAGE, Cursor(7, 9, 99 * PPQ, LineAt(7, Piece.SNARE))) == Cursor(0, 1, 4 * PPQ - 1, SNARE)
    assert within(PAGE, Cursor(0, 0, 0, RIDE)).line == RIDE, "a line that may be made"
    assert letter_at(PAGE.grids[0], Cursor(0, 0, PPQ, SNARE)) == "o"


def test_each_line_has_its_letters() -> None:
    assert [usual_letter(line) for line in (HIHAT, SNARE, TextLine.STICKING)] == ["x", "o", "R"]
    assert line_letters(SNARE)["X"] == "cross-stick, accent"
    assert line_letters(HIHAT)["o"] == "open"
    assert typed_letter(SNARE, "h", "-") is None
    assert typed_letter(TextLine.STICKING, "l", "R") == "L"
    assert [typed_letter(TextLine.LOUDNESS, "p", now) for now in ("-", "p", "pp", "ppp")] == ["p", "pp", "ppp", "p"]


RUNS_ON = """title = "T"

[grid]
hihat = "| xxxx | xxxx |"

[grid.cycle]
meter = "3/4"
kick = "o-x"
"""
CYCLE = LineAt(0, Piece.KICK, cycle=0)


def test_a_cycle_is_seen_as_it_runs_on_over_the_bars_and_written_in_its_own() -> None:
    text = RUNS_ON.replace("o-x", "o-X")
    page = page_of(text)
    grid = page.grids[0]
    first, second = (shown_bar(grid, bar, CYCLE) for bar in (0, 1))
    assert "".join(cell.letter for cell in (*first.cells, *second.cells)) == "o-Xo-Xo-"
    assert [cell.tick // PPQ for cell in second.cells] == [0, 1, 2, 3]
    assert (first.repeats, second.repeats) == (False, True)
    at = Cursor(0, 1, PPQ, CYCLE)  # the third beat of the cycle's second pass
    assert letter_at(grid, at) == "X"
    text = edited(text, writing(page, at, REST))
    assert 'kick = "o--"' in text or 'kick = "| o - - |"' in text
    assert cell_ticks(grid, 0, CYCLE, GridStep.QUARTERS) == (0, PPQ, 2 * PPQ, 3 * PPQ)
    half = [tick for tick in cell_ticks(grid, 1, CYCLE, GridStep.EIGHTHS) if tick % PPQ]
    assert half == [PPQ // 2 + PPQ * beat for beat in range(4)]
