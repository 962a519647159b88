"""`edited`: the text of a lesson after an edit, which keeps everything that the edit does not touch.

Every edit of `lesson_edits` is done by one function over a `Draft`, listed here; then `upkeep` takes away what the
edit has orphaned, and the lines of the grids that changed are laid out as `show` does.
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from station.core.errors import BadInput
from station.drills.editing.draft import Draft
from station.drills.editing.edits.bar_edits import add_bars, copy_bars, remove_bars
from station.drills.editing.edits.cell_edits import cut_beat, set_stroke
from station.drills.editing.edits.fold_kit import fold
from station.drills.editing.edits.grid_edits import add_grid, remove_grid
from station.drills.editing.edits.key_edits import set_key
from station.drills.editing.edits.line_edits import add_line, remove_line
from station.drills.editing.edits.play_in_text import play_in
from station.drills.editing.edits.sign_edits import set_sign
from station.drills.editing.edits.timing_upkeep import with_timing_kept
from station.drills.editing.edits.upkeep import kept_sound
from station.drills.editing.lesson_edits import (
    AddBars,
    AddGrid,
    AddLine,
    CopyBars,
    CutBeat,
    Fold,
    LessonEdit,
    PlayIn,
    RemoveBars,
    RemoveGrid,
    RemoveLine,
    SetKey,
    SetSign,
    SetStroke,
    SetText,
)
from station.drills.writing.lesson_text import with_grids_shown

_BY_PLACE: Mapping[type, Callable[[Draft, Any], Draft]] = MappingProxyType(
    {
        SetStroke: set_stroke,
        SetSign: set_sign,
        CutBeat: cut_beat,
        AddLine: add_line,
        RemoveLine: remove_line,
        AddBars: add_bars,
        RemoveBars: remove_bars,
        CopyBars: copy_bars,
        AddGrid: add_grid,
        RemoveGrid: remove_grid,
        PlayIn: play_in,
        Fold: fold,
    }
)
"""What does each edit that has a place in the music."""


def edited(text: str, edit: LessonEdit, name: str = "") -> str:
    """The text after an edit; raises `BadInput`, which has `name` for the file, where that cannot be done.

    A text that was sound is so after every edit by place, but for what hands cannot play; after `SetText` and `SetKey`
    it is whatever was asked for.
    """
    try:
        return _edited(text, edit)
    except BadInput as refused:
        raise BadInput(name, refused.place, refused.fault) from None


def _edited(text: str, edit: LessonEdit) -> str:
    if isinstance(edit, SetText):
        return edit.text
    before = Draft.of(text)
    if isinstance(edit, SetKey):
        return set_key(before, edit).text
    before.check_length()
    after = _BY_PLACE[type(edit)](before, edit)
    if after.text == before.text:
        return before.text
    index_of = _index_of(before, after, edit)
    if not isinstance(edit, PlayIn | Fold):  # which say the timing themselves
        after = with_timing_kept(before, after, edit, index_of)
    after = kept_sound(before, after, edit, index_of)
    return _shown(before, after).text


def _index_of(before: Draft, after: Draft, edit: object) -> Mapping[int, int]:
    """Where each grid is after the edit: grids that it adds or takes away are known by their names and neighbours."""
    count = len(before.grids)
    if isinstance(edit, AddGrid):
        new = next(i for i, grid in enumerate(after.grids) if grid.name == edit.name.strip())
        return {i: i + (i >= new) for i in range(count)}
    if isinstance(edit, RemoveGrid):
        gone = {edit.grid, *before.grids[edit.grid].endings.values()}
        return {was: now for now, was in enumerate(i for i in range(count) if i not in gone)}
    return {i: i for i in range(count)}


def _shown(before: Draft, after: Draft) -> Draft:
    """The draft with the lines of those grids laid out that say something else, or say it themselves now."""
    known = [(grid.raw, grid.own) for grid in before.grids]
    changed = [grid.path for grid in after.grids if (grid.raw, grid.own) not in known]
    return after.now(with_grids_shown(after.text, after.raw, after.places, changed))
