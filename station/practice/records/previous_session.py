"""An earlier session of the same lesson, from its folder, to be heard and seen beside the one that is over.

"Yesterday" is the last session of an earlier day, or where there is none the last one before. Its strokes are taken
from `pairs.csv`: each has its bar and beat of the lesson, and how many seconds from there it fell; so it can be laid
over the lesson at another tempo, as early or late in seconds as it was. Tables that were written before they held bar
and beat cannot be, and that is said.
"""

import csv
from dataclasses import dataclass
from datetime import date, datetime
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.disk.file_names import folder_name
from station.core.errors import BadInput
from station.core.pieces import Articulation, Piece, Zone
from station.music.performance import HIT_DTYPE
from station.practice.history.kept_json import kept_document
from station.practice.history.session_files import DOCUMENT_NAME, PAIRS_NAME
from station.practice.records.report.session_pairs import SESSION_COLUMNS

NONE_KEPT = "no earlier session of this lesson is kept"
_TOO_OLD = "the session of {:%Y-%m-%d} was kept before its table had bars and beats: it cannot be shown"
MOST_READ = 40
"""So many sessions are looked into; our choice, a fraction of a second of reading."""
_STARTED = "%Y-%m-%dT%H-%M-%S"
_STARTED_LETTERS = 19
_MOST = 1e6
"""No pass, bar, beat or second of a session is beyond it (our choice: a million seconds are twelve days)."""
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


def find_previous(folder: Path, lesson: str) -> PreviousSession | str:
    """The session to compare with that in `folder`, of the same student; or why there is none to be had."""
    started = _started(folder)
    if started is None:
        return NONE_KEPT
    others = [
        (when, path)
        for path in folder.parent.glob(f"*_{folder_name(lesson)}*")
        if (when := _started(path)) is not None and when < started
    ]
    others.sort(key=lambda other: (other[0].date() < started.date(), other[0]), reverse=True)
    fault = NONE_KEPT
    for when, path in others[:MOST_READ]:
        if _lesson_of(path) != lesson:
            continue
        found = _read((when, started.date()), path / PAIRS_NAME)
        if found is not None:
            return found
        if fault == NONE_KEPT:
            fault = _TOO_OLD.format(when)
    return fault


def _started(folder: Path) -> datetime | None:
    try:
        return datetime.strptime(folder.name[:_STARTED_LETTERS], _STARTED)
    except ValueError:
        return None


def _lesson_of(folder: Path) -> str | None:
    try:
        document = kept_document(folder / DOCUMENT_NAME)
        return str(document["session"]["lesson"]) if isinstance(document, dict) else None
    except (KeyError, TypeError, BadInput):
        return None  # a session that was cut off, or somebody else's folder


def _read(days: tuple[datetime, date], table: Path) -> PreviousSession | None:
    """What the table of the session of the first of `days` holds, seen from the second; None where it lacks some."""
    try:
        if not table.is_file():  # a pipe would never end
            return None
        with table.open(encoding="utf-8", newline="") as lines:
            rows = csv.DictReader(lines)
            if not set(SESSION_COLUMNS) <= set(rows.fieldnames or ()):
                return None
            played = [row for row in rows if row["hit_index"]]
            at = np.array([_at(row) for row in played], np.float64).reshape(-1, 4)
            due_s = np.array([float(row["note_time_s"]) if row["note_index"] else np.nan for row in played])
            if not (np.abs(at) <= _MOST).all() or not np.all(np.isnan(due_s) | (np.abs(due_s) <= _MOST)):
                return None
            return PreviousSession(*days, at, _strokes(played), due_s)
    except (OSError, ValueError, KeyError, TypeError, csv.Error):
        return None


def _at(row: dict[str, str]) -> tuple[float, float, float, float]:
    late_s = float(row["hit_time_s"]) - float(row["note_time_s"]) if row["note_index"] else 0.0
    return float(row["pass"]), float(row["bar"]), float(row["beat"]), late_s


def _strokes(rows: list[dict[str, str]]) -> NDArray[np.void]:
    strokes = np.zeros(len(rows), HIT_DTYPE)
    strokes["position"] = np.nan
    strokes["limb"] = -1
    for stroke, row in zip(strokes, rows, strict=True):
        stroke["piece"], stroke["zone"] = Piece[row["hit_piece"].upper()], Zone[row["hit_zone"].upper()]
        stroke["articulation"] = Articulation[row["hit_articulation"].upper()]
        velocity, openness = float(row["hit_velocity"]), float(row["hit_openness"] or "nan")
        if not 1 <= velocity < _HARDEST + 1 or not (np.isnan(openness) or 0.0 <= openness <= 1.0):
            raise ValueError(row)
        stroke["velocity_fraction"], stroke["velocity"] = np.modf(velocity)
        stroke["openness"] = openness
    return strokes
