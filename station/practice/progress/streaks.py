"""A streak that forgives: it counts weeks, and a day off never breaks it.

What is learnt is kept between days, not within one: gains show after 24 hours, and reviews come after days and weeks
(Simmons 2012; Latimier 2021). A streak of days would punish the nights and rests that do the work, and what frightens
with loss works for some weeks and then no more. So a week counts as soon as two of its days had practice, whichever;
a week with less leaves the streak as it is, even one without any; three whole weeks without practice end it. Its weeks
need not follow on one another, and nobody is told that they did.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import date

from station.practice.progress.calendar_days import WEEK, Days, monday_of, weeks_of

DAYS_A_WEEK = 2
"""So many days of practice make a week count (our choice: twice, so that a night lies between)."""
FORGIVEN_WEEKS = 2
"""So many weeks without practice in a row are forgiven (our choice: school holidays, or the flu)."""
RULE = (
    f"A week counts as soon as {DAYS_A_WEEK} of its days had practice, whichever they are: what you learn settles"
    " between days, so days off are part of it. A week with less leaves the streak as it is, and so do one week"
    " or two without any. After three weeks without any a new streak begins; nothing that you have played is lost."
)
"""The rule in words."""


@dataclass(frozen=True, slots=True)
class Streak:
    """The streak of now: `weeks` that count, from `since` (a Monday; None where there are none); the `longest` of all.

    Of this week: `days` of practice, and `to_go` until it counts.
    """

    weeks: int = 0
    since: date | None = None
    longest: int = 0
    days: int = 0
    to_go: int = DAYS_A_WEEK


def streak_of(days: Days, today: date) -> Streak:
    """The streak as it stands on `today`; days after it are left out, and this week breaks nothing."""
    this_monday = monday_of(today)
    weeks = weeks_of({day: one for day, one in days.items() if day <= today})
    weeks_long, since, longest, without = 0, None, 0, 0
    for monday in _mondays(min(weeks, default=this_monday), this_monday):
        practised = weeks[monday].days if monday in weeks else 0
        without = 0 if practised else without + (monday != this_monday)
        if without > FORGIVEN_WEEKS:
            weeks_long, since = 0, None
        if practised >= DAYS_A_WEEK:
            weeks_long, since = weeks_long + 1, since or monday
        longest = max(longest, weeks_long)
    now = weeks[this_monday].days if this_monday in weeks else 0
    return Streak(weeks_long, since, longest, now, max(DAYS_A_WEEK - now, 0))


def _mondays(first: date, last: date) -> Iterator[date]:
    while first <= last:
        yield first
        first += WEEK


def streak_words(streak: Streak) -> str:
    """The streak in a line."""
    if not streak.weeks:
        return f"A streak begins with the first week that has {DAYS_A_WEEK} days of practice"
    weeks = "1 week" if streak.weeks == 1 else f"{streak.weeks} weeks"
    best = f"; your longest: {streak.longest}" if streak.longest > streak.weeks else ""
    return f"{weeks} that {'counts' if streak.weeks == 1 else 'count'}{best}"


def this_week_words(streak: Streak) -> str:
    """What this week has, in a line that asks for nothing."""
    days = {0: "no day of practice yet", 1: "1 day of practice"}.get(streak.days, f"{streak.days} days of practice")
    if not streak.to_go:
        return f"This week: {days}; it counts"
    return f"This week: {days}; with {DAYS_A_WEEK} it counts"
