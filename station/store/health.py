"""How a history is, looked at without making or migrating it."""

from dataclasses import dataclass

from sqlalchemy import delete, text

from station.core.errors import BadInput, DeviceError
from station.store.database import Database
from station.store.schema_version import HEAD, version_of
from station.store.tables import SESSIONS

_NO_ID = 0
"""No session has it."""


@dataclass(frozen=True, slots=True)
class Health:
    """Where a history is kept; its size in bytes and the version of its tables, None where there is none yet.

    `fault` is why it cannot be used, None where it can be read and written.
    """

    name: str
    size: int | None = None
    version: str | None = None
    fault: str | None = None


def health_of(url: str) -> Health:
    """How the history at `url` is; raises `BadInput` for a URL that is none of ours."""
    database = Database(url)
    try:
        return _looked_at(database)
    except (BadInput, DeviceError) as fault:
        return Health(database.name, fault=str(fault))
    finally:
        database.close()


def _looked_at(database: Database) -> Health:
    if database.path is not None and not database.path.exists():
        return Health(database.name)
    found = version_of(database)
    if found is None:
        return Health(database.name)
    health = Health(database.name, _size(database), found)
    if found > HEAD:
        return Health(health.name, health.size, found, f"it was written by a newer station than this one ({HEAD})")
    with database.writing() as connection:  # a statement that asks for all that a writer needs, and changes nothing
        connection.execute(delete(SESSIONS).where(SESSIONS.c.id == _NO_ID))
    return health


def _size(database: Database) -> int:
    if database.path is not None:
        return database.path.stat().st_size
    with database.reading() as connection:
        return int(connection.execute(text("SELECT pg_database_size(current_database())")).scalar_one())
