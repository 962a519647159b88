"""What the readers of signals share: the lines of a file, and its numbers."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from station.core.errors import BadInput
from station.core.files import read_regular
from station.core.schema import shown
from station.core.utf8 import utf8_text

MOST_BYTES = 64_000_000
"""Our choice: the longest trial of the CMU database has 6 MB, ten minutes of its 62 channels about 55."""


_MOST_DIGITS = 11
"""Our choice: a year of frames at 240 a second has ten."""


def numbered_lines(path: Path, expected: str, comment: str = "") -> Iterator[tuple[int, str]]:
    """The lines of a file that say something, stripped, with their numbers from 1; raises `BadInput`."""
    text = utf8_text(read_regular(path, MOST_BYTES), path, expected)
    for number, line in enumerate(text.splitlines(), start=1):
        words = (line.split(comment, 1)[0] if comment else line).strip()
        if words:
            yield number, words


def is_count(word: str) -> bool:
    """Whether a word is a whole number from 0 that a file can count to."""
    return word.isascii() and word.isdecimal() and len(word) < _MOST_DIGITS


def numbers(words: Sequence[str], path: Path, line: int) -> list[float]:
    """Each word as a finite number; raises `BadInput` that names the line and the first word that is none."""
    try:
        values = [float(word) for word in words]
    except ValueError:
        raise _no_number(words, path, line) from None
    if not all(map(math.isfinite, values)):
        raise _no_number(words, path, line)
    return values


def _no_number(words: Sequence[str], path: Path, line: int) -> BadInput:
    at = next(at for at, word in enumerate(words) if not _is_number(word))
    return BadInput(path, f"line {line}", f"expected a number at place {at + 1}, found {shown(words[at])}")


def _is_number(word: str) -> bool:
    try:
        return math.isfinite(float(word))
    except ValueError:
        return False
