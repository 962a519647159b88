"""An older history becomes like a new one, and keeps what is in it; what cannot be migrated stays as it was."""

from pathlib import Path

import pytest
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import inspect

from station.store import schema_version
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from station.store.rows import MasteryRow
from station.store.schema_version import HEAD
from station.store.tables import METADATA

_MIGRATIONS = Path(schema_version.__file__).with_name("migrations")
_IN_0001 = (
    "INSERT INTO students (id, key, name) VALUES (7, 'ann', 'Ann')",
    "INSERT INTO mastery (student_id, lesson, first_bar, last_bar, document) VALUES (7, 'rock-1', 0, 3, '{}')",
)


def _config() -> Config:
    config = Config()
    config.set_main_option("script_location", str(_MIGRATIONS))
    return config


def _migrated(url: str, to: str, *statements: str) -> Database:
    """A database that was made by the migrations up to `to`, with rows in it."""
    database = Database(url)
    if database.path is not None:
        database.path.touch()
    with database.writing() as connection:
        config = _config()
        config.attributes["connection"] = connection
        command.upgrade(config, to)
        for statement in statements:
            connection.exec_driver_sql(statement)
    return database


def _schema(database: Database) -> dict[str, object]:
    """What the database itself says that its tables are."""
    with database.reading() as connection:
        looked = inspect(connection)
        return {
            table: (
                [{**column, "type": str(column["type"])} for column in looked.get_columns(table)],
                looked.get_pk_constraint(table),
                sorted(looked.get_foreign_keys(table), key=str),
                sorted(looked.get_indexes(table), key=str),
                sorted(looked.get_unique_constraints(table), key=str),
            )
            for table in looked.get_table_names()
        }


@pytest.fixture
def other_url(url: str, request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """Another new database of the same kind."""
    if url.startswith("sqlite"):
        return sqlite_url(tmp_path / "other.sqlite3")
    return str(request.getfixturevalue("postgres").new_database())


def test_migrations_make_what_the_tables_say(url: str, other_url: str) -> None:
    migrated, made = _migrated(url, "head"), History(Database(other_url)).database
    assert _schema(migrated) == _schema(made)
    with migrated.reading() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True, "compare_server_default": True})
        assert compare_metadata(context, METADATA) == []
    History(migrated)
    migrated.close()
    made.close()


def test_the_head_is_the_newest_migration() -> None:
    assert ScriptDirectory.from_config(_config()).get_current_head() == HEAD


def test_an_older_history_is_migrated_with_what_is_in_it(url: str) -> None:
    history = History(_migrated(url, "0001", *_IN_0001))
    assert history.mastery("Ann") == [MasteryRow("rock-1", 0, 3, "{}")]
    history.remember("Ann", levels={"rock-1": "beginner"})
    assert history.levels("Ann") == {"rock-1": "beginner"}
    history.database.close()
