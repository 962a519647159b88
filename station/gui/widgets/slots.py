"""Rows of numbered slots: one row to take what a slot holds, one to keep what is there now in a slot."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from imgui_bundle import imgui

from station.gui import theme


@dataclass(frozen=True, slots=True)
class Use:
    """One row: its `words`, what is done with a slot (from 0), what its tooltip says; `word` tells its buttons apart.

    With `needs_filled` an empty slot cannot be pressed.
    """

    words: str
    word: str
    act: Callable[[int], object]
    tip: Callable[[int], str]
    needs_filled: bool = False


@dataclass(frozen=True, slots=True)
class Grid:
    """Where the buttons stand, in the window's pixels: `left` of the words' beginning, 0 below them; `a_row` in a line.

    `gap` None is imgui's own.
    """

    left: float
    width: float
    a_row: int
    gap: float | None = None


def popup_grid(slots: int) -> Grid:
    """All `slots` in a line beside the words, as in a popup, which is as wide as it needs."""
    return Grid(theme.points(74), theme.points(34), slots)


def slot_rows(uses: Sequence[Use], filled: Sequence[bool], grid: Grid) -> None:
    """Draw the rows, and do what is pressed; `filled` says of each slot whether it holds anything."""
    edge = imgui.get_cursor_pos_x()
    for use in uses:
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(use.words)
        for slot, is_filled in enumerate(filled):
            if slot % grid.a_row:
                imgui.same_line(0, -1 if grid.gap is None else grid.gap)
            elif grid.left:
                imgui.same_line(edge + grid.left)
            imgui.begin_disabled(use.needs_filled and not is_filled)
            if imgui.button(f"{slot + 1}##{use.word}{slot + 1}", imgui.ImVec2(grid.width, 0)):
                use.act(slot)
            imgui.end_disabled()
            theme.tooltip(use.tip(slot))
