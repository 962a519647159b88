"""Bars that go on from what was heard: as wanted, the same for the same seed, and as the model says."""

import numpy as np
import pytest

from station.practice.battle.improvising.beat_model import MODEL_FILE, BeatModel, music_after
from station.practice.battle.improvising.beat_steps import Music, steps_of
from station.practice.battle.improvising.continuation import continued
from station.practice.battle.improvising.played_beats import Beats, Instrument, joined
from station.practice.battle.improvising.wanted import Wanted
from tests.unit.practice.battle.improvising.test_beat_network import random_beats

ROCK = Music(frozenset({"rock"}))
MODEL = BeatModel.load()


def groove() -> Beats:
    """Kick on one and three, snare on two and four, eighths on the hi-hat."""
    bar = Beats.silent(4, 4)
    bar.struck[[0, 2], 0, Instrument.KICK] = bar.struck[[1, 3], 0, Instrument.SNARE] = True
    bar.struck[:, [0, 2], Instrument.CLOSED_HIHAT] = True
    bar.velocity[bar.struck] = 90
    return bar


def rng(seed: int = 0) -> np.random.Generator:
    return np.random.default_rng(seed)


def test_the_model_is_small() -> None:
    assert MODEL_FILE.stat().st_size <= 150_000
    assert 30_000 <= MODEL.network.weights <= 40_000


def test_the_same_seed_gives_the_same_bars() -> None:
    heard = [joined([groove()] * 2)]
    one, two, other = (continued(MODEL, heard, 2, Wanted(ROCK), rng(seed)) for seed in (1, 1, 2))
    assert np.array_equal(one.struck, two.struck)
    assert not np.array_equal(one.struck, other.struck)


def test_at_no_boldness_it_plays_what_is_likeliest() -> None:
    """Every decision is the one that the model finds likelier, asked about the whole at once."""
    heard = random_beats(3, seed=4)
    bars = continued(MODEL, [heard], 2, Wanted(ROCK, boldness=0.0), rng())
    _, music = music_after([heard], ROCK)
    steps = steps_of(joined([heard, bars]))
    odds = MODEL.log_odds(steps, music)
    new = steps.beat >= len(heard)
    clear = np.abs(odds[new]) > 0.01
    assert clear.mean() > 0.99
    assert np.array_equal((odds[new] > 0)[clear], (steps.played[new] > 0)[clear])
    chance = MODEL.divisions(steps, np.arange(len(heard), len(heard) + 8), music)
    assert np.array_equal(np.array([3, 4, 6, 8])[chance.argmax(axis=1)], bars.division)


def test_a_groove_goes_on_in_a_mirror() -> None:
    bars = continued(MODEL, [joined([groove()] * 8)], 2, Wanted(ROCK, boldness=0.0, memory=1.5), rng())
    assert np.array_equal(bars.struck, np.concatenate([groove().struck] * 2))


def test_boldness_departs_from_the_likeliest() -> None:
    heard = [joined([groove()] * 8)]
    surprises = []
    for boldness in (0.1, 0.5, 0.9):
        bars = continued(MODEL, heard, 8, Wanted(ROCK, boldness=boldness), rng(3))
        surprises.append(MODEL.surprise(joined([*heard, bars]), ROCK).of_beat[32:].mean())
    assert surprises == sorted(surprises)


def test_only_what_is_allowed_is_played() -> None:
    drums = frozenset({Instrument.KICK, Instrument.SNARE, Instrument.FLOOR_TOM})
    wanted = Wanted(ROCK, boldness=1.0, instruments=drums, divisions=frozenset({3, 6}))
    bars = continued(MODEL, [random_beats(2)], 4, wanted, rng())
    assert set(bars.division.tolist()) <= {3, 6}
    assert set(np.nonzero(bars.struck)[2].tolist()) <= set(drums)
    assert not bars.struck[bars.division == 3, 3:].any()


def test_what_is_given_stays() -> None:
    call = random_beats(1, seed=7)
    call.velocity[call.struck] = 33
    call.late_ms[call.struck] = -9.0
    is_given = np.zeros((2, 8, 9), np.bool_)
    is_given[:2] = True
    bars = continued(MODEL, [call], 2, Wanted(ROCK, given=call, is_given=is_given), rng())
    assert bars.division[:2].tolist() == call.division[:2].tolist()
    for mine, theirs in ((bars.struck, call.struck), (bars.velocity, call.velocity), (bars.late_ms, call.late_ms)):
        assert np.array_equal(mine[:2], theirs[:2])
    assert np.all(bars.velocity[bars.struck] > 0)


@pytest.mark.parametrize(("favour", "more"), [(4.0, True), (-8.0, False)])
def test_favour_makes_an_instrument_likelier(favour: float, more: bool) -> None:
    lean = np.zeros((16, 9))
    lean[:, Instrument.HIGH_TOM] = favour
    plain = continued(MODEL, [groove()], 4, Wanted(ROCK), rng(1))
    leant = continued(MODEL, [groove()], 4, Wanted(ROCK, favour=lean), rng(1))
    counts = [int(b.struck[:, :, Instrument.HIGH_TOM].sum()) for b in (plain, leant)]
    assert counts[1] > counts[0] if more else counts[1] == 0


def test_other_meters_go_on_in_their_bars() -> None:
    bars = continued(MODEL, [random_beats(2, beats_a_bar=3)], 3, Wanted(ROCK), rng())
    assert (bars.beats_a_bar, len(bars)) == (3, 9)


def test_nothing_heard_is_enough() -> None:
    bars = continued(MODEL, [], 2, Wanted(ROCK), rng())
    assert len(bars) == 8
    assert bars.struck.any()


def test_a_bar_that_comes_again_surprises_less_with_the_memory() -> None:
    often = joined([random_beats(1, seed=5)] * 4)
    bits = MODEL.surprise(often, ROCK).of_beat.reshape(4, 4).sum(axis=1)
    alone = MODEL.surprise(often, ROCK, memory=0.0).of_beat.reshape(4, 4).sum(axis=1)
    assert bits[3] < bits[1] < bits[0]
    assert bits[3] < alone[3]
