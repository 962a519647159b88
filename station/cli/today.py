"""`station today`: the plan of the day, which block comes next, and the line about it."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from station.cli.console import print_json, say, write
from station.cli.input.caught_up import caught_up
from station.cli.options.option_fields import Command, flag, option, whole_number

if TYPE_CHECKING:
    from station.core.settings import Settings


@dataclass(frozen=True, slots=True, kw_only=True)
class TodayOptions:
    """What is asked of the day's plan."""

    minutes: int | None = option("N", "how long: another number makes another plan (20)", whole_number, None)
    leave_out: bool = flag("leave the next block out for today")
    line: str | None = option("TEXT", "one line about the day, for the lesson book", str, None)
    student: str | None = option("NAME", "whose day it is", str, None)
    json: bool = flag("print one JSON document")


def run(options: TodayOptions) -> int:
    """Show the plan."""
    from station.practice.book.book_words import today_document, today_text
    from station.practice.book.lesson_book import LessonBook

    settings, today = caught_up(settings_of(options.student)), date.today()
    book = LessonBook(settings, say)
    page = book.today(today, options.minutes)
    if options.leave_out and (following := page.progress.next) is not None:
        page = book.leave_out(today, following.place)
    if options.line is not None:
        page = book.reflect(today, options.line)
    if options.json:
        print_json(today_document(page, book.returning()))
    else:
        write(today_text(page), end="")
    return 0


def settings_of(student: str | None) -> Settings:
    """The settings, for another student where one is named."""
    from station.app.settings.settings_store import SettingsStore

    store = SettingsStore(said={} if student is None else {"student": student}, source="today")
    if store.fault is not None:
        say(f"{store.fault}; the defaults hold for what is wrong")
    return store.now


COMMAND = Command(TodayOptions, run)
