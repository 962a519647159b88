"""What a reader of a TOML value expects, as JSON Schema: for editors that check and complete while people write.

A reader is a function that says no by raising; what it would say yes to, it carries with it, so that reader and schema
are one. Source of the words: JSON Schema, draft 2020-12 (Core and Validation).
"""

from collections.abc import Callable
from typing import Any, TypeVar

R = TypeVar("R", bound=Callable[[object], Any])
JsonSchema = dict[str, Any]
_CARRIED = "json_schema"
DRAFT = "https://json-schema.org/draft/2020-12/schema"

TEXT: JsonSchema = {"type": "string"}
LINE: JsonSchema = {"type": "string", "minLength": 1}


def expects(schema: JsonSchema) -> Callable[[R], R]:
    """Makes a reader carry the schema of what it accepts."""

    def carrying(reader: R) -> R:
        setattr(reader, _CARRIED, schema)
        return reader

    return carrying


def expected_by(reader: Callable[[object], Any]) -> JsonSchema:
    """The schema of what `reader` accepts; one that accepts anything where it says nothing."""
    schema: JsonSchema = getattr(reader, _CARRIED, {})
    return schema


def later(schema: JsonSchema) -> Callable[[object], object]:
    """A reader that gives the value as it is: it is read once more is known, and has to be like `schema` then."""

    @expects(schema)
    def as_it_is(value: object) -> object:
        return value

    return as_it_is


def either_of(*schemas: JsonSchema) -> JsonSchema:
    """One or the other."""
    return {"anyOf": list(schemas)}


def list_like(entry: JsonSchema, least: int = 0) -> JsonSchema:
    """A list of such entries."""
    return {"type": "array", "items": entry} | ({"minItems": least} if least else {})
