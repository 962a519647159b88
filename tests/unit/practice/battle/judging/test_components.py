"""Each component by itself, on turns whose figures can be reckoned by hand."""

import math
from itertools import pairwise

import numpy as np
import pytest

from station.core.pieces import Piece
from station.practice.battle.judging.best_bar import best_bar
from station.practice.battle.judging.heard_turn import HeardTurn, heard
from station.practice.battle.judging.improvisation_marks import Component, ImprovisationMarks
from station.practice.battle.judging.judged_improvisation import WEIGHTS, judged_improvisation
from station.practice.battle.judging.likeness import likeness
from station.practice.battle.phrase import Turn
from tests.unit.practice.battle.improvising.played_by_hand import turn_of
from tests.unit.practice.battle.judging.phrases_by_hand import FILL, GROOVE, GROUND, VARIED, bars_of, phrase, struck


def figures(turn: Turn, component: Component) -> dict[str, float]:
    return dict(judged_improvisation(turn, (), None).of(component).figures)


def alike(one: list[tuple[float, Piece, int]], other: list[tuple[float, Piece, int]]) -> float:
    bars = heard(bars_of(one, other, landing=False)).bar_shapes
    return float(likeness(bars, bars)[0, 1])


# --- time -------------------------------------------------------------------------------------------------------------


def test_spread_and_home_are_what_was_played() -> None:
    # eighths, by turns 12 ms late and 12 early: mean 0, spread 12; home 20 ms late
    late = [i / 2 + (0.02 if i % 2 == 0 else -0.02) for i in range(32)]  # beats of 600 ms
    turn = turn_of([(beat, Piece.SNARE, 90) for beat in [*late, 16 + 20 / 600]], GROUND, 4)
    found = figures(turn, Component.TIME)
    assert found["spread_ms"] == pytest.approx(12.0, abs=0.1)
    assert found["home_ms"] == pytest.approx(20.0, abs=0.1)
    assert found["blur"] == pytest.approx(12.0 / 150.0, abs=0.001)  # a sixteenth is 150 ms
    words = judged_improvisation(turn, (), None).of(Component.TIME).words
    assert words == "kept within 12 ms (best: 4); back on one 20 ms late (best: 10)"


def test_a_drift_is_told() -> None:
    # each beat 2 ms later than the one before: 32 ms over sixteen beats
    turn = turn_of([(i + 2 * i / 600, Piece.SNARE, 90) for i in range(16)], GROUND, 4)
    assert figures(turn, Component.TIME)["drift_ms"] == pytest.approx(32.0, abs=0.5)


def test_more_spread_never_earns_more_time() -> None:
    earned = [judged_improvisation(phrase(noise_ms=n), (), None).of(Component.TIME).points for n in (0, 8, 16, 24, 32)]
    assert all(a >= b for a, b in pairwise(earned))  # type: ignore[operator]
    assert earned[0] == pytest.approx(100.0)


def test_without_a_landing_the_return_is_lost() -> None:
    home, away = (bars_of(GROOVE, VARIED, GROOVE, FILL, landing=landing) for landing in (True, False))
    lost = [judged_improvisation(turn, (), None).of(Component.TIME) for turn in (home, away)]
    assert lost[0].points - lost[1].points == pytest.approx(25.0)  # type: ignore[operator]
    assert "no stroke on the one after the turn" in lost[1].words


# --- dynamics ---------------------------------------------------------------------------------------------------------


def test_one_level_has_no_range() -> None:
    marks = judged_improvisation(struck(np.arange(0, 16, 0.5)), (), None).of(Component.DYNAMICS)
    assert marks.points == 0.0
    assert marks.words == "all at one level"


def test_accents_in_their_places_are_no_chance_and_shuffled_ones_are() -> None:
    levels = np.tile([120, 60, 60, 60, 120, 60, 120, 60], 4)
    beats = np.arange(32) / 2
    placed = turn_of([(b, Piece.SNARE, int(v)) for b, v in zip(beats, levels, strict=True)], GROUND, 4)
    shuffled = turn_of(
        [(b, Piece.SNARE, int(v)) for b, v in zip(beats, np.random.default_rng(3).permutation(levels), strict=True)],
        GROUND,
        4,
    )
    # 32 strokes in 8 places without any error: √(8 / (24 + 8)) = 0.5
    assert figures(placed, Component.DYNAMICS)["chance"] == pytest.approx(0.5, abs=0.01)
    assert figures(shuffled, Component.DYNAMICS)["chance"] > 0.8
    # 12 strokes at 120, 20 at 60: 12 dB apart (40·log10 2), SD 12.04·√(12·20)/32
    assert figures(placed, Component.DYNAMICS)["range_db"] == pytest.approx(12.04 * math.sqrt(240) / 32, abs=0.01)


# --- likeness, vocabulary, development --------------------------------------------------------------------------------


