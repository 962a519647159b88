"""Joint limits, in radians (HUMANS, Body), and what they leave to a stroke."""

from dataclasses import dataclass
from math import radians


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
