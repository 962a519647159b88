"""A groove's link on the command line, and lessons as links and as Hydrogen's songs."""

from pathlib import Path

import pytest

from station.cli.command_line import main
from station.drills.reading.lesson_file import read_lesson

LINK = (
    "https://www.mikeslessons.com/gscribe?TimeSig=4/4&Div=8&Title=Rock&Tempo=96&Measures=1"
    "&H=|xxxxxxxx|&S=|--O---O-|&K=|o---o---|"
)


def test_a_link_becomes_a_lesson(tmp_path: Path) -> None:
    out = tmp_path / "rock.toml"
    assert main(["lesson", "import", LINK, "--out", str(out)]) == 0
    lesson = read_lesson(out)
    assert lesson.title == "Rock"
    assert len(lesson.score) == 12
    assert lesson.score.tempo_map.bpm_at(0) == 96


def test_a_link_that_is_wrong_is_told_in_a_line(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    wrong = LINK.replace("Div=8", "Div=0")
    assert main(["lesson", "import", wrong, "--out", str(tmp_path / "rock.toml")]) == 2
    assert "Div: expected how many cells a whole note has" in capsys.readouterr().err


@pytest.mark.parametrize("percent", [10, 20, 30, 45])
def test_its_swing_is_the_lessons(percent: int, tmp_path: Path) -> None:
    out = tmp_path / "rock.toml"
    assert main(["lesson", "import", f"{LINK}&Swing={percent}", "--out", str(out)]) == 0
    lesson = read_lesson(out)
    assert lesson.swing.ratio == pytest.approx((100 + percent) / (100 - percent), abs=1e-3)
    assert "xx xx xx xx" in out.read_text()


@pytest.mark.parametrize("ending", ["groove", "h2song", "h2pattern"])
def test_a_lesson_goes_there_and_back(ending: str, tmp_path: Path) -> None:
    there, back = tmp_path / f"rock.{ending}", tmp_path / "back.toml"
    assert main(["lesson", "export", "rock-1", "--out", str(there)]) == 0
    assert main(["lesson", "import", str(there), "--out", str(back)]) == 0
    assert len(read_lesson(back).score) == 24


def test_what_is_lost_is_told(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["lesson", "export", "latin-jazz-1", "--out", str(tmp_path / "jazz.groove")]) == 0
    assert "swing of some bars is left out" in capsys.readouterr().err
