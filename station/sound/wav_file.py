"""Sound as a WAV file: 16 bits, which every program reads."""

import wave
from io import BytesIO
from pathlib import Path

import numpy as np

from station.core.disk.files import write_whole
from station.sound.drum_kit import Frames

_FULL, _BYTES = 32767, 2


def write_wav(frames: Frames, rate_hz: int, path: Path) -> None:
    """Write float `frames` (n, channels) of full scale ±1, clipped there, whole or not at all; raises `DeviceError`."""
    buffer = BytesIO()
    with wave.open(buffer, "wb") as file:
        file.setnchannels(frames.shape[1])
        file.setsampwidth(_BYTES)
        file.setframerate(rate_hz)
        file.writeframes(np.rint(np.clip(frames, -1, 1) * _FULL).astype("<i2").tobytes())
    write_whole(path, buffer.getvalue())
