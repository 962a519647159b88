"""`station book`: the lesson book, what was planned and practised, the lines about it, and what returns."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date

from station.cli.console import print_json, say, write
from station.cli.input.caught_up import caught_up
from station.cli.options.option_fields import Command, flag, option, whole_number
from station.cli.today import settings_of
from station.core.errors import BadInput


@dataclass(frozen=True, slots=True, kw_only=True)
class BookOptions:
    """Which days are shown."""

    days: int = option("N", "so many days, the newest first (7)", whole_number, 7)
    student: str | None = option("NAME", "whose book it is", str, None)
    json: bool = flag("print one JSON document")


def run(options: BookOptions) -> int:
    """Show the book."""
    if options.days < 1:
        raise BadInput("--days", f"{options.days}", "expected 1 or more")
    from station.practice.book.book_words import book_document, book_text
    from station.practice.book.lesson_book import LessonBook

    book = LessonBook(caught_up(settings_of(options.student)), say)
    pages = [book.page(day) for day in book.days()[::-1][: options.days]]
    if options.json:
        print_json(book_document(pages, book.returning()))
    else:
        write(book_text(pages, book.returning(), date.today()), end="")
    return 0


COMMAND = Command(BookOptions, run)
