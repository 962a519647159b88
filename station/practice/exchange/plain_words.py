"""Readers for what strangers write into a parcel's table: words that are safe to print, days, times, ids.

Letters that terminals obey, that turn the direction of writing or that nobody sees are refused (Unicode Technical
Report 36, 2.5 and 2.10.1): `str.isprintable` says no to all of them.
"""

import re
from collections.abc import Callable
from datetime import UTC, date, datetime
from typing import TypeVar
from unicodedata import normalize

from station.core.toml.schema import Reader, shown, text
from station.core.toml.toml_faults import wrong

_Value = TypeVar("_Value")
_When = TypeVar("_When", bound=date)
LONGEST_LINE = 120
"""Letters of a name or a title (our choice: what one row of a list can show)."""
LONGEST_WORDS = 4000
"""Letters of what a teacher or student writes at length (our choice: a page)."""
_MOST_ROWS = 200
_DAY = re.compile(r"[0-9]{4}-[0-9]{2}-[0-9]{2}")
_MOMENT = re.compile(r"[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}Z")
_PLAYED = re.compile(r"[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}")
_ID = re.compile(r"[0-9a-f]{32}")
_FIRST_YEAR, _LAST_YEAR = 2000, 2199
"""No assignment is of another year (our choice)."""


def line(value: object) -> str:
    """One line that says something: 1 to `LONGEST_LINE` printable letters, in Unicode's form C, blanks stripped."""
    found = line_or_none(value)
    if not found:
        raise wrong("expected a line of text, found nothing")
    return found


def line_or_none(value: object) -> str:
    """As `line`, or an empty text."""
    if len(text(value)) > LONGEST_LINE:
        raise wrong(f"expected {LONGEST_LINE} letters at most, found {len(text(value))}")
    return _printable(normalize("NFC", text(value).strip()))


def words(value: object) -> str:
    """Some lines of printable letters, 0 to `LONGEST_WORDS` in all."""
    written = text(value).replace("\r\n", "\n").replace("\t", " ").strip()
    if len(written) > LONGEST_WORDS:
        raise wrong(f"expected {LONGEST_WORDS} letters at most, found {len(written)}")
    rows = written.split("\n")
    if len(rows) > _MOST_ROWS:
        raise wrong(f"expected {_MOST_ROWS} lines at most, found {len(rows)}")
    return "\n".join(_printable(normalize("NFC", row)) for row in rows)


def _printable(written: str) -> str:
    bad = next((letter for letter in written if not letter.isprintable()), None)
    if bad is not None:
        raise wrong(f"expected letters that can be printed, found U+{ord(bad):04X}")
    return written


def due_day(value: object) -> date:
    """A day such as 2026-12-01."""
    return _dated(value, _DAY, "a day such as 2026-12-01", date.fromisoformat)


def moment(value: object) -> datetime:
    """A second of the world's time, such as 2026-12-01T18:30:00Z; aware."""
    return _dated(value, _MOMENT, "a time such as 2026-12-01T18:30:00Z", datetime.fromisoformat)


def played_at(value: object) -> datetime:
    """A second by the clock on the wall, such as 2026-12-01T18:30:00; naive."""
    return _dated(value, _PLAYED, "a time such as 2026-12-01T18:30:00", datetime.fromisoformat)


def moment_text(when: datetime) -> str:
    """An aware time as `moment` reads it."""
    return f"{when.astimezone(UTC):%Y-%m-%dT%H:%M:%SZ}"


def _dated(value: object, form: re.Pattern[str], expected: str, read: Callable[[str], _When]) -> _When:
    written = text(value)
    try:
        found = read(written) if form.fullmatch(written) else None
    except ValueError:
        found = None
    if found is None or not _FIRST_YEAR <= found.year <= _LAST_YEAR:
        raise wrong(f"expected {expected}, found {shown(value)}")
    return found


def identity(value: object) -> str:
    """An id: 32 digits of base 16, small letters."""
    if not _ID.fullmatch(text(value)):
        raise wrong(f"expected 32 hexadecimal digits, found {shown(value)}")
    return text(value)


def or_none(read: Reader[_Value]) -> Reader[_Value | None]:
    """What `read` makes of a value, None of a `null`."""
    return lambda value: None if value is None else read(value)
