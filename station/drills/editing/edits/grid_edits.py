"""Whole grids: added as a variation or as a bar of rests, taken away. What other grids play stays as it is.

A grid takes its tempo, meter and swing from the one written before it. Where an edit puts another one there, the grid
says itself what it had from then on.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from station.core.toml.toml_edits import table_rows, with_block, without
from station.core.toml.toml_faults import Faults
from station.core.toml.toml_write import toml_value
from station.drills.editing.bar_text import rests
from station.drills.editing.draft import Draft
from station.drills.editing.edits.bar_numbers import with_moved_numbers
from station.drills.editing.edits.own_lines import with_own_copies
from station.drills.editing.lesson_edits import AddGrid, RemoveGrid
from station.drills.grid.grid_timing import TIMING
from station.drills.reading.form_order import played_order
from station.drills.writing.form_text import form_text

_TABLES = ("dynamics", "graces")
"""Keys of the timing that are tables: what one grid says of them is added to what was said before."""
_NOT_OWN = ("name", "like", "ending")


# --- adding -----------------------------------------------------------------------------------------------------------


def add_grid(draft: Draft, edit: AddGrid) -> Draft:
    """The draft with a grid after grid `after` and its endings; last in the form, where the lesson has one."""
    draft.table(edit.after)
    if not edit.name.strip() or "\n" in edit.name or not edit.name.isprintable():
        raise draft.refused("a grid's name is one line of text")
    if edit.name in {grid.name for grid in draft.grids}:
        raise draft.refused(f"two grids would be called {edit.name}; expected another name")
    if edit.like is not None and edit.like > edit.after:
        raise draft.refused("a variation stands below the grid that it is like")
    draft = _in_a_list(draft)
    if "form" in draft.raw or edit.like is not None:
        draft = _with_names(draft, range(len(draft.grids)) if "form" in draft.raw else [edit.like or 0])
    after = max([edit.after, *draft.grids[edit.after].endings.values()])
    said: dict[str, object] = {"name": edit.name.strip()}
    if edit.like is not None:
        said["like"] = draft.grids[edit.like].name
    else:
        said |= {".".join(key): line for key, line in _silent_lines(draft, edit.after)}
    before = draft
    draft = _with_table(draft, after, said)
    if (form := draft.raw.get("form")) is not None:
        longer = f"{form}, {said['name']}" if isinstance(form, str) else [*form, said["name"]]
        draft = draft.with_key(("form",), longer)
    index_of = {i: i + (i > after) for i in range(len(before.grids))}
    draft = with_timings_of(before, draft, index_of)
    return with_moved_numbers(before, draft, {}, index_of)


def _in_a_list(draft: Draft) -> Draft:
    """The draft with its one grid as the first of a list."""
    text, places = draft.text, draft.places
    if isinstance(draft.raw["grid"], list):
        return draft
    at = places.keys[("grid",)]
    if text.startswith("[", at):
        if any(path[:1] == ("grid",) and places.keys[path] < at for path in places.keys):
            raise draft.refused("a table of the grid stands above its [grid]; write [grid] first")
        return draft.now(f"{text[:at]}[[grid]]{text[text.index(']', at) + 1 :]}")
    grid = draft.raw["grid"]
    if ("grid",) in places.values:
        start, end = places.values["grid",], places.ends["grid",]
        return draft.now(f"{text[:start]}[{text[start:end]}]{text[end:]}")
    rest = without(text, ("grid",))
    return draft.now(f"{rest}{'' if rest.endswith(chr(10)) else chr(10)}\n[[grid]]\n{table_rows(grid)}")


def _with_names(draft: Draft, grids: Sequence[int]) -> Draft:
    """The draft with a name for each of these grids that has none."""
    taken = {grid.name for grid in draft.grids}
    free = (name for number in range(1, 2000) for name in [_letters(number)] if name not in taken)
    for i in grids:
        if not draft.grids[i].name and not draft.grids[i].is_ending:
            draft = draft.now(_with_first(draft, i, "name", next(free)))
    return draft


def _letters(number: int) -> str:
    """A to Z, then A2 to Z2, and so on."""
    turn, letter = divmod(number - 1, 26)
    return f"{chr(ord('A') + letter)}{turn + 1 if turn else ''}"


def _with_first(draft: Draft, grid: int, key: str, value: object) -> str:
    """The text with a key as the first of a grid's table."""
    path, text = draft.grids[grid].path, draft.text
    at = draft.places.keys.get(path)
    if at is None or not text.startswith("[", at):
        return draft.with_key((*path, key), value).text
    end = text.find("\n", at)
    return (
        f"{text[:end]}\n{key} = {toml_value(value)}{text[end:]}" if end >= 0 else f"{text}\n{key} = {toml_value(value)}"
    )


def _silent_lines(draft: Draft, grid: int) -> list[tuple[tuple[str, ...], str]]:
    """The lines that a grid plays, with a bar of rests each."""
    lines = [line for line in draft.lines(grid) if line.cycle is None and line.piece is not None]
    silence = f"| {rests(draft.frame(grid, 0))} |"
    depth = len(draft.grids[grid].path)
    return [(tuple(str(key) for key in line.path[depth:]), silence) for line in lines] or [(("snare",), silence)]


