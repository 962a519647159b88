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


def test_an_export_says_what_the_format_has_no_word_for_and_leaves_files_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """rock-1 has a line of sticking; SMF has no message for hands."""
    song = tmp_path / "song.mid"
    assert main(["lesson", "export", "rock-1", "--out", str(song)]) == 0
    assert "MIDI has no word for: sticking of the hands" in "".join(capsys.readouterr())
    song.write_bytes(b"mine")
    assert main(["lesson", "export", "rock-1", "--out", str(song)]) == 2
    assert song.read_bytes() == b"mine"
    assert main(["lesson", "export", "rock-1", "--out", str(song), "--overwrite"]) == 0
    assert song.read_bytes() != b"mine"


def test_a_link_with_blanks_in_its_title_is_a_link(tmp_path: Path) -> None:
    """Browsers and mails show %20 as a blank, and people copy what they see."""
    out = tmp_path / "samba.toml"
    link = "https://www.mikeslessons.com/groove/?TimeSig=4/4&Div=16&Title=Samba Ostinato&Tempo=60&K=|o-xoo-xoo-xoo-xo|"
    assert main(["lesson", "import", link, "--out", str(out)]) == 0
    assert 'title = "Samba Ostinato"' in out.read_text()
