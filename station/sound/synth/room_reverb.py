"""The room around the drums: a few early reflections and a short, darkening tail, different for each ear.

A dry drum sounds like a machine; some energy that arrives 5–200 ms later from everywhere sounds like a drum in a room.
"""

from functools import lru_cache

import numpy as np

from station.sound.drum_kit import Frames
from station.sound.synth.sound_parts import Mono, decay

LENGTH_S = 0.22
_T60_S = 0.28
"""A small, damped practice room (our choice)."""
_FIRST_S = 0.004
_REFLECTIONS = 7
_LAST_S = 0.028
_DARKENING_HZ = 5000.0
_SOURCE_S = 0.35
"""So much of a sound excites the room; what comes later is masked by the sound itself."""


def in_room(dry: Mono, rate_hz: int) -> Frames:
    """What the room adds to `dry` (n,): float32 (n, 2), without the direct sound, of the same energy as `dry`."""
    source = dry[: round(_SOURCE_S * rate_hz)].copy()
    fade = len(source) // 3
    source[-fade:] *= np.linspace(1.0, 0.0, fade, dtype=np.float32)
    response = _response(rate_hz)
    size = 1 << (len(source) + len(response) - 1).bit_length()
    spectrum = np.fft.rfft(source, size)[:, None] * np.fft.rfft(response, size, axis=0)
    wet = np.fft.irfft(spectrum, size, axis=0)[: len(dry)].astype(np.float32)
    energy = float(np.sum(wet**2)) / 2.0
    if energy > 0.0:
        wet *= np.float32(np.sqrt(float(np.sum(dry**2)) / energy))
    if len(wet) < len(dry):
        wet = np.concatenate([wet, np.zeros((len(dry) - len(wet), 2), np.float32)])
    return wet


@lru_cache(maxsize=8)
def _response(rate_hz: int) -> Frames:
    """The impulse response (n, 2) of the room without the direct sound."""
    length = round(LENGTH_S * rate_hz)
    rng = np.random.default_rng(7)
    ears = []
    for _ in range(2):
        tail = rng.standard_normal(length).astype(np.float32) * decay(length, _T60_S, rate_hz)
        tail[: round(_LAST_S * rate_hz)] *= np.linspace(0.0, 1.0, round(_LAST_S * rate_hz), dtype=np.float32)
        times_s = np.geomspace(_FIRST_S, _LAST_S, _REFLECTIONS) * rng.uniform(0.9, 1.1, _REFLECTIONS)
        first = np.zeros(length, np.float32)
        first[np.round(times_s * rate_hz).astype(int)] = rng.choice([-1.0, 1.0], _REFLECTIONS) * _FIRST_S / times_s
        first *= np.float32(np.sqrt(np.sum(tail**2) / np.sum(first**2)))
        ears.append(_darken(tail + first, rate_hz))
    return np.column_stack(ears).astype(np.float32)


def _darken(sound: Mono, rate_hz: int) -> Mono:
    """A first-order low-pass at `_DARKENING_HZ`, and nothing below 60 Hz, where a small room does not ring."""
    freq_hz = np.fft.rfftfreq(len(sound), 1.0 / rate_hz)
    shape = (1.0 / np.sqrt(1.0 + (freq_hz / _DARKENING_HZ) ** 2)) * np.clip(freq_hz / 60.0 - 0.5, 0.0, 1.0)
    return np.fft.irfft(np.fft.rfft(sound) * shape, len(sound)).astype(np.float32)
