"""Whose folders lie beside one another, which names stay apart, and what no student may be called by folder."""

import json
from datetime import date
from pathlib import Path

import pytest

from station.practice.history.session_files import OWN_FOLDERS, student_folder
from station.practice.records.students import KnownStudent, known_students, sharing


def played(sessions: Path, folder: str, session: str, name: str | None = None) -> None:
    path = sessions / folder / session
    path.mkdir(parents=True)
    if name is not None:
        (path / "report.json").write_text(json.dumps({"session": {"student": name}}))


def test_who_is_named_comes_first_then_who_played_last(tmp_path: Path) -> None:
    played(tmp_path, "Zoe", "2026-03-02T10-00-00_rock-1")
    played(tmp_path, "Ann-Lee", "2026-03-05T10-00-00_rock-1", "Ann Lee")
    played(tmp_path, "Bea", "2026-03-09T10-00-00_rock-1", "somebody else's name")
    (tmp_path / "Dan" / "mastery").mkdir(parents=True)
    for other in (*OWN_FOLDERS, "holiday pictures"):
        (tmp_path / other / "2026").mkdir(parents=True)
    (tmp_path / "settings.toml").touch()
    assert known_students(tmp_path, ["Cem", "Zoe"]) == (
        KnownStudent("Cem"),
        KnownStudent("Zoe", date(2026, 3, 2)),
        KnownStudent("Bea", date(2026, 3, 9)),
        KnownStudent("Ann Lee", date(2026, 3, 5)),
        KnownStudent("Dan"),
    )


def test_a_folder_that_is_not_there_has_nobody(tmp_path: Path) -> None:
    assert known_students(tmp_path / "none", []) == ()


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
