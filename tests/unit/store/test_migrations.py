"""An older history becomes like a new one, and keeps what is in it; what cannot be migrated stays as it was."""

import json
import shutil
import sqlite3
import stat
import zlib
from contextlib import closing
from pathlib import Path

import pytest
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import inspect, text

from station.core.errors import BadInput, DeviceError
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


_SESSION = (
    "INSERT INTO sessions (id, student_id, name, kind, state, started, folder, lesson, title, device, played_s,"
    " complete, level, notes, \"right\", strokes, exam) VALUES ({number}, 7, 'session-{number}', 'lesson', 'kept',"
    " '2026-05-03 18:30:00.000000', '', 'rock-1', '', '', 1.0, true, '', 0, 0, 0, '')"
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


def test_what_was_asked_is_read_from_older_reports(url: str) -> None:
    database = _migrated(url, "0003", *_IN_0001, *(_SESSION.format(number=number) for number in (1, 2)))
    report = {
        "session": {
            "beats_a_minute": 60, "tempi": [{"beats_a_minute": 60}, {"beats_a_minute": 80}], "bars": [3, 6],
            "click": True, "gap": None, "input_latency_ms": 8.5, "output_latency_ms": 20,
        }
    }  # fmt: skip
    with database.writing() as connection:
        for number, body in ((1, zlib.compress(json.dumps(report).encode())), (2, b"damaged")):
            wanted = text("INSERT INTO documents (session_id, name, body) VALUES (:number, 'report.json', :body)")
            connection.execute(wanted, {"number": number, "body": body})
    read, damaged = History(database).sessions("Ann")
    assert (read.first_bar, read.last_bar, read.click, read.gap) == (3, 6, True, None)
    assert (read.input_latency_ms, read.output_latency_ms, read.top_beats_a_minute) == (8.5, 20.0, 80.0)
    assert (damaged.first_bar, damaged.click, damaged.top_beats_a_minute) == (None, None, None)
    database.close()


def test_a_copy_of_an_older_file_is_put_beside_it(tmp_path: Path) -> None:
    path = tmp_path / "history.sqlite3"
    _migrated(sqlite_url(path), "0001", *_IN_0001)
    History(Database(sqlite_url(path)))
    copy = tmp_path / f"history-before-{HEAD}-0001.sqlite3"
    assert stat.S_IMODE(copy.stat().st_mode) == 0o600
    with closing(sqlite3.connect(copy)) as older:
        assert older.execute("SELECT version_num FROM alembic_version").fetchall() == [("0001",)]
        assert older.execute("SELECT document FROM mastery").fetchall() == [("{}",)]
        assert older.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    assert {each.name for each in tmp_path.iterdir()} == {path.name, copy.name}


_FAILS = """
import sqlalchemy as sa
from alembic import op

revision, down_revision, branch_labels, depends_on = "9998", "{head}", None, None


def upgrade():
    op.create_table("halves", sa.Column("id", sa.Integer))
    op.execute("DROP TABLE levels")
    op.execute("INSERT INTO nowhere VALUES (1)")
"""


def test_a_migration_that_fails_leaves_the_history_as_it_was(
    url: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    database = _migrated(url, "head", *_IN_0001)
    before = _schema(database)
    scripts = tmp_path / "migrations"
    shutil.copytree(_MIGRATIONS, scripts, ignore=shutil.ignore_patterns("__pycache__"))
    (scripts / "versions" / "v9998_fails.py").write_text(_FAILS.format(head=HEAD))
    with monkeypatch.context() as newer:
        newer.setattr(schema_version, "_MIGRATIONS", scripts)
        newer.setattr(schema_version, "HEAD", "9998")
        with pytest.raises(DeviceError, match="nowhere"):
            History(database)
    assert _schema(database) == before
    assert History(database).mastery("Ann") == [MasteryRow("rock-1", 0, 3, "{}")]
    database.close()


_REBUILDS = """
import sqlalchemy as sa
from alembic import op

revision, down_revision, branch_labels, depends_on = "9998", "{head}", None, None


def upgrade():
    with op.batch_alter_table("students", recreate="always") as students:
        students.add_column(sa.Column("email", sa.String()))
"""


def test_rows_outlive_that_the_table_of_those_they_go_with_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    database = _migrated(sqlite_url(tmp_path / "history.sqlite3"), "head", *_IN_0001)
    scripts = tmp_path / "migrations"
    shutil.copytree(_MIGRATIONS, scripts, ignore=shutil.ignore_patterns("__pycache__"))
    (scripts / "versions" / "v9998_rebuilds.py").write_text(_REBUILDS.format(head=HEAD))
    monkeypatch.setattr(schema_version, "_MIGRATIONS", scripts)
    monkeypatch.setattr(schema_version, "HEAD", "9998")
    assert History(database).mastery("Ann") == [MasteryRow("rock-1", 0, 3, "{}")]


_REFUSED = {
    "UPDATE alembic_version SET version_num = '9999'": "version 9999: was written by a newer station",
    "UPDATE alembic_version SET version_num = 'rev-x'": "has a version that nobody wrote",
    "UPDATE alembic_version SET version_num = ''": "has a version that nobody wrote",
    "INSERT INTO alembic_version VALUES ('0001')": "has a version that nobody wrote",
    "DELETE FROM alembic_version": "has a version that nobody wrote",
    "DROP TABLE alembic_version": "is another program's database",
}


def test_what_is_newer_or_another_programs_is_refused_and_left_alone(url: str) -> None:
    database = _migrated(url, "head")
    for change, told in _REFUSED.items():
        with database.writing() as connection:
            connection.exec_driver_sql(change)
        before = _schema(database)
        with pytest.raises(BadInput, match=told) as refused:
            History(database)
        assert str(refused.value).startswith(database.name)
        assert _schema(database) == before
    database.close()


def test_another_programs_migrations_are_not_ours(url: str) -> None:
    database = Database(url)
    if database.path is not None:
        database.path.touch()
    with database.writing() as connection:
        connection.exec_driver_sql("CREATE TABLE songs (name TEXT)")
        connection.exec_driver_sql("CREATE TABLE alembic_version (version_num TEXT)")
        connection.exec_driver_sql("INSERT INTO alembic_version VALUES ('0001')")
    with pytest.raises(BadInput, match="is another program's database"):
        History(database)
    assert set(_schema(database)) == {"songs", "alembic_version"}
    database.close()


def test_students_who_shared_a_key_are_known_by_their_own(url: str) -> None:
    before = (("unnamed", "🥁"), ("zoe", "Zoe."), ("ann-lee", "Ann Lee"))
    rows = [f"INSERT INTO students (key, name) VALUES ('{key}', '{name}')" for key, name in before]
    history = History(_migrated(url, "0002", *rows))
    for _, name in before:
        history.remember(name, levels={"rock-1": "beginner"})
    history.remember("🎸", levels={"rock-1": "beginner"})
    assert sorted(row.name for row in history.students()) == sorted(["🥁", "🎸", "Zoe.", "Ann Lee"])
    history.database.close()
