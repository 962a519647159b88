"""Which tables a database has: none (they are made), ours, older ones (they are migrated) or newer ones (refused)."""

from pathlib import Path

from sqlalchemy import Connection, inspect, text

from station.core.errors import BadInput, DeviceError
from station.store.database import Database, is_postgres
from station.store.sqlite_files import copied, keep_log, made
from station.store.tables import METADATA, SESSIONS, STUDENTS
from station.store.turns import alone

HEAD = "0004"
"""The newest of `migrations/versions`."""
_MIGRATIONS = Path(__file__).with_name("migrations")
_VERSIONS = "alembic_version"
_COLUMNS = "version_num VARCHAR(32) NOT NULL, CONSTRAINT alembic_version_pkc PRIMARY KEY (version_num)"


def make_ready(database: Database) -> None:
    """Give a database the tables of `tables`; raises `BadInput` for newer ones or another program's, `DeviceError`.

    A SQLite file that is not there is made, for its owner alone. Before one is migrated a copy of it is put beside it.
    """
    if database.path is not None:
        with database.refusals():
            made(database.path)
    if version_of(database) != HEAD:
        with database.writing(migrates=True) as connection:
            alone(connection)
            _bring_up(connection, database)
    if database.path is not None:
        with database.refusals():
            keep_log(database.path)


def version_of(database: Database) -> str | None:
    """The version of the tables that are there, None where there are none.

    Raises `BadInput` where they are another program's, `DeviceError`.
    """
    with database.reading() as connection:
        return _version(connection, database)


def _version(connection: Connection, database: Database) -> str | None:
    tables = inspect(connection).get_table_names()
    if not tables:
        return None
    if not {_VERSIONS, STUDENTS.name, SESSIONS.name} <= {*tables}:
        raise BadInput(database.name, "", "is another program's database: the history needs one of its own")
    found = connection.execute(text(f"SELECT version_num FROM {_VERSIONS}")).scalars().all()
    if len(found) != 1 or not str(found[0]).isdigit():
        raise BadInput(database.name, "", "has a version that nobody wrote: put a backup in its place")
    return str(found[0])


def _bring_up(connection: Connection, database: Database) -> None:
    """Make the tables or migrate them, unless another station has just done it."""
    found = _version(connection, database)
    if found is None:
        _make(connection, database)
    elif found > HEAD:
        fault = f"was written by a newer station than this one, which knows version {HEAD}"
        raise BadInput(database.name, f"version {found}", fault)
    elif found != HEAD:
        if database.path is not None:
            copied(database.path, copy_beside(database.path, found))
        _migrate(connection, database)


def copy_beside(path: Path, found: str) -> Path:
    """Where the copy of a file with tables of version `found` is put before they are migrated."""
    return path.with_name(f"{path.stem}-before-{HEAD}-{found}{path.suffix}")


def _make(connection: Connection, database: Database) -> None:
    if is_postgres(connection):
        encoding = connection.execute(text("SHOW server_encoding")).scalar_one()
        if encoding != "UTF8":
            raise BadInput(
                database.name, f"encoding {encoding}", "cannot hold every name: createdb -E UTF8 -T template0"
            )
    METADATA.create_all(connection)
    connection.execute(text(f"CREATE TABLE {_VERSIONS} ({_COLUMNS})"))
    connection.execute(text(f"INSERT INTO {_VERSIONS} VALUES (:head)"), {"head": HEAD})


def _migrate(connection: Connection, database: Database) -> None:
    from alembic import command  # noqa: PLC0415 - a fifth of a second that only an older database needs
    from alembic.config import Config  # noqa: PLC0415
    from alembic.util import CommandError  # noqa: PLC0415

    config = Config()
    config.set_main_option("script_location", str(_MIGRATIONS).replace("%", "%%"))
    config.attributes["connection"] = connection
    try:
        command.upgrade(config, "head")
    except CommandError as fault:
        raise DeviceError(f"history {database.name}: cannot be migrated: {fault}") from fault
    if not is_postgres(connection) and connection.exec_driver_sql("PRAGMA foreign_key_check").first() is not None:
        raise DeviceError(f"history {database.name}: cannot be migrated: rows would lose what they go with")
