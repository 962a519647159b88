"""What SQLite needs beside its statements: files that only their owner reads, a log beside them, copies of them.

With a log beside the file (WAL) who reads never waits and keeps nobody waiting; who writes waits for the writer before.
"""

import os
import sqlite3
import time
from contextlib import closing
from pathlib import Path

from sqlalchemy import Connection
from sqlalchemy.engine.interfaces import DBAPIConnection

from station.core.disk.files import growing
from station.store.patience import PATIENCE_S, left_of

FOR_THE_OWNER = 0o600
"""Who may read a file: whoever made it, alone."""
_FOLDED_AFTER = 512
"""Pages of the log after which it is folded into the file (our choice: 2 MB)."""
_LONGEST_LOG = 16 * 2**20
"""A log that has grown beside a long reader is cut to so many bytes afterwards (our choice)."""
_AGAIN_S = 0.02


def prepared(connection: DBAPIConnection, _record: object) -> None:
    """Set a connection up; transactions are begun by us, so that a writer asks for its turn first."""
    connection.isolation_level = None
    cursor = connection.cursor()
    for setting in (
        "synchronous = FULL",  # what was committed outlives the power
        "foreign_keys = ON",
        "secure_delete = ON",  # what is deleted is not left lying in the file
        f"wal_autocheckpoint = {_FOLDED_AFTER}",
        f"journal_size_limit = {_LONGEST_LOG}",
        f"busy_timeout = {round(1000 * left_of(PATIENCE_S))}",  # who writes waits so long for the writer before
    ):
        cursor.execute(f"PRAGMA {setting}")
    cursor.close()


def begun(connection: Connection) -> None:
    """Begin a transaction: to write, with our turn; to migrate, without the rows that go with others being deleted."""
    options = connection.get_execution_options()
    if options.get("migrates"):
        connection.exec_driver_sql("PRAGMA foreign_keys = OFF")
    connection.exec_driver_sql("BEGIN IMMEDIATE" if options.get("writes") else "BEGIN")


def made(path: Path) -> None:
    """Make an empty file where none is, in a folder where none is; raises `OSError`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    os.close(os.open(path, os.O_RDWR | os.O_CREAT, FOR_THE_OWNER))


def keep_log(path: Path) -> None:
    """Have a log kept beside the file from now on, where its disk allows that; raises `sqlite3.Error`."""
    until = time.monotonic() + PATIENCE_S
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        while connection.execute("PRAGMA journal_mode").fetchone()[0] != "wal":
            try:
                connection.execute("PRAGMA journal_mode = WAL")
                return
            except sqlite3.OperationalError as fault:  # this waits for nobody by itself
                if fault.sqlite_errorcode != sqlite3.SQLITE_BUSY or time.monotonic() > until:
                    raise
            time.sleep(_AGAIN_S)


def keep_no_log(path: Path, patience_s: float = PATIENCE_S) -> None:
    """Fold the log into the file, which lies alone from then on; raises `sqlite3.Error` while others read it."""
    with closing(sqlite3.connect(path, timeout=patience_s, isolation_level=None)) as connection:
        connection.execute("PRAGMA journal_mode = DELETE")


def copied(path: Path, to: Path) -> None:
    """Copy a file as it was last committed, whole or not at all; raises `sqlite3.Error`, `DeviceError`."""
    with growing(to) as part:
        part.chmod(FOR_THE_OWNER)
        with closing(sqlite3.connect(path)) as old, closing(sqlite3.connect(part)) as copy:
            old.backup(copy)
        keep_no_log(part)
