"""Depths in body and kit worked by hand, for a man of 1.759 m who sits upright."""

import numpy as np
import pytest

from station.motion.kinematics.body_solids import (
    CHEST,
    FOREARM,
    HAND,
    ArmPoints,
    BodyPoints,
    arm_in_kit,
    in_each_other,
    in_the_body,
)
from station.motion.kit.kit import load_kit

STATURE_M = 1.759


def at(*point: float) -> np.ndarray:
    return np.array([point])


BODY = BodyPoints(
    pelvis=at(0.0, 0.0, 0.6),
    neck=at(0.0, 0.0, 1.1),
    head=at(0.0, 0.0, 1.2),
    crown=at(0.0, 0.0, 1.4),
    shoulders=(at(0.18, 0.0, 1.1), at(-0.18, 0.0, 1.1)),
    thighs=((at(0.1, 0.0, 0.6), at(0.1, 0.43, 0.6)), (at(-0.1, 0.0, 0.6), at(-0.1, 0.43, 0.6))),
)


def arm(x: float, y: float, z: float) -> ArmPoints:
    """Its forearm across in front of the player at that height and distance, hand and stick on in the same line."""
    points = [at(x + along, y, z) for along in (0.26, 0.0, -0.15, -0.02, -0.42)]
    return ArmPoints(at(0.18, 0.0, 1.1), *points)


def test_a_forearm_before_the_chest_is_as_deep_as_it_is_near() -> None:
    """Chest 10.6 cm and forearm 3.5 cm thick: 14.1 cm apart they touch, at 10 cm they are 4.1 cm in each other."""
    touching = (CHEST + FOREARM) * STATURE_M
    assert touching == pytest.approx(0.141, abs=0.001)
    for apart in (0.10, 0.141, 0.25):
        found = in_the_body(arm(-0.13, apart, 0.85), BODY, STATURE_M)["forearm in the trunk"]
        assert found[0] == pytest.approx(touching - apart, abs=1e-6)


def test_hands_one_over_the_other_are_in_each_other_by_what_they_are_thick() -> None:
    low, high = arm(0.0, 0.4, 0.8), arm(0.0, 0.4, 0.83)
    found = in_each_other(low, high, STATURE_M)
    assert found["hand in the other hand"][0] == pytest.approx(2 * HAND * STATURE_M - 0.03)
    assert found["stick in the other stick"][0] == pytest.approx(0.014 - 0.03)


def test_a_hand_over_the_snare_is_clear_and_in_it_is_found() -> None:
    kit = load_kit()
    x, y, z = next(p for p in kit.pieces.values() if p.kind == "drum").centre_m
    over, inside = (arm_in_kit(kit, arm(x + 0.1, y, z + up), STATURE_M)["hand in the kit"][0] for up in (0.2, -0.05))
    assert over < -0.1
    assert inside > 0.04
