"""Which tables a database has: none (they are made), ours, older ones (they are migrated) or newer ones (refused)."""

import sqlite3
from contextlib import closing
from pathlib import Path

from sqlalchemy import Connection, inspect, text

from station.core.errors import BadInput
from station.store.database import Database, alone
from station.store.tables import METADATA, SESSIONS

HEAD = "0001"
"""The newest of `migrations/versions`."""
_MIGRATIONS = Path(__file__).with_name("migrations")


def make_ready(database: Database) -> None:
    """Give a database the tables of `tables`; raises `BadInput` for newer ones or another program's, `DeviceError`.

    Before a SQLite file is migrated a copy of it is put beside it.
    """
    if database.path is not None:
        database.path.parent.mkdir(parents=True, exist_ok=True)
    with database.reading() as connection:
        found = version(connection)
    if found == HEAD:
        return
    with database.writing() as connection:
        alone(connection)
        found = version(connection)  # perhaps another station has just done it
        if found is None:
            _make(connection, database)
        elif found != HEAD:
            _migrate(connection, database, found)


def version(connection: Connection) -> str | None:
    """The version of the tables that are there; None where there are none."""
    if not inspect(connection).has_table("alembic_version"):
        return None
    return connection.execute(text("SELECT version_num FROM alembic_version")).scalar()


def _make(connection: Connection, database: Database) -> None:
    if inspect(connection).has_table(SESSIONS.name):
        raise BadInput(database.name, "", "is another program's database: it has tables, but none of our versions")
    METADATA.create_all(connection)
    connection.execute(text("CREATE TABLE alembic_version (version_num VARCHAR(32) NOT NULL PRIMARY KEY)"))
    connection.execute(text("INSERT INTO alembic_version VALUES (:head)"), {"head": HEAD})


def _migrate(connection: Connection, database: Database, found: str) -> None:
    from alembic import command  # noqa: PLC0415 - a fifth of a second that only an older database needs
    from alembic.config import Config  # noqa: PLC0415
    from alembic.script import ScriptDirectory  # noqa: PLC0415

    config = Config()
    config.set_main_option("script_location", str(_MIGRATIONS))
    known = {script.revision for script in ScriptDirectory.from_config(config).walk_revisions()}
    if found not in known:
        raise BadInput(
            database.name, f"version {found}", f"was written by a newer station than this one, which knows {HEAD}"
        )
    if database.path is not None:
        _copy_beside(database.path, found)
    config.attributes["connection"] = connection
    command.upgrade(config, "head")


def _copy_beside(path: Path, found: str) -> None:
    with (
        closing(sqlite3.connect(path)) as old,
        closing(sqlite3.connect(path.with_name(f"{path.stem}-before-{HEAD}-{found}{path.suffix}"))) as copy,
    ):
        old.backup(copy)
