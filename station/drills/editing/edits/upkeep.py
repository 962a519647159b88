"""What goes with an edit so that a sound text stays sound: hands without a stroke, holds without a roll, ends of marks.

The grid's own reader says what is at fault. Signs that the edit has orphaned are taken away or suit what is left; what
else would be a fault of the grid refuses the edit. A grid that was at fault before is left as it is.
"""

from collections.abc import Mapping, Sequence
from functools import lru_cache

from station.core.pieces import Limb
from station.core.toml.toml_faults import Faults, Noted, Wrong
from station.core.toml.toml_places import KeyPath
from station.drills.editing.draft import Draft
from station.drills.editing.edits.cell_edits import setting_of
from station.drills.editing.edits.own_lines import with_own_copies
from station.drills.editing.lesson_edits import REST, SetSign, SetStroke, TextLine
from station.drills.editing.line_words import bar_total, with_all_bars, written_text
from station.drills.grid.cell_strokes import BarClock, WrittenCell, parted
from station.drills.grid.grid import GridFrame, bar_of, parse_line
from station.drills.grid.grid_reader import GridSection, read_grid
from station.drills.grid.loudness_line import letter_runs
from station.drills.grid.sticking_line import BOTH, HANDS, is_of_a_hand, sign_fault
from station.drills.grid.tab_symbols import CHOKE, HOLD, RESTS
from station.drills.reading.lesson_fields import DEFAULT_TIMING
from station.drills.writing.written_meters import timing_said

_LETTER_OF = {limb: letter for letter, limb in HANDS.items()}
_KEPT = 32
"""Grids that are kept as they were read: the next edit asks again for those that this one left."""
_ROUNDS = 8
"""So often what was mended is read again; each round takes away what the last one orphaned (our choice)."""


def kept_sound(before: Draft, after: Draft, edit: object, index_of: Mapping[int, int] | None = None) -> Draft:
    """The draft after an edit, mended where that orphaned a sign; raises `BadInput` where it would be at fault.

    `index_of` says where each grid is afterwards.
    """
    places = {i: i for i in range(len(before.grids))} if index_of is None else index_of
    for was, now in places.items():
        if before.grids[was].raw != after.grids[now].raw or before.timings[was] != after.timings[now]:
            after = _grid_kept(before, after, was, now, edit)
    new = set(range(len(after.grids))) - set(places.values())
    for now in new:
        if faults := _read(after, now)[1]:
            raise after.refused(faults[0].words)
    return after


def _grid_kept(before: Draft, after: Draft, was: int, now: int, edit: object) -> Draft:
    section: GridSection | None = None
    for _ in range(_ROUNDS):
        read, faults = _read(after, now)
        if not faults:
            return after
        if section is None:
            section, old = _read(before, was)
            if old:
                return after
        if _is_own(edit, after, now, faults):
            raise after.refused(faults[0].words, "")
        mended = _mended(after, now, faults, section, read, edit)
        if mended is after:
            raise after.refused(faults[0].words)
        after = mended
    raise after.refused(faults[0].words)


@lru_cache(maxsize=_KEPT)
def _read(draft: Draft, grid: int) -> tuple[GridSection | None, list[Noted]]:
    """One grid as the reader has it, and its faults."""
    each = draft.grids[grid]
    first = timing_said(draft.raw, DEFAULT_TIMING)
    previous = grid - 1 if each.like is None else each.like
    faults = Faults()
    try:
        section = read_grid(each.raw, each.path, draft.timings[previous] if previous >= 0 else first, faults)
    except Wrong as found:
        return None, list(found.faults)
    return section, faults.noted


# --- the sign or letter that was set itself ---------------------------------------------------------------------------


def _is_own(edit: object, draft: Draft, grid: int, faults: Sequence[Noted]) -> bool:
    """Whether a fault is of the very letter that was set."""
    if not isinstance(edit, SetStroke | SetSign):
        return False
    index = edit.line.grid if isinstance(edit, SetStroke) else edit.grid
    line = draft.line(edit.line, grid)
    said = edit.letter if isinstance(edit, SetStroke) else edit.sign
    if index != grid or line is None or said == REST:
        return False
    chars = {fault.char for fault in faults if fault.path == line.path}
    bars = parse_line(line.text, _frames(draft, grid, line.cycle), lambda _char, _words: None)
    return any(cell.char in chars for cell in bars[edit.bar].cells if cell.tick == edit.tick)


def _frames(draft: Draft, grid: int, cycle: int | None = None) -> list[GridFrame]:
    meters = 1 if cycle is not None else len(draft.timings[grid].meters)
    return [draft.frame(grid, bar, cycle) for bar in range(meters)]