def _with_table(draft: Draft, after: int, said: Mapping[str, object]) -> Draft:
    """The draft with a table of these pairs behind grid `after`; keys with a dot are dotted keys."""
    path = draft.grids[after].path
    if ("grid",) in draft.places.values:
        pairs = ", ".join(f"{key} = {toml_value(value)}" for key, value in said.items())
        end = draft.places.ends[path]
        return draft.now(f"{draft.text[:end]}, {{{pairs}}}{draft.text[end:]}")
    rows = "".join(f"{key} = {toml_value(value)}\n" for key, value in said.items())
    return draft.now(with_block(draft.text, path, f"\n[[grid]]\n{rows}"))


# --- taking away ------------------------------------------------------------------------------------------------------


def remove_grid(draft: Draft, edit: RemoveGrid) -> Draft:
    """The draft without a grid and its endings; variations of them become grids of their own."""
    draft.table(edit.grid)
    gone = {edit.grid, *draft.grids[edit.grid].endings.values()}
    if not [i for i, grid in enumerate(draft.grids) if i not in gone and not grid.is_ending]:
        raise draft.refused("a lesson needs a grid to play; this is its last")
    before = draft
    for i, grid in enumerate(before.grids):
        if grid.like in gone and i not in gone:
            draft = _on_its_own(draft, i)
    draft = _without_in_form(draft, edit.grid)
    for i in sorted(gone, reverse=True):
        draft = draft.now(without(draft.text, before.grids[i].path))
    kept = [i for i in range(len(before.grids)) if i not in gone]
    index_of = {was: now for now, was in enumerate(kept)}
    return with_moved_numbers(before, with_timings_of(before, draft, index_of), {}, index_of)


def _on_its_own(draft: Draft, grid: int) -> Draft:
    """The draft with a variation that says everything itself."""
    draft = with_own_copies(draft, grid, draft.lines(grid))
    path = draft.grids[grid].path
    raw, own = draft.table(grid), draft.grids[grid].own
    lines = {line.path[len(path)] for line in draft.lines(grid)}
    for key, value in raw.items():
        if (key,) not in own and key not in lines and key not in _NOT_OWN and key not in TIMING:
            draft = draft.with_key((*path, key), value)
    if draft.grids[grid].at is not None and ("at",) not in own:
        draft = draft.with_key((*path, "at"), draft.grids[grid].at)
    return draft.now(without(draft.text, (*path, "like")))


def _without_in_form(draft: Draft, grid: int) -> Draft:
    """The draft without a grid in its form; without a form where that played nothing else."""
    form = draft.raw.get("form")
    if form is None or draft.grids[grid].is_ending:
        return draft
    faults = Faults()
    turns = [turn.grid for turn in played_order(form, draft.grids, faults)]
    if faults or grid not in turns:
        return draft
    names = [draft.grids[turn].name for turn in turns if turn != grid]
    if not names:
        return draft.now(without(draft.text, ("form",)))
    return draft.with_key(("form",), form_text(names) if isinstance(form, str) else names)


# --- what a grid takes from the one before it -------------------------------------------------------------------------


def with_timings_of(before: Draft, draft: Draft, index_of: Mapping[int, int]) -> Draft:
    """The draft with what each grid had of tempo, meter, swing and strokes, written where it would have another now."""
    for was, now in sorted(index_of.items(), key=lambda pair: pair[1]):
        if _told(draft, now) != _told(before, was):
            draft = _with_timing(draft, now, _told(before, was))
    return draft


def _told(draft: Draft, grid: int) -> dict[str, Any]:
    """What counts in a grid of the keys of the timing, as the file spells it."""
    told: dict[str, Any] = {}
    model = draft.grids[grid].like
    if grid and model is None:
        told = _told(draft, grid - 1)
    elif model is not None:
        told = _told(draft, model)
    else:
        told = {key: draft.raw[key] for key in TIMING if key in draft.raw}
    raw = draft.grids[grid].raw
    said = {key: raw[key] for key in TIMING if key in raw} if isinstance(raw, dict) else {}
    tables = {key: {**told[key], **said[key]} for key in _TABLES if _are_tables(told.get(key), said.get(key))}
    return {**told, **said, **tables}


def _are_tables(*values: object) -> bool:
    return all(isinstance(value, dict) for value in values)


def _with_timing(draft: Draft, grid: int, told: Mapping[str, Any]) -> Draft:
    now = _told(draft, grid)
    usual = {"tempo_bpm": 80, "meter": "4/4", "beat": "1/4", "swing_ratio": 1, "swing_unit": "1/8"}
    for key in TIMING:
        value = told.get(key, usual.get(key))
        if value is not None and now.get(key, usual.get(key)) != value:
            draft = draft.with_key((*draft.grids[grid].path, key), value)
    return draft
