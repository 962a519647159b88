"""Reading one TOML table key by key: each value is checked against a small reader, and whatever is wrong is noted.

A reader takes a raw value and gives the value that it means, or raises `ValueError` with what was expected.
"""

from collections.abc import Callable, Iterable
from typing import TypeVar

from station.core.did_you_mean import did_you_mean
from station.core.toml_places import KeyPath
from station.drills.faults import Faults

T = TypeVar("T")
Reader = Callable[[object], T]


def text(value: object) -> str:
    """A string, blanks at its ends stripped."""
    if not isinstance(value, str):
        raise ValueError('expected text in quotes, such as "…"')
    return value.strip()


def title(value: object) -> str:
    """A string of one line that says something."""
    line = text(value)
    if not line or "\n" in line:
        raise ValueError("expected one line of text")
    return line


def texts(value: object) -> tuple[str, ...]:
    """A list of strings."""
    if not isinstance(value, list) or not all(isinstance(v, str) and v.strip() for v in value):
        raise ValueError('expected a list of words, such as ["rock", "groove"]')
    return tuple(v.strip() for v in value)


def whole(low: int, high: int) -> Reader[int]:
    """A whole number from `low` to `high`."""

    def read(value: object) -> int:
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise ValueError(f"expected a whole number from {low} to {high}")
        return value

    return read


def number(low: float, high: float) -> Reader[float]:
    """A number from `low` to `high`."""

    def read(value: object) -> float:
        if not isinstance(value, int | float) or isinstance(value, bool) or not low <= value <= high:
            raise ValueError(f"expected a number from {low:g} to {high:g}")
        return float(value)

    return read


def fraction(value: object) -> tuple[int, int]:
    """Two whole numbers such as "6/8"."""
    top, slash, bottom = value.partition("/") if isinstance(value, str) else ("", "", "")
    if not (slash and top.strip().isdecimal() and bottom.strip().isdecimal() and len(top + bottom) < 8):
        raise ValueError('expected two numbers such as "4/4"')
    return int(top), int(bottom)


class Table:
    """A TOML table at `path`, whose keys are taken one by one."""

    def __init__(self, raw: object, path: KeyPath, faults: Faults) -> None:
        self.path = path
        self.faults = faults
        self.is_table = isinstance(raw, dict)
        self.raw: dict[str, object] = raw if isinstance(raw, dict) else {}
        self._taken: list[str] = []
        if not self.is_table:
            faults.add(path, f"expected a table: [{'.'.join(str(k) for k in path)}] and lines below it")

    def take(self, key: str, read: Reader[T], default: T) -> T:
        """The value of `key`, or `default` where it is missing or wrong."""
        self._taken.append(key)
        if key not in self.raw:
            return default
        try:
            return read(self.raw[key])
        except ValueError as fault:
            self.fault(key, f"{key}: {fault}")
            return default

    def require(self, key: str, read: Reader[T], default: T, what: str) -> T:
        """As `take`, but a missing key is a fault; `what` says what to write."""
        if key not in self.raw:
            self._taken.append(key)
            self.faults.add(self.path, f"{key} is missing; expected {what}", at_key=True)
            return default
        return self.take(key, read, default)

    def has(self, key: str) -> bool:
        """Whether the file says `key`."""
        return key in self.raw

    def allow(self, keys: Iterable[str]) -> None:
        """Count `keys` as known."""
        self._taken += keys

    def fault(self, key: str, text: str, char: int | None = None) -> None:
        """Note a fault of the value of `key`."""
        self.faults.add((*self.path, key), text, char)

    def close(self) -> None:
        """Note every key that nobody took, with the known one nearest to it."""
        for key in self.raw:
            if key not in self._taken:
                hint = did_you_mean(key, self._taken)
                self.faults.add((*self.path, key), f"no such key: {key}{hint}", at_key=True)
