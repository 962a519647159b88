"""What a musician would call low must be low, whatever else it has; expected order and bounds are ours, by ear."""

from types import MappingProxyType

import numpy as np
import pytest

from station.music.performance import Performance
from station.practice.battle.ground import Ground
from station.practice.battle.judging.improvisation_marks import Component, ComponentMarks, ImprovisationMarks
from station.practice.battle.judging.judged_improvisation import WEIGHTS, judged_improvisation
from station.practice.battle.phrase import Turn
from tests.unit.practice.battle.judging.phrases_by_hand import (
    ALL_PADS,
    FILL,
    GROOVE,
    GROUND,
    VARIED,
    bars_of,
    noise,
    phrase,
    struck,
    with_velocities,
)

GOOD = 80.0
"""A phrase that any teacher would praise."""


def points(turn: Turn, *before: Turn, call: Turn | None = None) -> float:
    return judged_improvisation(turn, before, call).points


def silence(bars: int = 4) -> Turn:
    return struck([])


def test_the_weights_are_a_hundred() -> None:
    assert sum(WEIGHTS.values()) == 100.0
    assert set(WEIGHTS) == set(Component)


def test_points_are_the_weighted_mean_of_what_could_be_told() -> None:
    weights = MappingProxyType({Component.TIME: 3.0, Component.KIT: 1.0, Component.SPACE: 6.0})
    told = (("time", 80.0), ("kit", 40.0), ("space", None))
    marks = ImprovisationMarks(tuple(ComponentMarks(Component(c), p, "") for c, p in told), weights)
    assert marks.points == pytest.approx(70.0)  # (3·80 + 1·40) / 4


def test_a_phrase_with_a_groove_a_variation_and_a_fill_is_good() -> None:
    assert points(phrase(noise_ms=8.0)) >= GOOD


def test_silence_is_worth_nothing() -> None:
    marks = judged_improvisation(silence(), (), None)
    assert marks.points == 0.0
    assert len(marks.components) == len(Component)


@pytest.mark.parametrize("beat", [0.0, 7.5, 15.75])
def test_a_lone_stroke_is_worth_next_to_nothing(beat: float) -> None:
    assert points(struck([beat])) < 5.0


@pytest.mark.parametrize("pads", [ALL_PADS[1:2], ALL_PADS])
@pytest.mark.parametrize("a_beat", [2, 4, 5.3, 8])
def test_hammering_is_low(pads: tuple[int, ...], a_beat: float) -> None:
    assert points(struck(np.arange(0, 16, 1 / a_beat), pads)) < 30.0  # type: ignore[arg-type]


@pytest.mark.parametrize("seed", range(5))
def test_noise_is_low(seed: int) -> None:
    assert points(noise(seed)) < 45.0


def test_one_bar_for_ever_is_low_and_lower_each_round() -> None:
    again = bars_of(*[GROOVE] * 4, noise_ms=8.0)
    assert points(again, again) < points(again) < 0.55 * points(phrase(noise_ms=8.0))


def test_a_longer_turn_of_one_bar_is_no_better() -> None:
    assert points(bars_of(*[GROOVE] * 8)) < points(bars_of(*[GROOVE] * 4)) + 1.0


def test_a_call_copied_stroke_by_stroke_earns_its_time_alone() -> None:
    marks = judged_improvisation(phrase(noise_ms=5.0), (), phrase())
    assert marks.points <= WEIGHTS[Component.TIME]
    assert marks.of(Component.TIME).points == pytest.approx(100.0, abs=5.0)


def test_a_call_taken_up_and_changed_is_good() -> None:
    call = bars_of(FILL, GROOVE, FILL, VARIED)
    assert points(phrase(), call=call) >= GOOD


def test_the_same_turn_again_is_worth_less() -> None:
    assert points(phrase(), phrase()) < points(phrase()) - 20.0


def test_a_groove_that_goes_on_with_another_fill_stays_good() -> None:
    assert points(bars_of(GROOVE, GROOVE, VARIED, FILL), phrase()) >= 0.7 * GOOD


def test_flat_and_exact_is_worse_than_human() -> None:
    exact = phrase()
    hits = exact.played.hits.copy()
    hits["velocity"] = 90
    flat = Turn(GROUND, 4, Performance.from_array(hits))
    assert points(flat) < points(phrase(noise_ms=10.0))


def test_a_constant_lean_changes_nothing() -> None:
    leaning = judged_improvisation(phrase(8.0, lean_ms=15.0), (), None)
    straight = judged_improvisation(phrase(8.0), (), None)
    for component in Component:
        assert leaning.of(component).points == pytest.approx(straight.of(component).points, abs=0.5)


def test_the_order_of_rows_does_not_matter() -> None:
    turn = phrase(8.0)
    shuffled = np.random.default_rng(1).permutation(turn.played.hits)
    other = Turn(GROUND, 4, Performance.from_array(shuffled))
    assert points(other) == pytest.approx(points(turn))


def test_a_louder_kit_changes_little() -> None:
    soft, loud = with_velocities(phrase(8.0), 0.7), with_velocities(phrase(8.0), 1.1)
    assert points(soft) == pytest.approx(points(loud), abs=4.0)


def test_another_meter_is_judged_and_not_compared() -> None:
    waltz = Ground(100.0, 3, 4)
    turn = Turn(waltz, 4, phrase().played)
    assert judged_improvisation(turn, [phrase()], phrase()).points == judged_improvisation(turn, (), None).points


@pytest.mark.parametrize("beats", [(3, 4), (5, 4), (6, 8), (7, 8)])
def test_any_meter_can_be_judged(beats: tuple[int, int]) -> None:
    marks = judged_improvisation(Turn(Ground(100.0, *beats), 2, phrase().played), (), None)
    assert 0.0 < marks.points <= 100.0


def test_a_single_bar_has_no_development_without_a_call() -> None:
    alone = judged_improvisation(bars_of(GROOVE), (), None)
    assert alone.of(Component.DEVELOPMENT).points is None
    assert 0.0 < alone.points <= 100.0
    assert judged_improvisation(bars_of(VARIED), (), bars_of(GROOVE)).of(Component.DEVELOPMENT).points is not None


def test_places_lie_within_the_turn() -> None:
    for turn in (phrase(30.0), noise(1), bars_of(*[GROOVE] * 4)):
        for marks in judged_improvisation(turn, (), None).components:
            assert all(0 <= p.bar < 4 and (p.beat is None or 0 <= p.beat < 4) and p.words for p in marks.places)
