"""The timing of a grid's strokes (`[grid.timing]`) while they are edited: each number stays with its stroke.

The text has a list of numbers for each line. Here a stroke's timing stands at its place, a bar and a tick; after an
edit the lists are written anew where they no longer say the same. A list that does not fit its line is left alone.
"""

from collections.abc import Mapping
from itertools import groupby

from station.core.pieces import USUAL_FEET, Limb, Piece
from station.core.toml.schema import said
from station.core.toml.toml_edits import with_pair, without
from station.core.toml.toml_faults import Wrong
from station.core.toml.toml_places import KeyPath
from station.core.toml.toml_write import toml_value
from station.drills.editing.draft import Draft, DraftLine
from station.drills.editing.edits.bar_edits import source_of
from station.drills.editing.lesson_edits import AddBars, CopyBars, LessonEdit, LineAt, RemoveBars
from station.drills.grid.grid import parse_line
from station.drills.grid.stroke_timing import STROKE_TIMING, STROKE_TIMINGS, LineTiming, line_timings
from station.drills.grid.tab_symbols import CHOKE, HOLD, RESTS

LineKey = tuple[Piece, Limb]
"""A line of a grid, by its piece and the limb that the text says, or custom."""
Place = tuple[int, int]
"""A bar of the grid and a tick of the bar, as written."""
Late = dict[LineKey, dict[Place, float]]
"""Of each line that has a timing the ms of each stroke."""

_ELSEWHERE = -1
"""Stands for the grid of another text that bars were copied from."""

_read = said(STROKE_TIMINGS, "line")


def key_of(line: LineAt) -> LineKey:
    """The line that `line` means."""
    limb = USUAL_FEET.get(line.piece, Limb.UNKNOWN) if line.limb is Limb.UNKNOWN else line.limb
    return line.piece, limb


def late_of(draft: Draft, grid: int) -> Late:
    """The timing of a grid's strokes, of those lines whose list fits them."""
    timings, found = _timings(draft, grid), Late()
    for line in _played(draft, grid) if timings else ():
        places, timing = stroke_places(draft, line), timings.get(_key(line))
        if timing and len(timing.late_ms) == len(places):
            found[_key(line)] = dict(zip(places, timing.late_ms, strict=True))
    return found


def with_late(draft: Draft, grid: int, late: Mapping[LineKey, Mapping[Place, float]]) -> Draft:
    """The draft whose grid has this timing of these lines: of each stroke, 0 where nothing is said.

    What the text says of a line that is not there goes.
    """
    for key in [_key(line) for line in _played(draft, grid) if _key(line) in late]:
        line = next(line for line in _played(draft, grid) if _key(line) == key)
        wanted = [late[key].get(place, 0) for place in stroke_places(draft, line)]
        timing = _timings(draft, grid).get(key)
        if list(timing.late_ms if timing else ()) != (wanted if any(wanted) else []):
            draft = draft.now(_written(draft, grid, line, timing, wanted))
    lines = {_key(line) for line in _played(draft, grid)}
    for timing in (timing for key, timing in _timings(draft, grid).items() if key not in lines):
        draft = draft.now(without(draft.text, timing.path))
    return draft


def with_timing_kept(before: Draft, after: Draft, edit: LessonEdit, index_of: Mapping[int, int]) -> Draft:
    """The draft after an edit with each stroke's timing as it was; `index_of` says where each grid is afterwards."""
    copied = source_of(before, edit) if isinstance(edit, CopyBars) else before
    if STROKE_TIMING not in before.text + copied.text:
        return after
    late = {grid: late_of(before, grid) for grid in index_of}
    if isinstance(edit, CopyBars) and edit.text:
        late[_ELSEWHERE] = late_of(copied, edit.grid)
    for was, now in sorted(index_of.items(), key=lambda pair: pair[1]):
        found = Late()
        unfit = _timings(before, was).keys() - late[was].keys()
        for line in (line for line in _played(after, now) if _key(line) not in unfit):
            found[_key(line)] = {}
            for bar, ticks in _by_bar(stroke_places(after, line)).items():
                grid, old_bar = _source(before, edit, was, bar)
                old = _in_bar(late.get(grid, {}).get(_key(line), {}), old_bar)
                found[_key(line)] |= {(bar, tick): ms for tick, ms in _kept(ticks, old).items()}
        if not _is_odd(after, now):
            after = with_late(after, now, found)
    return after


