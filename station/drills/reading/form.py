"""The grids of a file as the teacher meant them: variations (`like`) and endings; `form_order` has their order.

All this is worked out on the raw tables, before a line is read: a variation is a table that has its own keys and those
of the grid it is like. What is wrong in lines that it took over is told where they stand, once.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from station.core.expected import either_of, expected_by, expects, list_like
from station.core.pieces import Piece
from station.core.toml.schema import Field as SchemaField
from station.core.toml.schema import anything, list_of, no_such, optional, title, whole
from station.core.toml.toml_faults import Faults, Noted, wrong
from station.core.toml.toml_places import KeyPath
from station.drills.grid.grid_reader import MAX_TIMES
from station.drills.grid.sticking_line import STICKING
from station.drills.grid.stroke_timing import STROKE_TIMING
from station.drills.grid.tab_symbols import LIMB_TABLES, LINE_PIECES

LIKE, ENDING, AT, NAME, TIMES = "like", "ending", "at", "name", "times"
MAX_GRIDS = 500
"""One for every fourth bar of the longest lesson (our choice)."""


@expects(either_of(expected_by(whole(1, MAX_TIMES)), list_like(expected_by(whole(1, MAX_TIMES)), 1)))
def _ending(value: object) -> tuple[int, ...]:
    """The repetitions, from 0, that an ending belongs to."""
    read = whole(1, MAX_TIMES)
    numbers = list_of(read, "1, or a list such as [1, 2]")(value) if isinstance(value, list) else (read(value),)
    if not numbers:
        raise wrong("belongs to no repetition; expected 1, or a list such as [1, 2]")
    return tuple(number - 1 for number in numbers)


FORM_FIELDS: Mapping[str, SchemaField[Any]] = MappingProxyType(
    {LIKE: optional(title), ENDING: optional(_ending), AT: optional(anything)}
)
"""The keys of a grid that are read here; `bar_cues` reads what `at` holds."""


@dataclass(slots=True)
class WrittenGrid:
    """One grid of the file, whole: `raw` has what it took over, too, and no key of `FORM_FIELDS`.

    `path` leads to it, `at` is the list of what happens at its bars; `like` is the index of the grid it is like,
    `own` are the keys that it says itself; `ending_of` the index of the grid that it ends, in `repetitions` (from 0).
    """

    path: KeyPath
    raw: object
    name: str = ""
    at: object = None
    like: int | None = None
    own: frozenset[KeyPath] = frozenset()
    ending_of: int | None = None
    repetitions: tuple[int, ...] = ()
    endings: dict[int, int] = field(default_factory=dict)
    """Of a grid that has endings: the index of the ending of each repetition."""

    @property
    def number(self) -> int:
        """Which grid of the file it is, from 0."""
        return next((key for key in self.path if isinstance(key, int)), 0)

    @property
    def is_ending(self) -> bool:
        """Whether it is played after another grid, and not for itself."""
        return bool(self.repetitions)


def written_grids(raw: object, faults: Faults) -> list[WrittenGrid]:
    """The one `[grid]` or the several `[[grid]]` of a file; `faults` have paths from the top.

    Raises `Wrong` where there are more than anyone practises.
    """
    if isinstance(raw, list) and len(raw) > MAX_GRIDS:
        raise wrong(f"{len(raw)} grids; a lesson has at most {MAX_GRIDS}", "grid", MAX_GRIDS)
    grids: list[WrittenGrid] = []
    names: dict[str, int] = {}
    for i, each in enumerate(raw if isinstance(raw, list) else [raw]):
        path: KeyPath = ("grid", i) if isinstance(raw, list) else ("grid",)
        grids.append(_written(each, path, grids, names, faults))
        name = grids[i].name
        if name and names.setdefault(name, i) != i:
            faults.add((*path, NAME), f"two grids are called {name}; expected another name")
    for grid in grids:
        if grid.endings and isinstance(grid.raw, dict) and TIMES not in grid.raw:
            grid.raw[TIMES] = max(grid.endings) + 1
    _no_late_endings(grids, faults)
    return grids


def _written(
    raw: object, path: KeyPath, before: Sequence[WrittenGrid], names: Mapping[str, int], faults: Faults
) -> WrittenGrid:
    if not isinstance(raw, dict):
        return WrittenGrid(path, raw)
    said = {key: faults.attempt(one.read, raw[key], None, *path, key) for key, one in FORM_FIELDS.items() if key in raw}
    name = raw.get(NAME)
    grid = WrittenGrid(
        path,
        {key: value for key, value in raw.items() if key not in FORM_FIELDS},
        name.strip() if isinstance(name, str) else "",
        said.get(AT),
        own=frozenset(_paths(raw)),
    )
    if said.get(LIKE) is not None:
        _take_over(grid, said[LIKE], before, names, faults)
    if said.get(ENDING) is not None:
        _end(grid, said[ENDING], before, len(before), faults)
    return grid


# --- variations -------------------------------------------------------------------------------------------------------

_NOT_TAKEN_OVER = (NAME,)


def _take_over(
    grid: WrittenGrid, name: str, before: Sequence[WrittenGrid], names: Mapping[str, int], faults: Faults
) -> None:
    """Give `grid` what the grid called `name` says and it does not."""
    path = (*grid.path, LIKE)
    if name not in names:
        above = no_such("grid above", name, names) if names else f"no such grid above: {name}; no grid above has a name"
        faults.add(path, above)
        return
    grid.like = names[name]
    model = before[grid.like]
    if grid.at is None:
        grid.at = model.at
    if isinstance(model.raw, dict) and isinstance(grid.raw, dict):
        grid.raw = _varied(model.raw, grid.raw)


def _varied(model: Mapping[str, object], own: Mapping[str, object]) -> dict[str, object]:
    """The table of a variation; a line of its own takes the place of the model's, whatever it is called there.

    A line that names no limb takes the place of all lines of its piece, one of a limb that of the same limb's, and of
    one that names none.
    """
    kept = {key: value for key, value in model.items() if key not in _NOT_TAKEN_OVER}
    merged = _with_lines(_without_lines(kept, own), own)
    if isinstance(of_model := model.get(STROKE_TIMING), dict):
        of_own = own.get(STROKE_TIMING, {})
        left = _without_lines(of_model, own)  # the timing of a line goes with it
        merged[STROKE_TIMING] = (
            _with_lines(_without_lines(left, of_own), of_own) if isinstance(of_own, dict) else of_own
        )
    return merged


def _without_lines(model: Mapping[str, object], own: Mapping[str, object]) -> dict[str, object]:
    """What is left of a model's lines where a variation has its `own`."""
    plain = _pieces_of(own)
    by_limb = {limb: _pieces_of(own.get(limb)) for limb in LIMB_TABLES}
    left = _without(model, plain.union(*by_limb.values()))
    for limb, pieces in by_limb.items():
        if isinstance(of_model := model.get(limb), dict):
            left[limb] = _without(of_model, plain | pieces)
    return left


