"""The examiner's body: tapered capsules between the published joints.

Radii are girths over 2π of a median man of 1.759 m: upper arm 34 cm, forearm 28, wrist 17.5, thigh 58 and 40 over the
knee, calf 38, ankle 23 (Gordon 1989, ANSUR, rounded), head breadth 15.3 and length 19.7 cm, chest breadth 32 and depth
24 cm; other statures in proportion. A 5A stick is 14.4 mm thick (Vic Firth), half as much behind its tip.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks.examiner.take import SIDES, Sampled

Array = NDArray[np.float64]
STICK_M, NECK_OF_STICK_M = 0.0072, 0.0040
_RADII = {
    "upper arm": (0.050, 0.044),
    "forearm": (0.043, 0.028),
    "hand": (0.026, 0.026),
    "thigh": (0.085, 0.060),
    "shank": (0.056, 0.036),
    "foot": (0.034, 0.024),
}
_JOINTS = {
    "upper arm": ("shoulder", "elbow"),
    "forearm": ("elbow", "wrist"),
    "hand": ("wrist", "hand"),
    "thigh": ("hip", "knee"),
    "shank": ("knee", "ankle"),
    "foot": ("ankle", "toe"),
}


@dataclass(frozen=True, eq=False)
class Capsule:
    """From `a` to `b`, (n, 3) each, with the radii there."""

    name: str
    a: Array
    b: Array
    a_m: float
    b_m: float

    def cut(self, first: float, last: float) -> "Capsule":
        """The part from share `first` to `last` of its length."""
        way, taper = self.b - self.a, self.b_m - self.a_m
        ends = self.a + first * way, self.a + last * way
        return Capsule(self.name, *ends, self.a_m + first * taper, self.a_m + last * taper)

    def at(self, keep: NDArray[np.bool_]) -> "Capsule":
        """At some of its instants."""
        return Capsule(self.name, self.a[keep], self.b[keep], self.a_m, self.b_m)


def capsules(poses: Sampled, stature_m: float) -> dict[str, Capsule]:
    """Every part by its name, such as `right forearm`, `left stick`, `trunk left`, `head`."""
    scale = stature_m / 1.759
    parts = {part.name: part for part in _limbs(poses, scale)}
    for i, side in enumerate(SIDES):
        parts[f"{side} stick"] = Capsule(
            f"{side} stick", poses.butt_m[:, i], poses.tip_m[:, i], STICK_M, NECK_OF_STICK_M
        )
    parts |= {part.name: part for part in _trunk(poses, scale)}
    return parts


def _limbs(poses: Sampled, scale: float) -> Iterator[Capsule]:
    for side in SIDES:
        for name, (first, last) in _JOINTS.items():
            radii = [scale * r for r in _RADII[name]]
            yield Capsule(f"{side} {name}", poses.point(f"{side}_{first}"), poses.point(f"{side}_{last}"), *radii)


def _trunk(poses: Sampled, scale: float) -> Iterator[Capsule]:
    """Two upright capsules make the chest, 32 by 21 cm; its top lies a hand under the neck's base."""
    pelvis, neck = poses.point("pelvis"), poses.point("neck")
    across = poses.point("right_shoulder") - poses.point("left_shoulder")
    across = across / np.linalg.norm(across, axis=1, keepdims=True)
    top = neck + 0.10 * scale * _unit(pelvis - neck)
    for side, sign in zip(SIDES, (1, -1), strict=True):
        aside = sign * 0.055 * scale * across
        yield Capsule(f"trunk {side}", pelvis + aside, top + aside, 0.105 * scale, 0.105 * scale)
    head, crown = poses.point("head"), poses.point("crown")
    up = crown - head
    yield Capsule("head", head + 0.25 * up, crown - 0.085 * scale * _unit(up), 0.080 * scale, 0.085 * scale)
    yield Capsule("neck", neck, head, 0.058 * scale, 0.058 * scale)


def _unit(v: Array) -> Array:
    return np.asarray(v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12))


def overlap_m(p: Capsule, q: Capsule) -> Array:
    """How deep two capsules are in each other at each instant, (n,); negative: their distance.

    The nearest points of two segments: Ericson, Real-Time Collision Detection, section 5.1.9.
    """
    d1, d2, r = p.b - p.a, q.b - q.a, p.a - q.a
    a, e = (d1 * d1).sum(1), (d2 * d2).sum(1)
    b, c, f = (d1 * d2).sum(1), (d1 * r).sum(1), (d2 * r).sum(1)
    denominator = a * e - b * b
    s = np.clip(np.where(denominator > 1e-12, (b * f - c * e) / np.maximum(denominator, 1e-12), 0.0), 0, 1)
    t = (b * s + f) / np.maximum(e, 1e-12)
    beyond = (t < 0) | (t > 1)
    t = np.clip(t, 0, 1)
    s = np.where(beyond, np.clip((b * t - c) / np.maximum(a, 1e-12), 0, 1), s)
    gap = r + s[:, None] * d1 - t[:, None] * d2
    return np.asarray(p.a_m + s * (p.b_m - p.a_m) + q.a_m + t * (q.b_m - q.a_m) - np.sqrt((gap * gap).sum(1)))
