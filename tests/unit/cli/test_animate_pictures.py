"""`station animate` to video and pictures: names, options, what is refused; small, but drawn and encoded in earnest."""

import sys
from pathlib import Path

import numpy as np
import pytest

from station.app.equipment.diagnostics import check_video
from station.cli.animate import AHEAD_S, as_far_as_asked
from station.cli.animation.animate_options import AnimateOptions
from station.cli.command_line import main
from station.cli.console import progress_line
from station.cli.options.option_fields import read_options
from station.drills.library import find_lesson
from station.scenes.film import FilmLoop
from tests.fakes.sound_files import stroke
from tests.unit.cli.test_cli import refused
from tests.unit.render.test_png_file import decode


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody's own settings are touched; a kit of three short sounds, for it is loaded at once."""
    kit = tmp_path / "kit"
    kit.mkdir()
    for name in ("kick", "snare", "hihat_closed"):
        (kit / f"{name}.wav").write_bytes(stroke(length_s=0.1))
    settings = tmp_path / "config" / "drum-station" / "settings.toml"
    settings.parent.mkdir(parents=True)
    settings.write_text(f'drums = "{kit}"\n', encoding="utf-8")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("HOME", str(tmp_path))


def animate(out: Path, *words: str) -> int:
    return main(["animate", "rock-1", "--out", str(out), "--quality", "low", *words])


@pytest.mark.gl
def test_a_video_lasts_from_a_second_before_its_bars_until_the_score_has_rung_out(tmp_path: Path) -> None:
    av = pytest.importorskip("av", reason="av is not installed: pip install av")
    assert (
        animate(tmp_path / "x.mp4", "--fps", "5", "--start-bar", "2", "--size", "48x32", "--click", "--no-score") == 0
    )
    with av.open(str(tmp_path / "x.mp4")) as container:
        assert container.streams.video[0].frames == 25  # 1 s, a bar of 3 s (80 bpm) and 1 s, 5 pictures a second
        assert container.streams.audio[0].rate == 48_000


@pytest.mark.gl
def test_a_name_with_a_number_is_a_sequence_and_one_without_an_instant(tmp_path: Path) -> None:
    words = ("--size", "63x31", "--view", "feet", "--mirror")
    assert animate(tmp_path / "f" / "a%03d.png", "--fps", "5", "--start-bar", "2", "--seconds", "0.4", *words) == 0
    assert sorted(p.name for p in (tmp_path / "f").iterdir()) == ["a001.png", "a002.png"]
    assert animate(tmp_path / "still.png", "--time", "2.2", *words) == 0  # the bar begins at 3 s, its pictures at 2 s
    still, second = (decode((tmp_path / name).read_bytes()) for name in ("still.png", "f/a002.png"))
    assert still.shape == (31, 63, 3)
    assert np.abs(still.astype(int) - second).mean() < 0.1  # letters may be set anew
    assert np.abs(still.astype(int) - decode((tmp_path / "f" / "a001.png").read_bytes())).mean() > 0.1


@pytest.mark.gl
def test_a_gif_is_the_middle_of_three_passes(tmp_path: Path) -> None:
    av = pytest.importorskip("av", reason="av is not installed: pip install av")
    path = tmp_path / "x.gif"
    assert animate(path, "--fps", "1", "--start-bar", "2", "--size", "64x32", "--no-score") == 0
    with av.open(str(path)) as container:
        frames = [frame.pts for frame in container.decode(video=0)]
    assert frames == [0, 100, 200], "a bar of 3 s at 80 bpm, in hundredths, and no second before or after it"


def test_what_a_loop_shows_is_numbered_as_in_the_score() -> None:
    score = find_lesson("rock-1").score
    played = FilmLoop.score(score, 1, 1)
    assert (played.bar_count, len(played)) == (3, 3 * len(score.bars(1, 1)))


def test_what_cannot_be_is_refused_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def said(name: str, *words: str) -> str:
        return refused(capsys, "animate", "rock-1", "--out", str(tmp_path / name), *words)

    assert "161x90: a video's and a GIF's width and height are even" in said("x.mp4", "--size", "161x90")
    assert "expected a name that ends in .mp4, .gif, .png, .npz, .bvh or .glb" in said("x.avi")
    assert "the score has seconds 0 to 6.000" in said("x.png", "--time", "6.1")
    assert "expected a number above 0" in said("x.mp4", "--seconds", "0")
    assert "expected 1 to 1000 a second" in said("x.mp4", "--fps", "0")
    assert "expected one number such as %05d" in said("a%d%d.png")
    assert "--beat: x.mp4 makes a video; this is for a picture" in said("x.mp4", "--beat", "2")
    assert "--size: x.npz makes motion" in said("x.npz", "--size", "64x64")
    assert "--click: x.glb makes motion; this is for a video" in said("x.glb", "--click")
    assert "--click: x.gif makes a GIF; this is for a video" in said("x.gif", "--click")
    assert "--seconds: x.gif makes a GIF" in said("x.gif", "--seconds", "3")
    assert "expected 1 to 1000 a second" in said("x.gif", "--fps", "0")
    assert "the last bar is before the first" in said("x.npz", "--start-bar", "2", "--end-bar", "1")
    assert [p.name for p in tmp_path.iterdir() if p.suffix in (".mp4", ".gif", ".png")] == []


def test_without_the_encoder_a_video_is_refused_with_what_to_do(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "av", None)  # Python's own way to say that a module cannot be imported
    monkeypatch.delitem(sys.modules, "station.render.files.video_file", raising=False)
    said = refused(capsys, "animate", "rock-1", "--out", str(tmp_path / "x.mp4"))
    assert "videos need FFmpeg's libraries" in said
    assert "pip install av" in said
    assert not (tmp_path / "x.mp4").exists()
    assert check_video().works is False


def test_progress_tells_how_much_is_left() -> None:
    """A quarter in 10 s leaves 30 s; 600 pictures in 10 s of 12,000 leave 190 s."""
    assert progress_line(100, 400, 10.0) == "███████" + "░" * 23 + "  25 %  100 of 400 pictures, 10 a second, 30 s left"
    assert progress_line(600, 12_000, 10.0).endswith("5 %  600 of 12000 pictures, 60 a second, 3 min 10 s left")
    assert "left" not in progress_line(3, 400, 0.2)


def test_of_an_hour_of_strokes_motion_is_planned_as_far_as_it_is_asked_for() -> None:
    options = read_options(AnimateOptions, ["rock-1", "--out", "x.npz", "--seconds", "3"])
    hour = find_lesson("rock-1").score.repeated(600)
    near = as_far_as_asked(hour, options)
    assert near.end_tick == hour.end_tick
    assert float(near.onset_s.max()) < 3.0 + AHEAD_S
    assert near.notes.tobytes() == hour.notes[: len(near)].tobytes()
    minutes = hour.bars(0, 99)
    assert as_far_as_asked(minutes, options) is minutes  # as ever
