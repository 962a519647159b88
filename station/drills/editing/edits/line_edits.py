"""Whole lines: added as rests, taken away."""

from station.core.toml.toml_edits import without
from station.drills.editing.draft import Draft, same_line
from station.drills.editing.edits.own_lines import silence, with_own_line
from station.drills.editing.lesson_edits import AddLine, LineAt, RemoveLine


def add_line(draft: Draft, edit: AddLine) -> Draft:
    """The draft with a line of rests, unless the grid has that line already."""
    grid = edit.line.grid
    return draft if draft.line(edit.line, grid) else with_own_line(draft, edit.line, grid)[0]


def remove_line(draft: Draft, edit: RemoveLine) -> Draft:
    """The draft without a line; a variation whose model has that line keeps silent there."""
    lines = [line for line in draft.lines(edit.grid) if isinstance(line.at, LineAt)]
    line = draft.line(edit.line, edit.grid)
    if line is None:
        raise draft.refused("the grid has no such line")
    if [each for each in lines if not same_line(each.at, edit.line)] == []:
        raise draft.refused("a grid needs a line to play; this is its last")
    model = draft.grids[edit.grid].like
    if model is not None and (not line.is_own or _model_has(draft, edit, model)):
        draft, path = with_own_line(draft, edit.line, edit.grid)
        return draft.with_lines({path: silence(draft, edit.line, edit.grid)})
    alone = [each for each in lines if each.cycle == line.cycle] == [line] and line.cycle is not None
    return draft.now(without(draft.text, line.path[: line.path.index("cycle") + 2] if alone else line.path))


def _model_has(draft: Draft, edit: RemoveLine, model: int) -> bool:
    """Whether the model plays what the variation's own line takes the place of."""
    if isinstance(edit.line, LineAt):
        piece = edit.line.piece
        return any(isinstance(each.at, LineAt) and each.at.piece is piece for each in draft.lines(model))
    return draft.line(edit.line, model) is not None
