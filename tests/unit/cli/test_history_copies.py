"""`station history backup`, `copy`, and what `station doctor` says of the history."""

import json
import sqlite3
from contextlib import closing
from datetime import datetime
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.core.settings import Settings, data_folder, save_settings
from station.store import opening
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from tests.fakes.kept_sessions import kept, users_history


@pytest.fixture(autouse=True)
def _two_students(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    for student in ("Ann", "Ben"):
        users_history().keep(kept(student, datetime(2026, 11, 24, 18, 0)))


def students_in(path: Path) -> list[str]:
    """By SQL of our own."""
    with closing(sqlite3.connect(path)) as connection:
        rows = connection.execute(
            "SELECT students.name FROM sessions JOIN students ON students.id = student_id"
            " JOIN captures ON sha256 = capture_sha256 ORDER BY students.name"
        )
        return [name for (name,) in rows]


def test_a_backup_has_all_of_it_and_replaces_an_older_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "backup.sqlite3"
    assert main(["history", "backup", "--out", str(out)]) == 0
    assert capsys.readouterr().err == f"backup   {out}: 2 sessions of 2 students\n"
    assert students_in(out) == ["Ann", "Ben"]
    users_history().keep(kept("Zoë", datetime(2026, 11, 24, 18, 0)))
    assert main(["history", "backup", "--out", str(out)]) == 0
    assert students_in(out) == ["Ann", "Ben", "Zoë"]
    other = tmp_path / "mine.txt"
    other.write_text("mine")
    assert main(["history", "backup", "--out", str(other)]) == 2
    assert other.read_text() == "mine"
    assert main(["history", "backup", "--out", str(data_folder() / "history.sqlite3")]) == 2


def numbers_in(path: Path) -> dict[str, int]:
    with closing(sqlite3.connect(path)) as connection:
        return dict(
            connection.execute(
                "SELECT students.name, sessions.id FROM sessions JOIN students ON students.id = student_id"
            )
        )


def test_a_backup_keeps_the_numbers_and_a_copy_says_where_they_differ(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mine, backup, school = data_folder() / "history.sqlite3", tmp_path / "backup.sqlite3", tmp_path / "school.sqlite3"
    users_history().keep(kept("Aaron", datetime(2026, 11, 24, 18, 0)))  # first by the alphabet, last by number
    assert main(["history", "backup", "--out", str(backup)]) == 0
    assert numbers_in(backup) == numbers_in(mine)
    History(Database(sqlite_url(school))).keep(kept("Zoë", datetime(2026, 11, 24, 18, 0)))
    capsys.readouterr()
    assert main(["history", "copy", "--to", sqlite_url(school)]) == 0
    assert capsys.readouterr().err.endswith("of 3 students; sessions have other numbers there\n")
    assert numbers_in(school) != numbers_in(mine)


def test_one_student_moves_into_another_history(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    school = tmp_path / "school.sqlite3"
    url = sqlite_url(school)
    assert main(["history", "copy", "--to", url, "--student", "Ann"]) == 0
    assert capsys.readouterr().err == f"copied   {school}: 1 session added, 0 replaced, of 1 student\n"
    assert students_in(school) == ["Ann"]
    assert main(["history", "copy", "--to", url]) == 0
    assert "1 session added, 0 replaced, of 2 students" in capsys.readouterr().err
    changed = History(Database(url))
    changed.keep(kept("Ann", datetime(2026, 11, 24, 18, 0), score=1.0))
    changed.database.close()
    assert main(["history", "copy", "--to", url]) == 0
    assert "is another session there, or a newer one, and stays" in capsys.readouterr().err
    for wrong in ("nothing", "mysql://host/name", sqlite_url(data_folder() / "history.sqlite3")):
        assert main(["history", "copy", "--to", wrong]) == 2
    assert main(["history", "copy", "--to", url, "--student", "Nobody"]) == 2


def checked(capsys: pytest.CaptureFixture[str]) -> dict[str, object]:
    assert main(["doctor", "--json"]) == 0
    return next(each for each in json.loads(capsys.readouterr().out)["checks"] if each["name"] == "history")


def test_the_doctor_says_where_it_is_and_how(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = data_folder() / "history.sqlite3"
    size = path.stat().st_size
    found = checked(capsys)
    assert found["works"] is True
    assert f"{path}: {size / 1e6:.1f} MB, version 0" in str(found["finding"])
    absent = tmp_path / "absent.sqlite3"
    save_settings(Settings(history=sqlite_url(absent)))
    assert "not there yet" in str(checked(capsys)["finding"])
    assert not absent.exists()
    absent.write_text("no database at all, but a text of some length")
    found = checked(capsys)
    assert (found["works"], str(absent) in str(found["finding"])) == (False, True)
    save_settings(Settings(history="mysql://host/name"))
    found = checked(capsys)
    assert (found["works"], found["remedy"]) == (
        False,
        "mend the setting history, or leave it empty for a file of yours",
    )


def test_the_files_beside_the_history_are_no_place_for_a_backup(capsys: pytest.CaptureFixture[str]) -> None:
    for end in ("-wal", "-shm", "-journal"):
        assert main(["history", "backup", "--out", str(data_folder() / f"history.sqlite3{end}")]) == 2
        assert "belongs to the history itself" in capsys.readouterr().err


def test_what_fails_leaves_no_file_and_names_none_that_is_hidden(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    to = tmp_path / "to.sqlite3"
    assert main(["history", "copy", "--to", sqlite_url(to), "--student", "Nobody"]) == 2
    assert not list(tmp_path.glob("to.sqlite3*"))
    with closing(sqlite3.connect(data_folder() / "history.sqlite3")) as connection:
        connection.execute("DROP TABLE judgements")
    capsys.readouterr()
    assert main(["history", "backup", "--out", str(tmp_path / "backup.sqlite3")]) == 2
    assert ".part" not in capsys.readouterr().err
    assert not list(tmp_path.glob("*backup*"))


def test_a_damaged_file_says_what_to_do(capsys: pytest.CaptureFixture[str]) -> None:
    opening._opened.cache_clear()
    for path in data_folder().glob("history.sqlite3*"):
        path.unlink()
    (data_folder() / "history.sqlite3").write_bytes(b"damaged " * 1000)
    assert main(["history", "list"]) == 2
    assert "put a backup in its place, or move it away" in capsys.readouterr().err
