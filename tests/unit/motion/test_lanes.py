"""Lanes as a user draws them; the expected values are read off straight lines by hand."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.motion.drummer import Drummer
from station.motion.style.automation_lanes import (
    drawn,
    in_passes,
    in_turn,
    value_at,
    with_moved,
    with_point,
    without_point,
)
from station.motion.style.style import Style
from tests.fakes.scores import rock_beat

RAMP = ((1.0, 20.0), (5.0, 60.0))


def test_a_lane_is_straight_between_points_and_level_beyond_them() -> None:
    assert [value_at(RAMP, bar) for bar in (0.0, 1.0, 2.0, 4.5, 9.0)] == pytest.approx([20, 20, 30, 55, 60])


def test_points_come_go_and_keep_their_order() -> None:
    three = with_point(RAMP, 3.0, 90.0)
    assert three == ((1.0, 20.0), (3.0, 90.0), (5.0, 60.0))
    assert with_point(three, 3.001, 10.0) == ((1.0, 20.0), (3.001, 10.0), (5.0, 60.0)), "it takes the near one's place"
    assert without_point(three, 1) == RAMP


def test_a_point_moves_up_to_its_neighbours_and_no_further() -> None:
    three = with_point(RAMP, 3.0, 90.0)
    for wanted, found in ((4.0, 4.0), (99.0, 4.98), (-3.0, 1.02)):
        moved = with_moved(three, 1, wanted, 50.0)
        assert moved[1] == pytest.approx((found, 50.0))
        assert moved[0] == RAMP[0]
        assert moved[2] == RAMP[1]
    assert with_moved(three, 0, -3.0, 50.0)[0] == (1.0, 50.0), "there is nothing before the first bar"


def test_what_is_drawn_takes_the_place_of_what_lay_under_it() -> None:
    lane = ((1.0, 1.0), (2.0, 2.0), (3.0, 3.0), (4.0, 4.0))
    assert drawn(lane, [(3.25, 80.0), (1.75, 70.0), (2.5, 75.0)]) == (
        (1.0, 1.0),
        (1.75, 70.0),
        (2.5, 75.0),
        (3.25, 80.0),
        (4.0, 4.0),
    )
    assert drawn(lane, []) == lane
    assert drawn((), [(2.0, 90.0), (2.0, 30.0)]) == ((2.0, 30.0),), "what was drawn last counts"


def test_every_pass_has_the_lessons_own_bars() -> None:
    """Bars 3 and 4 of a lesson, three times: 40 where bar 3 begins, 50 where bar 4 begins, 60 where it ends."""
    style = in_passes(Style(automation={"amplitude_gain": RAMP}), 2, 2, 3)
    assert style.value("amplitude_gain", np.array([1.0, 2.0, 2.99])) == pytest.approx([40, 50, 60], abs=0.2)
    for passes in (2.0, 4.0):
        places = np.array([1.0, 1.5, 2.0, 2.5])
        assert style.value("amplitude_gain", places + passes) == pytest.approx([40, 45, 50, 55])
    bars = [bar for bar, _ in style.automation["amplitude_gain"]]
    assert bars == sorted(set(bars))


def test_a_style_without_lanes_stays_as_it_is() -> None:
    style = Style(amplitude_gain=30.0)
    assert in_passes(style, 2, 2, 3) is style


def test_styles_in_turn_change_evenly_over_half_a_bar() -> None:
    large, small = Style(whip=80.0, posture_deg=10.0), Style(whip=20.0)
    lanes = in_turn(Style(), [(3.0, large), (5.0, small)]).automation
    assert set(lanes) == {"whip", "posture_deg"}
    assert [value_at(lanes["whip"], bar) for bar in (1.0, 3.0, 3.25, 3.5, 5.0, 5.25, 5.5, 9.0)] == pytest.approx(
        [50, 50, 65, 80, 80, 50, 20, 20]
    )
    assert [value_at(lanes["posture_deg"], bar) for bar in (3.0, 4.0, 6.0)] == pytest.approx([6, 10, 6])


def test_a_style_at_the_first_bar_is_there_at_once_and_grips_stay() -> None:
    changed = in_turn(Style(), [(1.0, Style(whip=80.0, grip_left="traditional", mood="joyful"))])
    assert changed.value("whip", [0.0, 1.0, 8.0]).tolist() == [80, 80, 80]
    assert (changed.grip_left, changed.mood) == ("american", "focused")


def test_the_lane_of_a_style_lasts_until_the_next_style() -> None:
    lane = Style(automation={"whip": ((1.0, 0.0), (5.0, 100.0))})
    lanes = in_turn(lane, [(3.0, Style(whip=10.0))]).automation
    assert [value_at(lanes["whip"], bar) for bar in (1.0, 2.0, 3.0, 3.5, 5.0)] == pytest.approx([0, 25, 50, 10, 10])


def test_nothing_jumps_where_the_style_changes() -> None:
    """Tips and joints go no farther in a millisecond than those of the two styles played alone (2 % of measure)."""
    score, wild = rock_beat(4), Style(amplitude_gain=90.0, amplitude_neck=90.0, amplitude_twist=90.0, whip=80.0)
    mixed, pure = in_turn(Style(), [(2.0, wild), (4.0, Style())]), (Style(), wild)
    plain = Drummer(score)
    alone = [steps_m(plain.with_style(style), score.length_ns) for style in pure]
    assert (steps_m(plain.with_style(mixed), score.length_ns) <= 1.02 * np.maximum(*alone)).all()


def steps_m(drummer: Drummer, length_ns: int) -> NDArray[np.float64]:
    """The farthest that a tip and that a joint moves in a millisecond."""
    poses = [drummer.pose(at_ns / 1e9) for at_ns in range(0, length_ns, 1_000_000)]
    places = [np.array([pose.tip_m for pose in poses]), np.array([pose.joints_m for pose in poses])]
    return np.array([np.linalg.norm(np.diff(at, axis=0), axis=-1).max() for at in places])
