"""`station exam`: the rubric first, one take, the marks, and what is kept."""

import json
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.cli.exam import look


def test_a_virtual_student_takes_an_exam(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["exam", "--reading", "2", "--seed", "5", "--virtual-student", "pro,seed=1", "--json"]
    assert main([*words, "--report", str(tmp_path / "one")]) == 0
    printed = capsys.readouterr()
    document = json.loads(printed.out)
    assert document["schema"] == "drum-station/exam/1"
    assert document["unseen"] == {"level": 2, "seed": 5}
    assert sum(line["points"] for line in document["marks"]["lines"]) == pytest.approx(document["marks"]["total"], 0.01)
    assert printed.err.index("Notes") < printed.err.index("report"), "the rubric comes first"
    assert json.loads((tmp_path / "one" / "exam.json").read_text()) == document
    assert (tmp_path / "one" / "session.capture").is_file()


def test_the_rubric_alone_plays_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["exam", "rock-1", "--rubric"]) == 0
    assert "played once" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["--reading", "0"], "--reading: 0"),
        (["rock-1", "--seed", "3"], "--seed"),
        (["rock-1", "--reading", "2"], "--reading"),
        (["--preview", "nan"], "--preview: nan"),
        (["--preview", "-1"], "--preview: -1"),
        (["rock-1", "--tempo", "5000"], "--tempo"),
    ],
)
def test_what_cannot_be_is_one_line(words: list[str], fault: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["exam", *words, "--virtual-student", "pro"]) == 2
    (line,) = capsys.readouterr().err.strip().split("\n")
    assert fault in line


def test_enter_ends_the_look_and_what_is_left_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    waits: list[float] = []

    def after_two(wait_s: float) -> int | None:
        waits.append(wait_s)
        return 0 if len(waits) == 3 else None

    look(90.0, after_two)
    assert waits == [30.0, 30.0, 20.0]
    assert "60 seconds" in capsys.readouterr().err