def _with_lines(left: Mapping[str, object], own: Mapping[str, object]) -> dict[str, object]:
    """A table with a variation's own keys, the tables of limbs put together."""
    merged = {**left, **own}
    for limb in LIMB_TABLES:
        if isinstance(of_model := left.get(limb), dict) and isinstance(of_own := own.get(limb, {}), dict):
            merged[limb] = {**of_model, **of_own}
    return merged


def _pieces_of(lines: object) -> frozenset[Piece]:
    """The pieces that the lines of a limb's table play."""
    return (
        frozenset(LINE_PIECES[key] for key in lines if key in LINE_PIECES) if isinstance(lines, dict) else frozenset()
    )


def _without(table: Mapping[str, object], pieces: Collection[Piece]) -> dict[str, object]:
    """The table but for the lines of these pieces."""
    return {key: value for key, value in table.items() if key not in LINE_PIECES or LINE_PIECES[key] not in pieces}


def told_at_home(found: Faults, grid: WrittenGrid, grids: Sequence[WrittenGrid], known: Faults) -> list[Noted]:
    """What was found in `grid`, each fault where the teacher can mend it.

    What stands in keys that a variation took over is wrong in its model already and not told again; what is wrong in
    them only here is told at `like`. Where nobody knows what it is like, its own lines say nothing of what it lacks.
    """
    told: list[Noted] = []
    already = {(other.path, other.char) for other in known.noted}
    for fault in found.noted:
        if grid.like is None and (LIKE,) in grid.own and fault.path[len(grid.path) :] in ((), (STICKING,)):
            continue
        key = fault.path[len(grid.path)] if len(fault.path) > len(grid.path) else None
        if grid.like is None or not isinstance(key, str) or _says(grid, fault.path[len(grid.path) :]):
            told.append(fault)
        elif (home_of(fault.path, grid, grids), fault.char) not in already:
            name = ".".join(str(part) for part in fault.path[len(grid.path) :])
            told.append(Noted(f"{name}, as in {grids[grid.like].name}: {fault.text}", (*grid.path, LIKE)))
    return told


