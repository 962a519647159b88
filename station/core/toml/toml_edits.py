"""Editing a TOML text: one key is set, added or taken away, and everything else stays as it was written.

The text must be one that `tomllib` accepts, with line feeds as line ends; so is what comes out, if the values are of
TOML. Comments, the order of keys and the spelling of all that is not touched are kept; what stands behind a value in
its row goes with it when it is taken away.
"""

import re
from collections.abc import Iterable, Mapping, Sequence

from station.core.toml.toml_places import KeyPath, Places
from station.core.toml.toml_write import toml_key, toml_prose, toml_value

Splice = tuple[int, int, str]
"""From an offset to another, and what stands there instead."""
_BREAKS = re.compile(r"\n{3,}")


def spliced(text: str, splices: Iterable[Splice]) -> str:
    """The text with these pieces of it, none of which overlap, replaced."""
    parts, done = [], 0
    for start, end, new in sorted(splices):
        parts += [text[done:start], new]
        done = end
    return "".join(parts) + text[done:]


def with_value(text: str, path: KeyPath, value: object, order: Sequence[str] = ()) -> str:
    """The text with the value at `path`: in the place of what stood there, or where such a key is usually written.

    Tables that are missing are made: those of the top as `[table]`, before the first whose name comes later in `order`.
    An index just past the end of a list adds to it. Raises `KeyError` where the path leads through what is no table.
    """
    places = Places.of(text)
    is_row = not any(path[:depth] in places.values for depth in range(1, len(path)))
    said = toml_prose(value) if is_row and isinstance(value, str) and "\n" in value else toml_value(value)
    if path in places.values:
        return spliced(text, [(places.values[path], places.ends[path], said)])
    if _is_there(places, path):
        text = without(text, path)
    if isinstance(value, dict) and len(path) == 1 and order:
        return _with_table(text, Places.of(text), str(path[0]), table_rows(value), order)
    return _added(text, path, said, order)


def with_pair(text: str, table: KeyPath, key: str, value: str, beside: tuple[KeyPath, bool] | None = None) -> str:
    """The text with `key = value`, both as TOML spells them, in a table that is there.

    In the row before or after the key `beside` (True: after) where that has a row of the table; else behind its last.
    """
    places = Places.of(text)
    if beside and _has_row(places, beside[0]) and _is_header(places, table):
        path, is_after = beside
        at = _row_end(text, places.ends[path]) if is_after else _row_start(text, places.keys[path])
        return spliced(text, [(at, at, f"\n{key} = {value}" if is_after else f"{key} = {value}\n")])
    return _in_table(text, places, table, key, value)


def with_block(text: str, table: KeyPath, block: str) -> str:
    """The text with `block`, headers and rows, behind a table that has headers and all that is below it."""
    places = Places.of(text)
    below = _headers_below(places, table)
    at = max(_block(places, path)[1] for path in below)
    return spliced(text, [(at, at, f"{_line_end(text, at)}{block}{chr(10) if at < len(text) else ''}")])


def table_rows(table: Mapping[str, object]) -> str:
    """The pairs of a table, a row each."""
    return "".join(f"{toml_key(key)} = {toml_value(value)}\n" for key, value in table.items())


def without(text: str, path: KeyPath) -> str:
    """The text without the value at `path`, or without all that a table holds; as it is where there is none."""
    places = Places.of(text)
    if path in places.values:
        return spliced(text, [_cut(places, path)])
    rows = [p for p in places.values if p[: len(path)] == path and not _is_inside(places, p, path)]
    blocks = [_block(places, p) for p in _headers_below(places, path)]
    alone = [_cut(places, p) for p in rows if not any(a <= places.keys.get(p, -1) < b for a, b in blocks)]
    return _BREAKS.sub("\n\n", spliced(text, [*((a, b, "") for a, b in blocks), *alone])) if blocks or alone else text


# --- where things stand -----------------------------------------------------------------------------------------------


def _row_start(text: str, at: int) -> int:
    return text.rfind("\n", 0, at) + 1


def _row_end(text: str, at: int) -> int:
    end = text.find("\n", at)
    return len(text) if end < 0 else end


def _is_header(places: Places, path: KeyPath) -> bool:
    return path in places.keys and places.keys[path] in _header_set(places)


def _header_set(places: Places) -> frozenset[int]:
    return frozenset(places.headers)


