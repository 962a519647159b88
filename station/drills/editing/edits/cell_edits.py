"""Single cells: a stroke set or erased, a beat cut anew."""

from station.core.pieces import CYMBALS, Articulation, Piece, word
from station.drills.editing.bar_text import BarSetting, cell_at, with_cut, with_letter
from station.drills.editing.draft import Draft
from station.drills.editing.edits.own_lines import with_own_line
from station.drills.editing.lesson_edits import REST, CutBeat, LineAt, SetStroke, TextLine
from station.drills.editing.line_words import bar_total, with_bar, written_text
from station.drills.grid.grid import MAX_CELLS_A_BEAT, bar_of
from station.drills.grid.skeletons import GridSetting
from station.drills.grid.tab_symbols import BEYOND, CHOKE, HOLD, RESTS, SYMBOLS, family_of, not_a_letter


def set_stroke(draft: Draft, edit: SetStroke) -> Draft:
    """The draft with a letter at a tick, or without one."""
    at = edit.line
    check_letter(draft, at.piece, edit.letter)
    check_place(draft, at.grid, edit.bar, edit.tick, at.cycle)
    line = draft.line(at, at.grid)
    if stands(draft, line.text if line else None, at, at.grid, edit.bar, edit.tick) == edit.letter:
        return draft
    draft, path = with_own_line(draft, at, at.grid)
    line = draft.line(at, at.grid)
    assert line is not None
    setting = setting_of(draft, at, at.grid, edit.bar)
    word = sound_word(draft, line.text, setting, edit.bar, at)
    changed = with_letter(word, edit.tick, edit.letter, setting)
    if changed is None:
        raise draft.refused("no cell can begin there without moving what stands in the bar", place_words(at, edit.bar))
    return draft.with_lines({path: with_bar(line.text, edit.bar, changed)})


def cut_beat(draft: Draft, edit: CutBeat) -> Draft:
    """The draft with beats of one line, or of all that are played and their sticking, in other cells."""
    cycle = edit.line.cycle if edit.line else None
    check_place(draft, edit.grid, edit.bar, 0, cycle)
    if not 1 <= edit.cells <= MAX_CELLS_A_BEAT:
        raise draft.refused(f"{edit.cells} cells in a beat; expected 1 to {MAX_CELLS_A_BEAT}")
    spans = draft.frame(edit.grid, edit.bar, cycle).spans
    if edit.beat is not None and not 0 <= edit.beat < len(spans):
        raise draft.refused(f"there is no beat {edit.beat + 1}; the bar has {len(spans)}", f"bar {edit.bar + 1}")
    for at in [edit.line] if edit.line else _all_lines(draft, edit.grid):
        for beat in range(len(spans)) if edit.beat is None else (edit.beat,):
            draft = _cut(draft, at, edit, beat)
    return draft


def _all_lines(draft: Draft, grid: int) -> list[LineAt | TextLine]:
    return [line.at for line in draft.lines(grid) if line.cycle is None and line.at is not TextLine.LOUDNESS]


def _cut(draft: Draft, at: LineAt | TextLine, edit: CutBeat, beat: int) -> Draft:
    setting = setting_of(draft, at, edit.grid, edit.bar)
    line = draft.line(at, edit.grid)
    word = None if line is None else sound_word(draft, line.text, setting, edit.bar, at)
    if word is not None and _cells_in(word, setting, beat) == edit.cells:
        return draft
    draft, path = with_own_line(draft, at, edit.grid)
    line = draft.line(at, edit.grid)
    assert line is not None
    changed = with_cut(written_text(line.text, edit.bar), beat, edit.cells, setting)
    if changed is None:
        raise draft.refused(f"{edit.cells} cells do not fit that beat beside the others", place_words(at, edit.bar))
    return draft.with_lines({path: with_bar(line.text, edit.bar, changed)})


def _cells_in(word: str, setting: BarSetting, beat: int) -> int:
    start, length = setting.frame.spans[beat]
    return sum(start <= cell.tick < start + length for cell in bar_of(word, setting.frame).cells)


# --- what every edit of a bar asks ------------------------------------------------------------------------------------


def check_place(draft: Draft, grid: int, bar: int, tick: int, cycle: int | None = None) -> None:
    """Raise `BadInput` where the draft has no such grid, cycle, bar or tick."""
    cycles = len(draft.cycle_tables(grid))
    if cycle is not None and not 0 <= cycle < cycles:
        raise draft.refused(f"there is no cycle {cycle + 1}; the grid has {cycles}")
    bars = draft.bar_count(grid, cycle)
    if not 0 <= bar < bars:
        raise draft.refused(f"there is no bar {bar + 1}; the grid has {bars}")
    length = draft.frame(grid, bar, cycle).meter.bar_ticks
    if not 0 <= tick < length:
        raise draft.refused(f"tick {tick} lies outside the bar, which has {length}", f"bar {bar + 1}")


def setting_of(draft: Draft, at: LineAt | TextLine, grid: int, bar: int) -> BarSetting:
    """What the letters of a line mean in a bar."""
    cycle, family = (at.cycle, family_of(at.piece)) if isinstance(at, LineAt) else (None, None)
    return BarSetting(GridSetting(draft.frame(grid, bar, cycle), draft.timings[grid].swing), family)


def sound_word(draft: Draft, line: str, setting: BarSetting, bar: int, at: LineAt | TextLine) -> str:
    """What a bar of a line plays; raises `BadInput` where it is missing or at fault."""
    word = written_text(line, bar) if bar < bar_total(line) else ""
    if not bar_of(word, setting.frame).sound:
        raise draft.refused("this bar of the line is at fault; mend it in the text first", place_words(at, bar))
    return word


def stands(draft: Draft, line: str | None, at: LineAt | TextLine, grid: int, bar: int, tick: int) -> str:
    """The letter that begins at a tick of a line, a rest where none does; nothing where the bar is missing."""
    if line is None:
        return REST
    if bar >= bar_total(line):
        return ""
    cell = cell_at(written_text(line, bar), setting_of(draft, at, grid, bar).frame, tick)
    return REST if cell is None or cell.letter in RESTS else cell.letter


def place_words(at: LineAt | TextLine, bar: int) -> str:
    """A line and a bar of it, as faults name them."""
    return f"{word(at.piece) if isinstance(at, LineAt) else at}, bar {bar + 1}"


def check_letter(draft: Draft, piece: Piece, letter: str) -> None:
    """Raise `BadInput` for what no line of the piece knows."""
    family = family_of(piece)
    buzzes = any(symbol.articulation is Articulation.BUZZ for symbol in SYMBOLS[family].values())
    known = {*SYMBOLS[family], REST, BEYOND, *(HOLD if buzzes else ""), *(CHOKE if piece in CYMBALS else "")}
    if letter not in known:
        raise draft.refused(not_a_letter(letter, family))
