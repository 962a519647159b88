"""What joints do, measured anew from positions, and what people's joints can: ranges and speeds with their sources.

Ranges are HUMANS.md's (AAOS, rounded) and, where it is silent, Kapandji's and AAOS's from memory (`mem`). Speeds are
the fastest that studies of sport report: nobody drums faster.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.examiner.take import SIDES, Sampled

Array = NDArray[np.float64]


class Range(NamedTuple):
    """Degrees, and the greatest speed in degrees a second."""

    least: float
    most: float
    speed: float


SLACK_DEG = 5.0
"""Goniometers and their readers agree to about 5° (Gajdosik & Bohannon 1987)."""

MEASURED = {
    "elbow": Range(0, 150, 2300),  # extension in a pitch 2,300 (Fleisig 1999)
    "wrist extension": Range(
        -80, 70, 2000
    ),  # flexion in a tennis serve 1,950 (Fleisig 2003); a drum stroke 690 (Pearl)
    "wrist to the thumb": Range(-30, 20, 1000),  # our choice: half of flexion's, the range is a third
    "forearm pronation": Range(-80, 90, 2500),  # a pitch about 2,500 (mem); palms flat on a table is 80–90
    "shoulder inward rotation": Range(-90, 75, 2420),  # a tennis serve (Fleisig 2003)
    "upper arm across the chest": Range(-180, 50, 1100),  # horizontal adduction 45 past straight ahead (AAOS, mem)
    "upper arm backward": Range(-180, 60, 1100),
    "upper arm": Range(
        0, 180, 1100
    ),  # raising the arm, about 1,000 (mem: pitch's horizontal adduction 600, volley 1,100)
    "stick in the hand": Range(0, 180, 2600),  # 1,250 in a stroke at 100 bpm (Pearl 2023), twice that our choice
    "knee": Range(0, 135, 1500),  # a kick at football (mem)
    "hip": Range(-10, 125, 1000),
    "ankle": Range(-50, 20, 1000),  # push-off of a sprint 800–1,000 (mem)
}
"""From positions: what `measured` returns."""

STATED = {
    "torso_twist": Range(-45, 45, 400),  # thorax on pelvis 35–45 (Kapandji, mem); 400 is half of a serve's 870
    "torso_lean": Range(-30, 60, 280),  # trunk tilt in a serve 280 (Fleisig 2003)
    "torso_side": Range(-35, 35, 280),
    "head_nod": Range(-60, 50, 700),  # quickest head turns 600–780 (Grossman 1988)
    "head_turn": Range(-70, 70, 700),
    "head_tilt": Range(-45, 45, 500),
    "right_hip": Range(-10, 125, 1000),
    "left_hip": Range(-10, 125, 1000),
    "right_knee": Range(0, 135, 1500),
    "left_knee": Range(0, 135, 1500),
    "right_ankle": Range(-50, 20, 1000),
    "left_ankle": Range(-50, 20, 1000),
    "right_elbow": Range(0, 150, 2300),
    "left_elbow": Range(0, 150, 2300),
    "right_wrist": Range(-80, 70, 2000),
    "left_wrist": Range(-80, 70, 2000),
    "right_wrist_side": Range(-30, 20, 1000),
    "left_wrist_side": Range(-30, 20, 1000),
}
"""What the file's own angles may be; the arm plane's heading has no range, it spins where the arm hangs."""

FULCRUM_DEG = {"traditional": (25.0, 4.0)}
MATCHED_DEG = (18.0, 11.0)
"""From the hand's bones (the middle metacarpal, where a goniometer reads) to the line from wrist to fulcrum:
towards the thumb, under the palm. Between thumb and index finger's middle joint the fulcrum is about 105 mm ahead of
the wrist, 35 to the thumb's side and 20 under the bones; in the web of the thumb 75, 35 and 5 (our own hands, ± 5°)."""

TIP_M_S, HAND_M_S = 16.0, 9.0
"""Peak of a stick's tip 9.4 in a full stroke, of a boxer's fist 9 (Pearl 2023; Walilko 2005): the loudest rim shot
of a tall player is given 16 (our choice)."""


def _unit(v: Array) -> Array:
    return np.asarray(v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12))


def _dot(a: Array, b: Array) -> Array:
    return np.asarray((a * b).sum(-1))


def _degrees(y: Array, x: Array) -> Array:
    return np.degrees(np.arctan2(y, x))


def _between(a: Array, b: Array) -> Array:
    return _degrees(np.linalg.norm(np.cross(a, b), axis=-1), _dot(a, b))