def _is_there(places: Places, path: KeyPath) -> bool:
    """Whether the text says anything at `path` or below it."""
    return any(each[: len(path)] == path for each in (*places.keys, *places.values))


def _is_inside(places: Places, path: KeyPath, above: KeyPath) -> bool:
    """Whether the value at `path` is part of another one below `above`, such as a table in braces."""
    return any(path[:depth] in places.values for depth in range(len(above), len(path)))


def _has_row(places: Places, path: KeyPath) -> bool:
    """Whether the value at `path` has a row of its own."""
    if path not in places.values or path not in places.keys:
        return False
    start = _row_start(places.text, places.keys[path])
    return not places.text[start : places.keys[path]].strip()


def _headers_below(places: Places, path: KeyPath) -> list[KeyPath]:
    offsets = _header_set(places)
    return [p for p, at in places.keys.items() if at in offsets and p[: len(path)] == path]


def _block(places: Places, path: KeyPath) -> tuple[int, int]:
    """From the header of the table at `path` to the next one, or to the comments right above that."""
    start = places.keys[path]
    later = [at for at in places.headers if at > start]
    return start, _above(places.text, min(later)) if later else len(places.text)


def _above(text: str, at: int) -> int:
    """Start of the comments that stand in the rows right above the row that begins at `at`."""
    while at and (row := text[_row_start(text, at - 1) : at - 1]).lstrip().startswith("#"):
        at -= len(row) + 1
    return at


# --- adding -----------------------------------------------------------------------------------------------------------


def _added(text: str, path: KeyPath, said: str, order: Sequence[str]) -> str:
    """The text with a value where there is none."""
    *above, key = path
    parent = tuple(above)
    places = Places.of(text)
    if isinstance(key, int):
        return _with_entry(text, places, parent, key, said, order)
    if not parent or _is_there(places, parent):
        return _in_table(text, places, parent, toml_key(key), said)
    if len(parent) == 1 and order:
        return _with_table(text, places, str(parent[0]), f"{toml_key(key)} = {said}\n", order)
    return _added(text, parent, f"{{{toml_key(key)} = {said}}}", order)


def _in_table(text: str, places: Places, table: KeyPath, key: str, said: str) -> str:
    """The pair behind the last of a table that is there, in whatever way it is written."""
    if table in places.values:
        return _in_braces(places, table, f"{key} = {said}")
    if not table or _is_header(places, table):
        start = places.keys[table] if table else 0
        end = min((at for at in places.headers if at > start or not table), default=len(text) + 1)
        here = (p for p, at in places.keys.items() if p in places.ends and start <= at < end)
        last = max((places.ends[p] for p in here), default=-1)
        if last < 0 and not table:
            return f"{key} = {said}\n{text}"
        return _with_row(text, last if last >= 0 else text.index("]", start), f"{key} = {said}")
    return _behind_dotted(text, places, table, key, said)


def _with_row(text: str, after: int, row: str) -> str:
    at = _row_end(text, after)
    return spliced(text, [(at, at, f"\n{row}")])


def _in_braces(places: Places, table: KeyPath, pair: str) -> str:
    start, end = places.values[table], places.ends[table]
    if places.text[start] != "{":
        raise KeyError(table)
    inside = places.text[start + 1 : end - 1].rstrip()
    return spliced(places.text, [(start, end, f"{{{inside}{', ' if inside.strip() else ''}{pair}}}")])


def _behind_dotted(text: str, places: Places, table: KeyPath, key: str, said: str) -> str:
    """The same for a table that is written by dotted keys: behind the last of them, spelt as they are."""
    depths = range(len(table), 0, -1)
    depth = next((n for n in depths if table[:n] in places.values or _is_header(places, table[:n])), 0)
    spelt = ".".join([*(toml_key(str(part)) for part in table[depth:]), key])
    siblings = [p for p in places.ends if p[: len(table)] == table and p in places.keys]
    if not siblings:  # a table that only tables below it open, such as [grid.left_hand] without [grid]
        first = min(places.keys[p] for p in _headers_below(places, table))
        name = ".".join(toml_key(part) for part in table if isinstance(part, str))
        return spliced(text, [(first, first, f"[{name}]\n{key} = {said}\n\n")])
    last = max(siblings, key=lambda p: places.ends[p])
    if _has_row(places, last):
        return _with_row(text, places.ends[last], f"{spelt} = {said}")
    return spliced(text, [(places.ends[last], places.ends[last], f", {spelt} = {said}")])


