"""What the window shows of the history: days, a list of sessions, trends of a lesson, weeks by limb and by piece."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date

from station.app.actions.history_actions import Asked
from station.app.history.session_pages import PageFiles
from station.practice.progress.calendar_days import Month, PractisedDay
from station.practice.progress.overview import WeekTable
from station.practice.progress.streaks import Streak
from station.practice.progress.trends import LessonTrends
from station.store.rows import SessionRow, TimedFigure


@dataclass(frozen=True, slots=True)
class PractisedLesson:
    """A lesson that was practised: its name, its title, how often."""

    name: str
    title: str
    sessions: int


@dataclass(frozen=True, slots=True, eq=False)
class HistoryPages:
    """What was read: `sessions` the newest first, `days` and `months` with practice, `lessons` the last one first.

    `trends` are those of the lesson that was asked for, `weeks` the table, each None while nobody asks. `figures` are
    what tables of weeks are made of, None as long as none was asked for; `database` is where the history is.
    """

    student: str = ""
    today: date | None = None
    sessions: tuple[SessionRow, ...] = ()
    days: Mapping[date, PractisedDay] = field(default_factory=dict)
    months: tuple[Month, ...] = ()
    streak: Streak = field(default_factory=Streak)
    week_s: float = 0.0
    """Seconds that were played in the week of `today`."""
    lessons: tuple[PractisedLesson, ...] = ()
    trends: LessonTrends | None = None
    weeks: WeekTable | None = None
    figures: tuple[TimedFigure, ...] | None = None
    database: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class HistoryView:
    """The pages as they are shown: what was `asked`, what was read of it (None: nothing yet), and what goes on.

    `reads` while something is still to come; `fault` is why nothing could be read, empty where it was. `opening` is the
    id of the session that is being judged again to be shown, `opened` of the one that was shown last, None for none.
    `page_files` are the pages of sessions, as files.
    """

    asked: Asked = field(default_factory=Asked)
    pages: HistoryPages | None = None
    reads: bool = False
    fault: str = ""
    opening: int | None = None
    opened: int | None = None
    page_files: PageFiles = field(default_factory=PageFiles)
