import numpy as np
import pytest

from station.motion.kinematics.splines import SplineChannels, cubics, monotone_slopes, slopes

TIMES = np.array([0.0, 1.0, 2.0, 3.0, 4.0])
VALUES = np.array([0.0, 2.0, 1.0, 5.0, 5.0])


def kochanek_bartels(values: list[float], i: int, t: float, c: float, b: float) -> tuple[float, float]:
    """Equations 8 and 9 of Kochanek and Bartels (1984) as printed: source and destination derivative at key i."""
    before, after = values[i] - values[i - 1], values[i + 1] - values[i]
    source = ((1 - t) * (1 - c) * (1 + b)) / 2 * before + ((1 - t) * (1 + c) * (1 - b)) / 2 * after
    destination = ((1 - t) * (1 + c) * (1 + b)) / 2 * before + ((1 - t) * (1 - c) * (1 - b)) / 2 * after
    return source, destination


@pytest.mark.parametrize(("t", "c", "b"), [(0, 0, 0), (0.5, 0, 0), (0, 0.4, 0), (0, 0, -0.6), (0.3, -0.5, 0.2)])
def test_slopes_are_the_published_ones_on_even_keys(t: float, c: float, b: float) -> None:
    into, out = slopes(TIMES, VALUES, t, c, b)
    for i in (1, 2, 3):
        assert (into[i], out[i]) == pytest.approx(kochanek_bartels(VALUES.tolist(), i, t, c, b))


def test_natural_slope_on_uneven_keys_is_that_of_the_parabola() -> None:
    times = np.array([0.0, 1.0, 4.0])
    into, out = slopes(times, 3 * times**2 - times)
    assert into[1] == pytest.approx(5.0)  # d/dt (3t² − t) at 1
    assert out[1] == pytest.approx(5.0)


def test_continuity_minus_one_breaks_the_slope() -> None:
    into, out = slopes(TIMES, VALUES, 0.0, -1.0, 0.0)
    assert into[2] == pytest.approx(-1.0)  # the chord before
    assert out[2] == pytest.approx(4.0)  # the chord after


def test_a_curve_passes_its_keys_and_holds_its_ends() -> None:
    into, out = slopes(TIMES, VALUES)
    curves = SplineChannels(TIMES, cubics(TIMES, VALUES, into, out)[:, None, :])
    for t, v in zip(TIMES.tolist(), VALUES.tolist(), strict=True):
        assert curves.at(t) == [pytest.approx(v)]
    assert curves.at(-5.0) == [0.0]
    assert curves.at(9.0) == [5.0]


def test_one_instant_and_many_agree() -> None:
    into, out = slopes(TIMES, VALUES, 0.1, 0.2, 0.3)
    curves = SplineChannels(TIMES, cubics(TIMES, VALUES, into, out)[:, None, :])
    at = np.linspace(-1, 5, 61)
    assert curves.many(at)[0] == pytest.approx([curves.at(t)[0] for t in at.tolist()])


def test_keys_at_one_time_are_a_step_without_a_nan() -> None:
    times = np.array([0.0, 1.0, 1.0, 2.0])
    values = np.array([0.0, 0.0, 1.0, 1.0])
    into, out = slopes(times, values, 1.0)
    curves = SplineChannels(times, cubics(times, values, into, out)[:, None, :])
    assert curves.at(0.5) == [pytest.approx(0.0)]
    assert curves.at(1.5) == [pytest.approx(1.0)]


def test_monotone_slopes_never_overshoot_and_are_those_of_the_paper() -> None:
    """Fritsch and Butland: chords 1 and 2 over steps 1 and 2 give 9/(5/1 + 4/2) = 9/7 by hand; level at a turn."""
    slope = monotone_slopes(np.array([0.0, 1.0, 3.0]), np.array([0.0, 1.0, 5.0]))
    assert slope.tolist() == pytest.approx([0.0, 9 / 7, 0.0])
    random = np.random.default_rng(4)
    times, values = np.sort(random.uniform(0, 10, 30)), random.uniform(-1, 1, (2, 30))
    slope = monotone_slopes(times[None], values)
    rows = np.moveaxis(cubics(times[None], values, slope, slope), 0, 1)
    seen = SplineChannels(times, np.ascontiguousarray(rows)).many(np.linspace(times[0], times[-1], 4000))
    assert (seen.max(axis=1) <= values.max(axis=1) + 1e-9).all()
    assert (seen.min(axis=1) >= values.min(axis=1) - 1e-9).all()
