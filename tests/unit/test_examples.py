"""The examples run, and say what they promise."""

import runpy
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"


def run(name: str) -> None:
    runpy.run_path(str(EXAMPLES / name), run_name="__main__")


def test_every_example_is_run_here() -> None:
    assert {path.name for path in EXAMPLES.glob("*.py")} == {"score_a_take.py", "paper_figures.py"}


def test_a_take_is_scored(capsys: pytest.CaptureFixture[str]) -> None:
    run("score_a_take.py")
    assert "Score" in capsys.readouterr().out


def test_the_papers_figures_say_what_to_get_where_there_is_no_data(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["paper_figures.py", str(tmp_path)])
    with pytest.raises(SystemExit) as end:
        run("paper_figures.py")
    assert end.value.code == 2
    assert "get trial 07_01 from mocap.cs.cmu.edu" in capsys.readouterr().err
