"""The body as capsules, and how deep arms and sticks are in it, in each other and in the kit, at many moments at once.

Radii are shares of the stature, so that a small drummer has thin arms. Metres; points (n, 3). Where nothing touches a
depth is below 0 by the distance, so that what is nearly too near is seen as well.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.arm import Arm
from station.motion.kit.kit import Kit

Array = NDArray[np.float64]

STICK_RADIUS_M = 0.007
"""A 5A stick is 14 mm thick (ASTM has no standard; makers agree)."""
FOREARM, UPPER_ARM, HAND = 0.020, 0.026, 0.014
"""Radii of a forearm near the wrist (3.5 cm), an upper arm at the elbow (4.6 cm: 29 cm round) and a fist flat on its
side (2.5 cm) as shares of the stature of a median man (ANSUR II, Gordon and others 2014: wrist 17.5 cm and forearm
30 cm round, elbow 29 cm; a hand 2.8 cm thick)."""
CHEST, HEAD, THIGH = 0.060, 0.051, 0.043
"""A trunk 21 cm deep of the 25 that the chest of ANSUR's median man measures with the flesh that gives way; a head
17.8 cm broad between his breadth of 15.4 and length of 19.9; a thigh 15 cm thick, as it is near the knee."""
_ASIDE = 0.020
"""The trunk is two upright capsules so far to each side of the spine: 28 cm broad, as ANSUR's man's chest without the
arms (28.9); elbows that lie at the waist's flesh touch as they do in life."""
_CHEST_TOP = 0.08
"""So far under the neck's base the trunk narrows to where arms hang: what crosses above that is the shoulder's
flesh."""


@dataclass(frozen=True, slots=True, eq=False)
class ArmPoints:
    """Shoulder, elbow, wrist, the grip's fulcrum, butt and tip of one arm, (n, 3) each."""

    shoulder: Array
    elbow: Array
    wrist: Array
    hand: Array
    butt: Array
    tip: Array


def points_of(arm: Arm) -> ArmPoints:
    """The points of a solved arm, (n, 3) each."""
    ends = (arm.root, arm.elbow, arm.wrist, arm.hand, arm.butt, arm.tip)
    return ArmPoints(*(np.stack(np.broadcast_arrays(*p), -1) for p in ends))


@dataclass(frozen=True, slots=True, eq=False)
class BodyPoints:
    """Pelvis, neck's base, head and crown, both shoulders, and of the right and the left thigh hip and knee, (n, 3)."""

    pelvis: Array
    neck: Array
    head: Array
    crown: Array
    shoulders: tuple[Array, Array]
    thighs: tuple[tuple[Array, Array], tuple[Array, Array]]


_PARTS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "stick": ("butt", "tip"),
        "hand": ("wrist", "hand"),
        "forearm": ("elbow", "wrist"),
        "upper arm": ("shoulder", "elbow"),
    }
)
_AGAINST_THE_OTHER = (
    *(("stick", "stick"), ("stick", "hand"), ("hand", "stick"), ("stick", "forearm"), ("forearm", "stick")),
    *(("stick", "upper arm"), ("upper arm", "stick"), ("hand", "hand"), ("hand", "forearm"), ("forearm", "hand")),
    ("forearm", "forearm"),
)
_OUTER = 0.5
"""Of the upper arm the half to the elbow is held off the trunk; the other grows out of it (our choice)."""


def radius_m(part: str, stature_m: float) -> float:
    """The radius of a part of `_PARTS`."""
    return STICK_RADIUS_M if part == "stick" else stature_m * {"hand": HAND, "forearm": FOREARM}.get(part, UPPER_ARM)


def in_each_other(one: ArmPoints, other: ArmPoints, stature_m: float) -> dict[str, Array]:
    """How deep the parts of `one` arm are in those of the `other`, (n,) each."""
    gaps = _gaps([(*_ends(one, a), *_ends(other, b)) for a, b in _AGAINST_THE_OTHER])
    return {
        f"{a} in the other {b}": radius_m(a, stature_m) + radius_m(b, stature_m) - gap
        for (a, b), gap in zip(_AGAINST_THE_OTHER, gaps, strict=True)
    }


Capsules = list[tuple[Array, Array]]


def trunk_capsules(pelvis: Array, neck: Array, shoulders: tuple[Array, Array], stature_m: float) -> Capsules:
    """The trunk between the pelvis, the neck's base and the two shoulders, (n, 3) each or one of them (3,)."""
    right, down = shoulders[0] - shoulders[1], neck - pelvis
    aside = _ASIDE * stature_m * right / np.linalg.norm(right, axis=-1, keepdims=True)
    top = neck - _CHEST_TOP * stature_m * down / np.linalg.norm(down, axis=-1, keepdims=True)
    return [(pelvis + s * aside, top + s * aside) for s in (-1.0, 1.0)]


def in_capsules(arm: ArmPoints, part: str, capsules: Capsules, share: float, stature_m: float) -> Array:
    """How deep a part of an arm is in capsules whose radius is a `share` of the stature, (n,)."""
    gaps = _gaps([(*_ends(arm, part), *capsule) for capsule in capsules])
    return np.asarray(radius_m(part, stature_m) + share * stature_m - gaps.min(axis=0))


