"""Who is known here, which names stay apart, and what no student may be called by folder."""

import json
from dataclasses import replace
from datetime import date, datetime
from pathlib import Path

import pytest

from station.core.errors import DeviceError
from station.core.settings import Settings, StudentSettings
from station.drills.library import find_lesson
from station.drills.mastery.mastery_json import document_of
from station.drills.mastery.next_pass import new_item
from station.drills.mastery.practice_steps import item_of
from station.practice.history.session_files import OWN_FOLDERS, session_folder, student_folder, write_document
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


@pytest.mark.parametrize("name", ["Ann-Lee", "ann-lee", "ANN LEE", "Ann  Lee ", "Ａｎｎ Lee"])
def test_two_spellings_of_a_name_are_one_student(name: str) -> None:
    assert sharing(name, ["Bea", "Ann Lee"]) == "Ann Lee"
    assert sharing("Ann Lee", ["Bea", "Ann Lee"]) is None
    assert sharing("Ann Leigh", ["Bea", "Ann Lee"]) is None


@pytest.mark.parametrize("name", ["..", "../..", "/etc", "CON", "lessons", "Courses", "a\0b", "\n", "~", "." * 300])
def test_no_name_leads_elsewhere(tmp_path: Path, name: str) -> None:
    folder = student_folder(tmp_path, name)
    assert folder.parent == tmp_path
    assert folder.name.casefold() not in {*OWN_FOLDERS, "con", "..", "."}


def test_when_somebody_played_is_said(tmp_path: Path) -> None:
    today = date(2026, 3, 9)
    words = [KnownStudent("A", last).words(today) for last in (None, today, date(2026, 3, 8), date(2026, 2, 1))]
    assert words == ["nothing played yet", "played today", "played yesterday", "played on 1 February 2026"]


@pytest.mark.parametrize(
    ("name", "other"),
    [
        ("🥁", "🎸"),
        ("..", " "),
        ("Zoe.", "Zoe"),
        ("a/b", "a-b"),
        ("CON", "CON_"),
        ("lessons", "lessons_"),
        ("n" * 80 + "a", "n" * 80 + "b"),
    ],
)
def test_names_that_differ_are_students_apart(settings: Settings, name: str, other: str) -> None:
    assert sharing(name, [other]) is None
    folders = [student_folder(settings.sessions_dir, each).name for each in (name, other)]
    assert folders[0].casefold() != folders[1].casefold()
    for each, folder, day in zip((name, other), folders, (2, 3), strict=True):
        played(settings.sessions_dir, folder, f"2026-03-0{day}T10-00-00_rock-1", each)
    assert catch_up(settings, lambda _line: None) == 2
    assert {each.name for each in known_students(settings, [])} == {name, other}


@pytest.mark.parametrize("name", ["Ann", "Zoë", "Ann Lee", "O_Neil", "ann.lee", "שלום", "n" * 80])
def test_a_name_that_loses_nothing_keeps_its_folder(tmp_path: Path, name: str) -> None:
    assert student_folder(tmp_path, name).name == name.replace(" ", "-")


def test_a_folder_from_before_is_its_students_still(settings: Settings) -> None:
    for folder, name in (("unnamed", "🥁"), ("Zoe", "Zoe."), ("Zoe-Lee", "Zoe Lee")):
        played(settings.sessions_dir, folder, "2026-03-02T10-00-00_rock-1", name)
    named = replace(settings, students=(StudentSettings("Zoe."),))
    assert catch_up(named, lambda _line: None) == 3
    for name in ("🥁", "Zoe.", "Zoe Lee"):
        assert [path.name for path in student_folder(settings.sessions_dir, name).iterdir()] == [
            "2026-03-02T10-00-00_rock-1"
        ]
    assert {each.name for each in known_students(settings, [])} == {"🥁", "Zoe.", "Zoe Lee"}
    assert catch_up(named, pytest.fail) == 0


def test_a_folder_in_another_spelling_is_taken_and_all_spellings_come_in(settings: Settings) -> None:
    played(settings.sessions_dir, "Ann", "2026-03-02T10-00-00_rock-1", "Ann")
    assert student_folder(settings.sessions_dir, "ANN").name == "Ann"
    played(settings.sessions_dir, "ann", "2026-03-03T10-00-00_rock-1", "ann")
    assert catch_up(settings, lambda _line: None) == 2
    assert [each.last for each in known_students(settings, [])] == [date(2026, 3, 3)]


def test_a_link_to_another_students_folder_is_left_alone(settings: Settings) -> None:
    played(settings.sessions_dir, "Ann", "2026-03-02T10-00-00_rock-1", "Ann")
    (settings.sessions_dir / "Cem").symlink_to("Ann")
    told: list[str] = []
    assert catch_up(settings, told.append) == 1
    assert "Cem: is a link to another student's folder" in told[0]
    assert [each.name for each in known_students(settings, [])] == ["Ann"]
    with pytest.raises(DeviceError, match="a link to another student's folder"):
        session_folder(settings.sessions_dir, "Cem", "rock-1", datetime(2026, 3, 4))
