"""A week of practice told to people who play no drums: what was played how long, and what has surely got better."""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, datetime, timedelta

from station.core.counts import counted, whole_minutes
from station.core.disk.utf8 import one_line
from station.practice.progress.calendar_days import WEEK
from station.practice.progress.trends import FALSE_ANY, Measure, Trend, chance_of_no_gain, lessons_practised, trend_of
from station.store.rows import SessionKind, SessionRow

LOOKS_BACK = 11 * WEEK
"""So long before the week a change is looked for (our choice: what got better in spring is no news in autumn)."""
SAID_ONCE = 8 * WEEK
"""So long what was told is not told again (our choice: it is no news)."""
_FREE = "Free playing"
_NAMELESS = "A lesson"
_FEWEST_SAID = 3.0


@dataclass(frozen=True, slots=True)
class Practised:
    """What was played under one `title`: in whole `minutes` (0: less than half of one), and how many `times`."""

    title: str
    minutes: int
    times: int


def practised(rows: Iterable[SessionRow]) -> tuple[Practised, ...]:
    """What was played, the longest first."""
    played: defaultdict[str, list[float]] = defaultdict(list)
    for row in rows:
        played[title_of(row)].append(row.played_s)
    longest = sorted(played.items(), key=lambda item: (-sum(item[1]), item[0]))
    return tuple(Practised(title, whole_minutes(sum(times)), len(times)) for title, times in longest)


def title_of(row: SessionRow) -> str:
    """What a session is called, in one line."""
    named = _FREE if row.kind is SessionKind.TAKE else one_line(row.title or row.lesson) or _NAMELESS
    exam = one_line(row.exam)
    return f"{named} (exam: {exam})" if exam else named


def begin_of(day: date) -> datetime:
    """Its first moment, by the clock on the wall."""
    return datetime.combine(day, datetime.min.time())


def end_of(day: date) -> datetime | None:
    """The first moment after it; None after the last day that there is."""
    return None if day == date.max else begin_of(day + timedelta(days=1))


# --- what got better --------------------------------------------------------------------------------------------------


def got_better(rows: Iterable[SessionRow], monday: date) -> tuple[str, ...]:
    """A sentence for each lesson of the week from `monday` that surely got better and was not said to of late.

    `rows` are the sessions up to the end of that week, from `LOOKS_BACK` + `SAID_ONCE` before it at least. Of a lesson
    the surest of score, spread and lean is told, where it changed by more than what counts as small, and so surely that
    `FALSE_ANY` of weeks in which nothing did tell of anything at all: all measures of all lessons of the week are
    looked at together (Holm 1979). A tempo is chosen and tells of no progress by itself.
    """
    by_lesson = lessons_practised(rows)
    found = _surely_better(by_lesson, monday)
    said = set[tuple[str, Measure]]() if not found else _said_of_late(by_lesson, monday)
    best: dict[str, tuple[float, Trend]] = {}
    for (lesson, measure), (chance, trend) in found.items():
        if (lesson, measure) not in said and (lesson not in best or chance < best[lesson][0]):
            best[lesson] = chance, trend
    return tuple(_sentence(title_of(by_lesson[lesson][-1]), trend) for lesson, (_, trend) in best.items())


def _said_of_late(by_lesson: Mapping[str, Sequence[SessionRow]], monday: date) -> set[tuple[str, Measure]]:
    """What the pages of the weeks before found better."""
    weeks = range(1, SAID_ONCE // WEEK + 1)
    return {each for back in weeks for each in _surely_better(by_lesson, monday - back * WEEK)}


def _surely_better(
    by_lesson: Mapping[str, Sequence[SessionRow]], monday: date
) -> dict[tuple[str, Measure], tuple[float, Trend]]:
    """Measures of lessons of that week that got better, each with the chance that it did not (Holm's steps)."""
    looked_at: list[tuple[float, str, Trend]] = []
    for lesson, every in by_lesson.items():
        rows = [row for row in every if monday - LOOKS_BACK <= row.started.date() < monday + WEEK]
        if rows and rows[-1].started.date() >= monday:
            trends = (trend_of(measure, rows) for measure in Measure if measure is not Measure.TEMPO)
            looked_at += [(chance_of_no_gain(trend), lesson, trend) for trend in trends if trend.compared is not None]
    found: dict[tuple[str, Measure], tuple[float, Trend]] = {}
    for at, (chance, lesson, trend) in enumerate(sorted(looked_at, key=lambda each: each[0])):
        if chance > FALSE_ANY / (len(looked_at) - at):
            break
        found[lesson, trend.measure] = chance, trend
    return found


def _sentence(title: str, trend: Trend) -> str:
    """What got better by this measure."""
    assert trend.compared is not None, "what got better was compared"
    first, last = trend.compared.early, trend.compared.late
    match trend.measure:
        case Measure.SCORE:
            first, last = (min(max(each, 0.0), 100.0) for each in (first, last))
            words = (
                f"more of it comes out as it is written. Of 100 points it had {first:.0f}, and has about {last:.0f} now"
            )
        case Measure.SPREAD:
            words = f"the strokes come more evenly. They strayed by about {_thousandths(first)}, and by {last:.0f} now"
        case _:
            words = f"it is closer to the beat. It was {_beside(first)}, and is {_beside(last)} now"
    side = counted(trend.compared.a_side, "day")
    return f"{title}: {words} (the first {side} of {trend.days} against the last {trend.compared.a_side})."


def _thousandths(ms: float) -> str:
    return f"{ms:.0f} thousandths of a second"


def _beside(ms: float) -> str:
    if abs(ms) < _FEWEST_SAID:
        return "on it"
    return f"about {_thousandths(abs(ms))} {'late' if ms > 0 else 'early'}"