def trunk_axes(poses: Sampled) -> tuple[Array, Array, Array]:
    """The chest's right, forward and up, (n, 3) each."""
    up = _unit(poses.point("neck") - poses.point("spine"))
    right = poses.point("right_shoulder") - poses.point("left_shoulder")
    right = _unit(right - _dot(right, up)[:, None] * up)
    return right, np.cross(up, right), up


class Arm(NamedTuple):
    """One arm's directions in the world: upper arm, forearm, hand, back of the hand, thumb's side, stick."""

    upper: Array
    fore: Array
    hand: Array
    back: Array
    thumb: Array
    stick: Array


def arm(poses: Sampled, side: str, grip: str = "american") -> Arm:
    """The directions of `side`'s arm; the hand's are its bones', whose fulcrum lies where `grip` has it."""
    i, sign = SIDES.index(side), 1.0 if side == "right" else -1.0
    shoulder, elbow = poses.point(f"{side}_shoulder"), poses.point(f"{side}_elbow")
    wrist, fist = poses.point(f"{side}_wrist"), poses.point(f"{side}_hand")
    hand = _unit(fist - wrist)
    back = poses.back[:, i]
    back = _unit(back - _dot(back, hand)[:, None] * hand)
    thumb = sign * np.cross(back, hand)
    aside, under = np.radians(FULCRUM_DEG.get(grip, MATCHED_DEG))
    hand, thumb = np.cos(aside) * hand - np.sin(aside) * thumb, np.cos(aside) * thumb + np.sin(aside) * hand
    hand, back = np.cos(under) * hand + np.sin(under) * back, np.cos(under) * back - np.sin(under) * hand
    stick = _unit(poses.tip_m[:, i] - poses.butt_m[:, i])
    return Arm(_unit(elbow - shoulder), _unit(wrist - elbow), hand, back, thumb, stick)


def measured(poses: Sampled, side: str, grip: str = "american") -> tuple[dict[str, Array], dict[str, Array]]:
    """Angles in degrees of `side`'s arm and leg (n,), and the directions whose turning has a speed, (n, 3).

    NaN where a straight arm shows no angle.
    """
    limb = arm(poses, side, grip)
    sign = 1.0 if side == "right" else -1.0
    right, forward, up = trunk_axes(poses)
    angles = {
        "elbow": _between(limb.upper, limb.fore),
        "wrist extension": np.degrees(np.arcsin(np.clip(-_dot(limb.fore, limb.back), -1, 1))),
        "wrist to the thumb": _degrees(-_dot(limb.fore, limb.thumb), _dot(limb.fore, limb.hand)),
        "upper arm across the chest": np.degrees(np.arcsin(np.clip(-sign * _dot(limb.upper, right), -1, 1))),
        "upper arm backward": np.degrees(np.arcsin(np.clip(-_dot(limb.upper, forward), -1, 1))),
    }
    bent = angles["elbow"] > 15
    angles["forearm pronation"] = np.where(bent, _pronation(limb, sign), np.nan)
    angles["shoulder inward rotation"] = np.where(bent, _inward(limb, sign, forward, up), np.nan)
    turning = {
        "upper arm": np.stack([_dot(limb.upper, axis) for axis in (right, forward, up)], 1),
        "stick in the hand": np.stack([_dot(limb.stick, axis) for axis in (limb.hand, limb.back, limb.thumb)], 1),
    }
    hip, knee = poses.point(f"{side}_hip"), poses.point(f"{side}_knee")
    ankle = poses.point(f"{side}_ankle")
    angles["knee"] = _between(knee - hip, ankle - knee)
    return angles, turning


def _pronation(limb: Arm, sign: float) -> Array:
    """From thumb up, 90 is palm down; about the forearm, against the elbow's axis."""
    axis = _unit(np.cross(limb.upper, limb.fore))
    back = _unit(limb.back - _dot(limb.back, limb.fore)[:, None] * limb.fore)
    return _degrees(_dot(back, np.cross(axis, limb.fore)), sign * _dot(back, axis))


def _inward(limb: Arm, sign: float, forward: Array, up: Array) -> Array:
    """The upper arm's turn about itself, 0 where the shortest way up from hanging with the forearm ahead leads."""
    hanging = -up
    axis = np.cross(hanging, limb.upper)
    cosine = _dot(hanging, limb.upper)[:, None]
    ahead = forward * cosine + np.cross(axis, forward) + axis * _dot(axis, forward)[:, None] / (1 + cosine)
    fore = limb.fore - _dot(limb.fore, limb.upper)[:, None] * limb.upper
    return np.asarray(-sign * _degrees(_dot(np.cross(ahead, fore), limb.upper), _dot(ahead, fore)))


def turned_deg(directions: Array) -> Array:
    """From each direction (n, 3) to the next, (n − 1,) degrees."""
    return _between(directions[:-1], directions[1:])
