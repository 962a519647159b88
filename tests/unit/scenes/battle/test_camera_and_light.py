"""The camera changes on downbeats alone and seldom, the same battle alike; light is with who plays."""

import itertools
from dataclasses import replace

import pytest

from station.practice.battle.ground import Ground
from station.practice.battle.turn_plan import TurnKind
from station.scenes.battle.camera_plan import ShotKind, least_bars, shot_at, shots_of
from station.scenes.battle.stage_light import lights_at
from tests.unit.scenes.battle.battles_on_stage import BAR_NS, GROUND, RULES, turns

FAST, SLOW = Ground(180.0), Ground(80.0)
"""Bars of 1.33 s and of 3 s."""


@pytest.mark.parametrize("ground", [FAST, SLOW])
@pytest.mark.parametrize("bars", [1, 2, 4, 8])
@pytest.mark.parametrize("is_final", [False, True])
def test_cuts_are_whole_bars_apart(ground: Ground, bars: int, is_final: bool) -> None:
    turn, fewest = replace(turns(1)[0], bars=bars), 1 if ground is SLOW else 2
    assert least_bars(ground) == fewest
    for seed in range(30):
        shots = shots_of(replace(turn, index=seed), 12, ground, seed, is_final)
        cuts = [shot.first_bar for shot in shots] + [12 + bars]
        apart = [later - sooner for sooner, later in itertools.pairwise(cuts)]
        assert cuts[0] == 12
        assert min(apart) >= min(fewest, bars)
        assert len(shots) == 1 or shots[0].kind is ShotKind.BOTH
        assert all(one.kind is not other.kind for one, other in itertools.pairwise(shots))
        assert not is_final or len(shots) == 1 or shots[1].first_bar - 12 >= 2 * fewest


def test_one_bar_turns_at_a_fast_tempo_stay_on_both() -> None:
    """A cut every bar is more often than every second one."""
    shots = [shots_of(replace(turns(1)[0], index=k, bars=1), k, FAST, 7) for k in range(20)]
    assert {shot.kind for found in shots for shot in found} == {ShotKind.BOTH}


def test_a_turn_is_always_seen_alike_and_long_ones_are_not_dull() -> None:
    turn = replace(turns(1)[0], bars=8)
    found = [shots_of(replace(turn, index=k), 0, GROUND, 3) for k in range(20)]
    assert found == [shots_of(replace(turn, index=k), 0, GROUND, 3) for k in range(20)]
    assert {shot.kind for shots in found for shot in shots} == set(ShotKind)
    assert {shot.side for shots in found for shot in shots} == {None, 0}
    assert shot_at(found[0], 1) == found[0][0]
    assert shot_at(found[0], 7) == found[0][-1]


def test_a_change_of_seats_is_seen_whole() -> None:
    turn = replace(turns(1)[0], bars=8, kind=TurnKind.CHANGEOVER)
    assert [shot.kind for shot in shots_of(turn, 0, GROUND, 3)] == [ShotKind.BOTH]


def test_light_goes_over_in_the_beat_about_the_downbeat() -> None:
    known, beat = turns(2), RULES.beat_ns
    half = beat // 2
    assert lights_at(known, (0, 1), -beat, beat) == (1.0, 1.0), "both before the first turn"
    assert lights_at(known, (0, 1), BAR_NS, beat) == pytest.approx((1.0, 0.0))
    down = 2 * BAR_NS
    assert lights_at(known, (0, 1), down - half, beat) == pytest.approx((1.0, 0.0), abs=1e-6)
    assert lights_at(known, (0, 1), down, beat) == pytest.approx((0.5, 0.5), abs=1e-6)
    assert lights_at(known, (0, 1), down + half, beat) == pytest.approx((0.0, 1.0), abs=1e-6)
