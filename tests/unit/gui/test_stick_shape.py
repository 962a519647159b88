"""The stick in perspective: where its ends lie for turns that anybody can picture, and what of it is lit and seen."""

from math import cos, radians, sin

import numpy as np
import pytest

from station.core.imu import NO_TURN, Quaternion
from station.gui.widgets.stick_shape import LENGTH_M, head_outline, projected, stick_shape


def about(axis: str, degrees: float) -> Quaternion:
    """A turn about one of the earth's axes: x ahead, y to the left, z up."""
    c, s = cos(radians(degrees) / 2), sin(radians(degrees) / 2)
    return (c, s * (axis == "x"), s * (axis == "y"), s * (axis == "z"))


def ends(turn: Quaternion) -> tuple[np.ndarray, np.ndarray]:
    strips = stick_shape(turn).strips
    return strips[:, 0].mean(0), strips[:, -1].mean(0)


@pytest.mark.parametrize(
    ("turn", "way"),
    [
        (about("y", -40), "up"),  # the tip raised
        (about("y", 40), "down"),
        (about("z", 30), "left"),
        (about("z", -30), "right"),
    ],
)
def test_the_tip_goes_where_the_stick_is_turned(turn: Quaternion, way: str) -> None:
    (x, y), (moved_x, moved_y) = ends(NO_TURN)[1], ends(turn)[1]
    right, down = moved_x - x, moved_y - y
    assert {"up": down < -0.2, "down": down > 0.05, "left": right < -0.1, "right": right > 0.02}[way]


def test_what_is_nearer_is_larger() -> None:
    strips = stick_shape(NO_TURN).strips
    across = np.linalg.norm(strips[-1] - strips[0], axis=1)
    assert across[2] > across[3], "the shaft is as thick at both ends"


def test_a_stick_is_as_long_as_it_is() -> None:
    """Straight up through the fulcrum it is seen nearly from the side: its length by the eye's elevation of 22°."""
    butt, tip = ends(about("y", -90))
    height = LENGTH_M * cos(radians(22)) / 0.40
    assert np.linalg.norm(tip - butt) == pytest.approx(height, rel=0.1)


def test_the_sensors_face_is_seen_from_above_and_not_from_below() -> None:
    above, aside, below = (stick_shape(about("x", degrees)).faces for degrees in (0, 90, 180))
    assert above == pytest.approx(sin(radians(22)))
    assert below == 0.0
    assert above != aside


def test_light_comes_from_above_whichever_way_the_stick_is_rolled() -> None:
    for roll in (0, 90, 180, 270):
        shades = stick_shape(about("x", roll)).shades
        assert ((shades >= 0) & (shades <= 1)).all()
        assert np.ptp(shades) > 0.2, "round, not flat"
        assert np.allclose(shades, stick_shape(NO_TURN).shades, atol=1e-9)


def test_the_shadow_lies_under_the_stick_and_moves_apart_as_the_tip_is_raised() -> None:
    def gap(degrees: float) -> float:
        shape = stick_shape(about("y", -degrees))
        return float(shape.shadow[-2].mean(0)[1] - shape.strips[:, -2].mean(0)[1])

    assert 0.05 < gap(0) < gap(20) < gap(50)


def test_a_head_is_an_ellipse_about_its_middle() -> None:
    outline = head_outline(0.13, (0.0, 0.24, -0.06))
    middle = projected(np.array([0.0, 0.24, -0.06]))
    assert np.allclose(outline.mean(0), middle, atol=0.02)
    wide, high = np.ptp(outline, axis=0)
    assert 0.25 < high / wide < 0.55, "seen from 22° above: about sin 22°"


@pytest.mark.parametrize("seed", range(5))
def test_every_turn_gives_finite_points(seed: int) -> None:
    turn = np.random.default_rng(seed).normal(size=4)
    w, x, y, z = (turn / np.linalg.norm(turn)).tolist()
    shape = stick_shape((w, x, y, z))
    assert np.isfinite(shape.strips).all()
    assert np.isfinite(shape.shadow).all()
