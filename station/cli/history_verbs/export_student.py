"""`station history export --out DIR|FILE.zip`: everything that a student owns, as plain files."""

from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from station.cli.console import say
from station.cli.history_verbs.opened_history import opened_history, settings_for
from station.cli.options.option_fields import option, required
from station.core.counts import counted
from station.core.disk.utf8 import one_line


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """Whose data are written, and where."""

    student: str | None = option("NAME", "whose data", str, None)
    out: Path = required("DIR|FILE.zip", "a new folder, or a new file that ends in .zip", Path)


def run(options: ExportOptions) -> int:
    """Write them, whole or not at all."""
    from station.practice.own_data.take_away import take_away

    settings = settings_for(options.student)
    student = settings.student
    taken = take_away(opened_history(settings, student), settings, student, options.out, datetime.now())
    for path in taken.left_out:
        say(f"left out {one_line(str(path))}: a link, or no plain file")
    counts = (
        counted(taken.sessions, "session"),
        counted(taken.judgements, "judgement"),
        counted(taken.captures, "capture"),
        counted(taken.files, "file"),
    )
    say(f"export   {one_line(str(options.out))}: {', '.join(counts)} of {one_line(student)}")
    return 0
