"""What an opening history finds besides new sessions: notes of before, folders that were moved or are gone."""

import os
from dataclasses import replace
from datetime import datetime, timedelta
from pathlib import Path

import pytest

from station.core.settings import Settings
from station.devices.capture.capture import CaptureRecord, RecordKind
from station.practice.exchange.note_file import note_bytes
from station.practice.history import moved_folders
from station.practice.history.moved_folders import FORGOTTEN_AFTER, forget_gone
from station.practice.history.session_keeping import begin_session
from station.practice.history.student_history import StudentHistory
from station.practice.own_data.catching_up import catch_up
from station.practice.records.recovery import cut_off
from station.store.rows import KeptSession, SessionKind, SessionRow, SessionState
from tests.fakes.captures import capture_bytes
from tests.parcels_made import NOTE

NOW = datetime(2026, 3, 31, 12, 0, 0)


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return replace(Settings(), sessions=str(tmp_path / "sessions"), student="Zoë")


def written(path: Path, data: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def test_notes_from_before_there_was_a_history_come_in_once(settings: Settings) -> None:
    whose = StudentHistory.of(settings)
    folder = whose.folder / "assignments" / "week-3_0123" / "notes"
    written(folder / f"{NOTE.id}.drum-note", note_bytes(NOTE))
    written(folder / "torn.drum-note", note_bytes(NOTE)[:50])
    for _ in range(2):
        assert catch_up(settings, pytest.fail) == 0
        [row] = whose.open().notes("Zoë")
    assert (row.note, row.teacher, row.words, row.next) == (NOTE.id, "Ms Okafor", "Well done.", "the same at 100")
    assert row.body == note_bytes(NOTE)


def began(settings: Settings, day: int) -> Path:
    """The folder of a session that was begun on a day of March."""
    folder = StudentHistory.of(settings).folder / f"2026-03-{day:02}T18-30-05_rock-1"
    folder.mkdir(parents=True)
    begin_session(StudentHistory.of(settings), folder, SessionKind.LESSON, "rock-1")
    return folder


def kept_elsewhere(settings: Settings, folder: Path) -> None:
    """A session in a folder that the user named, which is not there any more."""
    row = SessionRow("Zoë", "2026-02-01T10-00-00_named-0000abcd", datetime(2026, 2, 1, 10), str(folder))
    StudentHistory.of(settings).open().keep(KeptSession(row))


@pytest.mark.parametrize("is_copied", [False, True])
def test_rows_follow_a_folder_of_all_sessions(
    is_copied: bool, settings: Settings, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whose = StudentHistory.of(settings)
    old = [began(settings, day) for day in (1, 2, 3)]
    history = whose.open()
    kept_elsewhere(settings, tmp_path / "named")
    history.keep(KeptSession(SessionRow("Zoë", old[0].name, datetime(2026, 3, 1, 18, 30, 5), str(old[0]))))
    moved = replace(settings, sessions=str(tmp_path / "disk" / "drums"))
    if is_copied:
        for folder in (StudentHistory.of(moved).folder / each.name for each in old):
            folder.mkdir(parents=True)
    else:
        Path(moved.sessions).parent.mkdir()
        Path(settings.sessions).rename(moved.sessions)
    assert catch_up(moved, pytest.fail) == 0
    home = whose.folder if is_copied else StudentHistory.of(moved).folder
    rows = {row.name: row.folder for row in history.sessions("Zoë")}
    assert rows[old[0].name] == str(home / old[0].name)
    assert rows["2026-02-01T10-00-00_named-0000abcd"] == str(tmp_path / "named")
    begun = [row.folder for row in history.sessions("Zoë", state=SessionState.BEGUN)]
    assert begun == [str(home / each.name) for each in old[1:]]
    if not is_copied:
        with monkeypatch.context() as patch:  # whose rows are right has no folder looked for
            patch.setattr(os.path, "isdir", pytest.fail)
            assert moved_folders.follow_moved(history, StudentHistory.of(moved).folder, "Zoë") == 0


def test_what_was_cut_off_is_offered_where_it_lies_now(settings: Settings, tmp_path: Path) -> None:
    folder = began(settings, 1)
    records = (CaptureRecord(kind, 0, 1, b"{}") for kind in (RecordKind.ANNOTATION, RecordKind.BYTES))
    (folder / "session.capture").write_bytes(capture_bytes(records))
    moved = replace(settings, sessions=str(tmp_path / "drums"))
    Path(settings.sessions).rename(moved.sessions)
    catch_up(moved, pytest.fail)
    assert cut_off(StudentHistory.of(moved)) == [StudentHistory.of(moved).folder / folder.name]


def test_what_was_begun_long_ago_and_is_gone_is_forgotten(settings: Settings) -> None:
    history = StudentHistory.of(settings).open()
    long_ago, there, lately = (began(settings, day) for day in (1, 2, 20))
    long_ago.rmdir()
    lately.rmdir()

    def begun() -> list[str]:
        return [row.name for row in history.sessions("Zoë", state=SessionState.BEGUN)]

    forget_gone(history, "Zoë", datetime(2026, 3, 1, 18, 30, 5) + FORGOTTEN_AFTER)
    assert begun() == [long_ago.name, there.name, lately.name]
    forget_gone(history, "Zoë", NOW + timedelta(hours=7))
    assert begun() == [there.name, lately.name]
