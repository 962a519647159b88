"""`station history list`: the sessions that are kept, a row each, and what they come to."""

from dataclasses import dataclass
from datetime import date, datetime, timedelta

from station.cli.console import print_json, say, write
from station.cli.history_verbs.opened_history import opened_history, settings_for
from station.cli.options.option_fields import day, flag, option
from station.core.counts import counted
from station.core.disk.utf8 import one_line
from station.core.errors import BadInput
from station.practice.history.kept_rows import Totals, session_fields, totals
from station.store.rows import SessionKind, SessionRow

SCHEMA = "drum-station/history/1"
_TITLE_LETTERS = 44
"""Our choice: with the figures before it a row of 100 letters."""
_KINDS = {SessionKind.TAKE: "just played", SessionKind.BATTLE: "a battle"}


@dataclass(frozen=True, slots=True, kw_only=True)
class ListOptions:
    """Which sessions are listed, and how."""

    student: str | None = option("NAME", "whose sessions", str, None)
    lesson: str | None = option("NAME", "of this lesson alone", str, None)
    since: date | None = option("DAY", "from this day on, such as 2026-12-01", day, None)
    until: date | None = option("DAY", "until this day, which is the last", day, None)
    json: bool = flag("print one JSON document")


def run(options: ListOptions) -> int:
    """List them, the oldest first."""
    if options.since is not None and options.until is not None and options.until < options.since:
        raise BadInput("--until", options.until.isoformat(), f"is before --since {options.since}")
    settings = settings_for(options.student)
    rows = opened_history(settings, settings.student).sessions(
        settings.student, _begin(options.since), _end(options.until)
    )
    rows = [row for row in rows if options.lesson in (None, row.lesson)]
    summed = totals(rows)
    if options.json:
        print_json(_document(settings.student, options, rows, summed))
    elif rows:
        write("\n".join([_HEAD, *map(_line, rows), total_words(summed)]))
    else:
        say(f"nothing of {one_line(settings.student)} is kept{_within(options)}")
    return 0


def total_words(summed: Totals) -> str:
    """Such as "12 sessions on 5 days, 48 minutes"."""
    sessions, days = counted(summed.sessions, "session"), counted(summed.days, "day")
    return f"{sessions} on {days}, {counted(summed.minutes, 'minute')}"


def _begin(since: date | None) -> datetime | None:
    return None if since is None else datetime.combine(since, datetime.min.time())


def _end(until: date | None) -> datetime | None:
    """The moment after the day; None after the last one that there is."""
    return None if until in (None, date.max) else _begin(until + timedelta(days=1))


def _within(options: ListOptions) -> str:
    limits = (("of", options.lesson), ("since", options.since), ("until", options.until))
    return "".join(f" {word} {limit}" for word, limit in limits if limit is not None)


_HEAD = "   no.  begun             minutes   bpm  score  spread  what"


def _line(row: SessionRow) -> str:
    tempo = "" if row.beats_a_minute is None else f"{row.beats_a_minute:g}"
    score = "" if row.score is None else f"{row.score:.0f}"
    spread = "" if row.sd_ms is None else f"{row.sd_ms:.0f} ms"
    minutes = f"{row.played_s / 60:.1f}"
    facts = f"{row.id:6}  {row.started.isoformat(' ', 'minutes')}  {minutes:>7}  {tempo:>4}  {score:>5}  {spread:>6}"
    return f"{facts}  {title_of(row)}{'' if row.complete else ' (stopped early)'}".rstrip()


def title_of(row: SessionRow) -> str:
    """What was played, in a line: nothing in it that a terminal obeys."""
    title = one_line(row.title or row.lesson)
    shown = title if len(title) <= _TITLE_LETTERS else f"{title[: _TITLE_LETTERS - 1]}…"
    name = one_line(row.lesson)
    return ": ".join(dict.fromkeys(filter(None, (name, shown)))) or _KINDS.get(row.kind, "")


def _document(student: str, options: ListOptions, rows: list[SessionRow], summed: Totals) -> dict[str, object]:
    return {
        "schema": SCHEMA,
        "student": student,
        "lesson": options.lesson,
        "since": None if options.since is None else options.since.isoformat(),
        "until": None if options.until is None else options.until.isoformat(),
        "sessions": [session_fields(row) for row in rows],
        "totals": {"sessions": summed.sessions, "days": summed.days, "played_s": summed.played_s},
    }
