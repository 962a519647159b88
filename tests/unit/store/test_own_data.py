"""What a student owns is taken away and deleted alike on both databases."""

import csv
import io
from datetime import datetime
from pathlib import Path
from zipfile import ZipFile

import pytest

from station.core.errors import DeviceError
from station.core.settings import Settings
from station.practice.own_data.student_deletion import delete_theirs, what_is_theirs
from station.practice.own_data.take_away import take_away
from station.store.database import Database
from station.store.history import History
from station.store.rows import MasteryRow, TeacherNoteRow
from station.store.tables import METADATA
from tests.fakes.kept_sessions import kept
from tests.fakes.postgres_server import PostgresServer

_DAY = datetime(2026, 11, 24, 18, 0)


def _everything(history: History) -> dict[str, list[tuple[object, ...]]]:
    with history.database.reading() as connection:
        return {
            table.name: sorted((tuple(row) for row in connection.execute(table.select())), key=repr)
            for table in METADATA.sorted_tables
        }


def test_taken_away_and_deleted_with_nothing_of_others(history: History, tmp_path: Path) -> None:
    settings = Settings(sessions=str(tmp_path / "sessions"))
    history.keep(kept("Ben", _DAY), [MasteryRow("rock-1", 0, 3, "{}")], {"rock-1": "beginner"})
    before = _everything(history)
    for second in range(3):
        history.keep(kept("Ann", _DAY.replace(second=second), title=f"=Title {second}"), levels={"rock-1": "beginner"})
    history.keep_note("Ann", TeacherNoteRow("n", "a", "Week 1", "Carla", _DAY, "Good.", "", b"note"))
    taken = take_away(history, settings, "Ann", tmp_path / "out.zip", _DAY)
    assert (taken.sessions, taken.judgements, taken.captures, taken.files) == (3, 6, 3, 0)
    with ZipFile(tmp_path / "out.zip") as archive:
        rows = list(csv.DictReader(io.StringIO(archive.read("sessions.csv").decode("utf-8-sig"), newline="")))
    assert [row["title"] for row in rows] == ["'=Title 0", "'=Title 1", "'=Title 2"]
    assert {float(row["sd_ms"]) for row in rows} == {15.25}
    theirs = what_is_theirs(history, settings, "Ann")
    assert (theirs.sessions, theirs.lessons, theirs.notes) == (3, 1, 1)
    assert any("other computers" in line for line in theirs.stays) == (history.database.path is None)
    assert delete_theirs(history, theirs) is None
    assert _everything(history) == before


def test_a_server_that_refuses_leaves_the_folder_and_is_asked_again(postgres: PostgresServer, tmp_path: Path) -> None:
    history = History(Database(postgres.new_database()))
    settings = Settings(sessions=str(tmp_path))
    history.keep(kept("Ann", _DAY))
    (tmp_path / "Ann" / "book").mkdir(parents=True)
    _let_write(history, False)
    with pytest.raises(DeviceError, match="read-only"):
        delete_theirs(history, what_is_theirs(history, settings, "Ann"))
    assert (tmp_path / "Ann" / "book").is_dir()
    assert len(history.sessions("Ann")) == 1
    _let_write(history, True)
    assert delete_theirs(history, what_is_theirs(history, settings, "Ann")) is None
    assert history.students() == []
    history.database.close()


def _let_write(history: History, is_allowed: bool) -> None:
    """Whether who connects from now on may write."""
    with history.database.reading() as connection:
        name = connection.exec_driver_sql("SELECT current_database()").scalar_one()
    engine = history.database.engine
    with engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
        connection.exec_driver_sql("SET default_transaction_read_only = off")
        word = "off" if is_allowed else "on"
        connection.exec_driver_sql(f'ALTER DATABASE "{name}" SET default_transaction_read_only = {word}')
    engine.dispose()
