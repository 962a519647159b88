"""An earlier session of the same lesson, from the history, to be heard and seen beside the one that is over.

"Yesterday" is the last session of an earlier day, or where there is none the last one before. Its strokes are taken
from its judgements: each has its bar and beat of the lesson, and how many seconds from there it fell; so it can be laid
over the lesson at another tempo, as early or late in seconds as it was. Tables that were written before they held bar
and beat cannot be, and that is said.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import date, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece, Zone
from station.music.performance import HIT_DTYPE
from station.practice.history.session_files import started_in
from station.practice.history.student_history import StudentHistory
from station.store.rows import JudgementRow

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History

NONE_KEPT = "no earlier session of this lesson is kept"
_TOO_OLD = "the session of {:%Y-%m-%d} was kept before its table had bars and beats: it cannot be shown"
MOST_READ = 40
"""So many sessions are looked into; our choice, a fraction of a second of reading."""
_HARDEST = 127


@dataclass(frozen=True, eq=False)
class PreviousSession:
    """An earlier session: when it was begun, seen from `today`, and where its strokes (n,) fell.

    `at` (n, 4) is pass, bar and beat from 1 in the lesson, and seconds after that; `strokes` are rows of `HIT_DTYPE`
    whose time is nothing; `due_s` (n,) when in that session the note was due that it answered, NaN without one.
    """

    when: datetime
    today: date
    at: NDArray[np.float64]
    strokes: NDArray[np.void]
    due_s: NDArray[np.float64]

    @property
    def day(self) -> str:
        """Its day in words."""
        return day_in_words(self.when.date(), self.today)

    def has_bar(self, bar: int) -> bool:
        """Whether the lesson's `bar`, from 1, was played."""
        return bool((self.at[:, 1] == bar).any())

    def beat_s(self, bar: int) -> float | None:
        """How long a beat of the meter lasted in the last pass over `bar`, from 1; None where too little was played."""
        here = (self.at[:, 1] == bar) & ~np.isnan(self.due_s)
        if not here.any():
            return None
        here &= self.at[:, 0] == self.at[here, 0].max()
        first, last = np.argmin(self.due_s[here]), np.argmax(self.due_s[here])
        beats = float(self.at[here, 2][last] - self.at[here, 2][first])
        seconds = float(self.due_s[here][last] - self.due_s[here][first])
        return seconds / beats if beats > 0 and seconds > 0 else None

    def in_bar(self, bar: int) -> tuple[NDArray[np.float64], NDArray[np.void]]:
        """Beat and seconds (m, 2), and the strokes (m,), of its last pass over `bar`; empty where there is none."""
        here = self.at[:, 1] == bar
        if here.any():
            here &= self.at[:, 0] == self.at[here, 0].max()
        return self.at[here, 2:], self.strokes[here]


def day_in_words(day: date, today: date) -> str:
    """The day as people say it: "earlier" for the same day, "yesterday", "20 Nov"."""
    return {0: "earlier", 1: "yesterday"}.get((today - day).days) or f"{day.day} {day:%b}"


def find_previous(whose: StudentHistory, folder: Path, lesson: str) -> PreviousSession | str:
    """The session to compare with that in `folder`, of the same student; or why there is none to be had."""
    started = started_in(folder.name)
    if started is None:
        return NONE_KEPT
    found = whose.ask(lambda history, student: _found(history, student, lesson, started))
    return NONE_KEPT if found is None else found


def _found(history: "History", student: str, lesson: str, started: datetime) -> PreviousSession | str:
    today = datetime.combine(started, datetime.min.time())
    before = history.latest(student, MOST_READ, lesson=lesson, until=today)
    earlier = [row for row in history.latest(student, MOST_READ, lesson=lesson, until=started) if row.started >= today]
    rows = (*before, *earlier)
    for row in rows:
        judged = history.judgements(row.id)
        with suppress(ValueError, KeyError):
            if judged:
                return _read((row.started, started.date()), [one for one in judged if one.hit_index is not None])
    return _TOO_OLD.format(rows[0].started) if rows else NONE_KEPT


def _read(days: tuple[datetime, date], played: Sequence[JudgementRow]) -> PreviousSession:
    """The strokes of the session of the first of `days`, seen from the second."""
    at = np.array([_at(row) for row in played], np.float64).reshape(-1, 4)
    due_s = np.array([np.nan if row.note_time_s is None else row.note_time_s for row in played])
    return PreviousSession(*days, at, _strokes(played), due_s)


def _at(row: JudgementRow) -> tuple[float, float, float, float]:
    late_s = _known(row.hit_time_s) - row.note_time_s if row.note_time_s is not None else 0.0
    return float(row.pass_number), float(row.bar), row.beat, late_s


def _strokes(rows: Sequence[JudgementRow]) -> NDArray[np.void]:
    strokes = np.zeros(len(rows), HIT_DTYPE)
    strokes["position"] = np.nan
    strokes["limb"] = -1
    for stroke, row in zip(strokes, rows, strict=True):
        stroke["piece"], stroke["zone"] = Piece[str(row.hit_piece).upper()], Zone[str(row.hit_zone).upper()]
        stroke["articulation"] = Articulation[str(row.hit_articulation).upper()]
        velocity = _known(row.hit_velocity)
        if not 1 <= velocity < _HARDEST + 1:
            raise ValueError(row)
        stroke["velocity_fraction"], stroke["velocity"] = np.modf(velocity)
        stroke["openness"] = np.nan if row.hit_openness is None else row.hit_openness
    return strokes


def _known(value: float | None) -> float:
    if value is None:
        raise ValueError("no data")
    return value
