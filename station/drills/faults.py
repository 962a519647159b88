"""The faults of a lesson file: every one of them, each with the line and column where a teacher must look.

While a file is read, a fault is noted against a *key path* (the keys that lead to a value, and the index in an array)
and, inside a text, against the index of a character. Lines and columns are worked out at the end, and only if there
was a fault: a good file never pays for them. Lines and columns count from 1, in characters.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from station.core.errors import BadInput
from station.core.toml_places import KeyPath, Places
from station.drills.toml_syntax import SyntaxFault


@dataclass(frozen=True, slots=True, order=True)
class Fault:
    """One fault of the file `source`; `text` says what is wrong and what was expected."""

    source: str
    line: int
    column: int
    text: str

    @property
    def place(self) -> str:
        """Where it is, for people."""
        return f"line {self.line}, column {self.column}"

    def __str__(self) -> str:
        return f"{self.source}: {self.place}: {self.text}"


@dataclass(frozen=True, slots=True)
class _Noted:
    path: KeyPath
    text: str
    char: int | None
    at_key: bool


@dataclass(slots=True)
class Faults:
    """Collects what is wrong while a file is read."""

    _noted: list[_Noted] = field(default_factory=list)

    def add(self, path: KeyPath, text: str, char: int | None = None, at_key: bool = False) -> None:
        """Note a fault of the value at `path`, of its character `char`, or of the key itself."""
        self._noted.append(_Noted(path, text, char, at_key))

    def __len__(self) -> int:
        return len(self._noted)

    def found(self, syntax: Sequence[SyntaxFault], text: str, source: str) -> list[Fault]:
        """These and the `syntax` faults of a file, in its order; `text` is what could be read, faulty lines blanked."""
        told = [Fault(source, *fault) for fault in syntax]
        semantic = self.placed(text, source)
        if syntax:  # lines were set aside: what seems to be missing may stand there
            semantic = [fault for fault in semantic if "is missing" not in fault.text]
        return sorted([*told, *semantic])

    def placed(self, text: str, source: str) -> list[Fault]:
        """All faults with their lines and columns in `text`, in the order of the file, each once."""
        if not self._noted:
            return []
        places = Places.of(text)
        found = {Fault(source, *places.find(n.path, n.char, n.at_key), n.text) for n in self._noted}
        return sorted(found)


def raise_first(faults: list[Fault], source: str | Path) -> None:
    """Raise `BadInput` for the first of `faults`, and say how many more there are; nothing if there is none."""
    if not faults:
        return
    more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
    raise BadInput(source, faults[0].place, faults[0].text + more)
