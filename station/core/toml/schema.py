"""What the tables of our TOML files hold: a schema is a table of fields, and every fault of a file is found at once.

A *reader* takes a raw value and gives what it means, or raises `Wrong` with everything that is wrong in it. Readers of
tables and lists are made of readers of their parts, so the schema of a whole file is one reader. Each carries what it
expects (`core.expected`).
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, datetime
from enum import IntEnum
from itertools import islice
from typing import Any, Generic, TypeVar
from unicodedata import category

from station.core.did_you_mean import did_you_mean, nearest, nearest_word
from station.core.expected import LINE, TEXT, JsonSchema, expected_by, expects, later, list_like
from station.core.pieces import word
from station.core.toml.toml_faults import MOST_FAULTS, Fault, Faults, Noted, Wrong, placed, refused, wrong
from station.core.toml.toml_source import Source
from station.core.toml.toml_write import toml_text

T = TypeVar("T")
K = TypeVar("K")
Reader = Callable[[object], T]
_MOST_BITS = 4_096
_LONGEST_SHOWN = 40
_LONGEST_LISTED = 80
"""Letters of a value, and of the words to choose from, that a message repeats (our choice)."""


# --- tables and lists -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Field(Generic[T]):
    """What stands at a key: its reader, and what counts where the file says nothing or something wrong.

    `must` is for a key that a file must have: an example of what to write, or nothing but an empty text. `called` is
    the name of the value where that is not the key.
    """

    read: Reader[T]
    default: T
    must: str | None = None
    called: str = ""


Fields = Mapping[str, Field[Any]]


def needed(read: Reader[T], example: str = "") -> Field[T | None]:
    """A key that the file must have."""
    return Field(read, None, example)


def optional(read: Reader[T]) -> Field[T | None]:
    """A key that the file may have; None where it has not."""
    return Field(read, None)


def table_like(fields: Fields) -> JsonSchema:
    """What a table with these fields is like, for editors."""
    must = [key for key, each in fields.items() if each.must is not None]
    return {
        "type": "object",
        "properties": {key: expected_by(each.read) for key, each in fields.items()},
        "additionalProperties": False,
    } | ({"required": must} if must else {})


def checked_values(raw: object, fields: Fields, noun: str = "key") -> tuple[dict[str, Any], Faults]:
    """The values of all fields of a table, in the table's order, and all that is wrong; `noun` names its keys."""
    values: dict[str, Any] = {}
    faults = Faults()
    nothing: dict[str, object] = {}
    table = faults.attempt(_table, raw, nothing)
    for key, value in table.items():
        if key in fields:
            values[key] = faults.attempt(fields[key].read, value, fields[key].default, key)
        elif not faults.are_many:
            faults.noted.append(Noted(no_such(noun, key, fields), (key,), at_key=True, is_unknown=True))
    unknown = islice((key for key in table if key not in fields), MOST_FAULTS)
    meant = {found for key in unknown if (found := nearest_word(key, fields))}
    for key, each in fields.items():
        if key not in table:
            values[key] = each.default
            if each.must is not None and table is not nothing and key not in meant:
                faults.noted.append(Noted(_missing(each.must), (key,), at_key=True, is_missing=True))
    return values, faults


def record(build: Callable[..., T], fields: Fields, noun: str = "key") -> Reader[T]:
    """A table with these fields; `build` takes all of them by name and may raise `Wrong`."""

    @expects(table_like(fields))
    def read(raw: object) -> T:
        values, faults = checked_values(raw, fields, noun)
        faults.check()
        return build(**{fields[key].called or key: value for key, value in values.items()})

    return read


def said(fields: Fields, noun: str = "key") -> Reader[dict[str, Any]]:
    """A table of which only those fields count that the file says: as what they are `called`, in the table's order."""

    @expects(table_like(fields))
    def read(raw: object) -> dict[str, Any]:
        values, faults = checked_values(raw, fields, noun)
        faults.check()
        return {fields[key].called or key: value for key, value in values.items() if key in _table(raw)}

    return read


