"""Rows of the history as documents and in sum: what `station history`, exports and the week's page have in common."""

from collections.abc import Iterable
from dataclasses import dataclass, fields
from datetime import datetime

from station.core.counts import whole_minutes
from station.practice.progress.calendar_days import practised_days
from station.store.rows import FigureRow, SessionRow


@dataclass(frozen=True, slots=True)
class Totals:
    """So many sessions on so many days of practice, `played_s` seconds of music in all."""

    sessions: int
    days: int
    played_s: float

    @property
    def minutes(self) -> int:
        """How long that is, in whole minutes."""
        return whole_minutes(self.played_s)


def totals(rows: Iterable[SessionRow]) -> Totals:
    """What some sessions come to."""
    all_rows = list(rows)
    return Totals(len(all_rows), len(practised_days(all_rows)), sum(row.played_s for row in all_rows))


SESSION_FIELDS = ("number", *(each.name for each in fields(SessionRow) if each.name != "id"))
"""What a document says of a session: the fields of its row, its id as the number that users say."""


def session_fields(row: SessionRow) -> dict[str, object]:
    """A session for programs, by `SESSION_FIELDS`."""
    values = {name: _plain(getattr(row, name)) for name in SESSION_FIELDS[1:]}
    return {"number": row.id, **values}


FIGURE_FIELDS = tuple(each.name for each in fields(FigureRow))


def figure_fields(figure: FigureRow) -> dict[str, object]:
    """Figures of a limb or a piece for programs."""
    return {name: _plain(getattr(figure, name)) for name in FIGURE_FIELDS}


def _plain(value: object) -> object:
    return value.isoformat(timespec="seconds") if isinstance(value, datetime) else value
