"""What deleted rows leave in the files of a database, overwritten or given back to the system."""

import sqlite3
from contextlib import closing

from sqlalchemy import text
from sqlalchemy.exc import SQLAlchemyError

from station.store.database import Database
from station.store.tables import METADATA

_IN_USE = "another program has it open"


def scrub(database: Database) -> str | None:
    """Write the file anew without what was deleted, the log beside it too; why that could not be done, None if it was.

    A server gives the space back, as far as its own logs and backups let it.
    """
    try:
        return _scrub_server(database) if database.path is None else _scrub_file(database)
    except (sqlite3.Error, SQLAlchemyError, OSError) as fault:
        return next(iter(str(fault).splitlines()), type(fault).__name__)


def _scrub_file(database: Database) -> str | None:
    with closing(database.engine.raw_connection()) as connection, closing(connection.cursor()) as cursor:
        cursor.execute("VACUUM")
        cursor.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        is_busy, *_ = cursor.fetchone() or (1,)
    return _IN_USE if is_busy else None


def _scrub_server(database: Database) -> str | None:
    with database.engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
        for table in METADATA.sorted_tables:
            connection.execute(text(f"VACUUM {table.name}"))
    return None