def table_of(read_key: Reader[K], read: Reader[T]) -> Reader[dict[K, T]]:
    """A table whose keys are all of one kind, and its values too."""

    @expects({"type": "object", "additionalProperties": expected_by(read)})
    def read_table(raw: object) -> dict[K, T]:
        found: dict[K, Any] = {}
        faults = Faults()
        for key, value in _table(raw).items():
            if faults.are_many:
                break
            try:
                name = read_key(key)
            except Wrong as fault:
                faults.noted += [replace(each, path=(key,), at_key=True, is_unknown=True) for each in fault.faults]
                continue
            if name in found:
                faults.add((key,), f"{key} is here twice", at_key=True)
            found[name] = faults.attempt(read, value, None, key)
        faults.check()
        return found

    return read_table


def list_of(read: Reader[T], expected: str) -> Reader[tuple[T, ...]]:
    """A list whose entries are all of one kind; `expected` is an example of it in words."""

    @expects(list_like(expected_by(read)))
    def read_list(raw: object) -> tuple[T, ...]:
        entries, faults = _list(raw, expected), Faults()
        found: list[Any] = [faults.attempt(read, entry, None, index) for index, entry in enumerate(entries)]
        faults.check()
        return tuple(found)

    return read_list


def row_of(reads: Sequence[Reader[Any]], expected: str) -> Reader[tuple[Any, ...]]:
    """A list of as many entries as there are readers, each of its own kind."""
    count = len(reads)

    @expects({"type": "array", "prefixItems": [*map(expected_by, reads)], "minItems": count, "maxItems": count})
    def read_row(raw: object) -> tuple[Any, ...]:
        entries, faults = _list(raw, expected), Faults()
        if len(entries) != len(reads):
            raise wrong(f"expected {expected}, found {len(entries)} entries")
        found = [faults.attempt(read, entries[index], None, index) for index, read in enumerate(reads)]
        faults.check()
        return tuple(found)

    return read_row


def _table(raw: object) -> dict[str, object]:
    if not isinstance(raw, dict):
        raise wrong(f"expected a table, found {shown(raw)}")
    return raw


def _list(raw: object, expected: str) -> list[object]:
    if not isinstance(raw, list):
        raise wrong(f"expected {expected}, found {shown(raw)}")
    return raw


def _missing(example: str) -> str:
    return f"is missing; expected {example}" if example else "is missing"


def no_such(noun: str, name: str, known: Iterable[str]) -> str:
    """That nobody knows `name`, and which one may be meant."""
    return f"no such {noun}: {_short(name)}{did_you_mean(name, known)}"


# --- single values ----------------------------------------------------------------------------------------------------


anything = later({})
"""The value as it is: it is read later, and nothing can be said of it before."""


def point(reach_m: float) -> Reader[tuple[float, float, float]]:
    """Three lengths in metres, none farther from 0 than `reach_m`."""
    lengths = row_of([number(-reach_m, reach_m)] * 3, "[right, forward, up] in metres")

    def read(value: object) -> tuple[float, float, float]:
        x, y, z = lengths(value)
        return x, y, z

    return read


@expects(TEXT)
def text(value: object) -> str:
    """A string as it is written."""
    if not isinstance(value, str):
        raise wrong(f'expected text in quotes, such as "…", found {shown(value)}')
    return value


@expects(TEXT)
def prose(value: object) -> str:
    """A string, blanks at its ends stripped; of control characters, which terminals obey, only line ends and tabs."""
    stripped = text(value).strip()
    control = next((c for c in stripped if category(c) == "Cc" and c not in "\n\t"), None)
    if control:
        raise wrong(f"expected text without control characters, found {control}")
    return stripped


@expects(LINE)
def title(value: object) -> str:
    """A string of one line that says something."""
    line = prose(value)
    if not line or "\n" in line:
        raise wrong("expected one line of text")
    return line


@expects({"type": "boolean"})
def flag(value: object) -> bool:
    """True or false."""
    if not isinstance(value, bool):
        raise wrong(f"expected true or false, found {shown(value)}")
    return value


@expects({"type": "string", "format": "date"})
def day(value: object) -> date:
    """A day without a time."""
    if not isinstance(value, date) or isinstance(value, datetime):
        raise wrong(f"expected a day such as 2026-01-31, found {shown(value)}")
    return value


