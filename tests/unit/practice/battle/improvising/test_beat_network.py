"""The network: honest probabilities, nothing from the future, and gradients that agree with differences."""

from itertools import product

import numpy as np
import pytest

from station.practice.battle.ground import Feel, Ground
from station.practice.battle.improvising.beat_model import BeatModel
from station.practice.battle.improvising.beat_network import BeatNetwork
from station.practice.battle.improvising.beat_steps import Music, division_rows, step_rows, steps_of, styles_of
from station.practice.battle.improvising.played_beats import Beats, Instrument

MUSIC = Music(frozenset({"funk"}))


def random_beats(bars: int, seed: int = 0, beats_a_bar: int = 4) -> Beats:
    rng = np.random.default_rng(seed)
    beats = Beats.silent(bars * beats_a_bar, beats_a_bar)
    beats.division[:] = rng.choice([3, 4, 6, 8], len(beats))
    inside = np.arange(8) < beats.division[:, None]
    beats.struck[:] = (rng.random(beats.struck.shape) < 0.25) & inside[:, :, None]
    beats.velocity[beats.struck] = 80
    return beats


def network() -> BeatNetwork:
    return BeatModel.load().network


def test_steps_are_the_cells_of_the_beats() -> None:
    beats = random_beats(2)
    steps = steps_of(beats)
    assert len(steps.at) == beats.division.sum()
    assert steps.played.sum() == beats.struck.sum()
    assert np.all(np.diff(steps.at) > 0)
    assert steps.at[int(beats.division[0])] == 24


@pytest.mark.parametrize("beats_a_bar", [3, 4, 5])
def test_nothing_of_the_future_is_known(beats_a_bar: int) -> None:
    beats = random_beats(6, beats_a_bar=beats_a_bar)
    other = Beats.silent(len(beats), beats_a_bar)
    half = len(beats) // 2
    other.division[:half], other.struck[:half] = beats.division[:half], beats.struck[:half]
    other.division[half:] = 8
    other.struck[half:] = True
    before = int(beats.division[:half].sum())
    one, two = steps_of(beats), steps_of(other)
    which = np.arange(before)
    assert np.array_equal(step_rows(one, which, MUSIC), step_rows(two, which, MUSIC))
    which = np.arange(half + 1)
    assert np.array_equal(division_rows(one, which, MUSIC), division_rows(two, which, MUSIC))


def test_a_bar_ago_the_same_place_is_seen() -> None:
    beats = Beats.silent(8, 4)
    beats.struck[1, 2, Instrument.SNARE] = True
    steps = steps_of(beats)
    with_it = step_rows(steps, np.array([16 + 6]), MUSIC)
    without = step_rows(steps_of(Beats.silent(8, 4)), np.array([16 + 6]), MUSIC)
    assert not np.array_equal(with_it, without)


def test_the_chords_of_a_step_have_a_probability_of_one_together() -> None:
    steps = steps_of(random_beats(3))
    row = step_rows(steps, np.array([20]), MUSIC)
    chords = np.array(list(product((0.0, 1.0), repeat=9)), np.float32)
    odds = network().log_odds(np.repeat(row, len(chords), axis=0), chords).astype(np.float64)
    chance = np.exp(-np.logaddexp(0.0, np.where(chords > 0, -odds, odds)).sum(axis=1))
    assert chance.sum() == pytest.approx(1.0, abs=1e-5)


def test_divisions_have_a_probability_of_one_together() -> None:
    steps = steps_of(random_beats(3))
    rows = division_rows(steps, np.arange(12), MUSIC)
    assert np.exp(network().divisions(rows)).sum(axis=1) == pytest.approx(np.ones(12), abs=1e-5)


def test_the_network_is_what_its_formula_says() -> None:
    """The estimator of Larochelle & Murray, written out for one step."""
    steps = steps_of(random_beats(3))
    row = step_rows(steps, np.array([11]), MUSIC)[0].astype(np.float64)
    played = np.array([1, 0, 1, 0, 0, 0, 0, 1, 0], np.float32)
    net = network()
    for k in range(9):
        hidden = net.seen_bias + row @ net.seen + sum(net.struck[j] for j in range(k) if played[j])
        expected = np.maximum(hidden, 0) @ net.asked[k] + row @ net.straight[:, k] + net.asked_bias[k]
        found = net.log_odds(row[None].astype(np.float32), played[None])[0, k]
        assert found == pytest.approx(float(expected), abs=1e-4)


def test_styles_are_known_by_the_words_of_grounds_and_files() -> None:
    assert styles_of("neworleans/secondline") == {"neworleans"}
    assert styles_of("funk/purdieshuffle") == {"funk", "shuffle"}
    assert styles_of("metal") == {"punk"}
    assert styles_of("polka") == frozenset()
    assert Music.of(Ground(140.0, feel=Feel.TRIPLET, style="jazz")) == Music(frozenset({"jazz"}), Feel.TRIPLET, 140.0)