def _with_entry(text: str, places: Places, parent: KeyPath, index: int, said: str, order: Sequence[str]) -> str:
    """The text with one more entry of a list: in the way in which the others are written."""
    if parent in places.values:
        start, end = places.values[parent], places.ends[parent]
        if text[start] != "[" or (index and (*parent, index - 1) not in places.values):
            raise KeyError(parent)
        return spliced(text, _entry_splices(places, (parent, index), said))
    if index and _is_header(places, (*parent, index - 1)) and said.startswith("{"):
        _, end = _block(places, _headers_below(places, (*parent, index - 1))[-1])
        name = ".".join(toml_key(part) for part in parent if isinstance(part, str))
        return spliced(text, [(end, end, f"{_break(text, end)}[[{name}]]\n{_rows(said)}\n")])
    if index or _is_there(places, parent):
        raise KeyError(parent)
    return _added(text, parent, f"[{said}]", order)


def _entry_splices(places: Places, entry: tuple[KeyPath, int], said: str) -> list[Splice]:
    """What is written for entry `index` of a list, behind its last: in the same row, or in one of its own like that."""
    parent, index = entry
    text, end = places.text, places.ends[parent] - 1
    if not index:
        return [(places.values[parent] + 1, end, said)]
    last = (*parent, index - 1)
    after, start = places.ends[last], places.values[last]
    has_comma = "," in re.sub(r"#[^\n]*", "", text[after:end])
    row = _row_start(text, start)
    if text[row:start].strip() or row < places.values[parent]:
        return [(after, end, f", {said}")] if "#" not in text[after:end] else [(after, after, f", {said}")]
    comma = [] if has_comma else [(after, after, ",")]
    at = _row_end(text, after) if _row_end(text, after) < end else end
    return [*comma, (at, at, f"\n{text[row:start]}{said}{',' if has_comma else ''}")]


def _rows(braces: str) -> str:
    """The pairs of a table in braces, a row each."""
    at = "t = "
    places = Places.of(at + braces)
    pairs = [p for p in places.values if len(p) == 2]
    return "".join(f"{places.text[places.keys[p] : places.ends[p]]}\n" for p in pairs)


def _break(text: str, at: int) -> str:
    """What must stand at `at` so that a blank row is above what follows."""
    return "" if not at or text[:at].endswith("\n\n") else "\n" if text[:at].endswith("\n") else "\n\n"


def _line_end(text: str, at: int) -> str:
    return "" if not at or text[at - 1] == "\n" else "\n"


def _with_table(text: str, places: Places, name: str, rows: str, order: Sequence[str]) -> str:
    """The text with a new table of the top that has these rows."""
    rank = {key: i for i, key in enumerate(order)}
    own = rank.get(name, len(rank))
    later = [places.keys[path] for path in _headers_below(places, ()) if rank.get(str(path[0]), -1) > own]
    at = _above(text, min(later)) if later else len(text)
    return spliced(text, [(at, at, f"{_break(text, at)}[{toml_key(name)}]\n{rows}{chr(10) if later else ''}")])


# --- taking away ------------------------------------------------------------------------------------------------------


def _cut(places: Places, path: KeyPath) -> Splice:
    """The piece of text that goes with the value at `path`: its row, or its part of braces or of a list."""
    text = places.text
    if _has_row(places, path) and not isinstance(path[-1], int):
        inside = any(path[:n] in places.values for n in range(1, len(path)))
        if not inside:
            return _row_start(text, places.keys[path]), min(_row_end(text, places.ends[path]) + 1, len(text)), ""
    above = max((path[:n] for n in range(1, len(path)) if path[:n] in places.values), key=len)
    entries = _entries(places, above)
    here = next(i for i, (_, _, p) in enumerate(entries) if p == path)
    start, end, _ = entries[here]
    if here + 1 < len(entries):
        return start, entries[here + 1][0], ""
    return (entries[here - 1][1], end, "") if here else (start, end, "")


def _entries(places: Places, above: KeyPath) -> list[tuple[int, int, KeyPath]]:
    """Start, end and path of each entry of a table in braces, or of a list."""
    found = [
        (places.keys.get(p, places.values[p]) if isinstance(p[-1], str) else places.values[p], places.ends[p], p)
        for p in places.values
        if len(p) > len(above)
        and p[: len(above)] == above
        and not any(p[:n] in places.values for n in range(len(above) + 1, len(p)))
    ]
    return sorted(found)
