"""Mastery's values as JSON and back, so that a history can keep them.

Dataclasses become tables of their fields, tuples lists, dates ISO 8601, members of enumerations their values. What is
read is checked against the types of the fields; what is absent takes its default, so that older documents stay legible.
"""

import dataclasses
import types
from datetime import date
from enum import Enum
from functools import cache
from typing import Any, TypeAlias, TypeVar, Union, get_args, get_origin, get_type_hints

from station.core.errors import BadInput
from station.drills.mastery.mastery_state import ItemState

SCHEMA = "drum-station/mastery/1"

Value = TypeVar("Value")
Hint: TypeAlias = Any
"""The type of a field, as `typing` tells it."""
Plain: TypeAlias = Any
"""What a field holds."""


def document_of(state: ItemState) -> dict[str, Any]:
    """What is known of an item, as a JSON document."""
    return {"schema": SCHEMA, "item": to_json(state)}


def state_from(document: object, source: str) -> ItemState:
    """The state in a document; raises `BadInput` that names `source`, the place and the fault."""
    if not isinstance(document, dict) or document.get("schema") != SCHEMA:
        raise BadInput(source, "schema", f"is not {SCHEMA}")
    return from_json(ItemState, document.get("item"), source, "item")


def to_json(value: object) -> Plain:
    """Any value of the policy (state, result, rules) as JSON values."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {field.name: to_json(getattr(value, field.name)) for field in dataclasses.fields(value)}
    if isinstance(value, tuple):
        return [to_json(one) for one in value]
    if isinstance(value, Enum):
        return value.value
    return value.isoformat() if isinstance(value, date) else value


def from_json(kind: type[Value], raw: object, source: str, place: str = "") -> Value:
    """A value of the dataclass `kind`; raises `BadInput` where `raw` does not fit it."""
    value = _read(kind, raw, _Place(source, place))
    assert isinstance(value, kind), "a dataclass reads as itself"
    return value


# --- reading ----------------------------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True, slots=True)
class _Place:
    source: str
    path: str

    def at(self, step: str) -> "_Place":
        return _Place(self.source, f"{self.path}.{step}" if self.path else step)

    def fault(self, text: str) -> BadInput:
        return BadInput(self.source, self.path, text)


def _read(kind: Hint, raw: object, place: _Place) -> Plain:
    origin: object = get_origin(kind)
    if origin in (Union, types.UnionType):
        some = [one for one in get_args(kind) if one is not type(None)]
        return None if raw is None and len(some) < len(get_args(kind)) else _read(some[0], raw, place)
    if origin is tuple:
        return _read_tuple(get_args(kind), raw, place)
    if dataclasses.is_dataclass(kind):
        return _read_fields(kind, raw, place)
    return _read_plain(kind, raw, place)


def _read_fields(kind: Hint, raw: object, place: _Place) -> Plain:
    if not isinstance(raw, dict):
        raise place.fault("is no table")
    hints = _hints(kind)
    unknown = sorted(set(raw) - set(hints))
    if unknown:
        raise place.at(str(unknown[0])).fault("nobody knows this key")
    missing = [field.name for field in dataclasses.fields(kind) if field.name not in raw and _is_required(field)]
    if missing:
        raise place.at(missing[0]).fault("is missing")
    return kind(**{name: _read(hints[name], value, place.at(name)) for name, value in raw.items()})


def _read_tuple(kinds: tuple[Hint, ...], raw: object, place: _Place) -> tuple[Plain, ...]:
    if not isinstance(raw, list):
        raise place.fault("is no list")
    if kinds[-1] is Ellipsis:
        kinds = (kinds[0],) * len(raw)
    if len(kinds) != len(raw):
        raise place.fault(f"has {len(raw)} values, not {len(kinds)}")
    return tuple(_read(kind, one, place.at(str(i))) for i, (kind, one) in enumerate(zip(kinds, raw, strict=True)))


def _read_plain(kind: Hint, raw: object, place: _Place) -> Plain:
    """A number, a word, a truth value, a date or a member of an enumeration."""
    if kind is float and isinstance(raw, int | float) and not isinstance(raw, bool):
        return float(raw)
    if kind is date or issubclass(kind, Enum):
        try:
            return date.fromisoformat(str(raw)) if kind is date else kind(raw)
        except ValueError as fault:
            raise place.fault(f"{raw!r} is no {kind.__name__.lower()}") from fault
    if not isinstance(raw, kind) or (isinstance(raw, bool) and kind is not bool):
        raise place.fault(f"{raw!r} is no {kind.__name__}")
    return raw


def _is_required(field: "dataclasses.Field[Any]") -> bool:
    return field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING


@cache
def _hints(kind: Hint) -> dict[str, Hint]:
    return get_type_hints(kind)
