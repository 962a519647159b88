"""The words of a component follow its points: what costs points is named, beside what would have been best."""

from collections import defaultdict
from functools import cache
from itertools import product

import numpy as np
import pytest

from station.core.pieces import Piece
from station.practice.battle.judging.improvisation_marks import Component, ImprovisationMarks
from station.practice.battle.judging.judged_improvisation import judged_improvisation
from tests.unit.practice.battle.improvising.played_by_hand import turn_of
from tests.unit.practice.battle.judging.phrases_by_hand import (
    FILL,
    GROOVE,
    GROUND,
    VARIED,
    bars_of,
    noise,
    phrase,
    struck,
)

PRINTED = 8.0
"""Two figures of a component that are printed to a percent, each worth up to four points a percent."""


@cache
def many_marks() -> list[ImprovisationMarks]:
    """Of every order of three bars, landed or not, played more and less evenly; of noise; of one stroke for ever."""
    orders = product((GROOVE, VARIED, []), repeat=3)
    turns = [bars_of(*order, noise_ms=ms, landing=ms < 20) for order in orders for ms in (0.0, 25.0)]
    turns += [*map(noise, range(20)), struck(range(16)), struck(np.arange(0, 16, 0.25))]
    return [judged_improvisation(turn, (phrase(),), None) for turn in turns]


@pytest.mark.parametrize("component", list(Component))
def test_turns_that_read_the_same_earned_the_same(component: Component) -> None:
    said = defaultdict[str, list[float]](list)
    for marks in (each.of(component) for each in many_marks()):
        if marks.points is not None:
            said[marks.words].append(marks.points)
    assert len(said) > 10, "the turns differ"
    apart = {words: max(points) - min(points) for words, points in said.items()}
    assert max(apart.values()) <= PRINTED, max(apart, key=lambda words: apart[words])


def test_space_names_the_density_that_has_no_shape() -> None:
    # quarters in each bar: 75 % open is best, and no bar is fuller than another
    marks = judged_improvisation(struck(range(16)), (), None).of(Component.SPACE)
    assert "left open" not in marks.words
    assert "bars 0 % fuller and thinner (best: 12–50)" in marks.words


def test_the_return_to_one_is_named_where_it_was_missed_and_dearest_first() -> None:
    words = (
        judged_improvisation(bars_of(GROOVE, VARIED, GROOVE, FILL, landing=False), (), None).of(Component.TIME).words
    )
    assert words == "no stroke on the one after the turn"


def test_strokes_that_are_too_few_to_prove_a_time_are_counted() -> None:
    turn = turn_of([(beat, Piece.SNARE, 90) for beat in (0, 4, 8, 12, 16)], GROUND, 4)
    # four of the sixteen that prove a time, dead even, and home
    assert judged_improvisation(turn, (), None).of(Component.TIME).words == "4 strokes (16 prove a time)"


def test_vocabulary_names_the_figures_that_earn_all() -> None:
    # .55 of sixteen beats
    words = judged_improvisation(bars_of(*[GROOVE] * 4), (), None).of(Component.VOCABULARY).words
    assert "figures in 16 beats (best: 8.8)" in words