def _says(grid: WrittenGrid, path: KeyPath) -> bool:
    """Whether the grid has the value at `path` (from the grid down) from its own table."""
    return path[:1] in grid.own or path[:2] in grid.own


def _paths(raw: Mapping[str, object]) -> Iterator[KeyPath]:
    """The keys of a grid's own table; those of a limb's table, and of the timing, each by itself."""
    for key, value in raw.items():
        if key in (*LIMB_TABLES, STROKE_TIMING) and isinstance(value, dict):
            yield from ((key, line) for line in value)
        else:
            yield (key,)


def home_of(path: KeyPath, grid: WrittenGrid, grids: Sequence[WrittenGrid]) -> KeyPath:
    """Where the value at `path` of `grid` is written: in the grid itself, or in one that it is like."""
    while grid.like is not None and len(path) > len(grid.path) and not _says(grid, path[len(grid.path) :]):
        model = grids[grid.like]
        path, grid = (*model.path, *path[len(grid.path) :]), model
    return path


# --- endings ----------------------------------------------------------------------------------------------------------


def _end(grid: WrittenGrid, numbers: Sequence[int], before: Sequence[WrittenGrid], index: int, faults: Faults) -> None:
    """Make `grid`, which is the file's `index`th, the ending of the grid before it."""
    path = (*grid.path, ENDING)
    grid.repetitions = tuple(numbers)
    main = next((i for i in reversed(range(len(before))) if not before[i].is_ending), None)
    if main is None:
        faults.add(path, "no grid before this one that it could end")
        return
    grid.ending_of = main
    for number in numbers:
        if before[main].endings.setdefault(number, index) != index or numbers.count(number) > 1:
            faults.add(path, f"repetition {number + 1} has an ending already; each has one at most")
            return


def ending_word(grid: WrittenGrid) -> str:
    """What an ending without a name is called after its grid's name: "ending 2", "ending 1 and 3"."""
    *firsts, last = (str(repetition + 1) for repetition in sorted(grid.repetitions))
    return f"ending {', '.join(firsts)}{' and ' if firsts else ''}{last}"


def _no_late_endings(grids: Sequence[WrittenGrid], faults: Faults) -> None:
    """Note endings of repetitions that are never played."""
    for grid in grids:
        main = None if grid.ending_of is None else grids[grid.ending_of]
        times = main.raw.get(TIMES, 1) if main and isinstance(main.raw, dict) else None
        if isinstance(times, bool) or not isinstance(times, int):
            continue  # none, or what is told as no number of times
        if late := [n + 1 for n in grid.repetitions if n >= times]:
            often = "once" if times == 1 else f"{times} times"
            faults.add((*grid.path, ENDING), f"the grid before is played {often}; there is no repetition {late[0]}")


def repetitions(main: int, grids: Sequence[WrittenGrid], times: Sequence[int]) -> Iterator[tuple[int, int]]:
    """One turn of the grid `main`: the index of what is played and its repetition, from 0; endings after theirs.

    `times` is how often each grid is played.
    """
    for repetition in range(times[main]):
        yield main, repetition
        if (ending := grids[main].endings.get(repetition)) is not None:
            yield from ((ending, again) for again in range(times[ending]))
