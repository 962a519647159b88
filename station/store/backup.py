"""A backup: a history in one SQLite file that takes the place of an older backup at once or not at all."""

import os.path
import platform
import sqlite3
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from sqlalchemy import select

from station.core.disk.files import growing
from station.core.errors import BadInput, DeviceError
from station.store.copying import Copied, copy_history
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from station.store.schema_version import version_of
from station.store.sqlite_files import FOR_THE_OWNER, keep_no_log
from station.store.tables import BACKUPS
from station.store.upserts import put

_BESIDE = ("-wal", "-shm", "-journal")
"""How the files end that SQLite keeps beside its own."""
_AS_LONG_AS_S = 1.0
"""So long whoever reads an older backup may still read it (our choice)."""


def back_up(history: History, path: Path) -> Copied:
    """Copy all of `history`, wherever it is kept, into the file `path`; the history remembers that it lies there.

    Raises `BadInput` where something else than a backup is at `path`, `DeviceError` where it cannot be written or is
    being read; what was there stays then.
    """
    own = history.database.path
    if own is not None and _real(path) in [_real(own.with_name(own.name + end)) for end in _BESIDE]:
        raise BadInput(path, "", "belongs to the history itself: a backup needs another file")
    if path.exists():
        _let_go(history, path)
    with growing(path) as part:
        part.chmod(FOR_THE_OWNER)
        try:
            copied = _copy(history, part)
        except DeviceError as fault:
            raise DeviceError(str(fault).replace(str(part), str(path))) from fault
        finally:
            for end in _BESIDE:
                with suppress(OSError):
                    part.with_name(part.name + end).unlink(missing_ok=True)
    place = {"computer": platform.node(), "file": str(path.resolve())}
    with history.database.writing() as connection:
        put(connection, BACKUPS, [place | {"made": datetime.now()}], list(place))
    return copied


def copies_known(history: History) -> list[str]:
    """Where copies lie that this history knows of: its backups, and what was put beside its file before migrations."""
    with history.database.reading() as connection:
        backups = connection.execute(select(BACKUPS).order_by(BACKUPS.c.computer, BACKUPS.c.file)).all()
    here = [each.file for each in backups if each.computer == platform.node() and Path(each.file).exists()]
    elsewhere = [f"{each.file} on {each.computer}" for each in backups if each.computer != platform.node()]
    path = history.database.path
    beside = (
        [] if path is None else sorted(str(each) for each in path.parent.glob(f"{path.stem}-before-*{path.suffix}"))
    )
    return [*here, *elsewhere, *beside]


def _copy(history: History, part: Path) -> Copied:
    database = Database(sqlite_url(part))
    try:
        copied = copy_history(history, History(database))
    finally:
        database.close()
    keep_no_log(part)
    return copied


def _real(path: Path) -> str:
    """Where links lead; those that lead in a circle lead to themselves."""
    return os.path.realpath(path)  # `resolve` fails for a circle, whatever it is told


def _let_go(history: History, path: Path) -> None:
    """Make sure that `path` is an older backup, alone in its file, which may be replaced."""
    own = history.database.path
    if own is not None and path.samefile(own):
        raise BadInput(path, "", "is the history itself: a backup needs another file")
    if not path.is_file():
        raise BadInput(path, "", "is no file")
    try:
        found = version_of(Database(sqlite_url(path)))
    except (BadInput, DeviceError):
        found = None
    if found is None:
        raise BadInput(path, "", "is there, and is no backup of a history: choose another name")
    try:
        keep_no_log(path, _AS_LONG_AS_S)
    except sqlite3.Error as fault:
        raise DeviceError(f"{path}: is in use, and stays as it is: {fault}") from fault
