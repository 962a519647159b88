"""The parts that sounds are made of: ringing modes and bands of noise, as float32 arrays that start at the stroke.

A sum of decaying modes is the real part of Σ cₘ zₘᵗ. With t = a·B + b that is one product of two small matrices,
(cₘ zₘ^{aB}) and (zₘᵇ), which the BLAS does some hundred times faster than one sine after the other.
"""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from station.sound.synth.recipe import Cloud, Glide, Noise, Tone

Mono = NDArray[np.float32]

LN_1000 = float(np.log(1000.0))
"""A decay of 60 dB in amplitude is a factor of 1000."""
_BLOCK = 256
_PRODUCT = 200_000
"""Multiplications in one matrix product. OpenBLAS splits larger ones (262,144) among threads, which wait by spinning:
on a busy computer they lose more time than they save.
"""
_LOOP_S = 1.3
"""Noise repeats after so long: longer than the ear follows a pattern in noise (about half a second)."""
_SKIRT_OCTAVES = 0.8
_TOP_HZ = 19_000.0
"""No noise above: every rate from 44.1 kHz up sounds alike."""
_T60_SPREAD = 0.2


def amplitude_of(level_db: float, t60_s: float) -> float:
    """The initial RMS amplitude of an exponential decay whose energy (mean square × seconds) is `level_db`."""
    return float(np.sqrt(10.0 ** (level_db / 10.0) * 2.0 * LN_1000 / t60_s))


def decay(length: int, t60_s: float, rate_hz: int) -> Mono:
    """exp(−t·ln 1000/t60), float32 (length,)."""
    exponent = np.arange(length, dtype=np.float32) * np.float32(-LN_1000 / (t60_s * rate_hz))
    envelope: Mono = np.exp(exponent)
    return envelope


def rise(sound: Mono, attack_s: float, rate_hz: int) -> Mono:
    """`sound` with its first `attack_s` shaped by a quarter sine squared; written in place."""
    count = min(len(sound), max(1, round(attack_s * rate_hz)))
    sound[:count] *= np.sin(0.5 * np.pi * np.arange(1, count + 1, dtype=np.float32) / count) ** 2
    return sound


def stretched_times(glide: Glide, hardnesses: Sequence[float], length: int, rate_hz: int) -> NDArray[np.float64]:
    """The time by which the tones of a gliding head go, at each hardness: float64 (hardnesses, length), in s.

    A frequency that starts higher by ratio·hardness and settles as exp(−t/τ) is the same frequency in a time that runs
    ahead. Where nothing glides there is one row for all.
    """
    time_s = np.arange(length) / rate_hz
    if not glide.ratio:
        return time_s[None]
    ahead_s = glide.ratio * glide.tau_s * (1.0 - np.exp(-time_s / glide.tau_s))
    return time_s + np.asarray(hardnesses)[:, None] * ahead_s


def tones(row: Tone, times_s: NDArray[np.float64], rate_hz: int) -> NDArray[np.float32]:
    """A tone that starts at zero, by each row of stretched times (k, n): float32 (k, n), of half the row's energy."""
    cycles = row.freq_hz * times_s
    cycles -= np.floor(cycles)
    sound: NDArray[np.float32] = np.sin((2.0 * np.pi * cycles).astype(np.float32))
    sound *= np.float32(amplitude_of(row.level_db, row.t60_s)) * decay(times_s.shape[1], row.t60_s, rate_hz)
    return sound


def halves(row: Cloud | Noise, length: int, rate_hz: int, rng: np.random.Generator) -> NDArray[np.float32]:
    """A row as two halves that do not resemble each other: float32 (2, length), each of half the row's energy."""
    return np.stack(_cloud(row, length, rate_hz, rng) if isinstance(row, Cloud) else _noise(row, length, rate_hz, rng))


