"""What a lesson says by the numbers of bars, kept at its bars while these move: `at`, `loop` and the goals of bars.

`at` counts the bars of its grid, `loop` and `[[goals.bars]]` those of the lesson as it is played.
"""

from collections.abc import Mapping, Sequence

from station.core.toml.toml_edits import without
from station.core.toml.toml_faults import Faults
from station.core.toml.toml_places import KeyPath
from station.drills.editing.draft import Draft
from station.drills.grid.grid_reader import MAX_TIMES
from station.drills.grid.line_group import MAX_BARS
from station.drills.reading.form import repetitions
from station.drills.reading.form_order import played_order

_MOST_PLAYED = 2 * MAX_BARS
"""Bars as played that are followed: twice those of the longest lesson, so that a text with that fault stays quick."""
BarMap = Sequence[int | None]
"""Where each bar of a grid is afterwards; None where it is gone."""
PlayedBar = tuple[int, int, int]
"""A grid by its index afterwards, how often it was played before (from 0), and a bar of it."""


def bars_after_adding(bars: int, at: int, count: int) -> BarMap:
    """Where the bars of a grid are when `count` new ones stand before bar `at`."""
    return [bar + count * (bar >= at) for bar in range(bars)]


def bars_after_removing(bars: int, first: int, last: int) -> BarMap:
    """Where they are when bars `first` to `last` are gone."""
    return [None if first <= bar <= last else bar - (last - first + 1) * (bar > last) for bar in range(bars)]


def with_moved_numbers(
    before: Draft, after: Draft, moved: Mapping[int, BarMap], index_of: Mapping[int, int] | None = None
) -> Draft:
    """The draft `after` an edit, which says the same of the same bars as the one `before`.

    `moved` has the grids whose bars moved; `index_of` where each grid of `before` is afterwards, if not where it was.
    """
    places = {i: i for i in range(len(before.grids))} if index_of is None else index_of
    draft = after
    for grid in places:
        draft = _with_cues(before, draft, grid, moved.get(grid), places[grid])
    old, new = played_bars(before), played_bars(after)
    if old is None or new is None:
        return draft
    known = {bar: i for i, bar in enumerate(new)}
    numbers = [_now(known, bar, moved, places) for bar in old]
    return _with_goal_bars(_with_loop(draft, numbers, len(new)), numbers)


def _now(
    known: Mapping[PlayedBar, int], was: PlayedBar, moved: Mapping[int, BarMap], places: Mapping[int, int]
) -> int | None:
    """The number, from 0, of a bar as played after the edit."""
    grid, time, bar = was
    if grid not in places:
        return None
    now = moved[grid][bar] if grid in moved and bar < len(moved[grid]) else bar
    return None if now is None else known.get((places[grid], time, now))


def played_bars(draft: Draft) -> list[PlayedBar] | None:
    """All bars of a lesson in the order in which they are played; None where that cannot be told."""
    faults = Faults()
    turns = played_order(draft.raw.get("form"), draft.grids, faults) if draft.grids else []
    times = [_times(draft, i) for i in range(len(draft.grids))]
    if faults or any(grid.raw is None or not isinstance(grid.raw, dict) for grid in draft.grids):
        return None
    counts = [0] * len(draft.grids)
    bars = [draft.bar_count(i) for i in range(len(draft.grids))]
    found: list[PlayedBar] = []
    for turn in turns:
        for grid, _ in repetitions(turn.grid, draft.grids, times):
            found += [(grid, counts[grid], bar) for bar in range(bars[grid])]
            counts[grid] += 1
            if len(found) > _MOST_PLAYED:
                return None
    return found


def _times(draft: Draft, grid: int) -> int:
    raw = draft.grids[grid].raw
    times = raw.get("times", 1) if isinstance(raw, dict) else 1
    return times if type(times) is int and 1 <= times <= MAX_TIMES else 1


# --- what happens at bars ---------------------------------------------------------------------------------------------


def _with_cues(before: Draft, draft: Draft, grid: int, moved: BarMap | None, now: int) -> Draft:
    """The draft with the entries of `at` of a grid at their bars; a variation gets its own where the model's moved."""
    was = before.grids[grid].at
    if not isinstance(was, list):
        return draft
    wanted = was if moved is None else [_moved_cue(cue, moved) for cue in was]
    kept = [cue for cue in wanted if cue is not None]
    if draft.grids[now].at == kept:
        return draft
    path: KeyPath = (*draft.grids[now].path, "at")
    if ("at",) not in draft.grids[now].own:
        return draft.with_key(path, kept)
    for i in reversed(range(len(wanted))):
        cue = wanted[i]
        if cue is None:
            draft = draft.now(without(draft.text, (*path, i)))
        elif cue != was[i]:
            draft = draft.with_key((*path, i, "bar"), cue["bar"])
    return draft if kept else draft.now(without(draft.text, path))


def _moved_cue(cue: object, moved: BarMap) -> dict[str, object] | None:
    if not isinstance(cue, dict) or type(bar := cue.get("bar")) is not int or not 1 <= bar <= len(moved):
        return cue  # type: ignore[return-value] # a fault stays as it is
    now = moved[bar - 1]
    return None if now is None else {**cue, "bar": now + 1}


# --- what counts bars as played ---------------------------------------------------------------------------------------


def _with_loop(draft: Draft, numbers: Sequence[int | None], total: int) -> Draft:
    """The draft with its loop over the same bars; one over the whole lesson stays so."""
    loop = _range(draft.raw.get("loop"), len(numbers))
    if loop is None:
        return draft
    whole = loop == (0, len(numbers) - 1)
    return _with_range(draft, ("loop",), loop, (0, total - 1) if whole else _kept(numbers, loop), ("loop",))


def _with_goal_bars(draft: Draft, numbers: Sequence[int | None]) -> Draft:
    goals = draft.raw.get("goals")
    parts = goals.get("bars") if isinstance(goals, dict) else None
    parts = parts if isinstance(parts, list) else []
    for i in reversed(range(len(parts))):
        bars = _range(parts[i].get("bars"), len(numbers)) if isinstance(parts[i], dict) else None
        if bars is not None:
            path: KeyPath = ("goals", "bars", i)
            draft = _with_range(draft, (*path, "bars"), bars, _kept(numbers, bars), path)
    return draft


def _range(raw: object, bars: int) -> tuple[int, int] | None:
    """First and last bar, from 0; None where they are no bars of the lesson."""
    if not (isinstance(raw, list) and len(raw) == 2 and all(type(each) is int for each in raw)):
        return None
    first, last = raw
    return (first - 1, last - 1) if 1 <= first <= last <= bars else None


def _kept(numbers: Sequence[int | None], bars: tuple[int, int]) -> tuple[int, int] | None:
    """The range that these bars have now; None where all are gone."""
    now = [number for number in numbers[bars[0] : bars[1] + 1] if number is not None]
    return (min(now), max(now)) if now else None


def _with_range(
    draft: Draft, path: KeyPath, was: tuple[int, int], now: tuple[int, int] | None, owner: KeyPath
) -> Draft:
    if now == was:
        return draft
    if now is None:
        return draft.now(without(draft.text, owner))
    return draft.with_key(path, [now[0] + 1, now[1] + 1])
