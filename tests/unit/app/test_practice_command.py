"""`station practice`: a session is kept whatever becomes of its words."""

import errno
import io
import json
import sys
from pathlib import Path

import pytest

from station.cli.command_line import main

VIRTUAL = ["--headless", "--virtual-student", "pro", "--loops", "1", "--no-pictures"]


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody's own settings or sessions are touched."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("HOME", str(tmp_path))


class FullDisk(io.StringIO):
    """A file on a disk that takes nothing more."""

    def write(self, text: str) -> int:
        raise OSError(errno.ENOSPC, "No space left on device")


@pytest.mark.parametrize("words", [["--json"], []])
def test_a_report_that_cannot_be_printed_is_kept_and_that_is_said(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "x"
    monkeypatch.setattr(sys, "stdout", FullDisk())
    assert main(["practice", "rock-1", *VIRTUAL, "--report", str(folder), *words]) == 2
    fault = f"the session is kept in {folder}, but not all could be printed: standard output: No space left on device"
    assert capsys.readouterr().err == f"station: {fault}\n"
    assert {"report.json", "report.txt", "pairs.csv"} <= {path.name for path in folder.iterdir()}


# --- how strictly is judged -------------------------------------------------------------------------------------------


def level_of(words: list[str], capsys: pytest.CaptureFixture[str]) -> object:
    """The level in the report of a virtual student's practice."""
    assert main(["practice", "rock-1", *VIRTUAL, "--json", *words]) == 0
    return json.loads(capsys.readouterr().out)["level"]


def test_the_level_is_the_lessons_until_another_is_asked_for_and_stays_with_the_student(
    capsys: pytest.CaptureFixture[str],
) -> None:
    anna = ["--student", "Anna"]
    assert level_of(anna, capsys) == "beginner", "Rock 1 is a first step"
    assert level_of([*anna, "--level", "advanced"], capsys) == "advanced"
    assert level_of(anna, capsys) == "advanced"
    assert level_of(["--student", "Ben"], capsys) == "beginner"


def test_a_virtual_student_without_a_name_leaves_no_level_behind(capsys: pytest.CaptureFixture[str]) -> None:
    assert level_of(["--level", "studio"], capsys) == "studio"
    assert level_of([], capsys) == "beginner"


def test_the_report_says_the_level(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["practice", "rock-1", *VIRTUAL, "--level", "elementary"]) == 0
    assert "1 pass, judged as elementary\n" in capsys.readouterr().out


def test_a_level_beyond_the_teachers_limit_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lesson = tmp_path / "slow.toml"
    lesson.write_text('title = "Slow"\n[goals]\nstrictest_level = "elementary"\n[grid]\nsnare = "oooo"\n')
    assert main(["practice", str(lesson), *VIRTUAL, "--level", "studio"]) == 2
    assert capsys.readouterr().err == "station: --level: studio: slow is judged as elementary at the strictest\n"


def test_a_level_of_another_program_is_none_of_a_students(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["practice", "rock-1", *VIRTUAL, "--level", "yarg"]) == 2
    assert "no such choice: 'yarg'" in capsys.readouterr().err


def test_a_student_who_holds_the_lesson_is_judged_more_strictly_the_next_time(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Ten passes at the target tempo, the fifth and the tenth blind and clean."""
    options = ["--student", "Anna", "--adapt", "--tempo", "110", "--loops", "10"]
    assert main(["practice", "rock-1", *VIRTUAL[:2], "sd_ms=5,seed=1", "--no-pictures", *options]) == 0
    assert "You hold it at beginner: judged as elementary from next time on." in capsys.readouterr().out
    assert level_of(["--student", "Anna"], capsys) == "elementary"


# --- on a smaller kit -------------------------------------------------------------------------------------------------


def test_a_lesson_is_practised_on_the_pieces_that_there_are(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["practice", "rock-fill-1", *VIRTUAL, "--json", "--fold", "kick, snare,hihat"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["session"]["title"] == "Rock fill: around the kit (smaller kit)"
    assert set(report["per_piece"]) == {"kick", "snare", "hihat"}


@pytest.mark.parametrize("pieces", ["kick,snair", ""])
def test_a_piece_that_nobody_knows_is_told(pieces: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["practice", "rock-fill-1", *VIRTUAL, "--fold", pieces]) == 2
    assert "expected pieces such as kick,snare,hihat" in capsys.readouterr().err
