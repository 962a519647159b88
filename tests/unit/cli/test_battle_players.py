"""Whose a battle is: virtual students leave nothing among a person's, and nobody's battle is kept."""

import json
from pathlib import Path

import pytest

from station.app.settings.settings_store import SettingsStore
from station.cli.command_line import main
from station.core.settings import load_settings, with_said
from station.practice.records.students import known_students

SHORT = ("battle", "--headless", "--rounds", "1", "--no-final", "--tempo", "150")


@pytest.fixture
def sessions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where all sessions are, of a computer at which Olga plays."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    store, folder = SettingsStore(), tmp_path / "sessions"
    store.update(lambda settings: with_said(settings, {"student": "Olga", "sessions": str(folder)}, "test"))
    store.write()
    return folder


def folders(sessions: Path) -> list[str]:
    return sorted({path.parent.parent.name for path in sessions.rglob("*.capture")})


def test_a_virtual_student_s_battle_is_nobody_s_who_practises_here(
    sessions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*SHORT, "--virtual-student", "beginner"]) == 0
    assert capsys.readouterr().out.startswith("Virtual beginner against The steady one\n")
    assert folders(sessions) == ["virtual-student"]
    assert [one.name for one in known_students(load_settings(), ["Olga"])] == ["Olga"], "nobody to choose in the window"


def test_so_is_a_session_and_an_exam(sessions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["practice", "rock-1", "--headless", "--virtual-student", "pro", "--loops", "1", "--no-pictures"]) == 0
    assert main(["exam", "rock-1", "--virtual-student", "pro"]) == 0
    assert folders(sessions) == ["virtual-student"]


def test_a_virtual_student_plays_under_the_name_that_is_given(
    sessions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*SHORT, "--virtual-student", "beginner", "--student", "Robot"]) == 0
    assert capsys.readouterr().out.startswith("Robot against ")
    assert folders(sessions) == ["Robot"]


def test_named_kits_that_are_not_there_are_one_error_and_nothing_is_kept(
    sessions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["battle", "--players", "Ann=No such kit,Ben=Nor this one"]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    (line,) = said.err.strip().splitlines()
    assert "no port is called 'No such kit' or 'Nor this one'" in line
    assert "these are there: " in line or "there is no MIDI port" in line
    assert not list(sessions.rglob("*battle*"))


def test_virtual_students_sit_at_kits_of_their_own_where_ports_are_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--players", "Ann=TD-17,Ben=Nitro", "--virtual-student", "pro", "--report", str(tmp_path / "x"), "--json"]
    assert main([*SHORT, *words]) == 0
    document = json.loads(capsys.readouterr().out)
    assert [score["name"] for score in document["scores"][1:]] == ["Ann", "Ben"]
    assert all(turn["strokes"] for turn in document["rounds"][0]["turns"] if turn["kind"] == "answer")


def test_a_battle_in_which_nobody_plays_is_not_kept(sessions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*SHORT, "--virtual-student", "miss_pct=100"]) == 0
    said = capsys.readouterr()
    assert "nobody has played a stroke: the battle is not kept" in said.err
    assert "draw" not in said.out
    assert not list(sessions.rglob("battle.*"))


def test_what_virtual_students_have_done_counts_for_them_alone(
    sessions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    two = ["--players", "Ann,Ben", "--handicap", "--mode", "improvise", "--bars", "1", "--virtual-student", "beginner"]
    expected = []
    for _ in range(2):
        assert main([*SHORT, *two, "--json"]) == 0
        expected.append(json.loads(capsys.readouterr().out)["rules"]["expectations"])
    assert expected[0] != expected[1], "they remember"
    assert folders(sessions) == ["virtual-student"]
