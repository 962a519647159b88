"""The schema of lesson files for editors, and the tables of the reference page, made of what the readers expect."""

from collections.abc import Iterator, Mapping
from typing import Any

from station.core.expected import DRAFT, JsonSchema, list_like
from station.core.toml.schema import table_like
from station.drills.grid.tab_symbols import LINE_PIECES
from station.drills.reading.lesson_fields import FIELDS
from station.drills.writing.lesson_words import LINES, words_of

_MOST_NAMED = 8
"""So many words to choose from are named in a table's cell (our choice)."""


def lesson_schema() -> JsonSchema:
    """JSON Schema, draft 2020-12, of a lesson file; each key has a `description`."""
    schema = _described(table_like(FIELDS), ())
    grid = schema["properties"]["grid"]
    one, _ = grid["anyOf"]
    each = {"$ref": "#/$defs/grid"}
    schema["properties"]["grid"] = {**grid, "anyOf": [each, list_like(each, 1)]}
    return {"$schema": DRAFT, "title": "A lesson of the drum station", **schema, "$defs": {"grid": one}}


def _described(schema: JsonSchema, path: tuple[str, ...]) -> JsonSchema:
    """The schema of the value at `path` with what its keys say."""
    out = dict(schema)
    if path and (words := words_of(path)):
        out = {"description": f"{words[0].upper()}{words[1:]}.", **out}
    if "properties" in schema:
        out["properties"] = {key: _described(each, (*path, name_of(key))) for key, each in schema["properties"].items()}
    if "items" in schema:
        out["items"] = _described(schema["items"], path) if "properties" in schema["items"] else schema["items"]
    if "anyOf" in schema:
        out["anyOf"] = [_described(each, path) if "properties" in str(each) else each for each in schema["anyOf"]]
    return out


def name_of(key: str) -> str:
    """The name under which `lesson_words` knows a key."""
    return LINES if key in LINE_PIECES else key


# --- the tables of the reference page ---------------------------------------------------------------------------------


def reference_tables() -> str:
    """A table in Markdown for each table of the format, below a heading that names it."""
    return "\n\n".join(
        f"### {heading}\n\n| key | value | says |\n|---|---|---|\n" + "\n".join(_rows(schema, path))
        for heading, schema, path in _tables()
    )


def _tables() -> Iterator[tuple[str, Mapping[str, Any], tuple[str, ...]]]:
    top = table_like(FIELDS)["properties"]
    goals = top["goals"]["properties"]
    grid = _entry(top["grid"])
    yield "The lesson", top, ()
    yield "`[dynamics]`", top["dynamics"]["properties"], ("dynamics",)
    yield "`[graces]`", top["graces"]["properties"], ("graces",)
    yield "`[goals]`", goals, ("goals",)
    yield "`[goals.right_hand]` and other limbs", goals["right_hand"]["properties"], ("goals", "right_hand")
    yield "`[[goals.bars]]`", _entry(goals["bars"]), ("goals", "bars")
    yield "`[grid]`, or each `[[grid]]`", grid, ("grid",)
    yield "`[grid.timing]`", grid["timing"]["properties"], ("grid", "timing")
    yield "Each entry of `at`", _entry(grid["at"]), ("grid", "at")
    yield "`[[grid.cycle]]`", _entry(grid["cycle"]), ("grid", "cycle")


def _entry(schema: Mapping[str, Any]) -> Mapping[str, Any]:
    """The keys of the tables that a list holds, or of the one or several tables that may stand here."""
    found: Mapping[str, Any] = next(s for s in schema.get("anyOf", [schema]) if "items" in s)["items"]["properties"]
    return found


def _rows(keys: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[str]:
    said_lines = False
    for key, schema in keys.items():
        if key in LINE_PIECES and said_lines:
            continue
        said_lines |= key in LINE_PIECES
        name = "`snare`, `hihat` …" if key in LINE_PIECES else f"`{key}`"
        yield f"| {name} | {_value(schema)}{_unit(key)} | {words_of((*path, name_of(key)))} |"


_UNITS = {"ms": " ms", "db": " dB", "pct": " %"}
"""By the end of a key."""
_ANY_NUMBER = 10**6
"""Whole numbers up to here are bounded elsewhere: by the bars that there are."""


def _unit(key: str) -> str:
    return _UNITS.get(key.rpartition("_")[2], "")


def _value(schema: Mapping[str, Any]) -> str:
    """What may stand at a key, in a few words."""
    if "anyOf" in schema:
        return " or ".join(dict.fromkeys(map(_value, schema["anyOf"])))
    if "enum" in schema:
        words = [f"`{word}`" for word in schema["enum"]]
        return ", ".join(words) if len(words) <= _MOST_NAMED else f"{', '.join(words[:3])} …"
    if "minimum" in schema:
        low, high = schema["minimum"], schema["maximum"]
        return f"{low:g} or more" if high >= _ANY_NUMBER else f"{low:g}–{high:g}"
    if "prefixItems" in schema:
        return f"[{', '.join(map(_value, schema['prefixItems']))}]"
    if schema.get("type") == "array":
        return "list of tables" if "properties" in schema["items"] else "list"
    return {"object": "table", "string": "text"}[schema["type"]]
