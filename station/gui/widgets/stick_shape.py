"""A drum stick in perspective, as plain numbers for whoever paints it: no imgui.

The stick turns about the hand's fulcrum, seen from behind and above the player: x to the right, y ahead, z up, metres.
It is a 5A: 406 mm long, 14.5 mm thick, its last 100 mm tapered to a neck of 7 mm before an oval tip (our choice, as
makers' catalogues draw it). The fulcrum is a third of its length from the butt (HUMANS).
"""

from math import cos, radians, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.imu import Quaternion
from station.sync.strokes.stick_axes import rows_of

Points = NDArray[np.float64]
"""(…, 2): to the right and down, in units of the picture's height, from its middle."""

LENGTH_M = 0.406
FULCRUM_M = LENGTH_M / 3
_MAKERS_MM = (
    (0, 5.6),
    (4, 7.0),
    (12, 7.25),
    (290, 7.25),
    (345, 5.6),
    (388, 3.5),
    (392, 4.6),
    (399, 5.2),
    (404, 4),
    (406, 0.8),
)
_PROFILE = np.array(_MAKERS_MM) / 1000.0
"""Metres from the butt, and the radius there."""
_SENSOR_M = (0.012, 0.045)
"""Where the sensor's mark lies, from the butt: sold sensors sit on it."""
_MARK_HALF_M = 0.012

_ELEVATION, _ASIDE, _AWAY_M, _HIGH_M = radians(22.0), radians(38.0), 1.15, 0.40
"""The eye: so far above the horizontal and to the right of behind the player, so far from the fulcrum; metres that the
picture's height shows there (our choice: how far a tip is raised, and where it points, are both seen)."""
_THICKER = 1.5
"""Drawn so much thicker than it is: in a small picture a stick is a line else (our choice)."""
_LIT = np.array([-0.45, -0.35, 0.82])
"""Where the light comes from: left, behind and above."""
_STRIPS = 7
"""Lengthwise strips of one shade each; our choice: fewer show their edges."""


class StickShape(NamedTuple):
    """What to paint of one stick, far before near.

    `strips` (strips, n, 2) run from butt to tip, each pair of neighbours the edges of a strip with a `shades` 0 … 1;
    `sensor` (4, 2) is the sensor's upper face and `faces` 0 … 1 how much of it is seen; `shadow` (n, 2, 2) has the two
    edges of what the stick throws on the head below it.
    """

    strips: Points
    shades: NDArray[np.float64]
    sensor: Points
    faces: float
    shadow: Points


def stick_shape(turn: Quaternion, below_m: float = 0.10) -> StickShape:
    """The stick as it is held: `turn` earth from stick, heading 0 ahead; the head lies `below_m` under the fulcrum."""
    axes = _AHEAD @ np.array(rows_of(turn))
    along, up = axes[:, 0], axes[:, 2]
    centres = (_PROFILE[:, :1] - FULCRUM_M) * along
    view = _EYE - centres[len(centres) // 2]
    side = np.cross(along, view)
    side /= max(float(np.linalg.norm(side)), 1e-9)
    front = np.cross(side, along)
    radii = _THICKER * _PROFILE[:, 1]
    angles = np.linspace(-np.pi / 2, np.pi / 2, _STRIPS + 1)
    normals = np.sin(angles)[:, None] * side + np.cos(angles)[:, None] * front
    edges = centres[None] + radii[None, :, None] * normals[:, None, :]
    middles = normals[:-1] + normals[1:]
    middles /= np.linalg.norm(middles, axis=1, keepdims=True)
    shades = np.clip(0.42 + 0.58 * (middles @ (_LIT / np.linalg.norm(_LIT))), 0.0, 1.0)
    return StickShape(
        projected(edges), shades, _sensor(axes), max(0.0, float(up @ _to_eye())), _shadow(centres, radii, below_m)
    )


def head_outline(radius_m: float, centre_m: tuple[float, float, float], points: int = 48) -> Points:
    """The edge (points, 2) of a round head that lies flat about `centre_m`."""
    angle = np.linspace(0.0, 2.0 * np.pi, points, endpoint=False)
    flat = np.stack([radius_m * np.cos(angle), radius_m * np.sin(angle), np.zeros(points)], axis=-1)
    return projected(flat + np.array(centre_m))


def projected(places: NDArray[np.float64]) -> Points:
    """Places (…, 3) in metres on the picture."""
    ahead, aside, z = places[..., 1], places[..., 0], places[..., 2]
    x = aside * cos(_ASIDE) + ahead * sin(_ASIDE)
    y = ahead * cos(_ASIDE) - aside * sin(_ASIDE)
    c, s = cos(_ELEVATION), sin(_ELEVATION)
    depth = _AWAY_M + y * c - z * s
    scale = _AWAY_M / np.maximum(depth, 0.1) / _HIGH_M
    return np.stack([x * scale, -(z * c + y * s) * scale], axis=-1)


_AHEAD = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
"""From the earth's axes with heading 0 along x to the picture's, where ahead is y and left is −x."""
_EYE = _AWAY_M * np.array([cos(_ELEVATION) * sin(_ASIDE), -cos(_ELEVATION) * cos(_ASIDE), sin(_ELEVATION)])


def _to_eye() -> NDArray[np.float64]:
    return _EYE / np.linalg.norm(_EYE)


def _sensor(axes: NDArray[np.float64]) -> Points:
    """The upper face of the sensor, as wide as the stick is thick and a little more."""
    along, left, up = axes.T
    corners = [
        (at - FULCRUM_M) * along + side * _MARK_HALF_M * left + 0.013 * up
        for at, side in ((_SENSOR_M[0], 1), (_SENSOR_M[0], -1), (_SENSOR_M[1], -1), (_SENSOR_M[1], 1))
    ]
    return projected(np.array(corners))


def _shadow(centres: NDArray[np.float64], radii: NDArray[np.float64], below_m: float) -> Points:
    on_head = centres.copy()
    on_head[:, 2] = -below_m
    along = on_head[-1] - on_head[0]
    aside = np.array([-along[1], along[0], 0.0]) / max(float(np.linalg.norm(along)), 1e-9)
    wide = radii[:, None] * aside
    return np.stack([projected(on_head - wide), projected(on_head + wide)], axis=1)
