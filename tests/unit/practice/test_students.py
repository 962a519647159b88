"""Who is known here, which names stay apart, and what no student may be called by folder."""

import json
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest

from station.core.settings import Settings
from station.drills.library import find_lesson
from station.drills.mastery.mastery_json import document_of
from station.drills.mastery.next_pass import new_item
from station.drills.mastery.practice_steps import item_of
from station.practice.history.session_files import OWN_FOLDERS, student_folder, write_document
from station.practice.own_data.catching_up import catch_up
from station.practice.records.students import KnownStudent, known_students, sharing

STATE = new_item(item_of(find_lesson("rock-1")), date(2026, 3, 1))


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return replace(Settings(), sessions=str(tmp_path / "sessions"), student="Cem")


def played(sessions: Path, folder: str, session: str, name: str | None = None) -> None:
    path = sessions / folder / session
    path.mkdir(parents=True)
    if name is not None:
        told = {"student": name, "lesson": "rock-1"}
        (path / "report.json").write_text(json.dumps({"session": told}))


def test_who_is_named_comes_first_then_who_played_last(settings: Settings) -> None:
    sessions = settings.sessions_dir
    played(sessions, "Zoe", "2026-03-02T10-00-00_rock-1", "Zoe")
    played(sessions, "Ann-Lee", "2026-03-05T10-00-00_rock-1", "Ann Lee")
    played(sessions, "Bea", "2026-03-09T10-00-00_rock-1", "somebody else's name")
    write_document(sessions / "Dan" / "mastery" / "rock-1_1-2.json", document_of(STATE))
    for other in (*OWN_FOLDERS, "holiday pictures"):
        (sessions / other / "2026").mkdir(parents=True)
    (sessions / "settings.toml").touch()
    assert known_students(settings, ["Cem", "Zoe"]) == (KnownStudent("Cem"), KnownStudent("Zoe"))
    told: list[str] = []
    assert catch_up(settings, told.append) == 3
    assert told == ["3 sessions taken into the history"]
    assert known_students(settings, ["Cem", "Zoe", "zoe"]) == (
        KnownStudent("Cem"),
        KnownStudent("Zoe", date(2026, 3, 2)),
        KnownStudent("Bea", date(2026, 3, 9)),
        KnownStudent("Ann Lee", date(2026, 3, 5)),
        KnownStudent("Dan"),
    )
    assert catch_up(settings, told.append) == 0
    assert len(told) == 1


def test_a_folder_that_is_not_there_has_nobody(settings: Settings) -> None:
    assert catch_up(settings, pytest.fail) == 0
    assert known_students(settings, []) == ()


def test_what_is_damaged_is_named_beside_what_came_and_no_more(settings: Settings) -> None:
    for student in ("Ann", "Ben", "Cem", "Dan", "Eve"):
        played(settings.sessions_dir, student, "2026-03-02T10-00-00_rock-1", student)
        played(settings.sessions_dir, student, "2026-03-03T10-00-00_rock-1", student)
        damaged = settings.sessions_dir / student / "2026-03-01T10-00-00_rock-1"
        damaged.mkdir()
        (damaged / "report.json").write_text("{")
    told: list[str] = []
    assert catch_up(settings, told.append) == 10
    assert ["report.json" in line for line in told] == [True, True, True, False, False]
    assert told[3:] == ["2 more folders could not be taken into the history", "10 sessions taken into the history"]
    assert catch_up(settings, pytest.fail) == 0


def test_a_history_that_is_away_is_said_once_and_costs_nothing(settings: Settings, tmp_path: Path) -> None:
    (tmp_path / "plain-file").touch()
    away = replace(settings, history=f"sqlite:///{tmp_path}/plain-file/history")
    played(settings.sessions_dir, "Ann", "2026-03-05T10-00-00_rock-1", "Ann")
    told: list[str] = []
    assert catch_up(away, told.append) == 0
    [line] = told
    assert "practice goes on" in line
    assert known_students(away, ["Ann"]) == (KnownStudent("Ann"),)
    assert catch_up(settings, told.append) == 1


@pytest.mark.parametrize("name", ["Ann/Lee", "Ann-Lee", "ann-lee", "ANN LEE", "Ann Lee/", "../Ann Lee", "Ａｎｎ Lee"])
def test_two_names_that_become_one_folder_are_found(tmp_path: Path, name: str) -> None:
    assert sharing(tmp_path, name, ["Bea", "Ann Lee"]) == "Ann Lee"
    assert sharing(tmp_path, "Ann Lee", ["Bea", "Ann Lee"]) is None
    assert sharing(tmp_path, "Ann Leigh", ["Bea", "Ann Lee"]) is None


@pytest.mark.parametrize("name", ["..", "../..", "/etc", "CON", "lessons", "Courses", "a\0b", "\n", "~", "." * 300])
def test_no_name_leads_elsewhere(tmp_path: Path, name: str) -> None:
    folder = student_folder(tmp_path, name)
    assert folder.parent == tmp_path
    assert folder.name.casefold() not in {*OWN_FOLDERS, "con", "..", "."}


def test_when_somebody_played_is_said(tmp_path: Path) -> None:
    today = date(2026, 3, 9)
    words = [KnownStudent("A", last).words(today) for last in (None, today, date(2026, 3, 8), date(2026, 2, 1))]
    assert words == ["nothing played yet", "played today", "played yesterday", "played on 1 February 2026"]
