"""Taps whose lateness is that of a made player; intervals from published ranges of people's habits."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.sound.calibration.taps import HABIT_MS, taps

CLICKS_NS = 10**13 + np.arange(36) * 600_000_000


def tapped(late_ms: float, sd_ms: float, seed: int = 2, count: int = 36) -> NDArray[np.int64]:
    off = late_ms + sd_ms * np.random.default_rng(seed).standard_normal(count)
    return CLICKS_NS[:count] + np.round(off * 1e6).astype(np.int64)


@pytest.mark.parametrize("late_ms", [-120.0, -20.0, 0.0, 80.0, 250.0, 420.0])
def test_the_sum_of_equipment_and_habit_is_found(late_ms: float) -> None:
    found = taps(tapped(late_ms, 12.0), CLICKS_NS)
    assert found.total.value_ms == pytest.approx(late_ms, abs=3 * 12.0 / 32**0.5)
    assert found.total.low_ms < found.total.value_ms < found.total.high_ms
    assert found.total.trusted


def test_missed_and_double_taps_do_not_matter() -> None:
    stamps = tapped(30.0, 8.0)
    stamps = np.sort(np.concatenate([np.delete(stamps, [7, 8, 20]), stamps[[11]] + 90_000_000]))
    assert taps(stamps, CLICKS_NS).total.value_ms == pytest.approx(30.0, abs=5.0)


@pytest.mark.parametrize("late_ms", [-30.0, 80.0, 420.0])
@pytest.mark.parametrize(("first", "stalled_ms"), [(1, 15.0), (9, 70.0), (1, -40.0)])
def test_a_card_that_stalls_moves_its_clicks_and_nothing_else(late_ms: float, first: int, stalled_ms: float) -> None:
    clicks = CLICKS_NS.copy()
    clicks[first:] += round(stalled_ms * 1e6)
    found = taps(tapped(late_ms, 2.0) + clicks - CLICKS_NS, clicks).total
    assert found.value_ms == pytest.approx(late_ms, abs=3 * 2.0 / 32**0.5)
    assert found.trusted


def test_the_equipments_share_is_never_free_of_doubt() -> None:
    found = taps(tapped(150.0, 12.0), CLICKS_NS)
    assert found.equipment.low_ms == pytest.approx(found.total.low_ms - HABIT_MS[1])
    assert found.equipment.high_ms == pytest.approx(found.total.high_ms - HABIT_MS[0])
    assert any("habit is in it" in doubt for doubt in found.equipment.doubts)


def test_a_usual_lean_may_be_all_habit() -> None:
    assert any("habit alone" in doubt for doubt in taps(tapped(-15.0, 12.0), CLICKS_NS).equipment.doubts)


def test_the_habit_is_what_known_equipment_leaves() -> None:
    habit = taps(tapped(-8.0, 10.0), CLICKS_NS).habit(7.0)
    assert habit.value_ms == pytest.approx(-15.0, abs=5.0)


def test_errors_that_are_carried_on_widen_the_interval() -> None:
    """A first-order autoregression of 0.6 is worth (1 − 0.6) / (1 + 0.6), a quarter, of its taps."""
    rng = np.random.default_rng(7)
    off = np.zeros(36)
    for k in range(1, 36):
        off[k] = 0.6 * off[k - 1] + 8.0 * rng.standard_normal()
    drifting = taps(CLICKS_NS + np.round(off * 1e6).astype(np.int64), CLICKS_NS).total
    plain = taps(CLICKS_NS + np.round(rng.permutation(off) * 1e6).astype(np.int64), CLICKS_NS).total
    assert drifting.half_ms > 1.4 * plain.half_ms


def test_taps_beside_the_click_are_doubted_and_few_are_refused() -> None:
    assert any("do not follow" in doubt for doubt in taps(tapped(0.0, 160.0), CLICKS_NS).total.doubts)
    with pytest.raises(DeviceError, match="too few taps"):
        taps(tapped(0.0, 10.0, count=10), CLICKS_NS)
