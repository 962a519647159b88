"""Expected values: the autocovariances of the model of `student_timing`, worked out here as a linear filter.

Bounds are four standard errors. Of a mean: SD·√((1 + 2·Σρₖ)/n); of an SD: SD·√((1 + 2·Σρₖ²)/2n); of a correlation:
√((1 + 2·Σρₖ²)/n), at most.
"""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from station.simulation.student_timing import (
    CORRECTION,
    LEAN_REACH,
    MOTOR_SHARE,
    Timekeeper,
    correction,
    leans,
    sway_s,
    timekeeper_noise_sd,
)

SLOTS = 100_000


def _impulse_autocovariance(alpha: float, sigma_c: float, sigma_m: float, lags: int) -> NDArray[np.float64]:
    """Autocovariance of A from its two impulse responses, each summed over 400 slots: another way than the head's."""
    k = np.arange(400)
    to_timekeeper = np.where(k >= 1, (1 - alpha) ** np.maximum(k - 1, 0), 0.0)
    to_motor = np.where(k >= 1, -alpha * (1 - alpha) ** np.maximum(k - 1, 0), 1.0)
    return np.array(
        [
            sigma_c**2 * float(to_timekeeper[: 400 - lag] @ to_timekeeper[lag:])
            + sigma_m**2 * float(to_motor[: 400 - lag] @ to_motor[lag:])
            for lag in range(lags)
        ]
    )


def _played(interval_s: float, seed: int = 5) -> NDArray[np.float64]:
    timekeeper, motor = Timekeeper(np.random.default_rng(seed)).run(np.full(SLOTS, interval_s))
    return timekeeper + motor


def _autocorrelation(x: NDArray[np.float64], lag: int) -> float:
    x = x - x.mean()
    return float(x[:-lag] @ x[lag:] / (x @ x))


@pytest.mark.parametrize("interval_s", [0.06, 0.125, 0.25, 1.0])
def test_the_noise_is_what_makes_the_variance_one(interval_s: float) -> None:
    alpha = correction(interval_s)
    covariance = _impulse_autocovariance(alpha, timekeeper_noise_sd(alpha), math.sqrt(MOTOR_SHARE), 4)
    np.testing.assert_allclose(covariance[0], 1.0, rtol=1e-6)
    np.testing.assert_allclose(covariance[1], 1.0 - MOTOR_SHARE - alpha, rtol=1e-6)
    np.testing.assert_allclose(covariance[3], covariance[1] * (1 - alpha) ** 2, rtol=1e-6)


@pytest.mark.parametrize("interval_s", [0.06, 0.25])
def test_asynchronies_are_stationary_with_that_autocorrelation(interval_s: float) -> None:
    alpha = correction(interval_s)
    rho = _impulse_autocovariance(alpha, timekeeper_noise_sd(alpha), math.sqrt(MOTOR_SHARE), 100)[1:]
    x = _played(interval_s)
    loss = 1 + 2 * float(rho @ rho)
    assert abs(x.mean()) < 4 * math.sqrt((1 + 2 * rho.sum()) / SLOTS)
    for part in np.split(x, 4):
        assert abs(part.std() - 1.0) < 4 * math.sqrt(loss / (2 * len(part)))
    for lag in (1, 2, 3):
        assert abs(_autocorrelation(x, lag) - rho[lag - 1]) < 4 * math.sqrt(loss / SLOTS)


def test_the_first_stroke_has_the_same_spread_as_the_last() -> None:
    firsts = np.array([_sum_of_first(seed) for seed in range(2000)])
    assert abs(firsts.std() - 1.0) < 4 / math.sqrt(2 * len(firsts))


def _sum_of_first(seed: int) -> float:
    timekeeper, motor = Timekeeper(np.random.default_rng(seed)).run(np.array([0.5]))
    return float(timekeeper[0] + motor[0])


def test_lag_one_is_what_is_seen_in_drummers() -> None:
    """HUMANS, "Timing": .21–.37 within a take, up to .45 under 130 bpm; eighths at 120 and sixteenths at 120 bpm."""
    for interval_s in (0.25, 0.125):
        assert 0.21 <= 1 - MOTOR_SHARE - correction(interval_s) <= 0.45


def test_the_parts_are_of_human_size() -> None:
    """HUMANS, "Timing": at 250 ms σ_C is 8 ms and σ_M 4–8 ms; an SD of 12 ms is a good amateur's there."""
    assert 6.0 < 12.0 * timekeeper_noise_sd(CORRECTION) < 10.0
    assert 4.0 < 12.0 * math.sqrt(MOTOR_SHARE) < 8.0


def test_the_timekeeper_goes_on_from_one_score_to_the_next() -> None:
    """Neighbours of B correlate by 1 − α: M is independent of it, C too. SE of a correlation ρ: (1 − ρ²)/√n."""
    seams = np.array([_seam(seed) for seed in range(1500)])
    expected = 1 - CORRECTION
    measured = float(np.corrcoef(seams.T)[0, 1])
    assert abs(measured - expected) < 4 * (1 - expected**2) / math.sqrt(len(seams))


def _seam(seed: int) -> tuple[float, float]:
    timekeeper = Timekeeper(np.random.default_rng(seed))
    before, after = timekeeper.run(np.full(3, 0.25))[0], timekeeper.run(np.full(3, 0.25))[0]
    return float(before[-1]), float(after[0])


def test_leans_balance_over_the_strokes_and_stay_small() -> None:
    limbs = np.array([0] * 90 + [1] * 9 + [2], np.int8)
    lean = leans(limbs, np.array([1.0, -1.0, 0.5, 0.0]))
    assert abs(lean.mean()) < 1e-12
    assert lean.std() <= LEAN_REACH
    assert len(set(lean.tolist())) == 3
    assert np.abs(lean).max() <= 2 * LEAN_REACH


def test_one_limb_alone_does_not_lean() -> None:
    np.testing.assert_allclose(leans(np.zeros(10, np.int8), np.array([0.7, 0.1, 0.2, 0.3])), 0.0, atol=1e-12)


def test_the_sway_is_the_integral_of_the_tempo() -> None:
    """The oracle adds up 1 ms steps that each last 1 − depth·sin of themselves."""
    at_s = np.arange(0, 90, 0.001)
    durations = 0.001 * (1 - 0.03 * np.sin(2 * np.pi * (at_s + 0.0005) / 60))
    expected = np.concatenate([[0], np.cumsum(durations)])[:-1] - at_s
    np.testing.assert_allclose(sway_s(at_s, 0.03), expected, atol=1e-6)
    assert sway_s(np.array([30.0]), 0.03)[0] == pytest.approx(-0.03 * 60 / math.pi)
