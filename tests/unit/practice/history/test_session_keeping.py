"""A session from its begin to its end in the history, and what becomes of it where the history is away."""

import json
from dataclasses import replace
from datetime import date
from itertools import count
from pathlib import Path
from types import SimpleNamespace

import pytest

from station.core.settings import Settings
from station.drills.library import find_lesson
from station.practice.headless.virtual_session import practise_adaptively
from station.practice.history import student_history
from station.practice.history.student_history import StudentHistory
from station.practice.own_data.catching_up import catch_up
from station.practice.records.memory import LevelMemory, Memory, Remembered, remembered
from station.practice.records.report.session_report import practice_document
from station.practice.records.save_session import SessionFolder, SessionRecord, save
from station.practice.session.plan import PlanOptions
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec
from station.store import memory_rows
from station.store.history import History
from station.store.rows import SessionState

TODAY = date(2026, 3, 1)
ROCK = find_lesson("rock-1")
HOLDS_IT = PlanOptions(tempo_bpm=ROCK.target_tempo_bpm, loops=10, demonstrations=0)
"""Ten passes at the target, two of them blind: who keeps time is judged at the next level from then on."""


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return replace(Settings(), sessions=str(tmp_path / "sessions"), student="Ann")


@pytest.fixture
def away(settings: Settings, tmp_path: Path) -> Settings:
    """Settings whose history cannot be reached."""
    (tmp_path / "plain-file").touch()
    return replace(settings, history=f"sqlite:///{tmp_path}/plain-file/history")


def practised(
    settings: Settings, options: PlanOptions = HOLDS_IT, wanted: Path | None = None
) -> tuple[SessionFolder, Remembered, SessionRecord]:
    """A session that followed the student, from its begin to its end."""
    whose = StudentHistory.of(settings)
    followed = Remembered.of(ROCK, options, TODAY, Memory(whose, ROCK.name, ROCK.loop))
    folder = SessionFolder.make(wanted, settings, ROCK.name)
    virtual = practise_adaptively(followed.adaptation, parse_spec("sd_ms=5,seed=1"), folder.capture)
    saved = save(folder, virtual.result, practice_document(virtual.result, settings), followed)
    return folder, followed, saved


def test_a_session_is_kept_with_what_was_learnt_in_it(settings: Settings) -> None:
    folder, followed, saved = practised(settings)
    assert (saved.fault, saved.unkept) == (None, None)
    whose = StudentHistory.of(settings)
    [row] = whose.open().sessions("Ann")
    assert (row.name, row.folder) == (folder.path.name, str(folder.path))
    assert whose.open().sessions("Ann", state=SessionState.BEGUN) == []
    assert remembered(whose) == [followed.adaptation.state]
    assert LevelMemory(whose).recall() == ({"rock-1": Level.ELEMENTARY}, None)
    assert not (folder.path / "learnt.json").exists()


def test_a_session_and_what_was_learnt_are_kept_together_or_not_at_all(
    settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:

        def refused(*_: object) -> None:
            raise OSError(28, "No space left on device")

        patch.setattr(memory_rows, "put_level", refused)
        folder, followed, saved = practised(settings)
    assert "No space left" in str(saved.unkept)
    assert str(folder.path) in str(saved.unkept)
    whose = StudentHistory.of(settings)
    assert whose.open().sessions("Ann") == []
    assert whose.open().mastery("Ann") == []
    assert remembered(whose) == [followed.adaptation.state]  # in this program, for the next step
    assert catch_up(settings, list[str]().append) == 1
    assert [row.name for row in whose.open().sessions("Ann")] == [folder.path.name]
    assert remembered(whose) == [followed.adaptation.state]


def test_what_the_history_learns_later_is_newer_than_what_has_not_arrived(
    settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:

        def refused(*_: object) -> None:
            raise OSError(28, "No space left on device")

        patch.setattr(memory_rows, "put_level", refused)
        practised(settings)
    whose = StudentHistory.of(settings)
    assert LevelMemory(whose).recall()[0] == {"rock-1": Level.ELEMENTARY}
    _, later, saved = practised(settings, replace(HOLDS_IT, loops=1))
    assert saved.unkept is None
    assert remembered(whose) == [later.adaptation.state]
    LevelMemory(whose).keep("rock-1", Level.BEGINNER)
    assert LevelMemory(whose).recall()[0] == {"rock-1": Level.BEGINNER}


def test_what_was_learnt_while_the_history_was_away_is_remembered_later(settings: Settings, away: Settings) -> None:
    folder, followed, saved = practised(away)
    assert followed.fault is not None
    assert saved.fault is None
    assert "another day" in str(saved.unkept)
    assert json.loads((folder.path / "learnt.json").read_text())["on_top"] is False
    told: list[str] = []
    assert catch_up(settings, told.append) == 1
    assert told == ["1 session taken into the history"]
    whose = StudentHistory.of(settings)
    assert remembered(whose) == [followed.adaptation.state]
    assert LevelMemory(whose).recall()[0] == {"rock-1": Level.ELEMENTARY}


def test_a_folder_elsewhere_is_taken_in_once_the_history_is_back(
    settings: Settings, away: Settings, tmp_path: Path
) -> None:
    _, followed, _ = practised(away, replace(HOLDS_IT, loops=1), tmp_path / "elsewhere")
    whose = StudentHistory.of(settings)
    assert [path.name for path in whose.folder.iterdir()] == ["kept-elsewhere.json"]
    assert catch_up(settings, list[str]().append) == 1
    assert [row.folder for row in whose.open().sessions("Ann")] == [str(tmp_path / "elsewhere")]
    assert remembered(whose) == [followed.adaptation.state]
    assert list(whose.folder.iterdir()) == []
    assert catch_up(settings, pytest.fail) == 0


def test_what_was_known_all_the_while_outlives_what_was_learnt_on_top_of_nothing(
    settings: Settings, away: Settings
) -> None:
    _, known, _ = practised(settings)
    practised(away, replace(HOLDS_IT, loops=1))
    assert catch_up(settings, list[str]().append) == 1
    whose = StudentHistory.of(settings)
    assert len(whose.open().sessions("Ann")) == 2
    assert remembered(whose) == [known.adaptation.state]


def test_a_report_that_is_written_anew_is_taken_in_again(settings: Settings) -> None:
    folder, _, saved = practised(settings)
    folder.write(saved.result, {**saved.document, "score": 1.5})
    assert folder.keep() is None
    assert [row.score for row in StudentHistory.of(settings).open().sessions("Ann")] == [1.5]


def test_a_history_that_makes_wait_in_vain_is_asked_once(
    settings: Settings, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By a clock of our own every question takes three seconds."""
    asked: list[str] = []
    clock = count(0.0, 3.0)
    monkeypatch.setattr(student_history, "time", SimpleNamespace(monotonic=lambda: next(clock)))

    def question(history: History, student: str) -> None:
        asked.append(student)
        with history.database.refusals():
            raise TimeoutError(110, "Connection timed out")

    whose = StudentHistory.of(replace(settings, history=f"sqlite:///{tmp_path}/slow.sqlite3"))
    assert whose.ask(question) is None
    assert whose.ask(question) is None
    assert asked == ["Ann"]
