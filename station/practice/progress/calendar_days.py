"""Days, weeks and months of practice, counted from sessions.

A week begins on Monday; a session is of the day on which it began. A day of practice is one of which a session is
kept: of one in which nothing was played nothing is kept, and a few bars are practice, too.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, timedelta

from station.store.rows import SessionRow

WEEK = timedelta(days=7)
MOST_MONTHS = 24
"""So many months are laid out (our choice: two years are scrolled through, more are not)."""


@dataclass(frozen=True, slots=True)
class PractisedDay:
    """A day: seconds played, how many sessions, and what was played, each title once in order."""

    day: date
    played_s: float = 0.0
    sessions: int = 0
    titles: tuple[str, ...] = ()

    @property
    def minutes(self) -> float:
        """Minutes played."""
        return self.played_s / 60.0


@dataclass(frozen=True, slots=True)
class Week:
    """A week: its Monday, seconds played, and on how many days of practice."""

    monday: date
    played_s: float = 0.0
    days: int = 0


@dataclass(frozen=True, slots=True)
class Month:
    """A month: its first day, its `weeks` from Monday to Sunday, None for days of other months, and what it adds up to.

    `days` counts days of practice.
    """

    first: date
    weeks: tuple[tuple[PractisedDay | None, ...], ...]
    played_s: float
    days: int


Days = Mapping[date, PractisedDay]


def practised_days(sessions: Iterable[SessionRow]) -> dict[date, PractisedDay]:
    """The days of practice, in order."""
    of_day: defaultdict[date, list[SessionRow]] = defaultdict(list)
    for row in sessions:
        of_day[row.started.date()].append(row)
    return {day: _day(day, of_day[day]) for day in sorted(of_day)}


def _day(day: date, rows: Sequence[SessionRow]) -> PractisedDay:
    titles = dict.fromkeys(row.title or row.lesson for row in rows)
    return PractisedDay(day, sum(row.played_s for row in rows), len(rows), tuple(title for title in titles if title))


def monday_of(day: date) -> date:
    """The Monday of the week of `day`."""
    return day - timedelta(days=day.weekday())


def weeks_of(days: Days) -> dict[date, Week]:
    """The weeks in which anything was played, by their Monday."""
    found: dict[date, Week] = {}
    for day in days.values():
        monday = monday_of(day.day)
        week = found.get(monday, Week(monday))
        found[monday] = Week(monday, week.played_s + day.played_s, week.days + 1)
    return found


def months_of(days: Days, today: date) -> list[Month]:
    """Every month from the first with practice to that of `today`, the newest first, at most `MOST_MONTHS`."""
    first = min([*days, today]).replace(day=1)
    months = [today.replace(day=1)]
    while months[-1] > first and len(months) < MOST_MONTHS:
        months.append((months[-1] - timedelta(days=1)).replace(day=1))
    return [_month(month, days) for month in months]


def _month(first: date, days: Days) -> Month:
    after = (first + timedelta(days=31)).replace(day=1)
    own = [first + timedelta(days=n) for n in range((after - first).days)]
    cells: list[PractisedDay | None] = [None] * first.weekday()
    cells += [days.get(day, PractisedDay(day)) for day in own]
    cells += [None] * (-len(cells) % 7)
    played = [days[day] for day in own if day in days]
    weeks = tuple(tuple(cells[at : at + 7]) for at in range(0, len(cells), 7))
    return Month(first, weeks, sum(day.played_s for day in played), len(played))
