"""What the readers of signals share: the lines of a file, and its numbers."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from station.core.disk.files import read_regular
from station.core.disk.utf8 import utf8_text
from station.core.errors import BadInput
from station.core.toml.schema import shown

MOST_BYTES = 64_000_000
"""Our choice: the longest trial of the CMU database has 6 MB, ten minutes of its 62 channels about 55."""

LARGEST = 1e12
"""A greater number is no measurement, and no model holds one (`phase.model_file`); its square would be none at all."""
SHORTEST_S = 1e-6
"""Between two samples: nothing that moves is measured more often (our choice)."""


def numbered_lines(path: Path, expected: str, comment: str = "") -> Iterator[tuple[int, str]]:
    """The lines of a file that say something, stripped, with their numbers from 1; raises `BadInput`."""
    text = utf8_text(read_regular(path, MOST_BYTES), path, expected)
    for number, line in enumerate(text.splitlines(), start=1):
        words = (line.split(comment, 1)[0] if comment else line).strip()
        if words:
            yield number, words


def numbers(words: Sequence[str], path: Path, line: int) -> list[float]:
    """Each word as a number, at most `LARGEST` from 0; raises `BadInput` naming the line and the first other word."""
    try:
        values = [float(word) for word in words]
    except ValueError:
        raise _no_number(words, path, line) from None
    if not _are_usable(values):
        raise _no_number(words, path, line)
    return values


def _are_usable(values: Sequence[float]) -> bool:
    return all(map(math.isfinite, values)) and max(map(abs, values), default=0.0) <= LARGEST


def _no_number(words: Sequence[str], path: Path, line: int) -> BadInput:
    at = next(at for at, word in enumerate(words) if not _is_number(word))
    return BadInput(path, f"line {line}", f"expected a number at place {at + 1}, found {shown(words[at])}")


def _is_number(word: str) -> bool:
    try:
        return _are_usable([float(word)])
    except ValueError:
        return False