def in_the_body(arm: ArmPoints, body: BodyPoints, stature_m: float) -> dict[str, Array]:
    """How deep the parts of an arm are in trunk, head and thighs, (n,) each."""
    middle = 0.5 * (body.head + body.crown)
    solids: tuple[tuple[str, float, Capsules, tuple[str, ...]], ...] = (
        ("trunk", CHEST, trunk_capsules(body.pelvis, body.neck, body.shoulders, stature_m), tuple(_PARTS)),
        ("head", HEAD, [(middle, middle)], ("stick", "hand")),
        ("thigh", THIGH, list(body.thighs), ("stick", "hand")),
    )
    wanted = [(name, share, part, c) for name, share, capsules, parts in solids for part in parts for c in capsules]
    gaps = _gaps([(*_ends(arm, part), *capsule) for *_, part, capsule in wanted])
    found: dict[str, Array] = {}
    for (name, share, part, _), gap in zip(wanted, gaps, strict=True):
        key, deep = f"{part} in the {name}", radius_m(part, stature_m) + share * stature_m - gap
        found[key] = np.maximum(found[key], deep) if key in found else deep
    return found


def arm_in_kit(kit: Kit, arm: ArmPoints, stature_m: float) -> dict[str, Array]:
    """How deep hand and forearm are in drums and cymbals, (n,) each: cylinders and discs; the kick is left out."""
    parts = ("hand", "forearm")
    start, end = (np.concatenate(points) for points in zip(*(_ends(arm, part) for part in parts), strict=True))
    thick = np.repeat([radius_m(part, stature_m) for part in parts], len(start) // 2)
    middle, reach = 0.5 * (start + end), 0.5 * np.linalg.norm(end - start, axis=1) + 2 * thick
    gap = np.full(len(start), np.inf)
    for piece in kit.pieces.values():
        if piece.kind == "kick":
            continue
        half = 0.5 * piece.depth_m if piece.kind in ("drum", "block") else 0.0
        centre = piece.centre - half * piece.normal
        away = middle - centre
        over = np.abs(away @ piece.normal) < reach + half
        on = np.flatnonzero(over & (_dot(away, away) < (reach + np.hypot(piece.radius_m, half)) ** 2))
        if len(on):
            points = start[on, None] + _ALONG * (end - start)[on, None]
            gap[on] = np.minimum(gap[on], _off_cylinder(points - centre, piece.normal, piece.radius_m, half))
    return {f"{part} in the kit": deep for part, deep in zip(parts, np.split(thick - gap, 2), strict=True)}


_ALONG = np.linspace(0.0, 1.0, 5)[:, None]
"""Places on hand and forearm at which they are looked at, nearer to one another than they are thick."""


def _off_cylinder(away: Array, normal: Array, radius_m: float, half_m: float) -> Array:
    """How far the nearest of points (n, k, 3) from its middle is off a cylinder or, `half_m` 0, a disc, (n,)."""
    height = away @ normal
    out = np.sqrt(np.maximum(_dot(away, away) - height**2, 0.0)) - radius_m
    over = np.abs(height) - half_m
    apart = np.hypot(np.maximum(out, 0.0), np.maximum(over, 0.0)) + np.minimum(np.maximum(out, over), 0.0)
    return np.asarray(apart.min(axis=1))


def _ends(arm: ArmPoints, part: str) -> tuple[Array, Array]:
    a, b = (getattr(arm, end) for end in _PARTS[part])
    return (a + _OUTER * (b - a) if part == "upper arm" else a), b


def _gaps(pairs: list[tuple[Array, Array, Array, Array]]) -> Array:
    """How far apart pairs of segments are, all at once, which is much faster than one by one, (pairs, n)."""
    moments = max(p.size for pair in pairs for p in pair) // 3
    every = np.empty((4, 3, len(pairs), moments))
    for i, pair in enumerate(pairs):
        for k, point in enumerate(pair):
            every[k, :, i] = point.T if point.ndim > 1 else point[:, None]
    return _apart(*every)


def segments_apart(a: Array, b: Array, c: Array, d: Array) -> Array:
    """The least distance between segments ab and cd, all (…, 3) (Ericson, Real-Time Collision Detection, § 5.1.9)."""
    return _apart(*(np.ascontiguousarray(np.moveaxis(p, -1, 0)) for p in (a, b, c, d)))


def _apart(a: Array, b: Array, c: Array, d: Array) -> Array:
    """`segments_apart` of points (3, …): sums over a first axis take a third of the time."""
    u, v, w = b - a, d - c, a - c
    uu, vv, uv, uw, vw = _sum(u, u), _sum(v, v), _sum(u, v), _sum(u, w), _sum(v, w)
    denominator = np.maximum(uu * vv - uv * uv, 1e-12)
    vv, uu = np.maximum(vv, 1e-12), np.maximum(uu, 1e-12)
    s = np.clip((uv * vw - vv * uw) / denominator, 0.0, 1.0)
    t = np.clip((uv * s + vw) / vv, 0.0, 1.0)
    s = np.clip((uv * t - uw) / uu, 0.0, 1.0)
    apart = w + s * u - t * v
    return np.sqrt(_sum(apart, apart))


def _sum(a: Array, b: Array) -> Array:
    """The scalar products of vectors (3, …), added up in einsum's order: to the last bit what `_dot` makes."""
    each = a * b
    return np.asarray(each[0] + each[2] + each[1])


def _dot(a: Array, b: Array) -> Array:
    """The scalar products of vectors (…, 3); a sum over so short an axis is slow."""
    return np.asarray(np.einsum("...i,...i->...", a, b))
