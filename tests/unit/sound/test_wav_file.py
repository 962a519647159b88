"""WAV files read by soundfile, another's reader."""

from pathlib import Path

import numpy as np
import pytest
import soundfile

from station.core.errors import DeviceError
from station.sound.wav_file import write_wav


def test_a_file_reads_back(tmp_path: Path) -> None:
    frames = np.array([[0.0, 0.5], [-0.25, 1.5], [-2.0, 0.125]], np.float32)
    write_wav(frames, 44_100, tmp_path / "a.wav")
    read, rate_hz = soundfile.read(tmp_path / "a.wav")
    assert rate_hz == 44_100
    assert read == pytest.approx(np.clip(frames, -1, 1), abs=1 / 16_384)


def test_a_place_that_cannot_be_written_to(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(DeviceError):
        write_wav(np.zeros((1, 2), np.float32), 48_000, tmp_path / "file" / "a.wav")
