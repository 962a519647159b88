"""The bones of a hand's fingers, and how each grip bends them round what it holds.

Everything is in the hand's own axes (`station.motion.kinematics.grip`), of a right hand, in metres for the median
man's; the left hand is its mirror image. Lengths of the bones after Buryanov and Kotiuk 2010 (International Journal of
Morphology 28(3), 755–758), the last with the soft tip.

A digit is bent by five angles: aside to the thumb, at each of its three joints towards the palm, and twisted about its
own axis; a thumb's first joint is the one at the wrist. A grip's table says how digits would close if nothing were
there; each is opened just as far as the stick needs that it holds, wherever the stick is on its arc.
"""

from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.grip import BARE, STICK_RADIUS_M, Grip, line_axes
from station.motion.kinematics.pose import OPEN_FINGERS_RAD

Array = NDArray[np.float64]

THUMB, INDEX, MIDDLE, RING, LITTLE = range(5)
DIGITS, JOINTS = 5, 3
KNUCKLES_M = np.array(
    [
        (0.022, -0.010, 0.020),
        (0.023, 0.002, 0.090),
        (0.004, 0.005, 0.095),
        (-0.015, 0.002, 0.090),
        (-0.031, -0.003, 0.081),
    ]
)
"""Where each digit begins: the joint between wrist and thumb, then the knuckles."""
BONES_M = np.array(
    [
        (0.0462, 0.0316, 0.0257),
        (0.0398, 0.0224, 0.0196),
        (0.0446, 0.0263, 0.0213),
        (0.0414, 0.0257, 0.0212),
        (0.0327, 0.0181, 0.0197),
    ]
)
RADII_M = np.array(
    [
        (0.0150, 0.0118, 0.0102, 0.0086),
        (0.0108, 0.0095, 0.0083, 0.0070),
        (0.0110, 0.0097, 0.0085, 0.0072),
        (0.0106, 0.0092, 0.0080, 0.0068),
        (0.0094, 0.0080, 0.0070, 0.0060),
    ]
)
"""Half thicknesses at each digit's joints and tip (our choice: of a man's hand of that length)."""

_FIST = ((2, 78, 94, 48, 0), (12, 72, 94, 46, 0), (22, 66, 90, 44, 0))
_SPREAD = ((0, 22, 26, 14, 0), (-5, 18, 24, 12, 0), (-14, 14, 22, 12, 0))
"""Middle, ring and little finger, quite closed and quite open, degrees."""
_RELAXED = ((34, 22, 12, 12, -62), (4, 12, 14, 8, 0), (0, 12, 16, 9, 0), (-5, 14, 18, 10, 0), (-13, 16, 18, 10, 0))
"""A hand at rest; the skin is made in it."""
_FLAT = ((34, 22, 12, 12, -62), (6, 7, 6, 4, 0), (0, 7, 6, 4, 0), (-6, 7, 6, 4, 0), (-15, 7, 6, 4, 0))
"""A hand that plays the drum itself."""


def bent(angles_deg: Array) -> Array:
    """The frames (…, 15, 4, 4) of the digits' bones, bent by (…, 5, 5) degrees: z along the bone, y its back."""
    a = np.radians(angles_deg)
    turn = _about(1, a[..., 0]) @ _about(0, a[..., 1]) @ _about(2, a[..., 4])
    start = np.broadcast_to(KNUCKLES_M, (*a.shape[:-1], 3))
    found = np.zeros((*a.shape[:-1], JOINTS, 4, 4))
    for joint in range(JOINTS):
        if joint:
            start = start + BONES_M[:, joint - 1, None] * turn[..., 2]
            turn = turn @ _about(0, a[..., 1 + joint])
        found[..., joint, :3, :3], found[..., joint, :3, 3] = turn, start
    found[..., 3, 3] = 1.0
    return found.reshape(*a.shape[:-2], DIGITS * JOINTS, 4, 4)


def _about(axis: int, angle: Array) -> Array:
    """Turns (…, 3, 3) about one of the axes."""
    m = np.zeros((*angle.shape, 3, 3))
    j, k = (axis + 1) % 3, (axis + 2) % 3
    m[..., axis, axis] = 1.0
    m[..., j, j] = m[..., k, k] = np.cos(angle)
    m[..., k, j], m[..., j, k] = np.sin(angle), -np.sin(angle)
    return m


