"""`station practice --today`: the next block of the day's plan as the options that begin it."""

from __future__ import annotations

from datetime import date

from station.cli.console import say
from station.core.errors import BadInput
from station.core.settings import Settings
from station.core.units import PPQ
from station.drills.daily.daily_items import DailyItem
from station.drills.lesson import Lesson
from station.practice.book.book_words import how_words
from station.practice.book.lesson_book import LessonBook
from station.practice.session.cues.quiet_bars import gap_of
from station.practice.session.rising_tempo import rise_of


def next_block(settings: Settings) -> DailyItem:
    """The block to play; raises `BadInput` where nothing is left, or nothing that a lesson is."""
    following = LessonBook(settings, say).today(date.today()).progress.next
    if following is None:
        raise BadInput("--today", "", "all of today's plan is played; `station today --minutes N` makes another")
    if not following.item.lesson:
        raise BadInput("--today", following.item.title, "that is for the window; `station today --leave-out` goes on")
    return following.item


def block_options(item: DailyItem, lesson: Lesson) -> dict[str, object]:
    """What the plan says, by the names of the options of `station practice`."""
    return {
        "lesson": item.lesson,
        "tempo": None if item.follows else item.beats_a_minute * lesson.beat_ticks / PPQ,
        "adapt": item.follows or None,
        "rise": rise_of(item.rise) if item.rise else None,
        "gap": gap_of(item.gap) if item.gap and not item.follows else None,
        "loops": item.passes,
        "bars": (item.bars[0] + 1, item.bars[1] + 1),
    }


def say_block(item: DailyItem) -> None:
    """Tell what is practised now, and why."""
    say(f"{item.kind.label}, {item.minutes} minutes: {item.title}\n{how_words(item)}\n{item.why}")


def say_what_follows(settings: Settings) -> None:
    """Name the block after the one that was played."""
    progress = LessonBook(settings, say).today(date.today()).progress
    if progress.next is None:
        say(f"done for today: {progress.minutes:.0f} minutes. One line about it: station today --line TEXT")
    else:
        say(f"next: {progress.next.item.kind.label.lower()}, {progress.next.item.title} (station practice --today)")
