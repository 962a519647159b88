"""`station history backup` and `copy`: all that the history holds, in a file of its own or in another database."""

from dataclasses import dataclass
from pathlib import Path

from station.cli.console import say
from station.cli.history_verbs.opened_history import opened_history, settings_for
from station.cli.options.option_fields import option, required
from station.core.counts import counted
from station.core.disk.utf8 import one_line
from station.core.errors import StationError
from station.store.copying import Copied


@dataclass(frozen=True, slots=True, kw_only=True)
class BackupOptions:
    """Where the backup is put."""

    out: Path = required("FILE", "the file to write; an older backup that is there gives way", Path)


@dataclass(frozen=True, slots=True, kw_only=True)
class CopyOptions:
    """What is copied, and where to."""

    to: str = required("URL", "the other database: postgresql://user@host/name, or sqlite:////folder/file", str)
    student: str | None = option("NAME", "what is this student's alone", str, None)


def back_up(options: BackupOptions) -> int:
    """Write all of it into one SQLite file, whole or not at all."""
    from station.store.backup import back_up as copy_to_file

    settings = settings_for(None, must_have_played=False)
    done = copy_to_file(opened_history(settings, settings.student), options.out)
    counts = f"{counted(done.added, 'session')} of {counted(done.students, 'student')}"
    say(f"backup   {one_line(str(options.out))}: {counts}")
    return 0


def copy(options: CopyOptions) -> int:
    """Add to another history what it has not, and what was written later here; delete nothing there."""
    from station.store.copying import copy_history
    from station.store.database import Database
    from station.store.history import History

    settings = settings_for(options.student, must_have_played=False)
    student = None if options.student is None else settings.student
    source = opened_history(settings, settings.student)
    database = Database(options.to)
    is_new = database.path is not None and not database.path.exists()
    try:
        _tell(copy_history(source, History(database), student), database.name)
    except StationError:
        if is_new and database.path is not None:
            database.close()
            for end in ("", "-wal", "-shm", "-journal"):
                database.path.with_name(database.path.name + end).unlink(missing_ok=True)
        raise
    finally:
        database.close()
    return 0


def _tell(done: Copied, name: str) -> None:
    for session in done.stayed:
        say(f"{one_line(session)} is another session there, or a newer one, and stays")
    numbers = "; sessions have other numbers there" if done.renumbered else ""
    counts = f"{counted(done.added, 'session')} added, {done.replaced} replaced"
    say(f"copied   {one_line(name)}: {counts}, of {counted(done.students, 'student')}{numbers}")
