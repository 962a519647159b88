"""Signs: the hand under a stroke, the marks and hairpins of the loudness line."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from station.core.toml.schema import either
from station.drills.editing.bar_text import BarSetting, cell_at, finer_skeletons, with_letter
from station.drills.editing.draft import Draft
from station.drills.editing.edits.cell_edits import check_place, setting_of, sound_word, stands
from station.drills.editing.edits.own_lines import with_own_line
from station.drills.editing.lesson_edits import REST, SetSign, TextLine
from station.drills.editing.line_words import with_bar
from station.drills.grid.grid import bar_of
from station.drills.grid.loudness_line import STICK_HEIGHTS_IN, letter_runs
from station.drills.grid.sticking_line import BOTH, HANDS
from station.drills.grid.tab_symbols import RESTS
from station.music.loudness_marks import FADE, GROW

_HAIRPINS = (GROW, FADE)
_SIGNS = {TextLine.STICKING: (*HANDS, BOTH, REST), TextLine.LOUDNESS: (*STICK_HEIGHTS_IN, *_HAIRPINS, REST)}


def set_sign(draft: Draft, edit: SetSign) -> Draft:
    """The draft with a sign at a tick, or without one."""
    if edit.sign not in _SIGNS[edit.line]:
        raise draft.refused(f"{edit.sign!r} is no sign of the {edit.line} line; expected {either(_SIGNS[edit.line])}")
    check_place(draft, edit.grid, edit.bar, edit.tick)
    line = draft.line(edit.line, edit.grid)
    if line is None and edit.sign == REST:
        return draft
    is_sticking = edit.line is TextLine.STICKING
    if (
        is_sticking
        and stands(draft, line.text if line else None, edit.line, edit.grid, edit.bar, edit.tick) == edit.sign
    ):
        return draft
    setting = setting_of(draft, edit.line, edit.grid, edit.bar)
    draft, path = with_own_line(draft, edit.line, edit.grid)
    line = draft.line(edit.line, edit.grid)
    assert line is not None
    word = sound_word(draft, line.text, setting, edit.bar, edit.line)
    change = with_letter if is_sticking else with_mark
    changed = change(word, edit.tick, edit.sign, setting)
    if changed is None:
        raise draft.refused(f"there is no room for {edit.sign} there", f"{edit.line}, bar {edit.bar + 1}")
    return draft.with_lines({path: with_bar(line.text, edit.bar, changed)}) if changed != word else draft


# --- loudness ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Mark:
    """A mark, or the cells of a hairpin, from tick `start` to `end`."""

    word: str
    start: int
    end: int


def with_mark(word: str, tick: int, sign: str, setting: BarSetting) -> str | None:
    """The bar of a loudness line with `sign` at `tick`, cut finer where it needs room; None where there is none."""
    marks = [mark for mark in _marks_of(word, setting) if mark.start != tick and not _is_erased(mark, tick, sign)]
    if sign != REST:
        length = next((c.length_ticks for c in bar_of(word, setting.frame).cells if c.tick == tick), 1)
        marks.append(_Mark(sign, tick, tick + length))
    wanted = sorted((mark.start, mark.word) for mark in marks if mark.word not in _HAIRPINS)
    for skeleton in _skeletons(word, tick, setting):
        written = _with_marks(skeleton, marks, setting)
        if written and wanted == [(m.start, m.word) for m in _marks_of(written, setting) if m.word not in _HAIRPINS]:
            return written
    return None


def _is_erased(mark: _Mark, tick: int, sign: str) -> bool:
    return sign == REST and mark.word in _HAIRPINS and mark.start <= tick < mark.end


def _marks_of(word: str, setting: BarSetting) -> list[_Mark]:
    """The marks of a bar, and its hairpins, each from its first cell to its last."""
    marks: list[_Mark] = []
    for run in letter_runs(bar_of(word, setting.frame).cells):
        said, start = "".join(cell.letter for cell in run), run[0].tick
        end = run[-1].tick + run[-1].length_ticks
        if said in _HAIRPINS and marks and (marks[-1].word, marks[-1].end) == (said, start):
            marks[-1] = _Mark(said, marks[-1].start, end)
        elif said not in RESTS:
            marks.append(_Mark(said, start, end))
    return marks


def _skeletons(word: str, tick: int, setting: BarSetting) -> Iterator[str]:
    blank = list(word)
    for cell in bar_of(word, setting.frame).cells:
        blank[cell.char] = REST
    yield "".join(blank)
    yield from finer_skeletons(word, tick, setting.frame)


def _with_marks(skeleton: str, marks: Sequence[_Mark], setting: BarSetting) -> str | None:
    """The skeleton with these marks over the cells that they take; None where one has no cell of its own."""
    out = list(skeleton)
    cells = bar_of(skeleton, setting.frame).cells
    for mark in (mark for mark in marks if mark.word in _HAIRPINS):
        for cell in cells:
            if mark.start <= cell.tick < mark.end:
                out[cell.char] = mark.word
    for mark in (mark for mark in marks if mark.word not in _HAIRPINS):
        first = cell_at(skeleton, setting.frame, mark.start)
        here = cells[cells.index(first) :][: len(mark.word)] if first else ()
        if len(here) < len(mark.word):
            return None
        for cell, letter in zip(here, mark.word, strict=True):
            out[cell.char] = letter
    return "".join(out)
