"""JSON of strangers: bounded, no key twice, no number that is none; and what it means, with the place of a fault."""

import json
from math import isfinite
from typing import TypeVar

from station.core.errors import BadInput
from station.core.toml.schema import Reader, shown
from station.core.toml.toml_faults import Wrong

T = TypeVar("T")
MOST_JSON_BYTES = 1 << 20
"""Of a parcel's table and of a report in it (our choice: the report of an hour of practice is a tenth of it)."""


def read_json(data: bytes, source: str, place: str) -> object:
    """What the document says, tables as `dict`; raises `BadInput` of `source` at `place`."""
    if len(data) > MOST_JSON_BYTES:
        raise BadInput(source, place, f"longer than {MOST_JSON_BYTES} bytes")
    try:
        return json.loads(data.decode("utf-8"), parse_float=_finite, parse_constant=_finite, object_pairs_hook=_table)
    except RecursionError:
        raise BadInput(source, place, "is no JSON document: tables or lists nested too deeply") from None
    except ValueError as fault:
        raise BadInput(source, place, f"is no JSON document: {fault}") from None


def meaning(raw: object, reader: Reader[T], source: str, place: str) -> T:
    """What `reader` makes of `raw`; raises `BadInput` with the place of the first fault and how many more there are."""
    try:
        return reader(raw)
    except Wrong as found:
        first, more = found.faults[0], len(found.faults) - 1
        keys = "".join(f"[{key + 1}]" if isinstance(key, int) else f".{key}" for key in first.path).removeprefix(".")
        said = first.text if first.path else first.words
        if first.is_missing:
            said = first.text
        at = f"{place}{'' if keys.startswith('[') or not keys else ', '}{keys}"
        raise BadInput(source, at, said + (f" (and {more} more)" if more else "")) from None


def _finite(written: str) -> float:
    number = float(written)
    if not isfinite(number):
        raise ValueError(f"{shown(written)} is no number that is read")
    return number


def _table(pairs: list[tuple[str, object]]) -> dict[str, object]:
    table = dict(pairs)
    if len(table) < len(pairs):
        raise ValueError("a key is there twice")
    return table
