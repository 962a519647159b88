"""CSV that gives back what was put in, and that no spreadsheet runs.

UTF-8 with the mark by which spreadsheets know it, commas, lines that end in CR LF (RFC 4180). A number is written with
all its digits, no data is an empty field. A text that a spreadsheet might take for a formula (OWASP, CSV Injection) has
an apostrophe before it, and so has one that begins with an apostrophe: take one away from the front to get the text.
"""

import csv
import io
from collections.abc import Iterable, Sequence
from typing import IO

_RUNS = ("=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠", "'")
"""How a text begins that a spreadsheet runs, in any width of letters, and our own mark."""
_TRUTH = {True: "true", False: "false"}


def cell(value: object) -> str:
    """A value as a field: a text, a number, a truth, or None for no data."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return _TRUTH[value]
    if isinstance(value, int | float):
        return repr(value)
    text = str(value)
    return f"'{text}" if text.startswith(_RUNS) else text


def write_csv(stream: IO[bytes], columns: Sequence[str], rows: Iterable[Sequence[object]]) -> int:
    """Write a table into a stream of bytes; how many rows it has."""
    text = io.TextIOWrapper(stream, "utf-8-sig", errors="backslashreplace", newline="")
    table = csv.writer(text, lineterminator="\r\n")
    table.writerow(columns)
    count = 0
    for row in rows:
        table.writerow([cell(value) for value in row])
        count += 1
    text.flush()
    text.detach()
    return count
