"""What can be asked of the pages of the history."""

from dataclasses import dataclass
from enum import StrEnum

from station.practice.progress.overview import WeekMeasure
from station.store.rows import Part


class HistorySection(StrEnum):
    """The pages."""

    CALENDAR = "Calendar"
    SESSIONS = "Sessions"
    TRENDS = "Trends"
    WEEKS = "Weeks"


@dataclass(frozen=True, slots=True)
class Asked:
    """What is looked at: a page; the `lesson` of the trends (empty: the last one), and that of the weeks (empty: all).

    The weeks are those of limbs or pieces, and have one measure.
    """

    section: HistorySection = HistorySection.CALENDAR
    lesson: str = ""
    part: Part = Part.LIMB
    measure: WeekMeasure = WeekMeasure.LEAN
    lesson_of_weeks: str = ""


@dataclass(frozen=True, slots=True)
class ShowPages:
    """Show this of the history."""

    asked: Asked


@dataclass(frozen=True, slots=True)
class ReadAgain:
    """Read the history once more."""


@dataclass(frozen=True, slots=True)
class OpenKept:
    """Show a session of the history as it was shown at its end; `number` is its id."""

    number: int


@dataclass(frozen=True, slots=True)
class WritePage:
    """Write the page about the session of the history whose id is `number` and whose folder is or was `name`."""

    number: int
    name: str


@dataclass(frozen=True, slots=True)
class OpenPage:
    """Show the page that was written about that session in the user's browser."""

    number: int


HistoryAction = ShowPages | ReadAgain | OpenKept | WritePage | OpenPage
