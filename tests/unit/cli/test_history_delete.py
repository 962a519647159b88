"""`station history delete`: nothing of a student is left, not in the bytes of the file either; all of others is."""

import os
import shutil
import sqlite3
import subprocess
from collections.abc import Iterator
from contextlib import closing, contextmanager
from datetime import datetime
from io import StringIO
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.cli.history_verbs import delete_student
from station.core.settings import Settings, StudentSettings, data_folder, load_settings, save_settings
from station.devices.capture.capture_writer import CaptureFile
from station.practice.history.session_files import student_folder
from station.store import sqlite_files
from station.store.rows import MasteryRow, SessionRow, SessionState, TeacherNoteRow
from tests.fakes.kept_sessions import kept, on_the_disk, users_history

HOSTILE = ("../../etc", "<script>x</script>", "=cmd()", "z" * 200, "\u202eevil שלום", "🥁 drum")
DAY = datetime(2026, 11, 24, 18, 0)


@pytest.fixture(autouse=True)
def _own_history(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for kind in ("DATA", "CONFIG"):
        monkeypatch.setenv(f"XDG_{kind}_HOME", str(tmp_path / kind))
    monkeypatch.setenv("XDG_DOCUMENTS_DIR", str(tmp_path / "documents"))


def keep_all_of(student: str, lesson: str) -> Path:
    """Something of every kind; the student's folder."""
    history = users_history()
    for hour in range(3):
        session = kept(student, DAY.replace(hour=hour), lesson, title=f"Title of {lesson}")
        on_the_disk(session)
        history.keep(session, [MasteryRow(lesson, 0, hour, f'{{"of": "{lesson}"}}')], {lesson: "beginner"})
    note = TeacherNoteRow(f"{student} n", "a1", lesson, "Carla", DAY, f"Well done, {student}.", "Slower", b"file")
    history.keep_note(student, note)
    return student_folder(load_settings().sessions_dir, student)


def rows() -> list[tuple[object, ...]]:
    """All that the database holds, by SQL of our own."""
    with closing(sqlite3.connect(data_folder() / "history.sqlite3")) as connection:
        tables = [name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        return [(table, *row) for table in tables for row in connection.execute(f"SELECT * FROM {table}")]


def bytes_below(*folders: Path) -> bytes:
    paths = [path for folder in folders for path in folder.rglob("*")]
    names = "\n".join(str(path) for path in paths).encode()
    return names + b"\n".join(path.read_bytes() for path in paths if path.is_file())


@pytest.mark.parametrize("name", ["Ann", *HOSTILE])
def test_nothing_of_them_is_left_and_all_of_others_is(name: str, tmp_path: Path) -> None:
    lesson = f"groove of {name}"
    bens = keep_all_of("Ben", "rock-1")
    before, folder_before = rows(), bytes_below(bens)
    theirs = keep_all_of(name, lesson)
    save_settings(
        Settings(student=name, hands="left", students=(StudentSettings("Ben", "right", "first-beats"),)),
    )
    assert main(["history", "delete", "--student", name, "--yes"]) == 0
    assert not theirs.exists()
    assert rows() == before
    assert bytes_below(bens) == folder_before
    left = bytes_below(tmp_path)
    for trace in (name, lesson, f"Title of {lesson}", f"Well done, {name}."):
        assert trace.encode() not in left
    settings = load_settings()
    assert (settings.student, settings.hands, settings.course) == ("Ben", "right", "first-beats")
    assert main(["history", "delete", "--student", name, "--yes"]) == 2


def test_it_says_what_goes_and_what_stays_and_asks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = keep_all_of("Ann", "rock-1")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    users_history().keep(kept("Ann", DAY, folder=str(elsewhere)))
    returns = folder.parent / "returns" / "Class 5" / "Ann"
    returns.mkdir(parents=True)
    copy = tmp_path / "backup.sqlite3"
    assert main(["history", "backup", "--out", str(copy)]) == 0
    words = ["history", "delete", "--student", "Ann"]
    assert main(words) == 2
    told = capsys.readouterr().err
    for fact in (
        "4 sessions with their judgements",
        "what is known of 1 lesson, 1 note of teachers",
        f"the folder {folder}: 6 files",
        f"{elsewhere}, where",
        f"{copy}, an older copy",
        f"{returns}, returns that a teacher keeps here",
        "returns that were sent",
        "say --yes",
    ):
        assert fact in told
    monkeypatch.setattr(delete_student, "is_attended", lambda: True)
    for answer, status in (("ann", 2), ("", 2), ("Ann", 0)):
        assert folder.is_dir()
        monkeypatch.setattr("sys.stdin", StringIO(f"{answer}\n"))
        assert main(words) == status
    assert not folder.exists()
    assert elsewhere.is_dir()
    assert returns.is_dir()


def test_another_name_is_asked_back_and_another_spelling_is_the_student(capsys: pytest.CaptureFixture[str]) -> None:
    folder = keep_all_of("Ann", "rock-1")
    keep_all_of("z" * 300, "rock-1")
    for name in ("../Ann", "Anna", "."):
        assert main(["history", "delete", "--student", name, "--yes"]) == 2
        told = capsys.readouterr().err
        assert "no such student; did you mean Ann?" in told or name == "."
        assert "zzz" not in told
    assert folder.is_dir()
    assert len(users_history().sessions("Ann")) == 3
    assert main(["history", "delete", "--student", "ann", "--yes"]) == 0
    assert "This deletes all of Ann" in capsys.readouterr().err
    assert not folder.exists()


def test_links_are_never_followed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "precious").write_text("stays")
    ann, zoe = keep_all_of("Ann", "rock-1"), keep_all_of("Zoë", "rock-1")
    (ann / "way-out").symlink_to(outside)
    (ann / "precious").symlink_to(outside / "precious")
    moved = zoe.rename(tmp_path / "moved")
    zoe.symlink_to(moved)
    for name in ("Ann", "Zoë"):
        assert main(["history", "delete", "--student", name, "--yes"]) == 0
    assert (outside / "precious").read_text() == "stays"
    assert not ann.exists()
    assert not zoe.is_symlink()
    assert len(list(moved.iterdir())) == 3
    assert f"{moved}, to which the folder's link leads" in capsys.readouterr().err


@contextmanager
def _no_file_leaves(folder: Path) -> Iterator[None]:
    """Nothing in it can be deleted: by its mode, and where root runs the tests by what the file system keeps."""
    if os.geteuid() != 0:
        folder.chmod(0o500)
    elif shutil.which("chattr") is None or subprocess.run(["chattr", "+i", folder], check=False).returncode:
        pytest.skip("root may delete everything here")
    try:
        yield
    finally:
        if os.geteuid() == 0:
            subprocess.run(["chattr", "-i", folder], check=True)
        else:
            folder.chmod(0o700)


def test_what_cannot_be_deleted_from_the_folder_keeps_the_history(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = keep_all_of("Ann", "rock-1")
    stays = sorted(folder.iterdir())[0]
    with _no_file_leaves(stays):
        assert main(["history", "delete", "--student", "Ann", "--yes"]) == 2
        told = capsys.readouterr().err
        assert "2 files could not be deleted, and the history stays" in told
        assert "session.capture" in told
        assert [path.name for path in folder.iterdir()] == [stays.name]
        assert len(users_history().sessions("Ann")) == 3
    assert main(["history", "delete", "--student", "Ann", "--yes"]) == 0
    assert not folder.exists()


def test_a_failure_in_the_middle_says_what_is_left_and_can_be_run_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = keep_all_of("Ann", "rock-1")
    settings = save_settings(Settings(student="Ann"))
    words = ["history", "delete", "--student", "Ann", "--yes"]
    with _no_file_leaves(settings.parent):
        assert main(words) == 2
    assert "folder and history are deleted, but the name stays in the settings" in capsys.readouterr().err
    assert not folder.exists()
    assert users_history().students() == []
    assert main(words) == 0
    assert b"Ann" not in settings.read_bytes()


def test_settings_that_are_wrong_delete_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    folder = keep_all_of("Ann", "rock-1")
    settings = save_settings(Settings(student="Ann"))
    settings.write_text("hysteria = 1\n")
    assert main(["history", "delete", "--student", "Ann", "--yes"]) == 2
    assert "no such setting: hysteria" in capsys.readouterr().err
    settings.unlink()
    assert folder.is_dir()
    assert len(users_history().sessions("Ann")) == 3


def test_a_history_that_another_program_holds_keeps_the_folder(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = keep_all_of("Ann", "rock-1")
    monkeypatch.setattr(sqlite_files, "PATIENCE_S", 0.01)
    with closing(sqlite3.connect(data_folder() / "history.sqlite3", isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        assert main(["history", "delete", "--student", "Ann", "--yes"]) == 2
        other.execute("ROLLBACK")
    assert "locked" in capsys.readouterr().err
    assert len(list(folder.iterdir())) == 3
    assert main(["history", "delete", "--student", "Ann", "--yes"]) == 0
    assert not folder.exists()


def test_who_plays_right_now_is_not_deleted(capsys: pytest.CaptureFixture[str]) -> None:
    folder = keep_all_of("Ann", "rock-1")
    running = folder / "2026-11-24T19-00-00_rock-1"
    users_history().begin(SessionRow("Ann", running.name, DAY, str(running), state=SessionState.BEGUN))
    capture = CaptureFile(running / "session.capture", 0)
    assert main(["history", "delete", "--student", "Ann", "--yes"]) == 2
    assert f"{running}: this session runs in another program right now" in capsys.readouterr().err
    assert len(list(folder.iterdir())) == 4
    capture.close(1)
    assert main(["history", "delete", "--student", "Ann", "--yes"]) == 0
    assert not folder.exists()


def test_a_folder_in_another_spelling_goes_too() -> None:
    folder = keep_all_of("Ann", "rock-1")
    other = shutil.copytree(folder, folder.with_name("ann"))
    assert main(["history", "delete", "--student", "Ann", "--yes"]) == 0
    assert not folder.exists()
    assert not other.exists()
    assert main(["history", "list", "--student", "Ann"]) == 2, "nobody comes back"
    assert users_history().students() == []
