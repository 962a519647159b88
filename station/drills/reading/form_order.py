"""The form: in which order the grids of a file are played, by their names.

A form is a list of names, or a text with commas between them. `A x3` plays A three times, `(A, B) x2` plays A and B,
and both again; a group holds no group. Where a grid is called so, "A x3" is that grid.
"""

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from station.core.toml.schema import list_of, no_such, title
from station.core.toml.toml_faults import Faults, Noted, wrong
from station.core.toml.toml_places import KeyPath
from station.drills.reading.form import NAME, WrittenGrid

MAX_FORM = 1000
"""Entries of a form, written out: more than one for every other bar of the longest lesson (our choice)."""
_AGAIN = re.compile(r"(.*\S)\s+[x×]\s?(\d{1,9})")
_GROUP_END = re.compile(r"(.*\S)\s*\)(?:\s*[x×]\s?(\d{1,9}))?")
_EXAMPLE = 'a list such as ["A", "A", "B"], or "A, A, B"'


@dataclass(frozen=True, slots=True)
class _Entry:
    """A grid's name, and which of the entries that are written it comes from, from 0."""

    name: str
    place: int


@dataclass(frozen=True, slots=True)
class Turn:
    """A grid (its index) that is played, and the entry of the form that asks for it: "A x3" is three turns of one."""

    grid: int
    entry: int


def played_order(raw: object, grids: Sequence[WrittenGrid], faults: Faults) -> list[Turn]:
    """The turns in the order of the form, endings left out; each grid once where the file has no form."""
    mains = [i for i, grid in enumerate(grids) if not grid.is_ending]
    if raw is None:
        return [Turn(i, i) for i in mains]
    by_name = {grid.name: i for i, grid in reversed(list(enumerate(grids))) if grid.name}
    nothing: tuple[_Entry, ...] = ()
    entries = faults.attempt(lambda value: _entries(value, by_name), raw, nothing, "form")
    order: list[Turn] = []
    wrong_names: set[str] = set()
    for entry in entries:
        name, found = entry.name, by_name.get(entry.name)
        if found is not None and not grids[found].is_ending:
            order.append(Turn(found, entry.place))
        elif found is None and any(_is_doubtful(grids[i], faults) for i in mains):
            wrong_names.add(name)  # the grid that is meant may be the one that is at fault
        elif name not in wrong_names:  # each is told once
            wrong_names.add(name)
            faults.noted.append(Noted(_not_played(name, found, mains, grids), *_place_in_form(raw, entry.place)))
    if entries and not wrong_names:  # a name that nobody knows may be meant for what is never played
        _all_played([turn.grid for turn in order], mains, grids, faults)
    return order or [Turn(i, i) for i in mains]


def _not_played(name: str, found: int | None, mains: Sequence[int], grids: Sequence[WrittenGrid]) -> str:
    """Why the form cannot play `name`, which is the grid `found` or none."""
    if found is not None:
        return f"{name} is an ending, which is played after its grid; expected that grid's name"
    known = [grids[i].name for i in mains if grids[i].name]
    return no_such("grid", name, known) if known else "no grid has a name; expected name = …"


def _place_in_form(raw: object, place: int) -> tuple[KeyPath, int | None]:
    """Where an entry of the form stands: the path of the list's, or the index of its first letter in the text."""
    if not isinstance(raw, str):
        return ("form", place), None
    entries = raw.split(",")
    before = sum(len(entry) + 1 for entry in entries[:place])
    return ("form",), before + len(entries[place]) - len(entries[place].lstrip())


def _entries(value: object, names: Collection[str]) -> tuple[_Entry, ...]:
    """The form written out; `names` are those that grids have."""
    if isinstance(value, str):
        value = value.split(",")
    written = list_of(title, _EXAMPLE)(value)
    played: list[_Entry] = []
    opened: int | None = None
    for place, entry in enumerate(written):
        text = entry
        if opened is None and text not in names and text.startswith("("):
            opened, text = len(played), text[1:].strip()
        ends = _GROUP_END.fullmatch(text) if opened is not None and text not in names else None
        name, times = _again(ends[1] if ends else text, names)
        _play(played, [_Entry(name, place)], times)
        if ends:
            _play(played, played[opened:], int(ends[2] or 1), already=1)
            opened = None
    if opened is not None:
        raise wrong(f"( before {played[opened].name} is never closed; expected ) after the last name of the group")
    if not played:
        raise wrong(f"0 entries; expected 1 to {MAX_FORM}, {_EXAMPLE}")
    return tuple(played)


def _again(text: str, names: Collection[str]) -> tuple[str, int]:
    """A name, and how often it is played."""
    said = None if text in names else _AGAIN.fullmatch(text)
    return (said[1], int(said[2])) if said else (text, 1)


def _play(played: list[_Entry], entries: Sequence[_Entry], times: int, already: int = 0) -> None:
    """Add `entries` until they are played `times`; raises `Wrong` for never, and for more than anyone practises."""
    count = len(played) + (times - already) * len(entries)
    if not times or count > MAX_FORM:
        raise wrong(f"{count if times else 0} entries; expected 1 to {MAX_FORM}, {_EXAMPLE}")
    played += list(entries) * (times - already)


def _is_doubtful(grid: WrittenGrid, faults: Faults) -> bool:
    """Whether the grid has no name and a fault: that may be why it has none, or seems to be no ending."""
    return not grid.name and any(fault.path[: len(grid.path)] == grid.path for fault in faults.noted)


def _all_played(order: Sequence[int], mains: Sequence[int], grids: Sequence[WrittenGrid], faults: Faults) -> None:
    """Note grids that the form never plays."""
    played = {grids[i].name for i in order}
    for grid in (grids[i] for i in sorted(set(mains) - set(order))):
        if _is_doubtful(grid, faults) or grid.name in played:  # of two with one name that is told already
            continue
        if grid.name:
            faults.add((*grid.path, NAME), f"never played; expected {grid.name} in form")
        else:
            faults.add(
                grid.path, "never played, for it has no name; expected name = … and that name in form", at_key=True
            )
