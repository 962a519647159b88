"""Any key of the lesson's tables set or taken away, as forms do it; and another text altogether."""

from station.core.toml.schema import shown
from station.core.toml.toml_edits import without
from station.core.toml.toml_places import KeyPath
from station.core.toml.toml_write import toml_value
from station.drills.editing.draft import Draft
from station.drills.editing.lesson_edits import SetKey


def set_key(draft: Draft, edit: SetKey) -> Draft:
    """The draft with the value at a path; tables that are left empty go with their last key."""
    path = _path_in(draft, edit.path)
    if edit.value is None:
        return _without(draft, path)
    try:
        toml_value(edit.value)
    except (TypeError, ValueError, RecursionError):
        raise draft.refused(f"TOML has no word for {shown(edit.value)}", _spelt(path)) from None
    return draft.with_key(path, edit.value)


def _path_in(draft: Draft, path: KeyPath) -> KeyPath:
    """The path as the text has it: without the index of a grid that stands alone."""
    if not path or not all(isinstance(key, str | int) for key in path):
        raise draft.refused("expected the key that is to be set")
    grid = draft.raw.get("grid")
    if path[0] != "grid" or len(path) < 2:
        return path
    index, count = path[1], len(grid) if isinstance(grid, list) else int("grid" in draft.raw)
    if not isinstance(index, int) or not 0 <= index < count:
        raise draft.refused(f"there is no such grid; the lesson has {count}", _spelt(path))
    return path if isinstance(grid, list) else ("grid", *path[2:])


def _without(draft: Draft, path: KeyPath) -> Draft:
    draft = draft.now(without(draft.text, path))
    for depth in range(len(path) - 1, 0, -1):
        above = path[:depth]
        if (isinstance(above[-1], int) and above[0] == "grid") or _value_at(draft.raw, above) not in ({}, []):
            break
        if above == ("grid",):
            break
        draft = draft.now(without(draft.text, above))
    return draft


def _value_at(raw: object, path: KeyPath) -> object:
    """What stands at a path; None where nothing does."""
    for key in path:
        table = dict(enumerate(raw)) if isinstance(raw, list) else raw
        raw = table.get(key) if isinstance(table, dict) else None
    return raw


def _spelt(path: KeyPath) -> str:
    return ".".join(str(key) for key in path)
