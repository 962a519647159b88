"""What can be asked of the day's plan and the lesson book. Blocks count from 0."""

from dataclasses import dataclass
from datetime import date


@dataclass(frozen=True, slots=True)
class PlanDay:
    """Make today's plan anew, for so many minutes."""

    minutes: int


@dataclass(frozen=True, slots=True)
class StartBlock:
    """Begin a block of today's plan: its lesson, bars, tempo, click and passes."""

    place: int


@dataclass(frozen=True, slots=True)
class LeaveOutBlock:
    """Leave a block of today's plan out."""

    place: int


@dataclass(frozen=True, slots=True)
class Reflect:
    """Keep a line about today."""

    line: str


@dataclass(frozen=True, slots=True)
class LookAtDay:
    """Show a day of the book; None today."""

    day: date | None


BookAction = PlanDay | LeaveOutBlock | Reflect | LookAtDay
TodayAction = StartBlock | BookAction
