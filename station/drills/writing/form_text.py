"""The order of the grids as one line that a teacher would write: what comes often in a row is said once.

The reverse of `reading.form_order`.
"""

import re
from collections.abc import Iterator, Sequence
from itertools import groupby

_WRITTEN_OUT = 2
"""A name comes so often in a row before it is counted: "A, A, B, A" shows its form better than "A x2, B, A"."""
_LONGEST = 8
"""A form of more names is folded into groups (our choice: AABA twice is written out)."""
_LEAST_SAVED = 4
"""Entries that a group must save (our choice)."""
_LOOKS_COUNTED = re.compile(r".*[x×]\s?\d+|\(.*|.*\)(\s*[x×]\s?\d+)?")


def form_text(names: Sequence[str]) -> str:
    """The names in the order in which they are played, between commas; "A x3" and "(A, B) x2" where that is shorter."""
    if any(map(_LOOKS_COUNTED.fullmatch, names)):
        return ", ".join(names)
    return ", ".join(_folded(names))


def _folded(names: Sequence[str]) -> Iterator[str]:
    """The entries of a form."""
    if len(names) <= _LONGEST:
        yield from _entries(names)
        return
    start, length, times = _longest_repeat(names)
    if length * (times - 1) < _LEAST_SAVED:
        yield from _entries(names)
        return
    yield from _folded(names[:start])
    entries = list(_entries(names[start : start + length]))
    yield f"{entries[0]} x{times}" if length == 1 else f"({', '.join(entries)}) x{times}"
    yield from _folded(names[start + length * times :])


def _entries(names: Sequence[str]) -> Iterator[str]:
    """Each name, those in a row counted."""
    for name, run in groupby(names):
        count = len(list(run))
        yield from [name] * count if count <= _WRITTEN_OUT else [f"{name} x{count}"]


def _longest_repeat(names: Sequence[str]) -> tuple[int, int, int]:
    """Start, length and times of what comes again at once and saves most entries; the shortest of equals."""
    best, found = 0, (0, 1, 1)
    for length in range(1, len(names) // 2 + 1):
        same = 0
        for end in range(length, len(names)):
            same = same + 1 if names[end] == names[end - length] else 0
            times = same // length + 1
            if length * (times - 1) > best:
                best, found = length * (times - 1), (end + 1 - length * times, length, times)
    return found