def test_a_bar_is_like_itself_and_unlike_what_shares_nothing() -> None:
    assert alike(GROOVE, GROOVE) == pytest.approx(1.0)
    assert alike([(0, Piece.KICK, 90)], [(2, Piece.SNARE, 90)]) == 0.0
    assert 0.7 < alike(GROOVE, VARIED) < 0.92
    assert alike(GROOVE, FILL) < 0.6


def test_silence_is_like_nothing() -> None:
    bars = heard(bars_of(GROOVE, [], GROOVE, landing=False))
    found = likeness(bars.bar_shapes, bars.bar_shapes)
    assert found[0, 1] == found[1, 1] == 0.0
    assert found[0, 2] == pytest.approx(1.0)


def test_half_of_a_phrase_that_says_one_bar_twice_is_its_own() -> None:
    assert figures(bars_of(GROOVE, FILL, GROOVE, FILL), Component.DEVELOPMENT)["own"] == pytest.approx(0.5)
    assert figures(bars_of(*[GROOVE] * 4), Component.DEVELOPMENT)["own"] == pytest.approx(0.25)


def test_a_copy_with_other_errors_is_a_copy() -> None:
    assert figures(bars_of(*[GROOVE] * 4, noise_ms=15.0), Component.DEVELOPMENT)["own"] < 0.4


def test_the_bar_that_was_taken_up_is_named() -> None:
    marks = judged_improvisation(bars_of(GROOVE, FILL, VARIED, []), (), None).of(Component.DEVELOPMENT)
    assert (marks.places[0].bar, marks.places[0].words) == (2, "takes up bar 1")
    answer = judged_improvisation(bars_of(VARIED, []), (), bars_of(FILL, GROOVE)).of(Component.DEVELOPMENT)
    assert (answer.places[0].bar, answer.places[0].words) == (0, "takes up bar 2 of the call")


def test_strangers_bars_develop_less_than_a_phrase() -> None:
    samba = [(i / 4, Piece.RIDE, 70) for i in range(16)] + [(0.75, Piece.KICK, 90), (1.75, Piece.KICK, 90)]
    toms = [(i / 3, Piece.FLOOR_TOM_1, 100) for i in range(12)]
    crash = [(0, Piece.CRASH_1, 120), (1.5, Piece.CRASH_1, 120), (2.75, Piece.SNARE, 120)]
    glued, whole = bars_of(GROOVE, samba, toms, crash), phrase()
    marks = [judged_improvisation(turn, (), None).of(Component.DEVELOPMENT).points for turn in (glued, whole)]
    assert marks[0] < 30.0  # type: ignore[operator]
    assert marks[1] > 70.0  # type: ignore[operator]


def test_nothing_new_in_another_round_has_little_vocabulary() -> None:
    first, again = (judged_improvisation(phrase(), said, None).of(Component.VOCABULARY) for said in ((), (phrase(),)))
    assert again.points < 0.3 * first.points  # type: ignore[operator]
    assert "0 % new since the turns before (best: 30)" in again.words


# --- kit, space, the best bar -----------------------------------------------------------------------------------------


def test_voicings_are_an_effective_number() -> None:
    # kick alone and snare alone, as often: two; all eight quarters kick and snare together: one
    apart = turn_of([(i, (Piece.KICK, Piece.SNARE)[i % 2], 90) for i in range(16)], GROUND, 4)
    assert figures(apart, Component.KIT)["voicings"] == pytest.approx(2.0)
    assert figures(struck(range(16), (Piece.KICK, Piece.SNARE)), Component.KIT)["voicings"] == pytest.approx(1.0)


def test_three_hands_are_too_many() -> None:
    crowd = struck(range(16), (Piece.SNARE, Piece.TOM_1, Piece.RIDE, Piece.KICK))
    assert figures(crowd, Component.KIT)["crowded"] == 1.0
    hat_by_foot = struck(range(16), (Piece.SNARE, Piece.RIDE, Piece.HIHAT, Piece.KICK))
    assert figures(hat_by_foot, Component.KIT)["crowded"] == 0.0


def test_what_is_left_open() -> None:
    # quarters leave three of four sixteenths open
    assert figures(struck(range(16)), Component.SPACE)["open"] == pytest.approx(0.75)
    assert figures(struck(np.arange(0, 16, 0.25)), Component.SPACE)["open"] == 0.0


def marks_of(*bar_points: float) -> ImprovisationMarks:
    return ImprovisationMarks((), WEIGHTS, bar_points)


def test_the_best_bar_is_the_one_with_the_most_points() -> None:
    assert best_bar([marks_of(10, 40), marks_of(70, 20), marks_of(70, 0)]) == (2, 0)  # of equals the later
    assert best_bar([]) is None
    assert best_bar([marks_of(0, 0)]) is None


def test_a_silent_bar_is_never_the_best() -> None:
    marks = judged_improvisation(bars_of(GROOVE, [], VARIED, []), (), None)
    assert marks.bar_points[1] == marks.bar_points[3] == 0.0
    assert best_bar([marks]) == (0, 2)


def test_what_was_heard_is_remembered() -> None:
    turn = phrase()
    assert isinstance(heard(turn), HeardTurn)
    assert heard(turn) is heard(turn)
