"""What the tables of our TOML files hold: a schema is a table of fields, and every fault of a file is found at once.

A *reader* takes a raw value and gives what it means, or raises `Wrong` with everything that is wrong in it. Readers of
tables and lists are made of readers of their parts, so the schema of a whole file is one reader. A fault is noted by
the keys that lead to it and, inside a text, by the index of a character. Lines and columns are worked out at the end,
and only if there was a fault: a good file never pays for them. Both count from 1, in characters.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date, datetime
from enum import IntEnum
from typing import Any, Generic, TypeVar

from station.core.did_you_mean import did_you_mean, nearest
from station.core.errors import BadInput
from station.core.pieces import word
from station.core.toml_places import KeyPath, Places
from station.core.toml_source import Source
from station.core.toml_write import toml_text

T = TypeVar("T")
K = TypeVar("K")
Reader = Callable[[object], T]
MOST_FAULTS = 1000
"""More are not told: whoever mends a file mends these first (our choice)."""
_LONGEST_SHOWN = 40
_LONGEST_LISTED = 80
"""Letters of a value, and of the words to choose from, that a message repeats (our choice)."""


# --- what is wrong ----------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Noted:
    """A fault of the value at `path`, of its character `char`, or of the key itself; or that the key is missing."""

    text: str
    path: KeyPath = ()
    char: int | None = None
    at_key: bool = False
    is_missing: bool = False

    def below(self, *keys: str | int) -> "Noted":
        """The same fault, told of the table that holds the value under `keys`."""
        return replace(self, path=(*keys, *self.path))

    @property
    def words(self) -> str:
        """What is wrong, with the name of the value that it is about."""
        name = ".".join(key for key in self.path if isinstance(key, str))
        if self.is_missing:
            return f"{name} {self.text}"
        return self.text if self.at_key or self.char is not None or not name else f"{name}: {self.text}"


class Wrong(Exception):
    """A value is not what it should be; `faults` are all there are in it."""

    def __init__(self, *faults: Noted) -> None:
        super().__init__("; ".join(fault.words for fault in faults))
        self.faults = faults


def wrong(text: str, *path: str | int) -> Wrong:
    """One fault of the value itself, or of what it holds at `path`."""
    return Wrong(Noted(text, path))


def wrong_key(text: str, *path: str | int) -> Wrong:
    """One fault of the key at the end of `path` or, with none, of the one that leads to the value."""
    return Wrong(Noted(text, path, at_key=True))


@dataclass(slots=True)
class Faults:
    """Collects what is wrong where reading goes on in spite of it."""

    noted: list[Noted] = field(default_factory=list)

    def add(self, path: KeyPath, text: str, char: int | None = None, at_key: bool = False) -> None:
        """Note a fault of the value at `path`, of its character `char`, or of the key itself."""
        self.noted.append(Noted(text, path, char, at_key))

    def take(self, found: "Faults", *path: str | int) -> None:
        """Note what was found in the value at `path`."""
        self.noted += [fault.below(*path) for fault in found.noted]

    def __len__(self) -> int:
        return len(self.noted)

    @property
    def are_many(self) -> bool:
        """Whether no more of them are told."""
        return len(self.noted) >= MOST_FAULTS

    def check(self) -> None:
        """Raise `Wrong` with all of them if there is any."""
        if self.noted:
            raise Wrong(*self.noted)

    def attempt(self, read: Reader[T], value: object, default: T, *path: str | int) -> T:
        """What `value`, which stands at `path`, means; `default`, and its faults noted, where it is wrong.

        Where there are too many faults already nothing more is read.
        """
        if self.are_many:
            return default
        try:
            return read(value)
        except Wrong as found:
            self.noted += [fault.below(*path) for fault in found.faults]
            return default


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


def taken(raw: object, fields: Fields, noun: str = "key") -> tuple[dict[str, Any], Faults]:
    """The values of all fields of a table, in the table's order, and all that is wrong; `noun` names its keys."""
    values: dict[str, Any] = {}
    faults = Faults()
    nothing: dict[str, object] = {}
    table = faults.attempt(_table, raw, nothing)
    for key, value in table.items():
        if key in fields:
            values[key] = faults.attempt(fields[key].read, value, fields[key].default, key)
        elif not faults.are_many:
            faults.add((key,), no_such(noun, key, fields), at_key=True)
    for key, each in fields.items():
        if key not in table:
            values[key] = each.default
            if each.must is not None and table is not nothing:
                faults.noted.append(Noted(_missing(each.must), (key,), at_key=True, is_missing=True))
    return values, faults


def record(build: Callable[..., T], fields: Fields, noun: str = "key") -> Reader[T]:
    """A table with these fields; `build` takes all of them by name and may raise `Wrong`."""

    def read(raw: object) -> T:
        values, faults = taken(raw, fields, noun)
        faults.check()
        return build(**{fields[key].called or key: value for key, value in values.items()})

    return read


def said(fields: Fields, noun: str = "key") -> Reader[dict[str, Any]]:
    """A table of which only those fields count that the file says: as what they are `called`, in the table's order."""

    def read(raw: object) -> dict[str, Any]:
        values, faults = taken(raw, fields, noun)
        faults.check()
        return {fields[key].called or key: value for key, value in values.items() if key in _table(raw)}

    return read