# --- what is mended ---------------------------------------------------------------------------------------------------


def _mended(
    draft: Draft, grid: int, faults: Sequence[Noted], was: GridSection | None, now: GridSection | None, edit: object
) -> Draft:
    """The draft without the orphaned signs among `faults`; the same one where there is nothing of that kind."""
    for line in draft.lines(grid):
        chars = [fault.char for fault in faults if fault.path == line.path and fault.char is not None]
        if not chars:
            continue
        if line.at is TextLine.STICKING and was and now:
            texts = _hands_mended(draft, grid, line.text, was, now)
        elif line.at is TextLine.LOUDNESS:
            texts = _marks_dropped(draft, grid, line.text, chars)
        else:
            texts = _texts(_without_chars(line.text, [c for c in chars if line.text[c : c + 1] in (HOLD, CHOKE)]))
        mended = with_all_bars(line.text, texts)
        if mended != line.text:
            draft = with_own_copies(draft, grid, [line])
            found = draft.line(line.at, grid)
            assert found is not None
            return draft.with_lines({found.path: mended})
    return _cycle_hands_dropped(draft, grid, faults)


def _texts(line: str) -> list[str]:
    return [written_text(line, bar) for bar in range(bar_total(line))]


def _without_chars(line: str, chars: Sequence[int]) -> str:
    letters = list(line)
    for char in chars:
        letters[char] = REST
    return "".join(letters)


def _marks_dropped(draft: Draft, grid: int, line: str, chars: Sequence[int]) -> list[str]:
    """The bars of a loudness line without the marks and hairpins at `chars`, and all cells of those hairpins."""
    dropped: list[int] = []
    is_dropped = False
    before = ""
    for bar in parse_line(line, _frames(draft, grid), lambda _char, _words: None):
        for run in letter_runs(bar.cells):
            said = "".join(cell.letter for cell in run)
            if said not in RESTS:
                is_dropped = any(cell.char in chars for cell in run) or (is_dropped and said == before)
                before = said
            dropped += [cell.char for cell in run] if is_dropped else []
    return _texts(_without_chars(line, dropped))


def _hands_mended(draft: Draft, grid: int, line: str, was: GridSection, now: GridSection) -> list[str]:
    """The bars of a sticking line whose letters suit the strokes: one that is left keeps its hand."""
    clock = BarClock(now.meters, now.timing.swing)
    strokes, before = _by_tick(now), _by_tick(was)
    texts = _texts(line)
    for number, bar in enumerate(now.meters[: len(texts)]):
        text = list(texts[number])
        frame = setting_of(draft, TextLine.STICKING, grid, number).frame
        for cell in bar_of(texts[number], frame).cells:
            tick = clock.place(bar.tick + cell.tick, cell.swings).played
            here = strokes.get(tick, [])
            if cell.letter not in RESTS and len(here) <= len(HANDS) and sign_fault(cell.letter, here):
                text[cell.char] = _suited(here, before.get(tick, []))
        texts[number] = "".join(text)
    return texts


def _by_tick(section: GridSection) -> dict[int, list[WrittenCell]]:
    """The strokes of the hands in one repetition that no cycle plays, by the moment at which they are heard."""
    asked, _ = parted(stroke for stroke in section.parts[0] if "cycle" not in stroke.origin.path)
    found: dict[int, list[WrittenCell]] = {}
    for stroke in filter(is_of_a_hand, asked):
        found.setdefault(stroke.place.played, []).append(stroke)
    return found


def _suited(here: Sequence[WrittenCell], before: Sequence[WrittenCell]) -> str:
    """The letter for these strokes, each in the hand that it had."""
    if len(here) == 1:
        limb = next((s.limb for s in before if s.piece is here[0].piece), Limb.UNKNOWN)
        letter = _LETTER_OF.get(limb, REST)
        return REST if letter == REST or sign_fault(letter, here) else letter
    return BOTH if len(here) == len(HANDS) and not sign_fault(BOTH, here) else REST


def _cycle_hands_dropped(draft: Draft, grid: int, faults: Sequence[Noted]) -> Draft:
    """The draft without the letters at fault in the sticking of a cycle."""
    for rel, cycle in draft.cycle_tables(grid):
        path: KeyPath = (*draft.grids[grid].path, *rel, TextLine.STICKING.value)
        chars = [fault.char for fault in faults if fault.path == path and fault.char is not None]
        text = cycle.get(TextLine.STICKING.value)
        if chars and isinstance(text, str) and path in draft.places.values:
            return draft.with_lines({path: _without_chars(text, chars)})
    return draft