def _cloud(row: Cloud, length: int, rate_hz: int, rng: np.random.Generator) -> tuple[Mono, Mono]:
    """The cloud's modes, dealt at random into two halves.

    The modes lie one in each equal slot between the row's frequencies, the higher the shorter; their amplitudes are
    Rayleigh-distributed, as where a stroke falls at a random place of a plate. Modes at or above the Nyquist frequency
    are left out.
    """
    slots = np.linspace(row.low_hz, row.high_hz, row.count, endpoint=False)
    freq_hz = slots + rng.uniform(0.0, (row.high_hz - row.low_hz) / row.count, row.count)
    t60_s = row.t60_s * np.sqrt(row.pitch_hz / freq_hz) * rng.uniform(1.0 - _T60_SPREAD, 1.0 + _T60_SPREAD, row.count)
    sizes = rng.rayleigh(1.0, row.count)
    phase_rad = rng.uniform(0.0, 2.0 * np.pi, row.count)
    sizes *= np.sqrt(2.0) * amplitude_of(row.level_db, row.t60_s) / np.sqrt(np.sum(sizes**2))
    sizes[freq_hz >= 0.5 * rate_hz] = 0.0
    order = rng.permutation(row.count)
    amplitude = sizes * np.exp(1j * phase_rad)
    left, right = (
        rise(_ring(freq_hz[part], amplitude[part], t60_s[part], length, rate_hz), row.attack_s, rate_hz)
        for part in (order[::2], order[1::2])
    )
    return left, right


def _ring(
    freq_hz: NDArray[np.float64],
    amplitude: NDArray[np.complex128],
    t60_s: NDArray[np.float64],
    length: int,
    rate_hz: int,
) -> Mono:
    """Re Σ amplitude·exp((−ln 1000/t60 + 2πi·freq)·t), float32 (length,)."""
    exponent = (-LN_1000 / t60_s + 2j * np.pi * freq_hz) / rate_hz
    rows = max(1, _PRODUCT // (2 * len(freq_hz) * _BLOCK))
    batches = -(-length // (rows * _BLOCK))
    coarse = amplitude * np.exp(np.arange(batches * rows)[:, None] * _BLOCK * exponent)
    fine = np.exp(exponent[:, None] * np.arange(_BLOCK))
    left = np.concatenate([coarse.real, -coarse.imag], axis=1).astype(np.float32)
    right = np.concatenate([fine.real, fine.imag], axis=0).astype(np.float32)
    whole: Mono = np.matmul(left.reshape(batches, rows, -1), right).reshape(-1)
    return whole[:length]


def _noise(row: Noise, length: int, rate_hz: int, rng: np.random.Generator) -> tuple[Mono, Mono]:
    """Two stretches of the row's noise, half its own length apart."""
    loop = _noise_loop(row.low_hz, row.high_hz, rate_hz)
    envelope = np.float32(np.sqrt(0.5) * amplitude_of(row.level_db, row.t60_s)) * decay(length, row.t60_s, rate_hz)
    envelope = rise(envelope, row.attack_s, rate_hz)
    start = int(rng.integers(len(loop)))
    left, right = (np.resize(np.roll(loop, -(start + shift)), length) for shift in (0, len(loop) // 2))
    return left * envelope, right * envelope


@lru_cache(maxsize=256)
def _noise_loop(low_hz: float, high_hz: float, rate_hz: int) -> Mono:
    """Noise of RMS 1 between two frequencies, with soft skirts, that repeats without a seam."""
    octaves, spectrum = _white(rate_hz)
    octaves_out = np.maximum(np.log2(low_hz) - octaves, octaves - np.log2(high_hz))
    inside = 0.5 + 0.5 * np.cos(np.pi * np.clip(octaves_out / _SKIRT_OCTAVES, 0.0, 1.0))
    inside[octaves > np.log2(_TOP_HZ)] = 0.0
    loop: Mono = np.fft.irfft(inside * spectrum).astype(np.float32)
    loop /= np.sqrt(np.mean(np.square(loop)))
    return loop


@lru_cache(maxsize=4)
def _white(rate_hz: int) -> tuple[NDArray[np.float32], NDArray[np.complex64]]:
    """Where each line of the noise's spectrum lies, as log₂ Hz, and the spectrum: float32 and complex64, (n/2 + 1,)."""
    length = 1 << (round(_LOOP_S * rate_hz) - 1).bit_length()
    freq_hz = np.fft.rfftfreq(length, 1.0 / rate_hz)
    freq_hz[0] = 1e-3
    spectrum = np.fft.rfft(np.random.default_rng(1).standard_normal(length))
    return np.log2(freq_hz).astype(np.float32), spectrum.astype(np.complex64)
