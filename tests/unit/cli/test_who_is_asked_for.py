"""Whose history is asked for: one rule for list, show, export, report and copy."""

from datetime import datetime
from pathlib import Path

import pytest

from station.cli.command_line import main
from tests.fakes.kept_sessions import kept, users_history

DAY = datetime(2026, 11, 24, 18, 0)


@pytest.fixture(autouse=True)
def _own_history(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for kind in ("DATA", "CONFIG"):
        monkeypatch.setenv(f"XDG_{kind}_HOME", str(tmp_path / kind))
    monkeypatch.setenv("XDG_DOCUMENTS_DIR", str(tmp_path / "documents"))


@pytest.mark.parametrize(
    "words",
    [
        ["history", "list"],
        ["history", "show", "last"],
        ["history", "export", "--out", "x"],
        ["history", "copy", "--to", "sqlite:///other.sqlite3"],
        ["report", "--week", "--out", "x.html"],
        ["report", "last", "--out", "x.html"],
        ["history", "delete", "--yes"],
    ],
)
def test_a_name_that_nobody_has_is_refused_everywhere(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    users_history().keep(kept("Mia", DAY))
    before = {path.name for path in tmp_path.iterdir()}
    assert main([*words, "--student", "Miaa"]) == 2
    assert "Miaa: no such student; did you mean Mia?" in capsys.readouterr().err
    assert {path.name for path in tmp_path.iterdir()} - before <= {"documents"}


@pytest.mark.parametrize("words", [["history"], ["history", "show", "last"], ["report", "last", "--out", "x.html"]])
def test_who_asks_for_nobody_is_told_who_is_here(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    users_history().keep(kept("Zoe", DAY))
    users_history().keep(kept("Mia", DAY.replace(hour=19)))
    assert main(words) == 2
    assert "nothing of student is kept; there are Mia, Zoe: --student NAME" in capsys.readouterr().err


def test_nothing_empty_is_taken_away(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    users_history().keep(kept("Mia", DAY))
    for words in (["history", "export", "--out"], ["report", "--week", "--out"]):
        out = tmp_path / "x.html"
        assert main([*words, str(out)]) == 2
        assert "there is Mia" in capsys.readouterr().err
        assert not out.exists()


def test_another_spelling_is_the_same_student(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    users_history().keep(kept("Mia", DAY))
    assert main(["history", "--student", "mia"]) == 0
    assert capsys.readouterr().out.splitlines()[-1].startswith("1 session on 1 day")
    out = tmp_path / "week.html"
    assert main(["report", "--week", "2026-11-24", "--student", "MIA", "--out", str(out)]) == 0
    assert "Mia played on 1 day" in out.read_text(encoding="utf-8")
