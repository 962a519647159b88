"""Arms are checked against plain vector geometry: lengths of bones, points where they must be."""

import math
from dataclasses import replace

import numpy as np
import pytest

from station.motion.kinematics.arm import Arm, ArmLengths, Contact, Offsets, solve
from station.motion.kinematics.figure import figure_of
from station.motion.kinematics.grip import GRIPS, HELD, Hold
from station.motion.kinematics.maths import MANY, ONE

LENGTHS = ArmLengths(upper=0.33, fore=0.26, hand=0.15, ahead=0.27, behind=0.135)
SHOULDER = (0.22, 0.03, 1.09)
STILL = Offsets(0.0, 0.0, 0.0, 0.0)
SNARE = Contact(-0.05, 0.45, 0.66, 0.05, 0.30, 0.3, 0.1, 0.27, 0.2)


def test_the_tip_touches_the_contact_at_the_strike() -> None:
    arm = solve(ONE, LENGTHS, SHOULDER, SNARE, STILL)
    assert math.dist(arm.tip, (-0.05, 0.45, 0.66)) < 1e-12
    assert arm.missing_m == 0.0


@pytest.mark.parametrize("offsets", [STILL, Offsets(0.2, 0.3, 0.4, 0.2), Offsets(-0.1, 0.0, 0.6, 0.0)])
@pytest.mark.parametrize("wing", [0.0, 0.5, -0.3])
def test_bones_keep_their_lengths(offsets: Offsets, wing: float) -> None:
    arm = solve(ONE, LENGTHS, SHOULDER, SNARE, offsets, wing)
    assert math.dist(arm.root, arm.elbow) == pytest.approx(LENGTHS.upper)
    assert math.dist(arm.elbow, arm.wrist) == pytest.approx(LENGTHS.fore)
    assert math.dist(arm.wrist, arm.hand) == pytest.approx(LENGTHS.hand)
    assert math.dist(arm.hand, arm.tip) == pytest.approx(LENGTHS.ahead)
    assert math.dist(arm.butt, arm.tip) == pytest.approx(LENGTHS.ahead + LENGTHS.behind)


def test_angles_are_those_between_the_bones() -> None:
    arm = solve(ONE, LENGTHS, SHOULDER, SNARE, STILL)
    upper = np.subtract(arm.elbow, arm.root) / LENGTHS.upper
    fore = np.subtract(arm.wrist, arm.elbow) / LENGTHS.fore
    assert arm.elbow_bend == pytest.approx(math.acos(float(upper @ fore)))
    hand, stick = np.subtract(arm.hand, arm.wrist), np.subtract(arm.tip, arm.hand)
    assert hand @ np.array(arm.back) == pytest.approx(0.0, abs=1e-12)
    between = math.acos(hand @ stick / (LENGTHS.hand * LENGTHS.ahead))
    assert between >= abs(arm.palm)  # μ is its part in the vertical plane; the rest is the yaw in the palm


def test_the_matched_grip_is_the_designs_formula() -> None:
    """DESIGN § 5: with one heading, tip = wrist + b(−sin Σ sin τ, sin Σ cos τ, −cos Σ), b² = h² + S² + 2hS cos μ."""
    mu = 0.25
    contact = Contact(-0.05, 0.45, 0.66, 0.05, 0.05 + mu, 0.0, 0.0, 0.27, 0.0)
    arm = solve(ONE, LENGTHS, (-0.05, 0.03, 1.09), contact, STILL)  # straight behind: all in one plane
    h, s = LENGTHS.hand, LENGTHS.ahead
    b = math.sqrt(h * h + s * s + 2 * h * s * math.cos(mu))
    delta = math.atan2(s * math.sin(mu), h + s * math.cos(mu))
    sigma = arm.shoulder + arm.elbow_bend + arm.extension + delta
    x, y, z = arm.wrist
    tau = arm.heading
    tip = (x - b * math.sin(sigma) * math.sin(tau), y + b * math.sin(sigma) * math.cos(tau), z - b * math.cos(sigma))
    assert math.dist(tip, arm.tip) < 1e-9


def test_offsets_turn_their_own_joint_alone() -> None:
    base = solve(ONE, LENGTHS, SHOULDER, SNARE, STILL)
    bent = solve(ONE, LENGTHS, SHOULDER, SNARE, Offsets(0.0, 0.0, 0.3, 0.0))
    assert math.dist(base.wrist, bent.wrist) < 1e-12
    assert bent.palm == pytest.approx(base.palm)
    assert bent.tip[2] > base.tip[2] + 0.05


def test_the_wing_swings_the_elbow_out_and_moves_nothing_else() -> None:
    base, out = (solve(ONE, LENGTHS, SHOULDER, SNARE, STILL, wing) for wing in (0.0, 0.6))
    assert out.elbow[0] > base.elbow[0] + 0.02
    assert math.dist(base.wrist, out.wrist) < 1e-12
    assert math.dist(base.tip, out.tip) < 1e-12


