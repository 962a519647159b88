"""The list of sessions: which of them are meant by a search, and a session in words."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date

from station.core.disk.utf8 import one_line
from station.store.rows import SessionKind, SessionRow

KINDS = {SessionKind.LESSON: "lesson", SessionKind.TAKE: "just played", SessionKind.BATTLE: "battle"}
"""What each kind is called."""


@dataclass(frozen=True, slots=True)
class SessionFilter:
    """Which sessions are listed: all words of `search`, of a `kind`, a `lesson` (empty: any), a `day` (None: any)."""

    search: str = ""
    kind: SessionKind | None = None
    lesson: str = ""
    day: date | None = None

    @property
    def is_any(self) -> bool:
        """Whether all are listed."""
        return self == _ANY

    def takes(self, row: SessionRow) -> bool:
        """Whether a session is listed."""
        if self.kind not in (None, row.kind) or self.lesson not in ("", row.lesson):
            return False
        if self.day not in (None, row.started.date()):
            return False
        text = f"{played_title(row)} {row.lesson} {row.device} {row.exam} {row.level} {when_words(row)}".casefold()
        return all(word in text for word in self.search.casefold().split())


_ANY = SessionFilter()


def listed(rows: Sequence[SessionRow], only: SessionFilter) -> tuple[SessionRow, ...]:
    """The sessions that are meant, in their order."""
    return tuple(rows) if only.is_any else tuple(row for row in rows if only.takes(row))


def played_title(row: SessionRow) -> str:
    """What was played."""
    return one_line(row.title or row.lesson) or KINDS[row.kind].capitalize()


def short_when(row: SessionRow, today: date) -> str:
    """When it was begun, as a narrow column has it: the hour this year, the year before."""
    last = f"{row.started:%H:%M}" if row.started.year == today.year else f"{row.started:%Y}"
    return f"{row.started.day} {row.started:%b} {last}"


def when_words(row: SessionRow) -> str:
    """When it was begun."""
    return f"{row.started.day} {row.started:%b %Y, %H:%M}"


def result_words(row: SessionRow) -> str:
    """How it went, shortly; empty of what is not judged."""
    if row.exam:
        return row.exam
    return "" if row.score is None else f"{row.score:.0f}"


def session_words(row: SessionRow) -> str:
    """All that the history says of a session, in lines."""
    minutes = f"{row.played_s / 60:.1f} minutes" if row.played_s >= 60 else f"{row.played_s:.0f} seconds"
    early = "" if row.complete or row.kind is not SessionKind.LESSON else ", stopped early"
    lines = [f"{played_title(row)} · {KINDS[row.kind]}", f"{when_words(row)} · {minutes}{early}"]
    tempo = [] if row.beats_a_minute is None else [f"{row.beats_a_minute:g} bpm"]
    score = [] if row.score is None else [f"{row.score:.0f} of 100"]
    level = [f"judged as {row.level}"] if row.level else []
    lines.append(" · ".join([*tempo, *score, *level]))
    if row.notes:
        lines.append(f"{row.right} of {row.notes} notes right")
    if row.mean_ms is not None and row.sd_ms is not None:
        lines.append(f"lean {row.mean_ms:+.0f} ms, spread {row.sd_ms:.0f} ms over {row.strokes} strokes")
    lines += [f"exam: {row.exam}"] if row.exam else []
    lines += [row.device] if row.device else []
    return "\n".join(line for line in lines if line)
