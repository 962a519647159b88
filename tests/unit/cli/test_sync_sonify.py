"""`station sync sonify`: files of every kind from a walk made of sines, and what it refuses."""

import json
from pathlib import Path

import mido
import numpy as np
import pytest
import soundfile

from station.cli.sync import COMMAND as SYNC
from station.core.errors import BadInput
from station.core.pieces import Piece
from station.music.formats.smf.standard_midi import performance_from_midi, read_midi
from station.sync.phase.model_file import save_model
from station.sync.signals.signal import CHANNEL_SETS, Signal
from station.sync.walking.trial import gait_model

RATE_HZ, PERIOD_S, CYCLES = 120.0, 1.05, 6


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with `walk.csv` and its model, `walk.toml`."""
    time_s = np.arange(round(CYCLES * PERIOD_S * RATE_HZ)) / RATE_HZ
    turn = 2 * np.pi * time_s / PERIOD_S
    hips = 25 * np.sin(turn)
    knees = [30 + 20 * np.cos(turn + side) + 9 * np.sin(2 * turn) for side in (0.6, 0.6 + np.pi)]
    values = np.stack([hips, -hips, *knees], axis=1)
    names = CHANNEL_SETS["walk"]
    rows = [f"{t:.6f},{','.join(f'{v:.6f}' for v in row)}" for t, row in zip(time_s, values, strict=True)]
    (tmp_path / "walk.csv").write_text("\n".join([",".join(["time_s", *names]), *rows]) + "\n")
    save_model(gait_model(Signal(time_s, names, values)), tmp_path / "walk.toml")
    return tmp_path


def sonify(folder: Path, *words: str) -> int:
    model, signal = str(folder / "walk.toml"), str(folder / "walk.csv")
    return SYNC.main("station sync", "", ["sonify", model, signal, *words])


def test_a_midi_file_has_a_kick_and_a_snare_in_turn(folder: Path) -> None:
    assert sonify(folder, "--out", str(folder / "walk.mid")) == 0
    played = performance_from_midi(read_midi(folder / "walk.mid"))
    pieces = [Piece(piece) for piece in played.hits["piece"]]
    assert len(pieces) >= 2 * CYCLES - 3
    assert {*pieces[::2]} != {*pieces[1::2]}
    assert {*pieces} == {Piece.KICK, Piece.SNARE}
    gaps_s = np.diff(played.hits["at_ns"][2:]) / 1e9
    assert gaps_s == pytest.approx(PERIOD_S / 2, abs=0.06)


def test_a_channel_moves_a_controller_while_locked(folder: Path) -> None:
    """The knee bends and stretches once a cycle: its controller goes from end to end."""
    assert sonify(folder, "--out", str(folder / "knee.mid"), "--level", "rtibia_rx=74") == 0
    (track,) = mido.MidiFile(folder / "knee.mid").tracks
    values = [message.value for message in track if message.type == "control_change" and message.control == 74]
    assert min(values) == 0
    assert max(values) == 127
    assert len(values) > 200


def test_a_sound_file_lasts_as_long_as_the_motion_and_what_rings(folder: Path) -> None:
    assert sonify(folder, "--out", str(folder / "walk.wav"), "--sounds", "electronic") == 0
    sound, rate_hz = soundfile.read(folder / "walk.wav")
    assert len(sound) / rate_hz == pytest.approx(CYCLES * PERIOD_S + 1.0, abs=0.02)
    assert np.abs(sound).max() > 0.05


def test_own_triggers_instead_of_a_preset(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ("--trigger", "0.5=ride@40", "--out", str(folder / "a.mid"), "--json")
    assert sonify(folder, *words) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "drum-station/sonify/1"
    assert {(sound["piece"], sound["velocity"]) for sound in document["sounds"]} == {("ride", 40)}
    assert len(document["time_s"]) == len(document["phase_rad"]) == len(document["locked"])


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (("--out", "a.txt"), "expected a name that ends in .mid, .wav, .mp4 or .png"),
        (("--out", "a.png"), "holds no skeleton"),
        (("--out", "a.wav", "--level", "rtibia_rx=74"), "--level: expected with a file that ends in .mid"),
        (("--out", "a.mid", "--preset", "walk", "--trigger", "0=kick"), "not both"),
        (("--out", "a.mid", "--trigger", "2=kick"), "--trigger: 2=kick"),
        (("--out", "a.mid", "--preset", "skip"), "no such choice"),
    ],
)
def test_what_it_refuses_leaves_nothing(folder: Path, words: tuple[str, ...], fault: str) -> None:
    before = sorted(folder.iterdir())
    with pytest.raises(BadInput, match=fault):
        sonify(folder, *(str(folder / word) if word.startswith("a.") else word for word in words))
    assert sorted(folder.iterdir()) == before


@pytest.mark.parametrize("name", ["a.wav", "a.mp4"])
def test_a_recording_with_a_leap_in_time_is_too_long_for_sound(folder: Path, name: str) -> None:
    signal = folder / "walk.csv"
    *rows, last = signal.read_text().splitlines()
    signal.write_text("\n".join([*rows, "1e9," + last.split(",", 1)[1]]) + "\n")
    with pytest.raises(BadInput, match=r"lasts 1e\+09 s: expected at most 1800 for sound or a film"):
        sonify(folder, "--out", str(folder / name))
    assert not (folder / name).exists()
