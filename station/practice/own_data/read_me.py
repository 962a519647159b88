"""README.txt of what a student takes away: which file holds what, in which unit."""

from datetime import datetime

from station.core.disk.utf8 import one_line
from station.practice.own_data.table_columns import ABOUT, COLUMNS, meaning

NAME = "README.txt"
_FILES = (
    ("mastery.json", "what is known of each lesson: how well it is held, and when it is due"),
    ("notes.json", "what teachers wrote, and notes/: their files as they came"),
    ("settings.json", "what the settings keep for the student alone"),
    ("documents/", "the reports of each session, under its number"),
    ("captures/", "every stroke as it was played, under its SHA-256; the station reads these files"),
    ("files/", "the student's folder as it lay on the computer: sessions, the lesson book (book/), assignments taken"),
)


def readme_text(student: str, now: datetime) -> str:
    """The whole text."""
    return "\n".join(
        [
            f"What drum station keeps of {one_line(student)}, as of {now:%Y-%m-%d %H:%M}.",
            "",
            "Tables are CSV: UTF-8, commas, no data is an empty field, numbers have all their digits.",
            "A text that begins with = + - @ or ' has an apostrophe ' before it, so that no spreadsheet runs it:",
            "take one apostrophe away from the front, and it is what was written.",
            *(line for table in COLUMNS for line in _table_lines(table)),
            "",
            *(f"{name}\n    {about}" for name, about in _FILES),
            "",
        ]
    )


def _table_lines(table: str) -> list[str]:
    return [
        "",
        f"{table}: {ABOUT[table]}",
        *(f"    {column:16} {meaning(table, column)}" for column in COLUMNS[table]),
    ]
