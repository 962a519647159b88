"""`station report`: a page about one session or about a week, which stands alone in a browser or on paper."""

from dataclasses import dataclass
from datetime import date, timedelta
from pathlib import Path

from station.cli.console import say
from station.cli.history_verbs.opened_history import settings_for
from station.cli.options.option_fields import Command, day, option, option_alone, optional_argument, required
from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.practice.history.session_choice import HELP

ENDINGS = (".html", ".pdf")
_THIS_WEEK = date.min
"""What `--week` without a day stands for: today's."""
_LAST_WEEK = date.max - timedelta(days=date.max.weekday() + 1)
"""The last day of the last whole week."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportOptions:
    """Which session or week, and where its page goes."""

    session: str | None = optional_argument("SESSION", HELP)
    week: date | None = option_alone(
        "DAY", "in place of a session the week of this day, told to parents (this week)", day, _THIS_WEEK
    )
    out: Path = required("FILE.html|FILE.pdf", "the page to write", Path)
    student: str | None = option("NAME", "whose week, last session or session of a day", str, None)


def run(options: ReportOptions) -> int:
    """Make the page and write it."""
    out = options.out
    if out.suffix.lower() not in ENDINGS:
        raise BadInput(out, "", f"expected a name that ends in {' or '.join(ENDINGS)}")
    if out.is_file() and (there := out.resolve()).suffix.lower() not in ENDINGS:
        raise BadInput(out, "", f"is a link to {there}, which is no page: choose another name")
    write_whole(out, _page(options, out.suffix.lower()))
    say(f"report   {out}")
    return 0


def _page(options: ReportOptions, ending: str) -> bytes:
    from station.scenes.report.page_files import page_bytes, week_bytes

    if options.week is None:
        if options.session is None:
            raise BadInput("report", "", "say which session, or --week")
        settings = settings_for(options.student, must_have_played=False)
        return page_bytes(options.session, settings, ending)
    if options.session is not None:
        raise BadInput("--week", "", f"is about a whole week: leave {options.session} out")
    if options.week > _LAST_WEEK:
        raise BadInput("--week", options.week.isoformat(), "its week ends after the last day that there is")
    settings, today = settings_for(options.student), date.today()
    return week_bytes(settings, today if options.week == _THIS_WEEK else options.week, today, ending)


COMMAND = Command(ReportOptions, run)
