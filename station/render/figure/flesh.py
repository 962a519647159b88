"""Bare skin: neck and upper chest, arms and, under shorts, legs."""

import numpy as np

from station.motion.kinematics.figure import Joint
from station.render.figure.bones import Bone
from station.render.figure.garments import Garment, Solid
from station.render.figure.measures import SHOULDER_OF, Measures
from station.render.geometry.implicit import cone, egg
from station.render.geometry.materials import Material


def torso(m: Measures, is_sleeveless: bool) -> list[Garment]:
    """Neck and upper chest; with bare shoulders the arms are of one piece with them."""
    k, g = m.k, m.girths
    base, head, spine = m.joints[Joint.NECK], m.joints[Joint.HEAD], m.joints[Joint.SPINE]
    low, high = base - m.by(0, 0.012, 0.02), head + m.by(0, 0.006, 0.045)
    below, above = base + 0.1 * (head - base), head - 0.2 * (head - base)
    r = k * g.neck
    ribs = spine + 0.60 * (base - spine)
    solids: list[tuple[Bone, Solid]] = [
        (Bone.CHEST, cone(low, below, 0.066 * r, 0.058 * r)),
        (Bone.NECK, cone(below, above, 0.058 * r, 0.053 * r)),
        (Bone.HEAD, cone(above, high, 0.053 * r, 0.053 * r)),
        (Bone.CHEST, egg(ribs + m.by(0, 0.004, 0.022), g.chest * m.by(0.134, 0.097, 0.130))),
    ]
    for upper, first in SHOULDER_OF.items():
        shoulder = m.joints[first]
        inner = base + (shoulder - base) * 0.26 + m.by(0, -0.018, 0.006)
        outer = base + (shoulder - base) * 0.84 + m.by(0, -0.006, -0.020)
        solids.append((Bone.CHEST, cone(inner, outer, 0.044 * k * g.chest, 0.040 * k * g.chest)))
        if is_sleeveless:
            solids += arm(m, upper, 0.0).solids
    return [Garment(Material.SKIN, solids, 0.032 * k, 0.010, softness=0.026)]


def arm(m: Measures, upper: Bone, begins: float) -> Garment:
    """An arm from a place on: 0 is the shoulder, 1 the elbow, 2 the wrist."""
    shoulder, elbow, wrist = m.arm(upper)
    k = m.k * m.girths.arms
    along = (0.0, 0.5, 1.0, 1.24, 1.5, 2.03)
    radii = (0.050, 0.048, 0.038, 0.0435, 0.037, 0.0265 / m.girths.arms)
    at = [begins, *(place for place in along if place > begins + 0.05)]
    points = [shoulder + min(s, 1.0) * (elbow - shoulder) + max(s - 1, 0.0) * (wrist - elbow) for s in at]
    thick = [k * float(np.interp(s, along, radii)) for s in at]
    solids: list[tuple[Bone, Solid]] = [
        (_arm_bone(upper, at[i]), cone(points[i], points[i + 1], thick[i], thick[i + 1])) for i in range(len(at) - 1)
    ]
    return Garment(Material.SKIN, solids, 0.02 * k, 0.0095, softness=0.030)


def _arm_bone(upper: Bone, place: float) -> Bone:
    """The bone on which an arm hangs from a place on."""
    return Bone(upper + (0 if place < 1 else 1 if place < 1.5 else 2))


def shank(m: Measures, thigh: Bone) -> Garment:
    """A bare leg from above the knee down."""
    hip, knee, ankle = m.leg(thigh)
    k = m.k * m.girths.legs
    down = ankle - knee
    calf = knee + 0.30 * down - m.by(0, 0.016, 0)
    solids: list[tuple[Bone, Solid]] = [
        (thigh, cone(hip + 0.55 * (knee - hip), knee, 0.070 * k, 0.056 * k)),
        (Bone(thigh + 1), cone(knee, calf, 0.054 * k, 0.056 * k)),
        (Bone(thigh + 1), cone(calf, knee + 0.66 * down, 0.056 * k, 0.042 * k)),
        (Bone(thigh + 1), cone(knee + 0.66 * down, ankle, 0.042 * k, 0.036 * k)),
    ]
    return Garment(Material.SKIN, solids, 0.03 * k, 0.0110)