def number(low: float, high: float) -> Reader[float]:
    """A number from `low` to `high`; neither NaN nor infinite."""

    @expects({"type": "number", "minimum": low, "maximum": high})
    def read(value: object) -> float:
        if not isinstance(value, int | float) or isinstance(value, bool) or not low <= value <= high:
            raise wrong(f"expected a number from {low:g} to {high:g}, found {shown(value)}")
        return float(value)

    return read


def whole(low: int, high: int) -> Reader[int]:
    """A whole number from `low` to `high`."""

    @expects({"type": "integer", "minimum": low, "maximum": high})
    def read(value: object) -> int:
        fits = isinstance(value, int | float) and not isinstance(value, bool) and low <= value <= high
        if not fits or int(value) != value:  # type: ignore[call-overload] # a number, for it fits
            raise wrong(f"expected a whole number from {low} to {high}, found {shown(value)}")
        return int(value)  # type: ignore[call-overload, no-any-return]

    return read


def whole_key(low: int, high: int) -> Reader[int]:
    """A key that is a whole number from `low` to `high`."""

    def read(key: object) -> int:
        number = str(key)
        if not (number.isascii() and number.isdecimal() and len(number) < 10 and low <= int(number) <= high):
            raise wrong(f"expected a number from {low} to {high} for a key, found {_short(number)}")
        return int(number)

    return read


def choice(choices: Mapping[str, T], noun: str) -> Reader[T]:
    """What one of some words stands for; `noun` is what they are called."""
    words = either(choices)
    listed = words if len(words) <= _LONGEST_LISTED else ""

    @expects({"enum": list(choices)})
    def read(value: object) -> T:
        if not isinstance(value, str):
            raise wrong(f"expected {listed or f'a {noun}'}, found {shown(value)}")
        if value in choices:
            return choices[value]
        if not listed:
            raise wrong(no_such(noun, value, choices))
        raise wrong(f"expected {listed}, found {shown(value)}{nearest(value, choices)}")

    return read


def one_of(words: Iterable[str], noun: str) -> Reader[str]:
    """One of some words."""
    return choice({each: each for each in words}, noun)


def key_of(choices: Mapping[str, T], noun: str) -> Reader[T]:
    """What a key of a closed set stands for."""

    def read(key: object) -> T:
        if key not in choices:
            raise wrong(no_such(noun, str(key), choices))
        return choices[str(key)]

    return read


Member = TypeVar("Member", bound=IntEnum)


def members_by_label(kind: type[Member]) -> dict[str, Member]:
    """The members of an enumeration by the words that files have for them."""
    return {word(member): member for member in kind}


def either(words: Iterable[str]) -> str:
    """Some words as a choice: `a, b or c`."""
    *most, last = words
    return f"{', '.join(most)} or {last}" if most else last


def shown(value: object) -> str:
    """A raw value as a message shows it: never long."""
    if isinstance(value, dict | list):
        return "a table" if isinstance(value, dict) else "a list"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and value.bit_length() > _MOST_BITS:  # more digits than Python writes
        return _short(hex(value))
    return _short(toml_text(value) if isinstance(value, str) else str(value))


def _short(words: str) -> str:
    half = _LONGEST_SHOWN // 2
    return words if len(words) <= _LONGEST_SHOWN else f"{words[:half]}…{words[-half:]}"


# --- a whole file -----------------------------------------------------------------------------------------------------


def read(source: Source, reader: Reader[T]) -> T:
    """What a whole file means; raises `BadInput` with the place of its first fault."""
    value, faults = reading(source, reader)
    if faults or value is None:
        raise refused(faults, source.is_file)
    return value


def reading(source: Source, reader: Reader[T]) -> tuple[T | None, list[Fault]]:
    """What a whole file means, and no fault; or None, and all its faults in their order."""
    try:
        value = reader(source.raw) if source.is_read else None
    except Wrong as found:
        return None, placed(source, found.faults)
    faults = placed(source, ())
    return (None if faults else value), faults
