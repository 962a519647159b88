"""`station report SESSION --out FILE`: a page about one session, which stands alone in a browser or on paper."""

from dataclasses import dataclass
from pathlib import Path

from station.cli.console import say
from station.cli.options.option_fields import Command, argument, option, required
from station.cli.today import settings_of
from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.practice.history.session_choice import HELP

ENDINGS = (".html", ".pdf")


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportOptions:
    """Which session, and where its page goes."""

    session: str = argument("SESSION", HELP, str)
    out: Path = required("FILE.html|FILE.pdf", "the page to write", Path)
    student: str | None = option("NAME", "whose last session, or whose session of a day", str, None)


def run(options: ReportOptions) -> int:
    """Make the page and write it."""
    out = options.out
    if out.suffix.lower() not in ENDINGS:
        raise BadInput(out, "", f"expected a name that ends in {' or '.join(ENDINGS)}")
    from station.scenes.report.page_files import page_bytes

    write_whole(out, page_bytes(options.session, settings_of(options.student), out.suffix.lower()))
    say(f"report   {out}")
    return 0


COMMAND = Command(ReportOptions, run)
