"""What was practised on which day, as the history has it: sessions of lessons and free takes."""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date, datetime, timedelta

from station.practice.history.student_history import StudentHistory
from station.store.rows import SessionKind, SessionRow


@dataclass(frozen=True, slots=True)
class PractisedSession:
    """A session: when it began, of which `lesson` (empty: a free take), how long was played, and how it went.

    `score` 0–100, None where nothing was judged; `complete` whether it was played to its end; `exam` what it came to as
    an exam, in a few words, empty where it was none.
    """

    started: datetime
    lesson: str
    title: str
    played_s: float
    complete: bool
    score: float | None = None
    beats_a_minute: float | None = None
    exam: str = ""

    @classmethod
    def of(cls, row: SessionRow) -> "PractisedSession":
        """What a row says."""
        return cls(
            row.started,
            row.lesson,
            row.title,
            row.played_s,
            row.complete,
            row.score,
            row.beats_a_minute if row.kind is SessionKind.LESSON else None,
            row.exam,
        )


def practised_on(whose: StudentHistory, days: Iterable[date]) -> list[PractisedSession]:
    """All sessions of those days but battles, in the order in which they began."""
    rows = (row for day in sorted(set(days)) for row in _rows_of(whose, day))
    return [PractisedSession.of(row) for row in rows if row.kind is not SessionKind.BATTLE]


def days_practised(whose: StudentHistory) -> list[date]:
    """The days on which anything was, in order."""
    return sorted({row.started.date() for row in whose.ask(lambda history, student: history.sessions(student)) or []})


def _rows_of(whose: StudentHistory, day: date) -> list[SessionRow]:
    begin = datetime.combine(day, datetime.min.time())
    end = begin + timedelta(days=1) if day < date.max else None
    return whose.ask(lambda history, student: history.sessions(student, begin, end)) or []
