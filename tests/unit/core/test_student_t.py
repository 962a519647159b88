"""The 95 % points of Student's t, against a published table and against scipy."""

import pytest
from scipy.special import stdtrit

from station.core.student_t import t_quantile, t_quantile_95

# Abramowitz & Stegun, table 26.10, column A = 0.95.
TABLE = [(1, 12.706), (2, 4.303), (3, 3.182), (4, 2.776), (5, 2.571), (10, 2.228), (30, 2.042), (120, 1.980)]


@pytest.mark.parametrize(("freedom", "point"), TABLE)
def test_the_points_of_the_table(freedom: float, point: float) -> None:
    assert t_quantile_95(freedom) == pytest.approx(point, abs=5.1e-4)


@pytest.mark.parametrize("freedom", [1.0, 1.01, 1.5, 2.0, 2.7, 6.3, 17.4, 239.5, 1e4, 1e7])
def test_any_freedom_against_scipy(freedom: float) -> None:
    assert t_quantile_95(freedom) == pytest.approx(float(stdtrit(freedom, 0.975)), rel=1e-8)


def test_less_than_one_degree_counts_as_one() -> None:
    assert t_quantile_95(0.0) == t_quantile_95(1.0)


@pytest.mark.parametrize("freedom", [1, 2, 4, 30, 1000])
@pytest.mark.parametrize("share", [0.5, 0.9, 0.99, 0.999, 0.99999])
def test_any_share_is_scipys(freedom: int, share: float) -> None:
    assert t_quantile(freedom, share) == pytest.approx(float(stdtrit(freedom, (1 + share) / 2)), rel=1e-7)
