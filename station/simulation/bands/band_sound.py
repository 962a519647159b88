"""How the virtual band sounds: drums, plucked bass, strummed chords, pads and a voice, in a room, by numpy alone.

A stroke or a pluck begins on its sample; pads and voices swell. Nothing of `station.sound` is used, so that what
listens there is not measured by itself.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece

Mono = NDArray[np.float32]
RATE_HZ = 44_100


@dataclass(frozen=True, slots=True)
class BandMix:
    """How loud each part is (1 is usual, 0 is left out), and the room."""

    drums: float = 1.0
    bass: float = 1.0
    chords: float = 1.0
    pad: float = 1.0
    voice: float = 1.0
    room: float = 0.15
    noise: float = 0.001


TAKES = 6
"""No two strokes in a row are the same noise."""


@lru_cache(maxsize=512)
def stroke(piece: Piece, velocity: int, take: int) -> Mono:
    """One stroke, its attack on sample 0; `take` 0 … `TAKES` − 1."""
    rng = np.random.default_rng(take)
    if piece == Piece.KICK:
        sound = _drum(55.0, 110.0, 0.12, 0.05, rng)
    elif piece == Piece.SNARE:
        sound = _drum(190.0, 40.0, 0.06, 0.6, rng)
    elif piece in (Piece.HIHAT, Piece.HIHAT_PEDAL):
        sound = 0.25 * _cymbal(0.035, rng)
    elif piece in (Piece.RIDE, Piece.CRASH_1):
        sound = (0.2 if piece == Piece.RIDE else 0.4) * _cymbal(0.12 if piece == Piece.RIDE else 0.6, rng)
    else:
        sound = _drum(130.0 if piece == Piece.TOM_1 else 85.0, 30.0, 0.15, 0.08, rng)
    return (sound * (velocity / 127) ** 2).astype(np.float32)


def _drum(
    freq_hz: float, sweep_hz: float, decay_s: float, wires: float, rng: np.random.Generator
) -> NDArray[np.float64]:
    t = np.arange(round(5 * decay_s * RATE_HZ)) / RATE_HZ
    phase = 2 * np.pi * (freq_hz * t + sweep_hz * 0.02 * (1 - np.exp(-t / 0.02)))
    skin = np.sin(phase + 0.5) * np.exp(-t / decay_s)
    return 0.8 * skin + wires * rng.normal(0.0, 0.5, len(t)) * np.exp(-t / (0.004 if wires < 0.3 else 0.09))


def _cymbal(decay_s: float, rng: np.random.Generator) -> NDArray[np.float64]:
    t = np.arange(round(5 * decay_s * RATE_HZ)) / RATE_HZ
    noise = rng.normal(0.0, 1.0, len(t) + 2)
    return (noise[2:] - 2 * noise[1:-1] + noise[:-2]) * np.exp(-t / decay_s) * 0.4


@lru_cache(maxsize=512)
def pluck(freq_hz: float, length_s: float, bright: float) -> Mono:
    """A plucked or picked string: harmonics that decay, the higher the sooner; full after 2 ms."""
    t = np.arange(round(length_s * RATE_HZ)) / RATE_HZ
    sound = np.zeros(len(t))
    for k in range(1, 12):
        if k * freq_hz < RATE_HZ / 2:
            sound += np.sin(2 * np.pi * k * freq_hz * t + k) * bright ** (k - 1) * np.exp(-t * (2.0 + 1.5 * k))
    ending = np.clip((length_s - t) / 0.01, 0.0, 1.0)
    return (0.3 * sound * np.minimum(t / 0.002, 1.0) * ending).astype(np.float32)


@lru_cache(maxsize=512)
def swell(freq_hz: float, length_s: float, rise_s: float, vibrato: float) -> Mono:
    """A pad or a sung note: it rises in `rise_s`, and tells no time."""
    t = np.arange(round(length_s * RATE_HZ)) / RATE_HZ
    phase = 2 * np.pi * freq_hz * t + vibrato * np.sin(2 * np.pi * 5.5 * t)
    sound = sum(np.sin(k * phase) / k**1.5 for k in range(1, 7))
    shape = np.minimum(t / rise_s, 1.0) * np.clip((length_s - t) / 0.1, 0.0, 1.0)
    return np.asarray(0.08 * sound * shape, np.float32)


def add(mix: Mono, at_s: float, sound: Mono, gain: float = 1.0) -> None:
    """Put `sound` into `mix` at `at_s`, as far as it fits."""
    first = round(at_s * RATE_HZ)
    end = min(len(mix), first + len(sound))
    if 0 <= first < end:
        mix[first:end] += np.float32(gain) * sound[: end - first]


def in_a_room(dry: Mono, wet: float, rng: np.random.Generator) -> Mono:
    """`dry` with a decaying, diffuse echo of 0.8 s from 8 ms on."""
    if wet == 0.0:
        return dry
    t = np.arange(round(0.8 * RATE_HZ)) / RATE_HZ
    echo = rng.normal(0.0, 1.0, len(t)) * np.exp(-t / 0.15) * (t > 0.008)
    echo *= wet / np.sqrt(np.sum(echo**2))
    size = 1 << 17
    step, wave = size - len(echo), np.fft.rfft(echo, size)
    tail = np.zeros(len(dry) + size)
    for first in range(0, len(dry), step):
        tail[first : first + size] += np.fft.irfft(np.fft.rfft(dry[first : first + step], size) * wave, size)
    return (dry + tail[: len(dry)]).astype(np.float32)
