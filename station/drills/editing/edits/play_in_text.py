"""`PlayIn` done to a draft: the strokes set in their lines, each line once, and the timing of those that keep it."""

from collections.abc import Sequence
from math import isfinite

from station.drills.editing.bar_text import BarSetting, with_letter
from station.drills.editing.draft import Draft
from station.drills.editing.edits.cell_edits import check_letter, setting_of, sound_word
from station.drills.editing.edits.own_lines import with_own_line
from station.drills.editing.edits.timing_upkeep import key_of, late_of, with_late
from station.drills.editing.lesson_edits import LineAt, PlayIn, SetStroke
from station.drills.editing.line_words import alone, with_bar, written_text
from station.drills.editing.page_reader import page_of
from station.drills.editing.play_in import played_in
from station.drills.grid.grid import MAX_CELLS_A_BEAT, bar_of


def play_in(draft: Draft, edit: PlayIn) -> Draft:
    """The draft with what was played; raises `BadInput` where a bar is at fault or not there."""
    bars = draft.bar_count(edit.grid)
    if not 0 <= edit.first <= edit.last < bars:
        raise draft.refused(f"there are no bars {edit.first + 1} to {edit.last + 1}; the grid has {bars}")
    if not (1 <= edit.quantise.cells <= MAX_CELLS_A_BEAT and 0 <= edit.quantise.strength <= 1):
        raise draft.refused(f"expected 1 to {MAX_CELLS_A_BEAT} cells a beat, and a strength from 0 to 1")
    if not all(isfinite(stroke.at_ticks) for stroke in edit.strokes):
        raise draft.refused("a stroke at a time that is no number")
    result = played_in(edit, page_of(draft.text).grids[edit.grid], draft.timings[edit.grid])
    late = late_of(draft, edit.grid)
    for line in dict.fromkeys(stroke.line for stroke in result.edits):
        draft = with_strokes(draft, line, [stroke for stroke in result.edits if stroke.line == line])
    for stroke in result.edits:
        late.get(key_of(stroke.line), {}).pop((stroke.bar, stroke.tick), None)
    for stroke, ms in result.late_ms:
        late.setdefault(key_of(stroke.line), {})[stroke.bar, stroke.tick] = ms
    return with_late(draft, edit.grid, late)


def with_strokes(draft: Draft, at: LineAt, strokes: Sequence[SetStroke]) -> Draft:
    """The draft with several letters in a line; bars that repeat one of those bars stay as they are.

    A stroke goes to the nearest cell that is there where none can begin at its own without moving what stands in the
    bar: a take is not lost for one stroke.
    """
    draft, path = with_own_line(draft, at, at.grid)
    line = draft.line(at, at.grid)
    assert line is not None, "it is the grid's own now"
    text = line.text
    for stroke in strokes:
        check_letter(draft, at.piece, stroke.letter)
        setting = setting_of(draft, at, at.grid, stroke.bar)
        sound_word(draft, line.text, setting, stroke.bar, at)
        word = written_text(text, stroke.bar)
        changed = _with_stroke(word, stroke, setting)
        if changed != word:
            text = with_bar(alone(text, stroke.bar), stroke.bar, changed)
    return draft.with_lines({path: text})


def _with_stroke(word: str, stroke: SetStroke, setting: BarSetting) -> str:
    changed = with_letter(word, stroke.tick, stroke.letter, setting)
    if changed is None:
        cells = bar_of(word, setting.frame).cells
        nearest = min(cells, key=lambda cell: abs(cell.tick - stroke.tick))
        changed = with_letter(word, nearest.tick, stroke.letter, setting)
    assert changed is not None, "a cell begins there"
    return changed
