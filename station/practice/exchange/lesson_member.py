"""Lessons inside a parcel: what they may be called, how long they may be, and what their texts mean.

A lesson's name becomes a file's on the student's disk: it is one that every file system takes, as it stands.
"""

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from station.core.disk.file_names import folder_name
from station.core.errors import BadInput
from station.core.toml.schema import shown
from station.core.toml.toml_faults import refused, wrong
from station.practice.exchange.parcel import Parcel
from station.practice.exchange.plain_words import line

if TYPE_CHECKING:
    from station.drills.lesson import Lesson

_COURSE = ".course"
"""So end the names of courses, before `.toml` (`drills.course.ENDING`)."""
MOST_LESSON_BYTES = 1 << 16
"""Of a lesson's text (our choice: thirty times the longest that ships)."""
MOST_LESSONS_BYTES = 1 << 19
"""Of all lessons' texts in a parcel (our choice: fifty of ten kilobytes, read within a second whatever they say)."""
MOST_STROKES = 12_000
"""In all lessons of a parcel (our choice: a quarter of an hour of sixteenths at 200 bpm, read within a second)."""


def lesson_title(value: object) -> str:
    """The name of a lesson that can be a file's: `folder_name` leaves it as it is."""
    name = line(value)
    if folder_name(name) != name or name.lower().endswith(_COURSE):
        raise wrong(f"expected a lesson's name that can be a file's, found {shown(value)}")
    return name


def lesson_text(parcel: Parcel, member: str) -> str:
    """The text of the lesson in `member`; raises `BadInput` where it is missing, too long or no text."""
    data = parcel.members.get(member)
    if data is None:
        raise parcel.fault(member, "is missing")
    if len(data) > MOST_LESSON_BYTES:
        raise parcel.fault(member, f"a lesson of more than {MOST_LESSON_BYTES} bytes")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        raise parcel.fault(member, "is not UTF-8 text") from None


def parsed(texts: Iterable[tuple[str, str]], source: str) -> "Iterator[Lesson]":
    """The lessons of (name, text); raises `BadInput` of `source` for the first that is none, or for too much music."""
    from station.drills.reading.lesson_file import parse_lesson  # noqa: PLC0415 - a refusal needs none of it

    strokes = size = 0
    for name, text in texts:
        size += len(text.encode())
        if size > MOST_LESSONS_BYTES:
            raise BadInput(source, name, f"more than {MOST_LESSONS_BYTES} bytes up to here in the lessons of one file")
        found = parse_lesson(text, f"{source}: {name}", name)
        if found.lesson is None:
            raise refused(found.faults, is_file=False)
        strokes += len(found.lesson.score.notes)
        if strokes > MOST_STROKES:
            raise BadInput(source, name, f"more than {MOST_STROKES} strokes up to here in the lessons of one file")
        yield found.lesson
