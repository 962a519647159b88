"""Depths worked by hand for sticks laid into a plain drum and a plain cymbal."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kinematics.body_solids import segments_apart
from station.motion.kinematics.collisions import ALONG, depth
from station.motion.kit.piece import KitPiece

Array = NDArray[np.float64]

DRUM = KitPiece(Piece.SNARE, "drum", (0.0, 0.0, 0.5), 0.2, 0.15)
CYMBAL = KitPiece(Piece.RIDE, "cymbal", (0.0, 0.0, 0.5), 0.2, 0.02)


def stick(*moments: tuple[tuple[float, float, float], tuple[float, float, float]]) -> Array:
    ends: Array = np.array(moments)
    return np.asarray(ends[:, :1] + ALONG[:, None] * (ends[:, 1:] - ends[:, :1]))


def test_a_tip_on_the_head_is_in_nothing() -> None:
    assert depth(DRUM, stick(((0.0, -0.4, 0.6), (0.0, 0.0, 0.5)))).tolist() == [0.0]


def test_a_tip_under_the_head_is_as_deep_as_it_is() -> None:
    found = depth(DRUM, stick(((0.0, -0.4, 0.6), (0.0, 0.0, 0.48))))
    assert found[0] == pytest.approx(0.02)


def test_a_stick_under_the_shell_or_beside_it_is_free() -> None:
    assert depth(DRUM, stick(((-0.3, 0.0, 0.3), (0.3, 0.0, 0.3))))[0] == 0.0
    assert depth(DRUM, stick(((-0.3, 0.21, 0.45), (0.3, 0.21, 0.45))))[0] == 0.0


def test_a_stick_that_pierces_a_cymbal_is_found() -> None:
    """It crosses 5 cm inside the edge and reaches 4 cm under."""
    found = depth(CYMBAL, stick(((0.0, -0.3, 0.65), (0.0, 0.0, 0.46))))
    assert 0.02 < found[0] <= 0.041


def test_a_stick_that_jumps_through_a_cymbal_between_two_moments_is_found() -> None:
    over, under = (((0.0, -0.2, z), (0.0, 0.1, z)) for z in (0.52, 0.48))
    assert depth(CYMBAL, stick(over, over)).tolist() == [0.0, 0.0]
    assert depth(CYMBAL, stick(over, under))[1] > 0.15


def test_touching_from_above_is_no_jump() -> None:
    over, on = (((0.0, -0.2, z), (0.0, 0.1, z)) for z in (0.52, 0.5))
    assert depth(CYMBAL, stick(over, on, over)).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("a", "b", "c", "d", "apart"),
    [
        ((0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), 1.0),  # parallel
        ((0, 0, 0), (1, 0, 0), (0.5, -1, 0.3), (0.5, 1, 0.3), 0.3),  # crossing over
        ((0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), 1.0),  # in a line
        ((0, 0, 0), (1, 0, 0), (2, 1, 0), (2, 3, 0), 2**0.5),  # end to end
    ],
)
def test_distances_of_segments(a: object, b: object, c: object, d: object, apart: float) -> None:
    points = [np.array([p], np.float64) for p in (a, b, c, d)]
    assert segments_apart(*points)[0] == pytest.approx(apart)
    assert segments_apart(*points[2:], *points[:2])[0] == pytest.approx(apart)
