"""The size of a scatter and its interval, by hand and against simulated players."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.scoring.analysis.technique.estimates import Scatter, scatter
from tests.fakes.autoregression import autoregression

Indices = NDArray[np.int64]


def test_scatter_by_hand() -> None:
    """0, 2 and 10, 14 about 1 and 12: squares 1, 1, 4, 4 with two degrees of freedom; one value alone says nothing."""
    found = scatter(np.array([0.0, 2.0, 10.0, 14.0, 99.0]), np.array([0, 0, 1, 1, 2]), np.arange(5))
    assert (found.count, found.ci) == (4, None)
    assert found.sd == pytest.approx(5**0.5)


def test_no_scatter_where_nothing_is_repeated() -> None:
    assert scatter(np.arange(3.0), np.arange(3), np.arange(3)) == Scatter(0, None, None)


def test_what_never_varies_has_a_spread_of_nothing() -> None:
    assert scatter(np.ones(32), np.arange(32) % 2, np.arange(32)).ci == (0.0, 0.0)


def share_held(rho: float, slots: int, groups: Indices) -> float:
    found = [scatter(row, groups, np.arange(slots)).ci for row in autoregression(1200, slots, rho, 3)]
    return float(np.mean([ci is not None and ci[0] <= 1.0 <= ci[1] for ci in found]))


@pytest.mark.parametrize(("rho", "places"), [(0.0, 20), (0.0, 100), (0.3, 60), (0.6, 100)])
def test_three_rounds_of_a_groove_bear_an_honest_interval(rho: float, places: int) -> None:
    """Every place of the bar has its own level, known from three strokes alone: a third of the freedom is gone.

    Beyond 97 % by little: that the spread of few strokes was seen too small must never be more than said.
    """
    assert 0.93 <= share_held(rho, 3 * places, np.arange(3 * places) % places) <= 0.985


@pytest.mark.parametrize(("rho", "slots"), [(0.0, 16), (0.0, 200), (0.3, 50), (0.8, 180)])
def test_one_spread_of_all(rho: float, slots: int) -> None:
    assert 0.93 <= share_held(rho, slots, np.zeros(slots, np.int64)) <= 0.985
