import numpy as np
import pytest

from station.sound.limiter import KNEE, soft_clip


def clipped(*values: float) -> list[float]:
    return [float(x) for x in soft_clip(np.array(values, np.float32))]


def test_below_the_knee_nothing_changes() -> None:
    values = np.linspace(-KNEE, KNEE, 101, dtype=np.float32)
    assert soft_clip(values.copy()).tolist() == values.tolist()


def test_beyond_the_knee_it_is_the_stated_curve() -> None:
    # 0.8 + 0.2·tanh((x − 0.8)/0.2), worked out by hand for tanh(½) = 0.462117 and tanh(1) = 0.761594.
    assert clipped(0.9, 1.0, -1.0) == pytest.approx([0.892423, 0.952319, -0.952319], abs=1e-5)


def test_nothing_exceeds_full_scale() -> None:
    assert max(map(abs, clipped(2.0, -50.0, 1e30))) <= 1.0


def test_louder_is_never_softer_and_the_curve_has_no_corner() -> None:
    x = np.linspace(0.5, 1.5, 20_001, dtype=np.float64).astype(np.float32)
    slope = np.diff(soft_clip(x.copy()).astype(np.float64)) / np.diff(x.astype(np.float64))
    assert slope.min() >= -1e-3
    around = np.abs(x[:-1] - KNEE) < 0.002
    assert slope[around] == pytest.approx(1.0, abs=0.01)


def test_an_empty_block_passes() -> None:
    assert soft_clip(np.zeros((0, 2), np.float32)).shape == (0, 2)
