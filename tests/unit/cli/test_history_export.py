"""`station history export`: read back by the standard library, and counted by SQL of its own."""

import csv
import io
import json
import os
import resource
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from datetime import datetime
from hashlib import sha256
from pathlib import Path
from zipfile import ZipFile

import pytest

from station.cli.command_line import main
from station.core.settings import Settings, StudentSettings, data_folder, save_settings
from station.practice.history.session_files import student_folder
from station.store.rows import MasteryRow, TeacherNoteRow
from tests.fakes.kept_sessions import kept, on_the_disk, users_history

EXACT = 0.1 + 0.2
TITLES = ("=cmd|' /C calc'!A1", "@SUM(1)", "-2+3", "+1", "\t=1", "'quoted", 'Zoë, "the\nbeat" 🥁', "\u202eשלום")


@pytest.fixture(autouse=True)
def _own_history(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for kind in ("DATA", "CONFIG"):
        monkeypatch.setenv(f"XDG_{kind}_HOME", str(tmp_path / kind))
    monkeypatch.setenv("XDG_DOCUMENTS_DIR", str(tmp_path / "documents"))


@pytest.fixture
def ann() -> Path:
    """Ann's sessions with hostile titles, what is known of her, her folder; and something of Ben's."""
    history = users_history()
    session = kept("Ann", datetime(2026, 11, 23, 18, 30), mean_ms=EXACT)
    folder = on_the_disk(session).parent
    known = [MasteryRow("rock-1", 0, 3, '{"ease": 2.5}')]
    history.keep(session, known, {"rock-1": "advanced", "=cmd()": "beginner"})
    for second, title in enumerate(TITLES):
        history.keep(kept("Ann", datetime(2026, 11, 24, 18, 0, second), title=title, device=title))
    history.keep(kept("Ben", datetime(2026, 11, 24, 18, 0)), levels={"rock-1": "beginner"})
    note = TeacherNoteRow("ab" * 16, "a1", "Week 1", "=Carla", datetime(2026, 5, 5, 9), "Good.", "Slower", b"\0file")
    history.keep_note("Ann", note)
    (folder / "book").mkdir()
    (folder / "book" / "2026-11-23.json").write_bytes(b'{"line": "fine"}')
    save_settings(Settings(student="Ben", students=(StudentSettings("Ann", "left", "first-beats"),)))
    return folder


def table(data: bytes) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(data.decode("utf-8-sig"), newline="")))


def plain(field: str) -> str:
    """As README.txt tells: an apostrophe in front is no part of the text."""
    return field[1:] if field.startswith("'") else field


def counted(what: str, student: str) -> int:
    """By SQL of our own."""
    with closing(sqlite3.connect(data_folder() / "history.sqlite3")) as connection:
        key = connection.execute("SELECT id FROM students WHERE name = ?", [student]).fetchone()
        sql = f"SELECT count(*) FROM {what} WHERE "
        owner = (
            "student_id = ?"
            if what in ("sessions", "levels")
            else "session_id IN (SELECT id FROM sessions WHERE student_id = ?)"
        )
        return int(connection.execute(sql + owner, key).fetchone()[0])


