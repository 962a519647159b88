"""A server that falls silent while a session is kept: frames go on, and what was learnt is known all the same."""

import os
import signal
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest
from sqlalchemy import text

from station.app.history.history_opening import HistoryOpening
from station.app.settings.settings_store import SettingsStore
from station.core.settings import Settings
from station.drills.library import find_lesson
from station.practice.headless.virtual_session import practise_adaptively
from station.practice.history import student_history
from station.practice.history.pending_sessions import is_all_there
from station.practice.history.student_history import AGAIN_S, StudentHistory
from station.practice.records.memory import LevelMemory, Memory, Remembered, remembered
from station.practice.records.report.session_report import practice_document
from station.practice.records.save_session import SessionFolder, SessionRecord, save
from station.practice.session.adaptation import Adaptation
from station.practice.session.plan import PlanOptions
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec
from station.store import memory_rows
from station.store.rows import SessionState
from tests.fakes.postgres_server import PostgresServer
from tests.fakes.work_later import WorkLater

TODAY = date(2026, 3, 1)
ROCK = find_lesson("rock-1")
HOLDS_IT = PlanOptions(tempo_bpm=ROCK.target_tempo_bpm, loops=10, demonstrations=0)
"""Ten passes at the target, two of them blind: who keeps time is judged at the next level from then on."""
SOON_S = 0.2


@pytest.fixture
def settings(postgres: PostgresServer, tmp_path: Path) -> Settings:
    return replace(Settings(), sessions=str(tmp_path / "sessions"), student="Ann", history=postgres.new_database())


@pytest.fixture
def store(settings: Settings, tmp_path: Path) -> SettingsStore:
    store = SettingsStore(tmp_path / "config.toml")
    store.update(lambda _: settings)
    return store


@pytest.fixture
def backend(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """The process of the server that answers this station; it goes on at the end."""
    monkeypatch.setattr(student_history, "HURRY_S", SOON_S)
    monkeypatch.setattr(student_history, "_PATIENT_S", SOON_S / 2)
    history = StudentHistory.of(settings).open()
    with history.database.reading() as connection:
        pid = int(connection.execute(text("SELECT pg_backend_pid()")).scalar_one())
    yield pid
    with suppress(ProcessLookupError):  # it has gone on, and seen that nobody listens any more
        os.kill(pid, signal.SIGCONT)
    history.database.close()


def followed_by(settings: Settings) -> Remembered:
    return Remembered.of(ROCK, HOLDS_IT, TODAY, Memory(StudentHistory.of(settings), ROCK.name, ROCK.loop))


def kept(folder: SessionFolder, followed: Remembered, settings: Settings) -> SessionRecord:
    virtual = practise_adaptively(followed.adaptation, parse_spec("sd_ms=5,seed=1"), folder.capture)
    return save(folder, virtual.result, practice_document(virtual.result, settings), followed)


def test_a_server_that_falls_silent_while_a_session_is_kept(
    settings: Settings, store: SettingsStore, backend: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    worker, now_s = WorkLater(), [1000.0]
    told: list[str] = []
    opening = HistoryOpening(store, told.append, worker, lambda: now_s[0])
    worker.work()
    assert opening.advance() is False
    whose = StudentHistory.of(settings)
    followed = followed_by(settings)
    folder = SessionFolder.make(None, settings, ROCK.name)
    put_level = memory_rows.put_level

    def silently(*words: object) -> None:
        os.kill(backend, signal.SIGSTOP)
        put_level(*words)  # type: ignore[arg-type]

    with monkeypatch.context() as patch:
        patch.setattr(memory_rows, "put_level", silently)
        saved = kept(folder, followed, settings)
    assert saved.fault is None
    assert "the server has not answered" in str(saved.unkept)
    assert (folder.path / "learnt.json").exists()
    assert not is_all_there(whose)

    known = followed.adaptation.state
    assert remembered(whose) == [known]  # the history is left alone, nobody waits for it
    assert LevelMemory(whose).recall() == ({"rock-1": Level.ELEMENTARY}, None)
    again = followed_by(settings)
    assert again.adaptation.state == Adaptation(ROCK, HOLDS_IT, TODAY, known).state
    assert again.adaptation.state != Adaptation(ROCK, HOLDS_IT, TODAY, None).state
    assert (again.fault, again.is_known) == (None, True)
    now_s[0] += AGAIN_S - 1.0
    assert opening.advance() is False
    assert worker.tasks == []

    os.kill(backend, signal.SIGCONT)
    monkeypatch.setattr(student_history, "_left_alone", {})
    now_s[0] += 1.0
    opening.advance()
    worker.work()
    assert opening.advance() is True
    assert told == ["1 session taken into the history"]
    assert [row.name for row in whose.open().sessions("Ann")] == [folder.path.name]
    assert is_all_there(whose)
    assert remembered(whose) == [known]
    assert LevelMemory(whose).recall() == ({"rock-1": Level.ELEMENTARY}, None)


def test_a_session_begins_though_the_server_is_silent(settings: Settings, backend: int) -> None:
    os.kill(backend, signal.SIGSTOP)
    folder = SessionFolder.make(None, settings, ROCK.name)
    assert folder.path.is_dir()
    assert StudentHistory.of(settings).ask(lambda history, student: history.sessions(student)) is None
    os.kill(backend, signal.SIGCONT)
    whose = StudentHistory.of(settings)
    assert whose.open().sessions("Ann", state=SessionState.BEGUN) == []
