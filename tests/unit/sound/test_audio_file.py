from pathlib import Path

import numpy as np
import pytest
import soundfile

from station.core.errors import BadInput
from station.sound.samples.audio_file import read_audio, resampled, to_stereo
from tests.fakes.sound_files import steady, wav


@pytest.mark.parametrize("ending", ["wav", "flac", "ogg", "mp3"])
def test_every_promised_format_is_read(tmp_path: Path, ending: str) -> None:
    tone = 0.5 * np.sin(2 * np.pi * 440 * np.arange(48_000) / 48_000)
    path = tmp_path / f"tone.{ending}"
    soundfile.write(path, np.column_stack([tone, tone]), 48_000)
    frames = read_audio(path, "tone", 48_000, 10.0)
    middle = frames[12_000:36_000]
    assert frames.dtype == np.float32
    # the RMS of a sine is its peak over root two; lossy formats come near it
    assert np.sqrt(np.mean(middle**2)) == pytest.approx(0.5 / np.sqrt(2), rel=0.02)


@pytest.mark.parametrize(("from_hz", "to_hz"), [(44_100, 48_000), (48_000, 44_100), (48_000, 96_000), (96_000, 44_100)])
def test_a_tone_keeps_its_pitch_and_level_at_any_rate(from_hz: int, to_hz: int) -> None:
    tone = np.sin(2 * np.pi * 1000 * np.arange(from_hz) / from_hz)
    out = resampled(to_stereo(tone.astype(np.float32)[:, None]), from_hz, to_hz)[:, 0]
    expected = np.sin(2 * np.pi * 1000 * np.arange(len(out)) / to_hz)
    inner = slice(to_hz // 10, -to_hz // 10)
    assert abs(len(out) - to_hz) <= 1
    assert np.abs(out - expected)[inner].max() < 1e-4


def test_an_octave_up_halves_the_length_and_doubles_the_pitch() -> None:
    tone = 0.5 * np.sin(2 * np.pi * 500 * np.arange(48_000) / 48_000)
    frames = read_audio(wav(tone), "tone", 48_000, 10.0, pitch=12.0)
    spectrum = np.abs(np.fft.rfft(frames[:, 0]))
    assert abs(len(frames) - 24_000) <= 1
    assert np.argmax(spectrum) * 48_000 / len(frames) == pytest.approx(1000, abs=3)


def test_channels_fold_to_two() -> None:
    mono = read_audio(wav(np.full(100, 0.25)), "mono", 48_000, 1.0)
    four = read_audio(wav(np.tile([0.1, 0.2, 0.3, 0.4], (100, 1))), "four", 48_000, 1.0)
    assert mono[50] == pytest.approx([0.25, 0.25], abs=1e-4)
    assert four[50] == pytest.approx([0.2, 0.3], abs=1e-4)  # the means of 1st and 3rd, of 2nd and 4th


def test_no_more_than_asked_is_read() -> None:
    assert len(read_audio(steady(0.1, 2.0), "long", 48_000, 0.5)) == 24_000


@pytest.mark.parametrize("data", [b"", b"RIFF", b"not a sound", wav(np.zeros(0)), steady(0.1)[:30]])
def test_what_is_no_sound_is_refused_by_name(data: bytes) -> None:
    with pytest.raises(BadInput, match=r"^broken\.wav"):
        read_audio(data, "broken.wav", 48_000, 1.0)


def test_numbers_that_are_none_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "nan.wav"
    soundfile.write(path, np.array([0.0, np.nan, 0.5], np.float32), 48_000, subtype="FLOAT")
    with pytest.raises(BadInput, match="numbers that are no sound"):
        read_audio(path, "nan.wav", 48_000, 1.0)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="nowhere"):
        read_audio(tmp_path / "nowhere.wav", "nowhere", 48_000, 1.0)


def test_a_header_that_promises_hours_takes_no_memory_for_them() -> None:
    data = bytearray(steady(0.1, 0.01))
    data[40:44] = (0xFFFFFF00).to_bytes(4, "little")  # the length of the data chunk: 4 GB
    assert len(read_audio(bytes(data), "liar", 48_000, 12.0)) <= 12 * 48_000


@pytest.mark.parametrize("peak", [17.0, 32_768.0, 1e38])
def test_floats_far_over_full_scale_are_refused(tmp_path: Path, peak: float) -> None:
    """Whole numbers that somebody called floats, or rubbish: they would sound as a burst."""
    path = tmp_path / "loud.wav"
    soundfile.write(path, np.array([[0.1], [peak]]), 48_000, subtype="FLOAT")
    with pytest.raises(BadInput, match="full scale is 1"):
        read_audio(path, "loud.wav", 48_000, 1.0)


def test_a_long_file_is_read_whole_piece_by_piece(tmp_path: Path) -> None:
    path, ramp = tmp_path / "ramp.wav", np.linspace(-1.0, 1.0, 150_001)
    soundfile.write(path, ramp, 48_000, subtype="FLOAT")
    frames = read_audio(path, "ramp.wav", 48_000, 10.0)
    assert np.array_equal(frames[:, 0], ramp.astype(np.float32))


@pytest.mark.parametrize("ending", ["flac", "ogg", "mp3"])
def test_a_file_cut_anywhere_is_read_up_to_there_or_refused(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"cut.{ending}"
    soundfile.write(path, 0.3 * np.sin(np.arange(40_000) / 9.0), 48_000)
    data = path.read_bytes()
    for length in range(0, len(data), len(data) // 23):
        try:
            frames = read_audio(data[:length], "cut", 48_000, 2.0)
        except BadInput:
            continue
        assert 1 <= len(frames) <= 50_000
        assert np.abs(frames).max() < 0.4  # what was written, and what a lossy format makes of it


def test_an_mp3_without_its_end_plays_up_to_there(tmp_path: Path) -> None:
    """Its header still promises the whole; what follows in memory is not sound."""
    path = tmp_path / "cut.mp3"
    soundfile.write(path, 0.3 * np.sin(np.arange(40_000) / 9.0), 48_000)
    data = path.read_bytes()
    frames = read_audio(data[: len(data) // 2], "cut", 48_000, 2.0)
    assert 10_000 < len(frames) < 25_000  # about half; the decoder starts late and frames are of 1,152
    assert np.abs(frames).max() < 0.4
