"""Which key of a lesson's text a fault is about, by the line and column where it was found."""

from bisect import bisect_right
from collections.abc import Sequence

from station.core.toml.toml_faults import Fault
from station.core.toml.toml_places import KeyPath, Places

_LISTED = ("grid", "cycle")
"""Tables that may stand alone or in a list: their paths have an index in either case."""


def faults_by_key(text: str, faults: Sequence[Fault]) -> dict[KeyPath, str]:
    """The words of `faults` by the path of the key or table that each is about, () where none is.

    The text must be one that `tomllib` accepts. Grids and cycles have their index even where there is only one.
    """
    places = Places.of(text)
    found: dict[KeyPath, str] = {}
    for fault in faults:
        path = with_indices(key_at(places, fault.line, fault.column))
        found[path] = f"{found[path]}; {fault.text}" if path in found else fault.text
    return found


def key_at(places: Places, line: int, column: int) -> KeyPath:
    """The path of the key or the table that stands at a line and a column, both from 1; () where none does."""
    offset = places.line_starts[min(line, len(places.line_starts)) - 1] + column - 1
    spans = ((start, places.ends.get(path), path) for path, start in places.keys.items())
    inside = [(len(path), path) for start, end, path in spans if end is not None and start <= offset < end]
    if inside:
        return max(inside, key=lambda each: each[0])[1]
    header = bisect_right(places.headers, offset) - 1
    if header < 0:
        return ()
    start = places.headers[header]
    return next(path for path, at in places.keys.items() if at == start)


def with_indices(path: KeyPath) -> KeyPath:
    """The path with the index 0 after each table that stands alone where others would be in a list."""
    found: list[str | int] = []
    for key, after in zip(path, (*path[1:], None), strict=True):
        found.append(key)
        if key in _LISTED and not isinstance(after, int):
            found.append(0)
    return tuple(found)
