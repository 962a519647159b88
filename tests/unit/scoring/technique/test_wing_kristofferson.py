"""Clock and hand told apart: the published formulas on simulated takes whose variances are known."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.analysis.technique.wing_kristofferson import (
    FEWEST,
    NotSeparable,
    WingKristofferson,
    wing_kristofferson,
)
from tests.fakes.answers import Played, take
from tests.fakes.scores import even_snare

Floats = NDArray[np.float64]


def with_click(strokes: int, clock_ms: float, hand_ms: float, correction: float, seed: int) -> Floats:
    """Asynchronies of Wing and Kristofferson's clock and hand with Vorberg and Wing's linear phase correction."""
    rng, state, said = np.random.default_rng(seed), 0.0, []
    for c, m in zip(rng.normal(0, clock_ms, strokes + 50), rng.normal(0, hand_ms, strokes + 50), strict=True):
        said.append(state + m)
        state += c - correction * said[-1]
    return np.array(said[50:])


def without_click(strokes: int, clock_ms: float, hand_ms: float, seed: int) -> Floats:
    """Times in ms beside an even pulse: the clock's noise adds up, the hand's does not."""
    rng = np.random.default_rng(seed)
    return np.asarray(np.cumsum(rng.normal(0, clock_ms, strokes)) + rng.normal(0, hand_ms, strokes))


def of(off_ms: Floats, clocked: bool = True) -> WingKristofferson:
    played = take(even_snare(len(off_ms), 500), Played(off_ms=off_ms), clocked)
    return wing_kristofferson(played.score, played.performance, played.alignment)


def test_lag_1_is_the_published_one() -> None:
    """Lag-1 autocovariance (1 − α)·var A − σ_M², var A = (σ_C² + 2ασ_M²)/(1 − (1 − α)²).

    With 8, 6 and 0.4: var A = (64 + 28.8)/0.64 = 145, lag-1 = 0.6 − 36/145 = 0.352. Ten thousand strokes: within 0.03.
    """
    long = [of(with_click(2000, 8, 6, 0.4, seed)).lag_1 for seed in range(5)]
    assert np.mean([lag for lag in long if lag is not None]) == pytest.approx(0.352, abs=0.03)


@pytest.mark.parametrize(("clock_ms", "hand_ms", "correction"), [(10, 10, 0.2), (7.3, 6.8, 0.38), (12, 5, 0.3)])
def test_intervals_hold_the_planted_variances_with_a_click(clock_ms: float, hand_ms: float, correction: float) -> None:
    """12 takes of 1200 strokes: binomially, 95 % intervals miss three or more of 12 in one case of fifty."""
    told = [of(with_click(1200, clock_ms, hand_ms, correction, seed)) for seed in range(12)]
    known = [(k.timekeeper, k.motor) for k in told if k.timekeeper is not None and k.motor is not None]
    assert len(known) >= 9
    assert sum(clock.ci[0] <= clock_ms <= clock.ci[1] for clock, _ in known) >= len(known) - 2
    assert sum(hand.ci[0] <= hand_ms <= hand.ci[1] for _, hand in known) >= len(known) - 2
    assert np.median([clock.sd_ms for clock, _ in known]) == pytest.approx(clock_ms, rel=0.15)
    assert np.median([hand.sd_ms for _, hand in known]) == pytest.approx(hand_ms, rel=0.2)


def test_independent_strokes_tell_nothing() -> None:
    """White noise is a clock that is corrected at once as well as a hand alone."""
    for seed in range(5):
        found = of(np.random.default_rng(seed).normal(0, 10, 600))
        assert (found.timekeeper, found.motor, found.cannot_tell) == (None, None, NotSeparable.INDEPENDENT)
        assert found.lag_1 == pytest.approx(0.0, abs=0.12)


def test_few_strokes_tell_nothing() -> None:
    found = of(with_click(FEWEST - 1, 10, 10, 0.2, 1))
    assert (found.strokes, found.timekeeper, found.cannot_tell) == (FEWEST - 1, None, NotSeparable.FEW)


def test_the_hand_with_most_even_strokes_is_looked_at() -> None:
    """Every second quarter silent: the spacing is 1000 ms; without any error there is no clock to tell from a hand."""
    notes = [Note(2 * i * PPQ, Piece.SNARE) for i in range(300)] + [Note(i * 16 * PPQ, Piece.KICK) for i in range(30)]
    score = Score.from_notes(notes, TempoMap.constant(120))
    played = take(score)
    found = wing_kristofferson(score, played.performance, played.alignment)
    assert found.strokes == 300
    assert found.interval_ms == pytest.approx(1000.0)
    assert (found.lag_1, found.cannot_tell) == (None, NotSeparable.FEW)


def test_lag_1_without_a_click_is_wing_and_kristoffersons() -> None:
    """−σ_M²/(σ_C² + 2σ_M²) with 9 and 6: −36/153 = −0.235; lines taken out of 32 intervals move it by under 0.06."""
    lags = [of(without_click(900, 9, 6, seed), clocked=False).lag_1 for seed in range(4)]
    assert np.mean([lag for lag in lags if lag is not None]) == pytest.approx(-0.235, abs=0.08)


def test_intervals_hold_the_planted_variances_without_a_click() -> None:
    told = [of(without_click(1000, 7, 7, seed), clocked=False) for seed in range(10)]
    known = [(k.timekeeper, k.motor) for k in told if k.timekeeper is not None and k.motor is not None]
    assert all(not k.with_click for k in told)
    assert len(known) >= 7
    assert sum(clock.ci[0] <= 7 <= clock.ci[1] for clock, _ in known) >= len(known) - 2
    assert sum(hand.ci[0] <= 7 <= hand.ci[1] for _, hand in known) >= len(known) - 2
    assert np.median([hand.sd_ms for _, hand in known]) == pytest.approx(7, rel=0.15)


def test_a_player_who_alternates_is_no_clock_and_hand() -> None:
    """Long and short in turn: lag-1 of the intervals near −1, below the −½ that the model admits."""
    rng = np.random.default_rng(2)
    turns = np.tile([15.0, -15.0], 300) + rng.normal(0, 1, 600)
    for off, clocked in ((turns, True), (turns + np.cumsum(rng.normal(0, 6, 600)), False)):
        found = of(off, clocked)
        assert (found.timekeeper, found.cannot_tell) == (None, NotSeparable.NOT_ADMITTED)


def test_offbeats_that_lean_are_no_clock() -> None:
    """Eighths with every offbeat 30 ms late: taken out, what is left is told as if they did not."""
    notes = [Note(i * PPQ // 2, Piece.HIHAT) for i in range(1200)]
    score = Score.from_notes(notes, TempoMap.constant(60))
    off = with_click(1200, 10, 10, 0.2, 3)
    straight, leaning = (take(score, Played(off_ms=off + np.tile([0.0, late], 600))) for late in (0.0, 30.0))
    one, other = (wing_kristofferson(score, t.performance, t.alignment) for t in (straight, leaning))
    assert one.timekeeper is not None
    assert other.timekeeper is not None
    assert other.timekeeper.sd_ms == pytest.approx(one.timekeeper.sd_ms)
