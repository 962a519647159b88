"""Where the history is: a SQLite file or a PostgreSQL server by its URL, opened so that nobody locks others out.

SQLite is in WAL mode: who reads never waits, who writes waits for the writer before, at most `PATIENCE_S`. Whatever
a database refuses becomes a `DeviceError` that names it, without its password.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sqlalchemy import Connection, Engine, create_engine, event, text
from sqlalchemy.engine import URL, make_url
from sqlalchemy.engine.interfaces import DBAPIConnection
from sqlalchemy.exc import ArgumentError, DBAPIError, NoSuchModuleError, SQLAlchemyError
from sqlalchemy.pool import NullPool

from station.core.errors import BadInput, DeviceError

PATIENCE_S = 10.0
"""So long a writer waits for another (our choice: a hundred times what a long session takes to be kept)."""
CONNECT_S = 3
"""So long a server may take to answer (our choice: what a user waits without asking)."""
DRIVERS = {"sqlite": "sqlite+pysqlite", "postgresql": "postgresql+psycopg", "postgres": "postgresql+psycopg"}
"""What each kind of database that a URL may name is reached by."""
_GOES_ON = 512
"""Pages of the log beside a SQLite file after which it is folded in (our choice: 2 MB)."""


class Database:
    """One database by its URL; raises `BadInput` for a URL that is none of ours."""

    def __init__(self, url: str) -> None:
        self.url = _checked(url)
        self.is_sqlite = self.url.drivername == DRIVERS["sqlite"]
        self.name = self.url.database or "" if self.is_sqlite else self.url.render_as_string(hide_password=True)
        self.engine = self._engine()

    @property
    def path(self) -> Path | None:
        """The file of a SQLite database; None for a server."""
        return Path(self.name) if self.is_sqlite else None

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """A connection that sees one state of the database; raises `DeviceError`."""
        with self._refusals(), self.engine.connect() as connection:
            yield connection

    @contextmanager
    def writing(self) -> Iterator[Connection]:
        """A transaction that is kept whole where the block ends and not at all where it fails; raises `DeviceError`."""
        with self._refusals(), self.engine.connect().execution_options(writes=True) as connection, connection.begin():
            yield connection

    def close(self) -> None:
        """Let go of every connection."""
        self.engine.dispose()

    @contextmanager
    def _refusals(self) -> Iterator[None]:
        try:
            yield
        except (SQLAlchemyError, OSError) as fault:
            raise DeviceError(f"history {self.name}: {_reason(fault)}") from fault

    def _engine(self) -> Engine:
        try:
            if not self.is_sqlite:
                return create_engine(
                    self.url,
                    pool_pre_ping=True,
                    pool_size=2,
                    isolation_level="REPEATABLE READ",
                    connect_args={"connect_timeout": CONNECT_S, "options": f"-c lock_timeout={round(PATIENCE_S)}s"},
                )
            engine = create_engine(self.url, poolclass=NullPool, connect_args={"timeout": PATIENCE_S})
        except (NoSuchModuleError, ImportError) as fault:
            raise DeviceError(
                f"history {self.name}: its driver is not installed: pip install 'drum-station[postgres]'"
            ) from fault
        event.listen(engine, "connect", _prepared)
        event.listen(engine, "begin", _begun)
        return engine


def _checked(url: str) -> URL:
    try:
        made = make_url(url)
    except (ArgumentError, ValueError) as fault:
        raise BadInput("history", "", "is no URL of a database, such as postgresql://user@host/name") from fault
    kind = made.drivername.partition("+")[0]
    if kind not in DRIVERS:
        raise BadInput("history", "", f"{kind!r} is none of {', '.join(sorted(DRIVERS))}")
    if kind == "sqlite" and (made.database or ":memory:") == ":memory:":
        raise BadInput("history", "", "a SQLite URL needs a file: sqlite:////folder/history.sqlite3")
    return made.set(drivername=DRIVERS[kind])


def sqlite_url(path: Path) -> str:
    """The URL of a SQLite file."""
    return URL.create(DRIVERS["sqlite"], database=str(path)).render_as_string()


def _prepared(connection: DBAPIConnection, _record: object) -> None:
    """What every connection to SQLite needs; transactions are begun by us, so that a writer asks for its turn first."""
    connection.isolation_level = None
    cursor = connection.cursor()
    for setting in (
        "journal_mode = WAL",
        "synchronous = FULL",  # what was committed outlives the power
        "foreign_keys = ON",
        f"wal_autocheckpoint = {_GOES_ON}",
    ):
        cursor.execute(f"PRAGMA {setting}")
    cursor.close()


def _begun(connection: Connection) -> None:
    writes = connection.get_execution_options().get("writes", False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")


def _reason(fault: Exception) -> str:
    """The first line of what the database says itself."""
    told = fault.orig if isinstance(fault, DBAPIError) and fault.orig is not None else fault
    return next((line for line in str(told).splitlines() if line.strip()), type(told).__name__)


def is_postgres(connection: Connection) -> bool:
    """Whether the connection leads to a PostgreSQL server."""
    return connection.dialect.name == "postgresql"


def alone(connection: Connection) -> None:
    """Until the transaction ends nobody else changes the tables themselves: a SQLite writer is alone anyway."""
    if is_postgres(connection):
        connection.execute(text("SELECT pg_advisory_xact_lock(7312)"))
