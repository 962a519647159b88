"""Where the history is: a SQLite file or a PostgreSQL server by its URL, opened so that nobody locks others out.

Whatever a database refuses becomes a `DeviceError` that names it, without its password.
"""

import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.exc import NoSuchModuleError, SQLAlchemyError, StatementError
from sqlalchemy.pool import NullPool

from station.core.errors import DeviceError
from station.store.database_url import file_of, name_of, parsed
from station.store.server_links import connect_args, connected
from station.store.sqlite_files import begun, prepared

_NO_ROOM_BYTES = 64 * 2**10
"""With less a file cannot even be read: SQLite keeps 32 KiB beside it (its page "WAL-mode File Format")."""
_DAMAGED = ("malformed", "not a database")
_PUT_AWAY = (
    "; put a backup in its place, or move it away: sessions are taken in again from their folders then, mastery and"
    " levels begin anew"
)


class Database:
    """One database by its URL; raises `BadInput` for a URL that is none of ours."""

    def __init__(self, url: str) -> None:
        self.url = parsed(url)
        self.path = file_of(self.url)
        """The file of a SQLite database; None for a server."""
        self.name = name_of(self.url)
        self.engine = self._engine()

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """A connection that sees one state of the database; raises `DeviceError`."""
        with self.refusals(), self.engine.connect() as connection:
            yield connection

    @contextmanager
    def writing(self, *, migrates: bool = False) -> Iterator[Connection]:
        """A transaction that is kept whole where the block ends and not at all where it fails; raises `DeviceError`.

        One that `migrates` may make a table anew: rows that go with its rows stay meanwhile.
        """
        options: dict[str, Any] = {"writes": True, "migrates": migrates}
        if self.path is None:
            options |= {"isolation_level": "READ COMMITTED"}  # who has waited for a turn sees what came of the last one
        with self.refusals(), self.engine.connect().execution_options(**options) as connection, connection.begin():
            yield connection

    def close(self) -> None:
        """Let go of every connection."""
        self.engine.dispose()

    @contextmanager
    def refusals(self) -> Iterator[None]:
        """What the database, its driver or its disk refuse as a `DeviceError` that names it."""
        try:
            yield
        except (SQLAlchemyError, sqlite3.Error, OSError) as fault:
            raise DeviceError(f"history {self.name}: {_reason(fault)}{self._what_to_do(fault)}") from fault

    def _what_to_do(self, fault: Exception) -> str:
        """What mends a file that its disk or its bytes refuse; empty for all else."""
        if self.path is None:
            return ""
        if any(words in str(fault) for words in _DAMAGED):
            return _PUT_AWAY
        with suppress(OSError):
            if shutil.disk_usage(self.path.parent).free < _NO_ROOM_BYTES:
                return "; the disk that it is on is full: make room there and try again"
        return ""

    def _engine(self) -> Engine:
        try:
            if self.path is not None:
                engine = create_engine(self.url, poolclass=NullPool)
                event.listen(engine, "connect", prepared)
                event.listen(engine, "begin", begun)
                return engine
            engine = create_engine(
                self.url,
                pool_pre_ping=True,
                pool_size=2,
                isolation_level="REPEATABLE READ",
                connect_args=connect_args(),
            )
        except (NoSuchModuleError, ImportError) as fault:
            raise DeviceError(
                f"history {self.name}: its driver is not installed: pip install 'drum-station[postgres]'"
            ) from fault
        event.listen(engine, "do_connect", connected)
        return engine


def _reason(fault: Exception) -> str:
    """The first line of what the database says itself."""
    told: object = fault
    if isinstance(fault, StatementError) and fault.orig is not None:  # a DBAPIError is one
        told = fault.orig
    elif isinstance(fault, OSError):
        told = fault.strerror or fault
    return next((line for line in str(told).splitlines() if line.strip()), type(fault).__name__)


def is_postgres(connection: Connection) -> bool:
    """Whether the connection leads to a PostgreSQL server."""
    return connection.dialect.name == "postgresql"
