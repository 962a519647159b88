"""Few causes for many deviations: exact without noise, honest errors with it, and the simplest explanation first."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.scoring.analysis.sparse_model import CONSTANT, Column, Explained, explain

Floats = NDArray[np.float64]
SLOTS = np.arange(200)
EVERY_2, EVERY_4 = (SLOTS % 2 == 1).astype(float), (SLOTS % 4 == 2).astype(float)


def constant(tau: float | None = 15.0) -> Column:
    return Column(CONSTANT, np.ones(200), tau)


def explained(y: Floats, suspects: list[Column], base: list[Column] | None = None) -> Explained:
    found = explain(y, base or [constant()], suspects, SLOTS)
    assert found is not None
    return found


def autoregression(seed: int, sd: float, lag_1: float, n: int = 200) -> Floats:
    rng = np.random.default_rng(seed)
    y = rng.normal(0, sd, n)
    for k in range(1, n):
        y[k] = lag_1 * y[k - 1] + (1 - lag_1**2) ** 0.5 * y[k]
    return y


def test_without_noise_effects_are_exact() -> None:
    y = 5.0 * EVERY_2 - 20.0 * EVERY_4
    found = explained(y, [Column("a", EVERY_2), Column("b", EVERY_4)], [constant(None)])
    assert set(found.chosen) == {"a", "b"}
    assert found.effects["a"].value == pytest.approx(5.0, abs=1e-3)
    assert found.effects["b"].value == pytest.approx(-20.0, abs=1e-3)


def test_the_many_may_be_early_and_the_few_on_time() -> None:
    """Three quarters of the strokes 45 ms early: one cause, not everything early and a quarter of it late."""
    many = 1.0 - (SLOTS % 4 == 0)
    y = -45.0 * many + autoregression(1, 12.0, 0.3)
    found = explained(y, [Column("few", 1.0 - many), Column("many", many), Column(CONSTANT, np.ones(200))])
    assert found.chosen == ("many",)
    assert found.effects["many"].value == pytest.approx(-45.0, abs=5.0)


def test_strokes_that_are_the_same_are_rivals_and_the_cheaper_one_is_named() -> None:
    y = 25.0 * EVERY_2 + autoregression(2, 10.0, 0.3)
    found = explained(y, [Column("hand", EVERY_2, cost=1.0), Column("piece", EVERY_2), Column("other", EVERY_4)])
    assert found.chosen == ("piece",)
    assert set(found.rivals["piece"]) == {"hand"}
    assert found.rivals["piece"]["hand"].value == pytest.approx(found.effects["piece"].value)


def test_causes_that_differ_in_few_strokes_are_told_apart_only_by_enough_of_them() -> None:
    """A piece that plays all of one hand but 3 strokes of 100, and one that plays 50 of them."""
    hand = EVERY_2
    y = 25.0 * hand + autoregression(3, 20.0, 0.3)
    nearly = hand * (SLOTS > 5)
    found = explained(y, [Column("hand", hand), Column("nearly", nearly)])
    assert {*found.chosen, *found.rivals[found.chosen[0]]} == {"hand", "nearly"}
    half = hand * (SLOTS % 4 == 1)
    assert explained(y, [Column("hand", hand), Column("half", half)]).rivals == {"hand": {}}


@pytest.mark.parametrize("lag_1", [0.0, 0.3, 0.6])
def test_errors_are_as_large_as_the_estimates_scatter(lag_1: float) -> None:
    """Over 200 takes without an effect z has SD 1 (itself known to 5 %), whether the flag alternates or stays."""
    for flag in (EVERY_2, (SLOTS > 100).astype(float)):
        effects = [explained(autoregression(k, 12.0, lag_1), [Column("a", flag)]).effects["a"] for k in range(200)]
        assert 0.8 < np.std([e.value / e.error for e in effects]) < 1.3


def test_chance_alone_has_no_cause() -> None:
    """Twelve suspects, 200 takes: z² > ln 200 + 2·ln 12 = 10.3 has a chance of 0.13 %, 1.6 % in twelve, 3 takes."""
    rng = np.random.default_rng(7)
    flags = [Column(str(k), (rng.random(200) < 0.3).astype(float)) for k in range(12)]
    assert sum(explained(autoregression(k, 15.0, 0.3), flags).chosen != () for k in range(200)) <= 8


def test_a_lean_that_any_player_has_hides_no_cause_and_is_none() -> None:
    """Half the strokes are one piece; players' pieces lean by 5 in SD. 3 ms are nothing, 30 are a cause."""
    base = [constant(), Column("piece", EVERY_2, 5.0)]
    for size, chosen in ((3.0, ()), (30.0, ("piece",))):
        y = size * EVERY_2 + autoregression(5, 10.0, 0.3)
        assert explained(y, [Column("piece", EVERY_2)], base).chosen == chosen


def test_single_strokes_far_off_move_little() -> None:
    y = autoregression(6, 8.0, 0.0) + 20.0 * EVERY_2
    slipped = y.copy()
    slipped[[1, 51, 101]] += 400.0
    before, after = (explained(v, [Column("a", EVERY_2)]).effects["a"].value for v in (y, slipped))
    assert after == pytest.approx(before, abs=2.5)


def test_too_little_is_nothing() -> None:
    assert explain(np.zeros(0), [], [], np.zeros(0, np.int64)) is None
    assert explain(np.ones(5), [constant()], [Column("a", np.arange(5.0))], np.arange(5)) is None
