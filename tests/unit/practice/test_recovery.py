"""Sessions that were cut off: what is found, what is offered, and what their captures give again.

The expected figures are those of the report that the session itself left.
"""

import json
import shutil
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.core.settings import Settings
from station.devices.capture.capture import RecordKind, read_capture
from station.practice.history.session_files import CAPTURE_NAME, DOCUMENT_NAME
from station.practice.history.student_history import StudentHistory
from station.practice.records.recovery import cut_off, offer
from station.practice.records.save_session import SessionFolder
from station.store.rows import SessionState
from tests.fakes.captures import capture_bytes
from tests.fakes.known_students import one_student, take_all_in

STUDENT = "seed=4,bias_ms=-6,sd_ms=14,miss_pct=4,extra_pct=4,wrong_piece_pct=3"


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody's own settings or sessions are touched."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("HOME", str(tmp_path))


def practised(folder: Path, *words: str) -> dict[str, dict[str, object]]:
    """A whole session that loses its report; returns the report."""
    virtual = ["--headless", "--virtual-student", STUDENT, "--loops", "3", "--no-pictures", "--report", str(folder)]
    assert main(["practice", "rock-fill-1", *virtual, *words]) == 0
    report: dict[str, dict[str, object]] = json.loads((folder / DOCUMENT_NAME).read_text())
    for path in folder.iterdir():
        if path.name != CAPTURE_NAME:
            path.unlink()
    return report


@pytest.mark.parametrize("words", [(), ("--adapt",), ("--no-click",)])
def test_a_capture_gives_the_report_that_the_session_would_have_left(words: tuple[str, ...], tmp_path: Path) -> None:
    report = practised(tmp_path / "x", *words)
    assert main(["practice", "--recover", str(tmp_path / "x"), "--no-pictures"]) == 0
    again = json.loads((tmp_path / "x" / DOCUMENT_NAME).read_text())
    for key in ("score", "counts", "timing"):
        assert again[key] == report[key]
    for key in ("lesson", "title", "tempo_bpm", "bars", "passes", "complete", "pauses", "latency"):
        assert again["session"][key] == report["session"][key]
    assert {path.name for path in (tmp_path / "x").iterdir()} == {
        CAPTURE_NAME,
        DOCUMENT_NAME,
        "report.txt",
        "pairs.csv",
    }


def test_what_was_cut_off_in_mid_session_is_judged_until_there(tmp_path: Path) -> None:
    report = practised(tmp_path / "x")
    capture = tmp_path / "x" / CAPTURE_NAME
    data = capture.read_bytes()
    capture.write_bytes(data[: len(data) * 2 // 3])
    assert main(["practice", "--recover", str(tmp_path / "x"), "--no-pictures"]) == 0
    again = json.loads((tmp_path / "x" / DOCUMENT_NAME).read_text())
    assert again["session"]["complete"] is False
    assert 0 < again["counts"]["hits"] < int(str(report["counts"]["hits"]))


def test_the_newest_is_offered_until_it_is_judged(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    settings = Settings(sessions=str(tmp_path / "all"), student="Ann")
    student = tmp_path / "all" / "Ann"
    assert offer(settings) is None
    whose = StudentHistory.of(settings)
    old, new = (student / f"2026-03-0{day}T10-00-00_rock-fill-1" for day in (1, 2))
    old.parent.mkdir(parents=True)
    practised(old)
    shutil.copytree(old, new)
    take_all_in(whose)
    assert cut_off(whose) == [new, old]
    command = f"station practice --recover {new}"
    assert (
        offer(settings) == f"a session was cut off before it was judged: {new.name} (and 1 more); {command} judges it"
    )
    assert main(["practice", "--recover", str(new), "--no-pictures"]) == 0
    assert cut_off(whose) == [old]
    assert main(["practice", "--recover", str(new), "--no-pictures"]) == 2
    assert "this session has its report" in capsys.readouterr().err


def test_nothing_is_offered_where_nothing_was_played(tmp_path: Path) -> None:
    """Captures that were begun and never played to, cannot be read, or are free takes."""
    whole = practised(tmp_path / "x")
    assert whole
    records = read_capture(tmp_path / "x" / CAPTURE_NAME).records
    silent = capture_bytes(record for record in records if record.kind != RecordKind.BYTES)
    free = capture_bytes(record for record in records if record.kind != RecordKind.ANNOTATION)
    whose = one_student(tmp_path / "all", "Ann")
    for day, data in enumerate((silent, free, b"not a capture"), 1):
        (whose.folder / f"2026-03-0{day}T10-00-00_rock-1").mkdir(parents=True)
        (whose.folder / f"2026-03-0{day}T10-00-00_rock-1" / CAPTURE_NAME).write_bytes(data)
    take_all_in(whose)
    assert len(whose.open().sessions("Ann", state=SessionState.BEGUN)) == 3
    assert cut_off(whose) == []


def test_one_that_the_user_kept_elsewhere_is_offered_too(tmp_path: Path) -> None:
    settings = Settings(sessions=str(tmp_path / "all"), student="Ann")
    practised(tmp_path / "x")
    folder = SessionFolder.make(tmp_path / "there", settings, "rock-fill-1")
    assert cut_off(folder.whose) == [], "nothing was struck yet"
    shutil.copy(tmp_path / "x" / CAPTURE_NAME, folder.capture)
    assert cut_off(folder.whose) == [tmp_path / "there"]
    shutil.copy(tmp_path / "x" / CAPTURE_NAME, tmp_path / "there" / DOCUMENT_NAME)
    assert cut_off(folder.whose) == [], "it has its report"


def test_a_session_in_which_nothing_was_played_is_forgotten(tmp_path: Path) -> None:
    settings = Settings(sessions=str(tmp_path / "all"), student="Ann")
    with SessionFolder.make(None, settings, "rock-1") as folder:
        history = folder.whose.open()
        assert [row.lesson for row in history.sessions("Ann", state=SessionState.BEGUN)] == ["rock-1"]
    assert history.sessions("Ann", state=SessionState.BEGUN) == []
    assert not folder.path.exists()


def test_a_folder_without_a_session_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["practice", "--recover", str(tmp_path)]) == 2
    assert f"{tmp_path}: no session was begun in this folder" in capsys.readouterr().err