def table_of(read_key: Reader[K], read: Reader[T]) -> Reader[dict[K, T]]:
    """A table whose keys are all of one kind, and its values too."""

    def read_table(raw: object) -> dict[K, T]:
        found: dict[K, Any] = {}
        faults = Faults()
        for key, value in _table(raw).items():
            if faults.are_many:
                break
            try:
                name = read_key(key)
            except Wrong as fault:
                faults.noted += [replace(each, path=(key,), at_key=True) for each in fault.faults]
                continue
            if name in found:
                faults.add((key,), f"{key} is here twice", at_key=True)
            found[name] = faults.attempt(read, value, None, key)
        faults.check()
        return found

    return read_table


def list_of(read: Reader[T], expected: str) -> Reader[tuple[T, ...]]:
    """A list whose entries are all of one kind; `expected` is an example of it in words."""

    def read_list(raw: object) -> tuple[T, ...]:
        entries, faults = _list(raw, expected), Faults()
        found: list[Any] = [faults.attempt(read, entry, None, index) for index, entry in enumerate(entries)]
        faults.check()
        return tuple(found)

    return read_list


def row_of(reads: Sequence[Reader[Any]], expected: str) -> Reader[tuple[Any, ...]]:
    """A list of as many entries as there are readers, each of its own kind."""

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


def anything(value: object) -> object:
    """The value as it is: it is read later."""
    return value


def point(reach_m: float) -> Reader[tuple[float, float, float]]:
    """Three lengths in metres, none farther from 0 than `reach_m`."""
    lengths = row_of([number(-reach_m, reach_m)] * 3, "[right, forward, up] in metres")

    def read(value: object) -> tuple[float, float, float]:
        x, y, z = lengths(value)
        return x, y, z

    return read


def text(value: object) -> str:
    """A string as it is written."""
    if not isinstance(value, str):
        raise wrong(f'expected text in quotes, such as "…", found {shown(value)}')
    return value


def prose(value: object) -> str:
    """A string, blanks at its ends stripped."""
    return text(value).strip()


def title(value: object) -> str:
    """A string of one line that says something."""
    line = prose(value)
    if not line or "\n" in line:
        raise wrong("expected one line of text")
    return line


def flag(value: object) -> bool:
    """True or false."""
    if not isinstance(value, bool):
        raise wrong(f"expected true or false, found {shown(value)}")
    return value


def day(value: object) -> date:
    """A day without a time."""
    if not isinstance(value, date) or isinstance(value, datetime):
        raise wrong(f"expected a day such as 2026-01-31, found {shown(value)}")
    return value


def number(low: float, high: float) -> Reader[float]:
    """A number from `low` to `high`; neither NaN nor infinite."""

    def read(value: object) -> float:
        if not isinstance(value, int | float) or isinstance(value, bool) or not low <= value <= high:
            raise wrong(f"expected a number from {low:g} to {high:g}, found {shown(value)}")
        return float(value)

    return read


def whole(low: int, high: int) -> Reader[int]:
    """A whole number from `low` to `high`."""

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


def words_of(kind: type[Member]) -> dict[str, Member]:
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
    return _short(toml_text(value) if isinstance(value, str) else str(value))


def _short(words: str) -> str:
    half = _LONGEST_SHOWN // 2
    return words if len(words) <= _LONGEST_SHOWN else f"{words[:half]}…{words[-half:]}"


# --- a whole file -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, order=True)
class Fault:
    """One fault of the file `source`; `text` says what is wrong and what was expected. Line 0 is the whole file."""

    source: str
    line: int
    column: int
    text: str

    @property
    def place(self) -> str:
        """Where it is, for people."""
        return f"line {self.line}, column {self.column}" if self.line else ""

    def __str__(self) -> str:
        return ": ".join(part for part in (self.source, self.place, self.text) if part)


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


def placed(source: Source, noted: Sequence[Noted]) -> list[Fault]:
    """The faults of the syntax and those `noted` of the values in the order of the file, then what is missing.

    Where lines were set aside for their syntax nothing is told to be missing, for it may stand there.
    """
    there = {Fault(source.name, *fault) for fault in source.syntax}
    if not noted:
        return sorted(there)
    places = Places.of(source.text)
    missing: list[Fault] = []
    for fault in noted[:MOST_FAULTS]:
        told = Fault(source.name, *places.find(fault.path, fault.char, fault.at_key), fault.words)
        if fault.is_missing:
            missing.append(told)
        else:
            there.add(told)
    return [*sorted(there), *([] if source.syntax else missing)]


def refused(faults: Sequence[Fault], is_file: bool = True) -> BadInput:
    """The first of `faults` in one line, which says how many more there are and what lists those of a file."""
    first, more = faults[0], len(faults) - 1
    file = f'"{first.source}"' if " " in first.source else first.source
    lists = f": `station lesson check {file}` lists them" if is_file else ""
    return BadInput(first.source, first.place, first.text + (f" (and {more} more{lists})" if more else ""))
