from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from station.core.errors import BadInput, DeviceError
from station.sound.track import load
from station.sound.track_file import TRACK_DB, TrackRequest, pcm_of, prepare, prepare_in_background, stretched

RATE_HZ = 48_000


def tone(freq_hz: float, length_s: float, rate_hz: int = RATE_HZ) -> NDArray[np.float32]:
    mono = 0.25 * np.sin(2 * np.pi * freq_hz * np.arange(round(length_s * rate_hz)) / rate_hz)
    return np.column_stack([mono, mono]).astype(np.float32)


def file_of(folder: Path, length_s: float = 4.0, name: str = "song.wav", rate_hz: int = RATE_HZ) -> Path:
    path = folder / name
    soundfile.write(path, tone(440.0, length_s, rate_hz), rate_hz)
    return path


def pitch_hz(frames: NDArray[np.float32]) -> float:
    spectrum = np.abs(np.fft.rfft(frames[:, 0] * np.hanning(len(frames))))
    return float(spectrum.argmax()) * RATE_HZ / len(frames)


@pytest.mark.parametrize("speed", [0.5, 0.8, 1.0, 1.5])
def test_speed_changes_length_and_not_pitch(speed: float) -> None:
    out = stretched(tone(440.0, 4.0), RATE_HZ, speed)
    assert len(out) == pytest.approx(4.0 / speed * RATE_HZ, abs=2)
    assert pitch_hz(out[RATE_HZ // 2 : -RATE_HZ // 2]) == pytest.approx(440.0, abs=1.0)


@pytest.mark.parametrize("speed", [0.5, 0.75, 1.25, 1.5])
def test_beats_stay_where_they_belong(speed: float) -> None:
    """Bursts a second apart come out 1/speed apart, each within 3 ms."""
    sound = np.zeros((6 * RATE_HZ, 2), np.float32)
    burst = np.sin(2 * np.pi * 800 * np.arange(2000) / RATE_HZ) * np.exp(-np.arange(2000) / 300)
    for second in range(1, 6):
        sound[second * RATE_HZ :][:2000] += burst[:, None]
    out = np.abs(stretched(sound, RATE_HZ, speed)[:, 0])
    for second in range(1, 6):
        around = round(second / speed * RATE_HZ)
        window = out[around - 5000 : around + 5000]
        found = int(np.argmax(window > 0.3 * window.max())) - 5000
        assert abs(found) < 0.003 * RATE_HZ


@pytest.mark.parametrize("ending", ["wav", "flac", "ogg", "mp3"])
def test_a_file_is_prepared_and_loaded(tmp_path: Path, ending: str) -> None:
    song = file_of(tmp_path, name=f"song.{ending}", rate_hz=44_100)
    prepared = prepare(TrackRequest(song, RATE_HZ, 0.8, start_s=1.0, loop_s=(1.0, 3.0)), tmp_path / "kept")
    track = load(prepared)
    assert len(track.pcm) / RATE_HZ == pytest.approx(5.0, abs=0.1)
    assert track.start == round(1.0 / 0.8 * RATE_HZ)
    assert track.loop == (round(1.0 / 0.8 * RATE_HZ), round(3.0 / 0.8 * RATE_HZ))
    middle = track.pcm[RATE_HZ : 4 * RATE_HZ].astype(np.float32)
    assert pitch_hz(middle) == pytest.approx(440.0, abs=1.0)


def test_the_same_wish_finds_its_file_and_another_does_not(tmp_path: Path) -> None:
    song = file_of(tmp_path)
    first = prepare(TrackRequest(song, RATE_HZ, start_s=1.0), tmp_path / "kept")
    made_ns = first.file.stat().st_mtime_ns
    assert prepare(TrackRequest(song, RATE_HZ, start_s=2.0), tmp_path / "kept").file == first.file
    assert first.file.stat().st_mtime_ns == made_ns
    assert prepare(TrackRequest(song, 44_100), tmp_path / "kept").file != first.file
    song.write_bytes(song.read_bytes()[:-4000])
    assert prepare(TrackRequest(song, RATE_HZ), tmp_path / "kept").file != first.file


def test_loud_music_lies_below_the_kit_and_never_clips() -> None:
    loud = pcm_of(4.0 * tone(440.0, 1.0))
    assert 20 * np.log10(np.sqrt(np.mean((loud / 32768.0) ** 2))) == pytest.approx(TRACK_DB, abs=0.1)
    spiky = np.zeros((RATE_HZ, 2), np.float32)
    spiky[100] = 3.0
    assert np.abs(pcm_of(spiky).astype(int)).max() < 32767
    assert np.all(pcm_of(np.zeros((10, 2), np.float32)) == 0)


@pytest.mark.parametrize(
    ("wish", "fault"),
    [
        ({"speed": 0.4}, "speed: expected 0.5 to 1.5"),
        ({"speed": float("nan")}, "speed: expected"),
        ({"start_s": 4.5}, "start: expected 0 to 4.0 s"),
        ({"start_s": -1.0}, "start: expected"),
        ({"loop_s": (3.0, 2.0)}, "loop 3-2"),
        ({"loop_s": (0.0, 9.0)}, "loop 0-9"),
        ({"loop_s": (1.0, 1.1)}, "loop 1-1.1"),
        ({"loop_s": (0.0, 2.0), "start_s": 3.0}, "ends after the start"),
        ({"loop_s": (0.0, float("nan"))}, "loop 0-nan"),
    ],
)
def test_wishes_that_cannot_be_are_refused(tmp_path: Path, wish: dict[str, object], fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        prepare(TrackRequest(file_of(tmp_path), RATE_HZ, **wish), tmp_path)  # type: ignore[arg-type]


def test_what_is_no_music_is_refused_by_name(tmp_path: Path) -> None:
    (tmp_path / "song.mp3").write_bytes(b"nothing")
    with pytest.raises(BadInput, match=r"song\.mp3: .*cannot be read as sound"):
        prepare(TrackRequest(tmp_path / "song.mp3", RATE_HZ), tmp_path)


def test_a_disk_that_refuses_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(DeviceError, match="folder"):
        prepare(TrackRequest(file_of(tmp_path), RATE_HZ), tmp_path / "file" / "folder")


def test_it_is_prepared_in_a_process_of_its_own(tmp_path: Path) -> None:
    good = prepare_in_background(TrackRequest(file_of(tmp_path, 1.0), RATE_HZ), tmp_path / "kept")
    bad = prepare_in_background(TrackRequest(tmp_path / "none.wav", RATE_HZ), tmp_path / "kept")
    assert good.result(60).file.exists()
    with pytest.raises(BadInput, match=r"none\.wav"):
        bad.result(60)


@pytest.mark.parametrize("speed", [0.5, 0.6, 1.5])
def test_a_slowed_track_does_not_drift_in_a_minute(speed: float) -> None:
    """Bursts at odd times: each within 5 ms of its time over the speed, the last ten as the first within 1 ms."""
    at_s = np.arange(1, 59) + np.random.default_rng(4).uniform(0.0, 0.4, 58)
    sound = np.zeros((60 * RATE_HZ, 2), np.float32)
    burst = np.sin(2 * np.pi * 800 * np.arange(2000) / RATE_HZ) * np.exp(-np.arange(2000) / 300)
    for second in at_s:
        sound[round(second * RATE_HZ) :][:2000] += burst[:, None]
    out = np.abs(stretched(sound, RATE_HZ, speed)[:, 0])
    around = np.rint(at_s / speed * RATE_HZ).astype(int)
    windows = np.stack([out[at - 4000 : at + 4000] for at in around])
    off_ms = 1e3 * (np.argmax(windows > 0.3 * windows.max(axis=1, keepdims=True), axis=1) - 4000) / RATE_HZ
    assert np.abs(off_ms).max() < 5.0
    assert abs(off_ms[:10].mean() - off_ms[-10:].mean()) < 1.0
