"""Benchmarks of time: how exactly blocks are placed on a card that drifts, and how exactly latency is measured."""

import numpy as np
from numpy.typing import NDArray

from station.bench.harness.benchmark import Benchmark, Measurement
from station.core.units import NS_PER_MS, NS_PER_S
from station.sound.calibration.chirp import train
from station.sound.calibration.loopback import LoopbackRound, loopback
from station.sound.calibration.timeline import TimedRecording, Timeline
from station.sound.output.dac_clock import DacClock

RATE_HZ = 48_000
BLOCK_FRAMES = 128
_DRIFT_PPM = 200.0
"""Twice what is sold as a sound card's crystal."""
_JITTER_NS = 0.5 * NS_PER_MS
_LATE_SHARE, _LATE_NS = 0.01, 20.0 * NS_PER_MS
_MINUTES = 2
_SETTLED_S = 10
_BEGIN_NS = 10**13
_DELAY_FRAMES = 592.56
"""12.345 ms."""
_NOISE = 0.1
"""RMS of full scale; the chirps come back with a fifth of `chirp.PEAK`, 12 dB below it."""
_GAIN = 0.2
_ROUNDS = 3


def _block_time() -> Measurement:
    """The greatest error of a block's time by reports that jitter and come late; beside it, by the nominal rate."""
    rng = np.random.default_rng(1)
    blocks = _MINUTES * 60 * RATE_HZ // BLOCK_FRAMES
    true_ns = np.arange(blocks) * BLOCK_FRAMES * NS_PER_S / (RATE_HZ * (1 + _DRIFT_PPM / 1e6))
    late_ns = rng.normal(0.0, _JITTER_NS, blocks) + (rng.random(blocks) < _LATE_SHARE) * rng.uniform(
        0, _LATE_NS, blocks
    )
    reported = _BEGIN_NS + np.round(true_ns + late_ns).astype(np.int64)
    clock = DacClock(RATE_HZ)
    said = np.array([clock.block(BLOCK_FRAMES, at_ns) for at_ns in reported.tolist()]) - _BEGIN_NS
    settled = np.arange(blocks) * BLOCK_FRAMES > _SETTLED_S * RATE_HZ
    uncorrected = np.arange(blocks) * BLOCK_FRAMES * NS_PER_S / RATE_HZ - true_ns
    return Measurement(
        float(np.abs(said - true_ns)[settled].max()) / NS_PER_MS,
        float(np.abs(uncorrected).max()) / NS_PER_MS,
        f"{_DRIFT_PPM:.0f} parts in a million, {_MINUTES} minutes",
    )


def _loopback() -> Measurement:
    """The error of a loopback in noise that is louder than what comes back."""
    rng = np.random.default_rng(2)
    found = loopback([_round(rng) for _ in range(_ROUNDS)])
    error_ms = abs(found.value_ms - 1e3 * _DELAY_FRAMES / RATE_HZ)
    return Measurement(error_ms, note=f"said to be within {found.half_ms:.3f} ms")


def _round(rng: np.random.Generator) -> LoopbackRound:
    sound, starts = train(RATE_HZ)
    count = len(sound) + 2 * RATE_HZ
    heard = _GAIN * _delayed(sound, count) + _NOISE * rng.standard_normal(count)
    frames = np.arange(0, count, BLOCK_FRAMES)
    timeline = Timeline(frames, _BEGIN_NS + np.round(frames * NS_PER_S / RATE_HZ).astype(np.int64), RATE_HZ)
    played = _BEGIN_NS + np.round(starts * NS_PER_S / RATE_HZ).astype(np.int64)
    return LoopbackRound(played, TimedRecording(heard.astype(np.float32)[:, None], timeline))


def _delayed(sound: NDArray[np.float32], count: int) -> NDArray[np.float64]:
    """`sound` later by `_DELAY_FRAMES`, between frames by the spectrum's phase."""
    spectrum = np.fft.rfft(np.asarray(sound, np.float64), count)
    shifted: NDArray[np.float64] = np.fft.irfft(
        spectrum * np.exp(-2j * np.pi * np.fft.rfftfreq(count) * _DELAY_FRAMES), count
    )
    return shifted


BENCHMARKS = (
    Benchmark("block_time_error_max_on_a_drifting_card", "ms", 0.1, "lower", "the nominal rate", _block_time),
    Benchmark("loopback_error_in_noise", "ms", 0.05, "lower", None, _loopback),
)
