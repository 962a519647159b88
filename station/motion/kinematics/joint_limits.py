"""Joint limits (HUMANS, Body) and the fastest that joints turn: what no motion may pass. Radians, radians a second."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import radians, sqrt
from types import MappingProxyType


@dataclass(frozen=True, slots=True)
class Limits:
    """How far each joint goes; every number may be set in a figure's file."""

    shoulder_flexion: float = radians(180)
    shoulder_extension: float = radians(60)
    elbow_flexion: float = radians(150)
    wrist_extension: float = radians(70)
    wrist_flexion: float = radians(80)
    wrist_radial: float = radians(20)
    wrist_ulnar: float = radians(30)
    forearm_roll: float = radians(80)
    fingers: float = radians(60)  # the stick's angle in the hand; our choice
    hip_flexion: float = radians(125)
    knee_flexion: float = radians(130)
    ankle_plantar: float = radians(50)
    ankle_dorsi: float = radians(20)
    neck_rotation: float = radians(70)


_ARM = {"shoulder_twist": 2420, "shoulder": 2420, "shoulder_wing": 2420, "elbow": 1510, "wrist": 1950}
"""Mean peaks of world-class men in the tennis serve (Fleisig and others 2003, Sports Biomechanics 2(1), 51–64):
rotation of the upper arm, extension of the elbow, flexion of the wrist."""
_HAND = {"wrist_side": 1950, "forearm": 1950, "stick": 2500}
"""The wrist sideways and the forearm's roll as the wrist. One full stroke at an easy
tempo turns the stick in the hand at 1250°/s (HUMANS); twice that is taken for the fastest (our choice: no measurement
is known)."""
_LEG_RATE = sqrt(9.81 / 1.0)
_LEG = {"hip": 6.1 * _LEG_RATE, "knee": 6.1 * _LEG_RATE, "ankle": 7.2 * _LEG_RATE}
"""Mean peaks of volleyball players in the spike jump, in roots of gravity over leg length, here 1 m (Bisseling and
others 2008, British Journal of Sports Medicine 42, 483–489, table 3); the hip as the knee (our choice)."""
_TRUNK = {"torso_twist": 870, "torso_lean": 280, "torso_side": 280, "head_nod": 540, "head_turn": 540, "head_tilt": 540}
"""Upper torso and trunk tilt in the same serves; the head as in vigorous shaking, 91° to and fro at 1.9 Hz (Funk and
others 2015, Journal of Applied Biomechanics 31(3), 170–175: half of 91° · 2π · 1.9 Hz)."""

FASTEST_RAD_S: Mapping[str, float] = MappingProxyType(
    {f"{side}_{joint}": radians(speed) for side in ("right", "left") for joint, speed in (_ARM | _HAND).items()}
    | {f"{side}_{joint}": speed for side in ("right", "left") for joint, speed in _LEG.items()}
    | {joint: radians(speed) for joint, speed in _TRUNK.items()}
)
"""How fast each angle of a pose (`pose.ANGLE_NAMES`) turns at most."""