def _kept(ticks: list[int], old: Mapping[int, float]) -> Mapping[int, float]:
    """The timing of strokes at `ticks` of a bar: of as many strokes as before in their order, else by their places."""
    if len(ticks) == len(old):
        return dict(zip(ticks, old.values(), strict=True))
    return {tick: old.get(tick, 0) for tick in ticks}


def _source(before: Draft, edit: LessonEdit, grid: int, bar: int) -> tuple[int, int]:
    """The grid and bar of the draft before an edit that a bar of a grid comes from; −1 where it is new."""
    match edit:
        case AddBars(changed, at, count) if _takes_part(before, changed, grid):
            return grid, bar if bar < at else bar - count if bar >= at + count else -1
        case RemoveBars(changed, first, last) if _takes_part(before, changed, grid):
            return grid, bar if bar < first else bar + last - first + 1
        case CopyBars(source, first, last, to, at, over) if _takes_part(before, to, grid):
            count = last - first + 1
            if at <= bar < at + count and edit.text:
                return _ELSEWHERE, bar - at + first
            if at <= bar < at + count:
                return (grid if source == to else source), bar - at + first
            return grid, bar if bar < at or over else bar - count
        case _:
            return grid, bar


def _takes_part(before: Draft, changed: int, grid: int) -> bool:
    """Whether bars of a grid come and go with those of another, which it is or is like."""
    return grid == changed or grid in before.followers(changed)


# --- the text ---------------------------------------------------------------------------------------------------------


def stroke_places(draft: Draft, line: DraftLine) -> list[Place]:
    """Where each stroke of a line stands, in order; the bars of `%` have theirs."""
    grid = line.at.grid if isinstance(line.at, LineAt) else 0
    frames = draft.frames(grid)
    bars = parse_line(line.text, frames, lambda _char, _words: None) if frames else []
    silent = (*RESTS, HOLD, CHOKE)
    return [(i, cell.tick) for i, bar in enumerate(bars) for cell in bar.cells if cell.letter not in silent]


def _by_bar(places: list[Place]) -> dict[int, list[int]]:
    return {bar: [tick for _, tick in group] for bar, group in groupby(places, key=lambda place: place[0])}


def _in_bar(late: Mapping[Place, float], bar: int) -> dict[int, float]:
    return {tick: ms for (at, tick), ms in late.items() if at == bar}


def _played(draft: Draft, grid: int) -> list[DraftLine]:
    """The lines of a grid that may have a timing."""
    return [line for line in draft.lines(grid) if isinstance(line.at, LineAt) and line.cycle is None]


def _key(line: DraftLine) -> LineKey:
    assert isinstance(line.at, LineAt), "a line that is played"
    return key_of(line.at)


def _timings(draft: Draft, grid: int) -> dict[LineKey, LineTiming]:
    """What a grid says of its lines' timing, what it takes over too; nothing where that is at fault."""
    try:
        raw = draft.table(grid).get(STROKE_TIMING)
        return {} if raw is None else line_timings(_read(raw), draft.grids[grid].path)
    except Wrong:
        return {}


def _is_odd(draft: Draft, grid: int) -> bool:
    """Whether a grid has a timing that cannot be read: it is the teacher's to mend."""
    return bool(draft.table(grid).get(STROKE_TIMING)) and not _timings(draft, grid)


def _written(draft: Draft, grid: int, line: DraftLine, timing: LineTiming | None, wanted: list[float]) -> str:
    """The text with the timing of a line, or without it where all its strokes are on their cells."""
    path: KeyPath = draft.grids[grid].path
    own = timing.path if timing and timing.path in draft.places.values else None
    if not any(wanted):
        return without(draft.text, own) if own else draft.text
    rel = line.path[len(path) :]
    value = [int(ms) if ms == int(ms) else ms for ms in wanted]
    if own or (*path, STROKE_TIMING) in draft.places.keys | draft.places.values:
        return draft.with_key(own or (*path, STROKE_TIMING, *rel), value).text
    return with_pair(draft.text, path, ".".join([STROKE_TIMING, *map(str, rel)]), toml_value(value))
