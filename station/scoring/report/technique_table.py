"""Technique as a JSON table: every field of its dataclasses under its own name, docs/report.md describes them.

Numbers have three decimals, bars count from 1 as people count, enumerations are words; None is null.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum, IntEnum

import numpy as np

from station.core.pieces import word

Json = dict[str, "Json"] | list["Json"] | str | float | int | bool | None

_DECIMALS = 3
_FROM_ONE = ("bar", "bars")


def plain(value: object, name: str = "") -> Json:
    """`value` in JSON's own types; `name` is the field that it came from."""
    if is_dataclass(value) or isinstance(value, Mapping):
        return _table(value)
    if isinstance(value, np.ndarray | tuple | list):
        return [plain(each, name) for each in (value.tolist() if isinstance(value, np.ndarray) else value)]
    if isinstance(value, Enum):
        return _key(value)
    return _figure(value, name)


def _table(value: object) -> Json:
    if is_dataclass(value):
        return {f.name: plain(getattr(value, f.name), f.name) for f in fields(value)}
    assert isinstance(value, Mapping), "it is the one or the other"
    return {_key(key): plain(each) for key, each in value.items()}


def _figure(value: object, name: str) -> Json:
    if isinstance(value, float | np.floating):
        return round(float(value), _DECIMALS)
    if isinstance(value, int) and not isinstance(value, bool):
        return value + 1 if name in _FROM_ONE else value
    assert value is None or isinstance(value, str | bool), f"{type(value)} has no place in a report"
    return value


def _key(value: object) -> str:
    return word(value) if isinstance(value, IntEnum) else str(value.value if isinstance(value, Enum) else value)