def test_out_of_reach_the_shoulder_comes_along_and_the_lack_is_told() -> None:
    far = SNARE._replace(y=1.2)
    arm = solve(ONE, LENGTHS, SHOULDER, far, STILL)
    assert math.dist(arm.tip, (-0.05, 1.2, 0.66)) < 1e-9
    assert arm.missing_m == pytest.approx(math.dist(arm.root, SHOULDER))
    assert arm.missing_m > 0.1


def test_a_crossed_hand_still_touches() -> None:
    crossed = SNARE._replace(hand_yaw=-1.0, turns=0.0)
    lengths = ArmLengths(upper=0.33, fore=0.26, hand=0.15, ahead=0.27, behind=0.135)
    arm = solve(ONE, lengths, SHOULDER, crossed, STILL)
    assert math.dist(arm.tip, (-0.05, 0.45, 0.66)) < 1e-12
    rolled = solve(ONE, lengths, SHOULDER, crossed, Offsets(0.0, 0.0, 0.4, 0.0))
    assert math.dist(arm.hand, rolled.hand) < 1e-12  # the forearm's roll swings the stick alone
    assert rolled.tip[2] > arm.tip[2] + 0.05


def test_one_instant_and_many_agree() -> None:
    many = solve(MANY, LENGTHS, SHOULDER, Contact(*(np.full(3, v) for v in SNARE)), Offsets(0.1, 0.2, 0.3, 0.1), 0.1)
    one = solve(ONE, LENGTHS, SHOULDER, SNARE, Offsets(0.1, 0.2, 0.3, 0.1), 0.1)
    assert [float(v[1]) for v in many.tip] == pytest.approx(one.tip)
    assert float(many.extension[2]) == pytest.approx(one.extension)


def angles_of(arm: Arm) -> np.ndarray:
    """Heading, shoulder, elbow, extension, deviation and palm at each moment, (n, 6)."""
    angles = arm.heading, arm.shoulder, arm.elbow_bend, arm.extension, arm.deviation, arm.palm
    return np.stack(np.broadcast_arrays(*angles), 1)


@pytest.mark.parametrize("x", [-0.30, 0.0, 0.20, 0.22, 0.2201, 0.25, 0.40])
def test_angles_are_continuous_where_the_tip_passes_under_the_shoulder(x: float) -> None:
    """40 cm in half a second, at 1 kHz: no joint turns 1° in a step, which would be 1,000° a second."""
    figure = figure_of()
    lengths = Hold(GRIPS["american"], HELD["stick"]).lengths(figure)
    y = np.linspace(0.6, 0.2, 500)
    contact = Contact(np.full(500, x), y, *(np.full(500, v) for v in (0.75, 0.05, 0.30, 0.3, 0.1, 0.27, 0.2, 1.0)))
    found = np.degrees(angles_of(solve(MANY, lengths, SHOULDER, contact, STILL)))
    assert np.abs(np.diff(found, axis=0)).max() < 1.0
    limits = figure.limits
    assert found[:, 2].max() <= math.degrees(limits.elbow_flexion) + 1e-9
    assert found[:, 3].max() <= math.degrees(limits.wrist_extension) + 1e-9
    assert found[:, 3].min() >= -math.degrees(limits.wrist_flexion) - 1e-9
    assert found[:, 4].max() <= math.degrees(limits.wrist_radial) + 1e-9
    assert found[:, 4].min() >= -math.degrees(limits.wrist_ulnar) - 1e-9


@pytest.mark.parametrize("yaw", [-0.25, -0.3, 0.5])
def test_a_wrist_gives_in_at_its_limit_and_the_tip_stays(yaw: float) -> None:
    """The hand may turn about the fulcrum while the stick stays on the drum: a few degrees too much take nothing
    off."""
    held = replace(LENGTHS, wrist=tuple(np.radians((-80.0, 70.0, -30.0, 20.0)).tolist()))
    asked, given = (solve(ONE, k, SHOULDER, SNARE._replace(hand_yaw=yaw), STILL) for k in (LENGTHS, held))
    most = math.radians(20 if yaw > 0 else 30)
    assert abs(asked.deviation) > most
    assert abs(given.deviation) <= most + 1e-9
    assert math.dist(given.tip, (-0.05, 0.45, 0.66)) < 1e-3
    assert math.dist(given.wrist, given.hand) == pytest.approx(LENGTHS.hand)
    many = solve(MANY, held, SHOULDER, Contact(*(np.full(3, v) for v in SNARE._replace(hand_yaw=yaw))), STILL)
    assert [float(v[1]) for v in many.tip] == pytest.approx(given.tip)
