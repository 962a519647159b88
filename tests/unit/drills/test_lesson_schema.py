"""The schema for editors says what the reader says: both are asked, and must agree.

The judge of JSON Schema here is small and its own; it knows the words that are used, and refuses others.
"""

import re
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

from station.core.expected import DRAFT
from station.drills.library import lesson_names, lesson_path
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.lesson_schema import lesson_schema
from tests.unit.drills.lesson_faults import GOOD
from tools.lesson_reference import PAGE, page_with_tables

SCHEMA = lesson_schema()
KNOWN = {"$schema", "$defs", "$ref", "title", "description", "type", "properties", "additionalProperties", "required"}
KNOWN |= {"propertyNames", "items", "minItems", "maxItems", "prefixItems", "enum", "const", "anyOf"}
KNOWN |= {"minimum", "maximum", "minLength", "pattern"}
TYPES: Mapping[str, tuple[type, ...]] = {
    "string": (str,),
    "number": (int, float),
    "integer": (int, float),
    "object": (dict,),
    "array": (list,),
    "boolean": (bool,),
}


def suits(value: object, schema: Mapping[str, Any]) -> bool:
    """Whether the value is one that the schema describes."""
    assert set(schema) <= KNOWN, set(schema) - KNOWN
    if "$ref" in schema:
        return suits(value, SCHEMA["$defs"][schema["$ref"].rpartition("/")[2]])
    if "anyOf" in schema:
        return any(suits(value, each) for each in schema["anyOf"])
    if "enum" in schema or "const" in schema:
        return value in schema.get("enum", [schema.get("const")])
    if "type" not in schema:
        return True
    if not isinstance(value, TYPES[schema["type"]]) or (isinstance(value, bool) and schema["type"] != "boolean"):
        return False
    return all(_parts(value, schema))


def _parts(value: object, schema: Mapping[str, Any]) -> Iterator[bool]:
    if isinstance(value, int | float):
        yield schema.get("minimum", value) <= value <= schema.get("maximum", value)
        yield schema["type"] != "integer" or value == int(value)
    elif isinstance(value, str):
        yield len(value) >= schema.get("minLength", 0)
        yield re.search(schema.get("pattern", ""), value) is not None
    elif isinstance(value, list):
        yield schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value))
        entries = schema.get("prefixItems", [schema.get("items", {})] * len(value))
        yield all(suits(one, each) for one, each in zip(value, entries, strict=False))
    elif isinstance(value, dict):
        yield set(schema.get("required", ())) <= set(value)
        yield all(suits(key, schema.get("propertyNames", {})) for key in value)
        yield all(suits(each, _of(key, schema)) for key, each in value.items())


def _of(key: str, schema: Mapping[str, Any]) -> Mapping[str, Any]:
    other = schema.get("additionalProperties", {})
    known: Mapping[str, Any] = schema.get("properties", {}).get(key, {"enum": []} if other is False else other)
    return known


@pytest.mark.parametrize("name", lesson_names())
def test_every_shipped_lesson_suits_the_schema(name: str) -> None:
    assert suits(tomllib.loads(lesson_path(name).read_text(encoding="utf-8")), SCHEMA)


def test_a_lesson_that_uses_every_word_suits_it() -> None:
    assert SCHEMA["$schema"] == DRAFT
    assert suits(tomllib.loads(GOOD), SCHEMA)


def ranges(schema: Mapping[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], float, float]]:
    """Every number of the schema by the way to it."""
    if "minimum" in schema:
        yield path, schema["minimum"], schema["maximum"]
    for key, each in schema.get("properties", {}).items():
        yield from ranges(each, (*path, key))


UNBOUND = 10**6
"""Bars and beats are bounded by the grid that they are in."""
OF_THE_TOP = [one for one in ranges(SCHEMA) if one[2] < UNBOUND]
OF_A_GRID = [(("grid", *path), low, high) for path, low, high in ranges(SCHEMA["$defs"]["grid"])]


@pytest.mark.parametrize(("path", "low", "high"), OF_THE_TOP + OF_A_GRID, ids=str)
def test_the_reader_draws_the_line_where_the_schema_does(path: tuple[str, ...], low: float, high: float) -> None:
    for value, is_right in ((low, True), (high, True), (low - 0.01, False), (high + 0.5, False)):
        words = f"{path[-1]}: expected"
        said = [fault.text for fault in parse_lesson(_lesson(path, value), "t", "t").faults]
        assert any(words in text for text in said) != is_right, (value, said)


def _lesson(path: tuple[str, ...], value: float) -> str:
    return f'title = "T"\n{".".join(path)} = {value!r}\ngrid.snare = "o"\n'


def keys(schema: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for key, each in schema.get("properties", {}).items():
        yield key, each
        yield from keys(each)
    items = [schema["items"]] if "items" in schema else []
    for each in (*schema.get("anyOf", ()), *items, *schema.get("$defs", {}).values()):
        yield from keys(each)


def test_every_key_has_a_description() -> None:
    faults = set(SCHEMA["properties"]["goals"]["properties"]["faults"]["properties"])
    lacking = {key for key, each in keys(SCHEMA) if not each.get("description")} - faults
    assert lacking == set()


def test_the_reference_page_has_the_tables_of_the_reader() -> None:
    """If not: python -m tools.lesson_reference."""
    page = Path(PAGE).read_text(encoding="utf-8")
    assert page == page_with_tables(page)
