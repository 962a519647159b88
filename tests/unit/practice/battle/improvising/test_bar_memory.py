"""The memory of a player's own bars, by counts made by hand."""

from functools import reduce
from math import log

import numpy as np
import pytest
from hypothesis import given as given_any
from hypothesis.strategies import integers, lists

from station.practice.battle.improvising.bar_memory import (
    MOST_KEPT,
    ORDERS,
    BarMemory,
    chord_of,
    contexts,
    evidence_of,
    given,
    said_of,
    with_chord,
)
from station.practice.battle.improvising.beat_steps import steps_of
from station.practice.battle.improvising.played_beats import Beats, Instrument, joined

KICK, SNARE = 1 << Instrument.KICK, 1 << Instrument.SNARE


def test_a_chord_has_a_bit_for_each_instrument() -> None:
    assert chord_of([1, 1, 0, 0, 0, 0, 0, 0, 0]) == KICK | SNARE


def test_counts_become_log_odds() -> None:
    memory = BarMemory()
    for chord in (KICK, KICK, KICK, 0):
        memory.learn(["here"], chord)
    ((column, odds),) = said_of(memory.after(["here"]), Instrument.KICK)
    assert column == 2  # four times: the third class of 1, 2, 4, 8
    assert odds == pytest.approx(log(3.4 / 1.4), abs=1e-9)


def test_what_is_known_of_a_chord_narrows_the_rest() -> None:
    memory = BarMemory()
    for chord in (KICK | SNARE, KICK | SNARE, 0, 0, 0):
        memory.learn(["here"], chord)
    after = memory.after(["here"])
    ((_, odds),) = said_of(given(after, Instrument.KICK, True), Instrument.SNARE)
    assert odds == pytest.approx(log(2.4 / 0.4))
    ((_, odds),) = said_of(given(after, Instrument.KICK, False), Instrument.SNARE)
    assert odds == pytest.approx(log(0.4 / 3.4))
    assert given(after, Instrument.RIDE, True) == []


def test_old_habits_fade() -> None:
    memory = BarMemory()
    for _ in range(3 * MOST_KEPT):
        memory.learn(["here"], KICK)
    for _ in range(MOST_KEPT):
        memory.learn(["here"], SNARE)
    ((_, odds),) = said_of(memory.after(["here"]), Instrument.SNARE)
    assert odds > 0  # a quarter of all, but the last ones


def test_what_was_never_heard_says_nothing() -> None:
    assert said_of(BarMemory().after(["here"]), 0) == []
    assert not evidence_of(steps_of(Beats.silent(4, 4)))[0].any()


def past_of(chords: list[int]) -> int:
    return reduce(with_chord, chords, 0)


def test_contexts_know_no_more_than_the_past() -> None:
    keys = contexts(5, 0, 4, past_of([0] * 20))
    assert len(keys) == ORDERS == len(set(keys))
    assert keys == contexts(5, 0, 4, past_of([0] * 20))
    assert contexts(5, 0, 4, past_of([0] * 19 + [KICK])) != keys


@given_any(chords=lists(integers(0, 511), max_size=12), others=lists(integers(0, 511), max_size=12))
def test_pasts_are_alike_where_their_last_eight_chords_are(chords: list[int], others: list[int]) -> None:
    assert (past_of(chords) == past_of(others)) == (chords[-8:] == others[-8:])
    ones, two = contexts(1, 6, 4, past_of(chords)), contexts(1, 6, 4, past_of(others))
    assert (ones[3] == two[3]) == (chords[-3:] == others[-3:])
    assert (ones[4] == two[4]) == (chords[-8:] == others[-8:])


def test_a_bar_that_comes_again_is_expected() -> None:
    bar = Beats.silent(4, 4)
    bar.struck[[0, 2], 0, Instrument.KICK] = bar.struck[[1, 3], 0, Instrument.SNARE] = True
    evidence = evidence_of(steps_of(joined([bar] * 4)))
    last = evidence[3 * 16 : 4 * 16].sum(axis=2)
    assert np.array_equal(last[::4, :2] > 0, [[True, False], [False, True], [True, False], [False, True]])
    assert np.all(last[1::4, :2] < 0)
