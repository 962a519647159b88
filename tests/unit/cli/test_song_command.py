"""`station song`: made of a part and a band, checked, practised by a virtual student whose bias is known."""

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.cli.command_line import main
from station.drills.songs.song_file import read_song
from tests.fakes.song_files import write_part
from tests.unit.practice.test_song_sound import beats_s, write_band

BARS = 16
POINT_BEATS = (0, 16, 32, 44, 60)


def band_s() -> NDArray[np.float64]:
    """The beats of a band that drifts as bands do: some percent within sixteen bars."""
    return beats_s(3, 4 * BARS + 1, wander=0.003)


@pytest.fixture
def made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A song of 16 bars by a band that wanders, timed by five points that are up to 8 ms off."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    times_s = band_s()
    part = write_part(tmp_path, BARS)
    write_band(tmp_path / "band.wav", times_s)
    words = ["song", "new", "--part", str(part), "--sound", str(tmp_path / "band.wav"), "--title", "Ours"]
    for index, beat in enumerate(POINT_BEATS):
        words += ["--point", f"{beat // 4 + 1}.{beat % 4 + 1}={times_s[beat] + 0.008 * (-1) ** index:.4f}"]
    assert main([*words, "--out", str(tmp_path / "ours.song")]) == 0
    return tmp_path / "ours.song"


def test_every_quarter_lies_within_ten_milliseconds_of_the_band(made: Path) -> None:
    song = read_song(made)
    assert song.title == "Ours"
    assert len(song.quarters_s) == 4 * BARS + 1
    off_ms = 1e3 * (np.array(song.quarters_s) - band_s())[:-1]
    assert np.abs(off_ms).max() < 10.0


def test_it_is_practised_slowed_and_looped_and_judged(made: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["practice", str(made), "--bars", "5-6", "--speed", "60%", "--loops", "4", "--headless", "--json"]
    report = made.parent / "report"
    student = ["--virtual-student", "seed=2,bias_ms=15,sd_ms=5", "--report", str(report), "--no-pictures"]
    assert main([*words, *student]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["counts"]["matched"] == 32
    assert document["timing"]["mean_signed_asynchrony_ms"] == pytest.approx(15.0, abs=2.0)
    assert (report / "report.json").is_file()


def test_check_says_how_far_the_points_are_off(made: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["song", "check", str(made)]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert "16 bars" in rows[0]
    assert [row.split()[0] for row in rows[2:]] == ["1.1", "5.1", "9.1", "12.1", "16.1"]


def test_a_point_of_the_wrong_beat_is_shown(made: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = made.read_text().replace("bar = 9\n", "bar = 9\nbeat = 2\n").replace("beat = 2\nbeat = 1", "beat = 2")
    made.write_text(text)
    assert main(["song", "sync", str(made)]) == 0
    (wrong,) = [row for row in capsys.readouterr().out.splitlines() if "more than 20 ms" in row]
    assert wrong.split()[0] == "9.2"


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["--point", "1.1"], "expected a bar, a beat and a second"),
        (["--point", "99.1=3", "--point", "1.1=1"], "bars 1 to 16"),
        (["--point", "2.1=inf", "--point", "1.1=1"], "point"),
        (["--sound", "nothing.ogg"], "nothing.ogg"),
    ],
)
def test_what_cannot_be_is_one_line(
    made: Path, words: list[str], fault: str, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = made.parent
    sound = [] if "--sound" in words else ["--sound", str(folder / "band.wav")]
    out = folder / "other.song"
    assert main(["song", "new", "--part", str(folder / "part.mid"), *sound, *words, "--out", str(out)]) == 2
    said = capsys.readouterr().err
    assert fault in said
    assert said.count("\n") == 1
    assert not out.exists()


def test_a_song_is_not_overwritten(made: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["song", "new", "--part", "p.mid", "--sound", "s.wav", "--out", str(made)]) == 2
    assert "is there already" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["--adapt"], "one tempo"),
        (["--rise", "5/8"], "one tempo"),
        (["--track", "x.wav"], "brings its own"),
        (["--speed", "20%"], "of its own speed"),
        (["--speed", "0.6"], "beats a minute; expected 20 to 400, such as --speed 60%"),
    ],
)
def test_what_a_song_cannot_do_is_refused(
    made: Path, words: list[str], fault: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["practice", str(made), "--headless", *words]) == 2
    assert fault in capsys.readouterr().err


def test_a_song_without_sound_cannot_be_timed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "part.toml").write_text('title = "P"\n[grid]\nsnare = "o--- | o---"\n', encoding="utf-8")
    points = "".join(f"[[point]]\nbar = {bar}\nat_s = {2.0 * bar}\n" for bar in (1, 2))
    song = tmp_path / "mute.song"
    song.write_text(f'title = "Mute"\npart = "part.toml"\n{points}', encoding="utf-8")
    assert main(["song", "sync", str(song)]) == 2
    assert "sound: is missing" in capsys.readouterr().err
