"""The drummer's body: its joints, how they hang together, and its measures as fractions of the stature.

Segment lengths and joint heights after Winter and Drillis & Contini (HUMANS, Body); their shoulder breadth of .259 is
drawn about the deltoids, and from acromion to acromion a median man has .23 (Pheasant, Bodyspace: 400 of 1740 mm). The
joints lie farther in: .34 m apart in the 1.70 m man of Rajagopal 2016 (doi 10.1109/TBME.2016.2586891). Where in the
hand the fulcrum of a grip is, `grip` says.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from enum import IntEnum
from math import radians
from pathlib import Path

from station.core.disk.shipped import find_shipped, shipped
from station.core.toml.schema import Field, Fields, Reader, needed, number, optional, read, record, said, text
from station.core.toml.toml_source import read_source
from station.motion.kinematics.joint_limits import Limits
from station.motion.kinematics.look import LOOK, Look


class Joint(IntEnum):
    """Points of the body whose positions a pose gives; right before left."""

    PELVIS = 0
    SPINE = 1
    NECK = 2  # the base of the neck, between the shoulders
    HEAD = 3  # where the skull sits on the neck
    CROWN = 4  # the top of the head
    RIGHT_SHOULDER = 5
    RIGHT_ELBOW = 6
    RIGHT_WRIST = 7
    RIGHT_HAND = 8  # the fulcrum of the grip
    LEFT_SHOULDER = 9
    LEFT_ELBOW = 10
    LEFT_WRIST = 11
    LEFT_HAND = 12
    RIGHT_HIP = 13
    RIGHT_KNEE = 14
    RIGHT_ANKLE = 15
    RIGHT_TOE = 16
    LEFT_HIP = 17
    LEFT_KNEE = 18
    LEFT_ANKLE = 19
    LEFT_TOE = 20


PARENT: dict[Joint, Joint | None] = {
    Joint.PELVIS: None,
    Joint.SPINE: Joint.PELVIS,
    Joint.NECK: Joint.SPINE,
    Joint.HEAD: Joint.NECK,
    Joint.CROWN: Joint.HEAD,
    Joint.RIGHT_SHOULDER: Joint.NECK,
    Joint.RIGHT_ELBOW: Joint.RIGHT_SHOULDER,
    Joint.RIGHT_WRIST: Joint.RIGHT_ELBOW,
    Joint.RIGHT_HAND: Joint.RIGHT_WRIST,
    Joint.LEFT_SHOULDER: Joint.NECK,
    Joint.LEFT_ELBOW: Joint.LEFT_SHOULDER,
    Joint.LEFT_WRIST: Joint.LEFT_ELBOW,
    Joint.LEFT_HAND: Joint.LEFT_WRIST,
    Joint.RIGHT_HIP: Joint.PELVIS,
    Joint.RIGHT_KNEE: Joint.RIGHT_HIP,
    Joint.RIGHT_ANKLE: Joint.RIGHT_KNEE,
    Joint.RIGHT_TOE: Joint.RIGHT_ANKLE,
    Joint.LEFT_HIP: Joint.PELVIS,
    Joint.LEFT_KNEE: Joint.LEFT_HIP,
    Joint.LEFT_ANKLE: Joint.LEFT_KNEE,
    Joint.LEFT_TOE: Joint.LEFT_ANKLE,
}
"""The joint that each joint hangs from; the segment between the two is one bone."""


@dataclass(frozen=True, slots=True)
class Figure:
    """Lengths in metres, the joints' limits, and what pictures show of it."""

    stature_m: float
    trunk_m: float  # hip to shoulder height
    shoulder_breadth_m: float  # between the shoulder joints
    hip_breadth_m: float  # between the hip joints
    neck_m: float
    head_m: float  # from the joint on the neck to the crown
    upper_arm_m: float
    forearm_m: float
    hand_m: float  # wrist to the fingertips of the straight hand
    thigh_m: float
    shank_m: float
    foot_m: float
    ankle_height_m: float
    stick_m: float = 0.406  # 5A (HUMANS, Kit)
    limits: Limits = field(default_factory=Limits)
    look: Look = field(default_factory=Look)


MEDIAN_STATURE_M = 1.759
"""A median man (HUMANS, Body)."""
_SHARES: Mapping[str, float] = {
    "trunk_m": 0.288,
    "shoulder_breadth_m": 0.200,  # between the joints
    "hip_breadth_m": 0.115,  # the breadth of the hips is .191; their joints lie at .6 of it (our choice)
    "neck_m": 0.060,
    "head_m": 0.122,
    "upper_arm_m": 0.186,
    "forearm_m": 0.146,
    "hand_m": 0.108,
    "thigh_m": 0.245,
    "shank_m": 0.246,
    "foot_m": 0.152,
    "ankle_height_m": 0.039,
}
"""Segments as shares of the stature."""


def figure_of(stature_m: float = MEDIAN_STATURE_M) -> Figure:
    """A figure of that stature with the published proportions."""
    lengths = {name: share * stature_m for name, share in _SHARES.items()}
    return Figure(stature_m=stature_m, **lengths)  # type: ignore[arg-type] # lengths alone


# --- files ------------------------------------------------------------------------------------------------------------

FIGURES = Path(__file__).parents[1] / "data" / "drummers"
DEFAULT_FIGURE = "headphones"
"""Who plays where nobody is asked for: `figure_of()`."""
LEAST_STATURE_M, GREATEST_STATURE_M = 0.8, 2.4


def figure_names() -> list[str]:
    """The drummers that ship with the station."""
    return shipped(FIGURES)


def load_figure(name_or_path: str | Path) -> Figure:
    """A shipped drummer by name, or a drummer's file; raises `BadInput` with the place of the first fault.

    A file holds `stature_m`, and where they differ from the published proportions a table `segments` of lengths in
    metres and a table `limits` of angles in degrees, both by the names of the fields here; a table `look` (`look`).
    """
    path = find_shipped(name_or_path, FIGURES, "drummer")
    return read(read_source(path), FIGURE)


def _angle(value: object) -> float:
    """An angle that the file has in degrees, in radians."""
    return radians(number(0.0, 200.0)(value))


def _figure(
    title: str, stature_m: float, segments: Mapping[str, float], limits: Mapping[str, float], look: Look
) -> Figure:
    """The figure that a file describes; its title is for people alone."""
    return replace(figure_of(stature_m), limits=replace(Limits(), **limits), look=look, **segments)


FIELDS: Fields = {
    "title": Field(text, ""),
    "stature_m": needed(number(LEAST_STATURE_M, GREATEST_STATURE_M), "stature_m = 1.76"),
    "segments": Field(said({name: optional(number(0.01, 1.5)) for name in _SHARES}, "segment"), {}),
    "limits": Field(said({each.name: optional(_angle) for each in fields(Limits)}, "limit"), {}),
    "look": Field(LOOK, Look()),
}
FIGURE: Reader[Figure] = record(_figure, FIELDS)
"""The schema of the file."""
