"""Benchmarks of the phase tracker: a sample of 12 channels live, and in a whole signal, plain numpy's time beside ours.

The signal is what two IMUs of six axes give: smooth periodic channels with noise, at a tenth more than the cadence that
is expected, so that every sample surprises the tracker.
"""

from collections.abc import Callable

import numpy as np

from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.sync.phase.periodic_model import TURN, Exemplar, PeriodicModel, centres, fitted, wrapped
from station.sync.phase.phase_tracker import ADAPTIVE, PAPER, PhaseTracker, TrackerSettings, tracked
from station.sync.signals.signal import FloatArray

_CHANNELS = 12
_LIVE, _WHOLE = 5_000, 500_000
_NOISE = 0.2
_PER_US = 1e6
_TIMES, _WHOLE_TIMES = 9, 3


def periodic_model() -> PeriodicModel:
    """Twelve sines of one to three turns a period."""
    phase = np.linspace(0, TURN, 200, endpoint=False)
    values = np.stack([np.sin((at % 3 + 1) * phase + at) for at in range(_CHANNELS)], axis=1)
    return fitted([str(at) for at in range(_CHANNELS)], [Exemplar(values, phase)])


def noisy_signal(model: PeriodicModel, count: int) -> FloatArray:
    """What the model does, with noise (count, 12)."""
    values = model.values(np.arange(count, dtype=np.float64) * (1.1 * PAPER.cadence_rad))
    noise = np.random.default_rng(0).standard_normal((count, _CHANNELS))
    values += _NOISE * noise
    return values


def plain_tracker(model: PeriodicModel) -> Callable[[FloatArray], float]:
    """The paper's three steps as numpy says them, all centres each time: how one would write it first."""
    count = model.centre_count
    mu = centres(count)
    f = model.at(mu)
    f /= np.linalg.norm(f, axis=1, keepdims=True)
    phase_rad = 0.0

    def step(sample: FloatArray) -> float:
        nonlocal phase_rad
        y = sample - model.mean
        turns = wrapped(mu - (phase_rad + PAPER.cadence_rad)) / TURN
        e = f @ y / np.linalg.norm(y) - PAPER.smoothing * turns**2
        j = int(np.argmax(e))
        below, here, above = e[j - 1], e[j], e[(j + 1) % count]
        phase_rad = float(mu[j] - (above - below) / (above + below - 2 * here) / 2 * TURN / count)
        return phase_rad

    return step


def _live(settings: TrackerSettings) -> Measurement:
    model = periodic_model()
    samples = list(noisy_signal(model, _LIVE))

    def run(step: Callable[[FloatArray], object]) -> float:
        return median_s(lambda: [step(sample) for sample in samples], _TIMES) / _LIVE * _PER_US

    return Measurement(run(PhaseTracker(model, settings).step), run(plain_tracker(model)))


def _whole(settings: TrackerSettings) -> Measurement:
    model = periodic_model()
    values = noisy_signal(model, _WHOLE)
    taken = median_s(lambda: tracked(model, values, settings), _WHOLE_TIMES) / _WHOLE * _PER_US
    step, few = plain_tracker(model), list(values[:_LIVE])
    plain = median_s(lambda: [step(sample) for sample in few], _WHOLE_TIMES) / _LIVE * _PER_US
    return Measurement(taken, plain)


_PEER = "plain numpy, sample by sample"
BENCHMARKS = (
    Benchmark("phase_live_12_channels", "us", 5.0, "lower", _PEER, lambda: _live(PAPER)),
    Benchmark("phase_live_12_channels_adaptive", "us", 5.0, "lower", _PEER, lambda: _live(ADAPTIVE)),
    Benchmark("phase_batch_12_channels", "us", 0.2, "lower", _PEER, lambda: _whole(PAPER)),
    Benchmark("phase_batch_12_channels_adaptive", "us", None, "lower", _PEER, lambda: _whole(ADAPTIVE)),
)
