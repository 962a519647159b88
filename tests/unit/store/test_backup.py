"""A backup is one file, readable by its owner, whole or not there."""

import sqlite3
import stat
from contextlib import closing
from datetime import datetime
from pathlib import Path

import pytest

from station.core.errors import BadInput, DeviceError
from station.store.backup import back_up, copies_known
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from station.store.rows import KeptSession, SessionRow


def _keep(history: History, name: str) -> None:
    history.keep(KeptSession(SessionRow("Ann", name, datetime(2026, 5, 3), "/here"), documents={"report.json": b"{}"}))


def _names(path: Path) -> frozenset[str]:
    opened = History(Database(sqlite_url(path)))
    names = opened.session_names("Ann")
    opened.database.close()
    return names


@pytest.fixture
def backup(tmp_path: Path) -> Path:
    """Where it goes: a folder that is not there yet."""
    return tmp_path / "stick" / "backup.sqlite3"


def test_a_backup_is_one_file_of_its_owner_alone(history: History, backup: Path) -> None:
    _keep(history, "one")
    assert back_up(history, backup).added == 1
    assert [each.name for each in backup.parent.iterdir()] == ["backup.sqlite3"]
    assert stat.S_IMODE(backup.stat().st_mode) == 0o600
    assert _names(backup) == {"one"}
    assert copies_known(history) == [str(backup)]
    backup.unlink()
    assert copies_known(history) == []


def test_a_newer_backup_takes_the_place_of_an_older_one_whole(history: History, backup: Path) -> None:
    _keep(history, "one")
    back_up(history, backup)
    assert _names(backup) == {"one"}  # it was looked at: a log may lie beside it
    _keep(history, "two")
    back_up(history, backup)
    assert [each.name for each in backup.parent.iterdir()] == ["backup.sqlite3"]
    assert _names(backup) == {"one", "two"}


def test_a_backup_that_fails_leaves_the_older_one(history: History, backup: Path) -> None:
    _keep(history, "one")
    back_up(history, backup)
    before = backup.read_bytes()
    with history.database.writing() as connection:
        connection.exec_driver_sql("ALTER TABLE documents RENAME TO gone")
    with pytest.raises(DeviceError, match="documents"):
        back_up(history, backup)
    assert backup.read_bytes() == before
    assert [each.name for each in backup.parent.iterdir()] == ["backup.sqlite3"]


def test_a_backup_that_is_being_read_stays(history: History, backup: Path) -> None:
    _keep(history, "one")
    back_up(history, backup)
    reader = History(Database(sqlite_url(backup)))
    with reader.database.reading() as connection:
        connection.exec_driver_sql("SELECT * FROM students").all()
        with pytest.raises(DeviceError, match="is in use"):
            back_up(history, backup)
    assert _names(backup) == {"one"}


def test_what_is_no_backup_is_never_overwritten(history: History, backup: Path) -> None:
    backup.parent.mkdir()
    backup.write_text("My notes.")
    with pytest.raises(BadInput, match="is no backup of a history"):
        back_up(history, backup)
    assert backup.read_text() == "My notes."
    with closing(sqlite3.connect(backup.parent / "songs.sqlite3")) as others:
        others.execute("CREATE TABLE songs (name)")
    before = (backup.parent / "songs.sqlite3").read_bytes()
    with pytest.raises(BadInput, match="is no backup of a history"):
        back_up(history, backup.parent / "songs.sqlite3")
    assert (backup.parent / "songs.sqlite3").read_bytes() == before
    with pytest.raises(BadInput, match="is no file"):
        back_up(history, backup.parent)


def test_the_history_itself_is_no_backup(tmp_path: Path) -> None:
    path = tmp_path / "history.sqlite3"
    history = History(Database(sqlite_url(path)))
    _keep(history, "one")
    with pytest.raises(BadInput, match="is the history itself"):
        back_up(history, path)
    assert _names(path) == {"one"}
