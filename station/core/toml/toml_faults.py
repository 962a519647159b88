"""What is wrong in a TOML file: noted by keys while it is read, reported by line and column.

A fault is noted by the keys that lead to its value and, inside a text, by the index of a character. Lines and columns
are worked out at the end, and only if there was a fault: a good file never pays for them. Both count from 1, in
characters.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

from station.core.errors import BadInput
from station.core.toml.toml_places import KeyPath, Places
from station.core.toml.toml_source import Source

T = TypeVar("T")
MOST_FAULTS = 1000
"""More are not reported: whoever mends a file mends these first (our choice)."""
_LONGEST = 500
"""Letters of a message, some six rows of a terminal; of a longer one, as of a name without end, the middle is left out
(our choice)."""


# --- while a file is read ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Noted:
    """A fault of the value at `path`, of its character `char`, or of the key itself.

    The key may be at fault for being missing, or unknown where it stands.
    """

    text: str
    path: KeyPath = ()
    char: int | None = None
    at_key: bool = False
    is_missing: bool = False
    is_unknown: bool = False

    def below(self, *keys: str | int) -> "Noted":
        """The same fault, of the table that holds the value under `keys`."""
        return replace(self, path=(*keys, *self.path))

    @property
    def words(self) -> str:
        """What is wrong, in one line, with the name of the value that it is about."""
        said = self._said
        if len(said) > _LONGEST:
            said = f"{said[: _LONGEST // 2]}…{said[-_LONGEST // 2 :]}"
        return "".join(letter if letter.isprintable() else _escaped(letter) for letter in said)

    @property
    def _said(self) -> str:
        name = ".".join(key for key in self.path if isinstance(key, str))
        if self.is_missing:
            return f"{name} {self.text}"
        return self.text if self.at_key or self.char is not None or not name else f"{name}: {self.text}"


def _escaped(letter: str) -> str:
    """What Python and TOML write for a letter that no terminal shows, or that it obeys."""
    return letter.encode("unicode_escape").decode("ascii")


class Wrong(Exception):
    """A value is not what it should be; `faults` are all there are in it."""

    def __init__(self, *faults: Noted) -> None:
        super().__init__("; ".join(fault.words for fault in faults))
        self.faults = faults


def wrong(text: str, *path: str | int) -> Wrong:
    """One fault of the value itself, or of what it holds at `path`."""
    return Wrong(Noted(text, path))


@dataclass(slots=True)
class Faults:
    """Collects what is wrong where reading goes on in spite of it."""

    noted: list[Noted] = field(default_factory=list)

    def add(self, path: KeyPath, text: str, char: int | None = None, at_key: bool = False) -> None:
        """Note a fault of the value at `path`, of its character `char`, or of the key itself."""
        self.noted.append(Noted(text, path, char, at_key))

    def miss(self, path: KeyPath, text: str) -> None:
        """Note that the table at `path` lacks something, which a faulty line may have said: `text` follows its name."""
        self.noted.append(Noted(text, path, at_key=True, is_missing=True))

    def merge(self, found: "Faults", *path: str | int) -> None:
        """Note what was found in the value at `path`."""
        self.noted += [fault.below(*path) for fault in found.noted]

    def __len__(self) -> int:
        return len(self.noted)

    @property
    def are_many(self) -> bool:
        """Whether no more of them are reported."""
        return len(self.noted) >= MOST_FAULTS

    def check(self) -> None:
        """Raise `Wrong` with all of them if there is any."""
        if self.noted:
            raise Wrong(*self.noted)

    def attempt(self, read: Callable[[object], T], value: object, default: T, *path: str | int) -> T:
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


# --- for people -------------------------------------------------------------------------------------------------------


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


def placed(source: Source, noted: Sequence[Noted]) -> list[Fault]:
    """The faults of the syntax and those `noted` of the values in the order of the file, then what is missing.

    Where lines were set aside for their syntax nothing is reported missing, for it may stand there.
    """
    there = {Fault(source.name, *fault) for fault in source.syntax}
    if not noted:
        return sorted(there)
    places = Places.of(source.text)
    missing: list[Fault] = []
    for fault in noted[:MOST_FAULTS]:
        placed_fault = Fault(source.name, *places.find(fault.path, fault.char, fault.at_key), fault.words)
        if fault.is_missing:
            missing.append(placed_fault)
        else:
            there.add(placed_fault)
    return [*sorted(there), *([] if source.syntax else missing)]


def refused(faults: Sequence[Fault], is_file: bool = True) -> BadInput:
    """The first of `faults` in one line, which says how many more there are and what lists those of a file."""
    first, more = faults[0], len(faults) - 1
    file = f'"{first.source}"' if " " in first.source else first.source
    lists = f": `station lesson check {file}` lists them" if is_file else ""
    return BadInput(first.source, first.place, first.text + (f" (and {more} more{lists})" if more else ""))