def test_all_that_is_a_students_own_is_read_back(ann: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.zip"
    assert main(["history", "export", "--student", "Ann", "--out", str(out)]) == 0
    with ZipFile(out) as archive:
        assert archive.testzip() is None
        files = {name: archive.read(name) for name in archive.namelist()}
    sessions = table(files["sessions.csv"])
    assert len(sessions) == counted("sessions", "Ann") == 1 + len(TITLES)
    assert [plain(row["title"]) for row in sessions[1:]] == list(TITLES)
    assert float(sessions[0]["mean_ms"]) == EXACT
    assert {row["student"] for row in sessions} == {"Ann"}
    judgements, figures = table(files["judgements.csv"]), table(files["figures.csv"])
    assert len(judgements) == counted("judgements", "Ann")
    assert len(figures) == counted("figures", "Ann")
    assert (judgements[0]["hit_velocity"], judgements[0]["hit_openness"], judgements[1]["hit_time_s"]) == (
        "64.25",
        "",
        "",
    )
    assert float(figures[0]["mean_ms"]) == -3.5
    assert [(plain(row["lesson"]), row["level"]) for row in table(files["levels.csv"])] == [
        ("=cmd()", "beginner"),
        ("rock-1", "advanced"),
    ]
    assert json.loads(files["mastery.json"])["lessons"] == [
        {"lesson": "rock-1", "bars": [1, 4], "known": {"ease": 2.5}}
    ]
    assert json.loads(files["notes.json"])["notes"][0]["teacher"] == "=Carla"
    assert files[f"notes/{'ab' * 16}.drum-note"] == b"\0file"
    assert json.loads(files["settings.json"])["settings"] == [{"name": "Ann", "hands": "left", "course": "first-beats"}]
    captures = {name: data for name, data in files.items() if name.startswith("captures/")}
    assert set(captures) == {f"captures/{row['capture_sha256']}.capture" for row in sessions}
    assert all(name == f"captures/{sha256(data).hexdigest()}.capture" for name, data in captures.items())
    assert files[f"documents/{sessions[0]['number']}/report.json"] == b'{"student": "Ann"}'
    there = {
        f"files/{path.relative_to(ann).as_posix()}": path.read_bytes() for path in ann.rglob("*") if path.is_file()
    }
    assert {name: data for name, data in files.items() if name.startswith("files/")} == there
    assert not any(b"Ben" in data for data in files.values())


def test_no_field_is_a_formula_and_every_column_is_explained(ann: Path, tmp_path: Path) -> None:
    out = tmp_path / "new" / "out"
    assert main(["history", "export", "--student", "Ann", "--out", str(out)]) == 0
    readme = (out / "README.txt").read_text(encoding="utf-8")
    tables = sorted(out.glob("*.csv"))
    assert len(tables) == 4
    for path in tables:
        rows = list(csv.reader(io.StringIO(path.read_bytes().decode("utf-8-sig"), newline="")))
        section = readme.partition(f"\n{path.name}: ")[2].partition("\n\n")[0]
        assert [line.split()[0] for line in section.splitlines()[1:]] == rows[0]
        for field in (field for row in rows[1:] for field in row if field.startswith(tuple("=+-@\t\r"))):
            float(field)  # a negative number, and nothing else


@pytest.mark.parametrize("name", ["out", "out.zip"])
def test_what_lies_there_stays(name: str, ann: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / name
    words = ["history", "export", "--student", "Ann", "--out", str(out)]
    assert main(words) == 0
    before = {path: path.read_bytes() for path in [out, *out.rglob("*")] if path.is_file()}
    assert main(words) == 2
    assert "is there already" in capsys.readouterr().err
    assert {path: path.read_bytes() for path in [out, *out.rglob("*")] if path.is_file()} == before
    assert main([*words[:-1], str(ann / name)]) == 2
    assert main(["history", "export", "--student", "Nobody", "--out", str(tmp_path / "new.zip")]) == 2
    assert not (tmp_path / "new.zip").exists()


@pytest.mark.parametrize("name", ["out", "out.zip"])
def test_it_is_written_whole_or_not_at_all(
    name: str, ann: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (ann / "large.bin").write_bytes(os.urandom(1_000_000))
    before = sorted(tmp_path.iterdir())
    with _at_most(300_000):
        assert main(["history", "export", "--student", "Ann", "--out", str(tmp_path / name)]) == 2
    assert "cannot be written" in capsys.readouterr().err
    assert sorted(tmp_path.iterdir()) == before


@contextmanager
def _at_most(size: int) -> Iterator[None]:
    """No file of this process grows beyond `size` bytes, as on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_no_link_is_followed_out_of_the_folder(ann: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    secret = tmp_path / "secret"
    secret.mkdir()
    (secret / "key").write_text("not Ann's")
    (ann / "way-out").symlink_to(secret)
    (ann / "key").symlink_to(secret / "key")
    out = tmp_path / "out"
    assert main(["history", "export", "--student", "Ann", "--out", str(out)]) == 0
    assert not any(path.is_file() and b"not Ann's" in path.read_bytes() for path in out.rglob("*"))
    assert capsys.readouterr().err.count("left out") == 2
    assert student_folder(Settings().sessions_dir, "Ann") == ann


@pytest.mark.parametrize("name", ["../../etc", "<script>x</script>", "=cmd()", "y" * 200, "\u202eevil", "🥁"])
def test_any_name_can_take_its_own_away(name: str, tmp_path: Path) -> None:
    on_the_disk(kept(name, datetime(2026, 11, 24, 18, 0), lesson=name))
    users_history().keep(kept(name, datetime(2026, 11, 24, 18, 0), lesson=name))
    assert main(["history", "export", "--student", name, "--out", str(tmp_path / "out.zip")]) == 0
    with ZipFile(tmp_path / "out.zip") as archive:
        assert not any(part in ("..", "") for entry in archive.namelist() for part in entry.split("/"))
        rows = table(archive.read("sessions.csv"))
    assert [(plain(row["student"]), plain(row["lesson"])) for row in rows] == [(name, name)]


def test_nothing_is_taken_into_another_students_folder(ann: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = ann.parent / "Ben" / "ann.zip"
    assert main(["history", "export", "--student", "Ann", "--out", str(out)]) == 2
    assert "lies in a student's folder" in capsys.readouterr().err
    assert not out.exists()
