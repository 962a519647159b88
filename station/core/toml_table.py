"""TOML tables that check what is taken from them and name the place of a fault: kits, figures and styles share them.

A place is the keys that lead to a value, joined by dots; the tables of an array are counted from 0.
"""

import difflib
import re
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.toml_places import KeyPath, Places
from station.core.utf8 import utf8_text

_MAX_LENGTH_M = 3.0


_AT = re.compile(r" \(at (line \d+, column \d+)\)$")
"""How `tomllib` ends its complaints."""


def read_toml(path: Path) -> dict[str, object]:
    """The whole file; raises `BadInput` if it cannot be read or is not TOML."""
    return parse_toml(_bytes(path), path)


def parse_toml(data: bytes, source: str | Path) -> dict[str, Any]:
    """What a file's bytes say; raises `BadInput` that names `source` if they are not TOML."""
    try:
        return tomllib.loads(utf8_text(data, source, "a TOML file"))
    except tomllib.TOMLDecodeError as fault:
        at = _AT.search(str(fault))
        raise BadInput(source, at[1] if at else "", _AT.sub("", str(fault))) from fault
    except RecursionError as fault:
        raise BadInput(source, "", "lists or tables nested too deeply") from fault


def _bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError as fault:
        raise BadInput(path, "", "no such file") from fault
    except OSError as fault:
        raise BadInput(path, "", f"cannot be read: {fault.strerror or fault}") from fault


@contextmanager
def located(path: Path) -> Iterator[None]:
    """Give the faults that are found in the file at `path` by their key the line and column of its value."""
    try:
        yield
    except BadInput as fault:
        if fault.source != str(path) or not fault.place or fault.place.startswith("line "):
            raise
        places = Places.of(utf8_text(_bytes(path), path, "a TOML file"))
        line, column = places.find(_key_path(fault.place, places))
        raise BadInput(path, f"line {line}, column {column}, {fault.place}", fault.fault) from fault


def _key_path(place: str, places: Places) -> KeyPath:
    """The keys of a place; a number is an index where the file has an array there, else a key."""
    path: KeyPath = ()
    for part in place.split("."):
        index = (*path, int(part)) if part.isdecimal() else None
        path = index if index in places.keys or index in places.values else (*path, part)
    return path


def find_shipped(name_or_path: str | Path, folder: Path, what: str) -> Path:
    """The file that is meant: a path that ends in .toml, or the name of one in `folder`.

    Raises `BadInput` that names the nearest there are.
    """
    path = Path(name_or_path)
    if path.suffix == ".toml":
        return path
    path = folder / f"{name_or_path}.toml"
    if not path.exists():
        names = shipped(folder)
        near = difflib.get_close_matches(str(name_or_path), names, n=2) or names
        raise BadInput(str(name_or_path), "", f"no such {what}; {_there(near)}")
    return path


def _there(names: list[str]) -> str:
    """What there is, in words."""
    if len(names) == 1:
        return f"there is {names[0]}"
    return f"there are {', '.join(names[:-1])} and {names[-1]}"


def shipped(folder: Path) -> list[str]:
    """The names of the files in `folder`."""
    return sorted(p.stem for p in folder.glob("*.toml"))


class Table:
    """A TOML table that checks what is taken from it and names the place of a fault."""

    def __init__(self, raw: object, source: Path, place: str) -> None:
        if not isinstance(raw, Mapping):
            raise BadInput(source, place, f"expected a table, found {raw!r}")
        self.raw: Mapping[str, object] = raw
        self.source = source
        self.place = place

    def _at(self, key: str) -> str:
        return f"{self.place}.{key}" if self.place else key

    def _lacks(self, key: str) -> BadInput:
        return BadInput(self.source, self.place, f"{key} is missing")

    def only(self, keys: set[str]) -> None:
        """Refuse any key that is not in `keys`."""
        for key in self.raw:
            if key not in keys:
                raise BadInput(self.source, self._at(key), f"no such key{did_you_mean(key, sorted(keys))}")

    def table(self, key: str, default: Mapping[str, object] | None = None) -> "Table":
        """The table at `key`."""
        if key not in self.raw and default is None:
            raise self._lacks(key)
        return Table(self.raw.get(key, default), self.source, self._at(key))

    def tables(self, key: str) -> list["Table"]:
        """The array of tables at `key`; empty where there is none."""
        found = self.raw.get(key, [])
        if not isinstance(found, list):
            raise BadInput(self.source, self._at(key), f"expected an array of tables, found {found!r}")
        return [Table(entry, self.source, f"{self._at(key)}.{index}") for index, entry in enumerate(found)]

    def numbers(self, low: int, high: int) -> list[tuple[int, str]]:
        """Its keys, which must be whole numbers from `low` to `high`, each as a number and as written."""
        for key in self.raw:
            if not key.isdecimal() or not low <= int(key) <= high:
                raise BadInput(self.source, self._at(key), f"expected a number from {low} to {high} for a key")
        return [(int(key), key) for key in self.raw]

    def number(self, key: str, low: float, high: float, default: float | None = None) -> float:
        """The number at `key`, from `low` to `high`."""
        value = self.raw.get(key, default)
        if value is None:
            raise self._lacks(key)
        if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
            raise BadInput(self.source, self._at(key), f"expected a number from {low:g} to {high:g}, found {value!r}")
        return float(value)

    def whole(self, key: str, low: int, high: int, default: int) -> int:
        """The whole number at `key`, from `low` to `high`."""
        value = self.number(key, low, high, default)
        if not value.is_integer():
            raise BadInput(self.source, self._at(key), f"expected a whole number, found {value:g}")
        return int(value)

    def word(self, key: str, words: tuple[str, ...], default: str) -> str:
        """One of `words` at `key`."""
        value = self.raw.get(key, default)
        if value not in words:
            raise BadInput(self.source, self._at(key), f"expected {' or '.join(words)}, found {value!r}")
        return str(value)

    def flag(self, key: str, default: bool) -> bool:
        """The truth value at `key`."""
        value = self.raw.get(key, default)
        if not isinstance(value, bool):
            raise BadInput(self.source, self._at(key), f"expected true or false, found {value!r}")
        return value

    def point(self, key: str, default: tuple[float, float, float] | None = None) -> tuple[float, float, float]:
        """The three lengths at `key`, in metres."""
        value = self.raw.get(key, default)
        if value is None:
            raise self._lacks(key)
        if not isinstance(value, list | tuple) or len(value) != 3:
            raise BadInput(self.source, self._at(key), f"expected [right, forward, up] in metres, found {value!r}")
        x, y, z = (Table({key: v}, self.source, self.place).number(key, -_MAX_LENGTH_M, _MAX_LENGTH_M) for v in value)
        return x, y, z