def to_butt(grip: Grip, opened_rad: Array) -> Array:
    """The stick's way from fulcrum to butt (n, 3) when the fingers have let it sink by `opened_rad` (n,)."""
    way = np.array(grip.to_butt)
    up = np.array([np.sin(grip.roll), np.cos(grip.roll), 0.0]) @ line_axes(grip.fulcrum)
    up -= (up @ way) * way
    up /= np.linalg.norm(up)
    return np.asarray(np.cos(opened_rad)[:, None] * way - np.sin(opened_rad)[:, None] * up)


@lru_cache(maxsize=16)
def finger_frames(grip: Grip) -> Array:
    """The frames (STEPS, 15, 4, 4) of the digits' bones from open to closed, evenly over `Pose.fingers` 0 … 1."""
    opened = (1 - np.linspace(0.0, 1.0, STEPS)) * OPEN_FINGERS_RAD
    closed, wide = (np.array(pose, np.float64) for pose in _DIGITS[grip.name])
    if grip.name == BARE.name:  # the fingers are what is held: they themselves turn about the knuckles
        angles = np.tile(closed, (STEPS, 1, 1))
        angles[:, INDEX:, 1] -= np.degrees(opened)[:, None]
        return bent(angles)
    share = np.linspace(0.0, 1.0, _TRIES)  # from closed to open
    tries = closed + share[:, None, None] * (wide - closed)
    free = _free(bent(tries), np.array(grip.fulcrum), to_butt(grip, opened))
    blocked = np.where(free, -1, np.arange(_TRIES)[:, None])  # the most open try that the stick forbids
    chosen = share[np.minimum(blocked.max(axis=1) + 1, _TRIES - 1)]
    at_least = (opened / OPEN_FINGERS_RAD)[:, None]
    chosen = np.maximum(chosen, at_least)
    chosen[:, : _PINCHING[grip.name]] = at_least
    return bent(closed + chosen[..., None] * (wide - closed))


STEPS = 17
_PINCHING = {"german": 2, "american": 2, "french": 2, "traditional": 1}
"""So many of the first digits stay at the fulcrum, however the stick turns in them."""
_TRIES = 61
_PRESSED_M = 0.0005
"""So deep the flesh of a finger gives where it holds (our choice)."""


def _free(frames: Array, fulcrum: Array, way: Array) -> NDArray[np.bool_]:
    """Whether each digit (steps, tries, 5) is clear of the stick with `way` (steps, 3) to its butt."""
    along = np.linspace(0.0, 1.0, 7)
    bones = frames.reshape(len(frames), DIGITS, JOINTS, 4, 4)
    points = bones[..., None, :3, 3] + (along[:, None] * BONES_M[..., None, None]) * bones[..., None, :3, 2]
    radii = RADII_M[:, :-1, None] + along * (RADII_M[:, 1:] - RADII_M[:, :-1])[..., None]
    away = points - fulcrum
    on = np.einsum("tdjpk,sk->stdjp", away, way)
    gap = np.sqrt(np.maximum((away * away).sum(-1) - on * on, 0.0)) - radii - STICK_RADIUS_M
    return np.asarray((gap > -_PRESSED_M).all(axis=(3, 4)))


_DIGITS: Mapping[str, tuple[tuple[tuple[int, ...], ...], tuple[tuple[int, ...], ...]]] = MappingProxyType(
    {
        "german": (
            ((47, 10, 55, -4, -79), (0, 38, 110, 20, 7), *_FIST),
            ((52, 7, 67, -15, -83), (-5, 30, 111, -13, 20), *_SPREAD),
        ),
        "american": (
            ((47, 11, 56, -4, -81), (1, 38, 110, 21, 7), *_FIST),
            ((53, 21, 74, -25, -93), (9, 28, 106, 1, 13), *_SPREAD),
        ),
        "french": (
            ((48, 15, 56, -1, -85), (3, 37, 108, 21, 7), *_FIST),
            ((49, 34, 77, -30, -108), (9, 29, 106, 11, 13), *_SPREAD),
        ),
        "traditional": (
            ((39, 31, 60, 28, -91), (2, 62, 52, 26, 0), (0, 66, 52, 28, 0), (2, 66, 34, 8, 0), (6, 66, 62, 32, 0)),
            ((74, 37, 77, 15, -69), (6, 10, 14, 8, 0), (0, 14, 16, 8, 0), (0, 6, 14, 5, 0), (-8, 30, 44, 22, 0)),
        ),
        "bare": (_FLAT, _FLAT),
    }
)
"""Closed, and open by `OPEN_FINGERS_RAD`, degrees. Thumbs, and the matched grips' index fingers, are as their bones and
joints best bring thumb pad and middle joint to the stick at the fulcrum, by least squares; the rest is our choice."""
REST = bent(np.array(_RELAXED, np.float64))
"""The frames (15, 4, 4) in which the skin is made."""
