"""Trousers and shorts by their words in `look.WORDS`."""

from station.motion.kinematics.figure import Joint
from station.render.figure.bones import Bone
from station.render.figure.garments import Crease, End, Garment, Solid
from station.render.figure.measures import HIP_OF, Measures
from station.render.figure.skin import Skin
from station.render.geometry.implicit import cone, egg
from station.render.geometry.materials import Material
from station.render.geometry.transforms import unit

_SHORT = 0.80
"""Where the legs of shorts end, as a share of the thigh."""


def legwear(m: Measures, word: str) -> Garment:
    """Jeans down to the shoes, or shorts."""
    k, g = m.k, m.girths
    hips = egg(m.joints[Joint.PELVIS] + m.by(0, 0.0, -0.005), m.by(0.160 * g.hips, 0.125 * g.hips, 0.095))
    solids: list[tuple[Bone, Solid]] = [(Bone.WAIST, hips)]
    folds = []
    r = k * g.legs
    for thigh in HIP_OF:
        hip, knee, ankle = m.leg(thigh)
        down, shin = knee - hip, ankle - knee
        if word == "shorts":
            solids.append((thigh, cone(hip + m.by(0, 0.01, 0), hip + (_SHORT + 0.12) * down, 0.094 * r, 0.086 * r)))
            folds.append(Crease(hip + 0.55 * down + m.by(0, 0, 0.05), unit(down), 0.07, 0.050, 0.0025))
        else:
            calf = knee + 0.45 * shin
            solids.append((thigh, cone(hip + m.by(0, 0.01, 0), knee, 0.092 * r, 0.068 * r)))
            solids.append((Bone(thigh + 1), cone(knee, calf, 0.066 * r, 0.062 * r)))
            solids.append((Bone(thigh + 1), cone(calf, ankle, 0.062 * r, 0.058 * r)))
            folds.append(Crease(knee - 0.05 * unit(down), unit(shin - down), 0.045, 0.042, 0.0034))
            folds.append(Crease(knee + m.by(0, -0.05, -0.03), unit(shin), 0.045, 0.042, 0.0034))
            folds.append(Crease(ankle - 0.10 * shin, unit(shin), 0.045, 0.040, 0.0036))
        folds.append(Crease(hip + 0.14 * down + m.by(0, 0, 0.08), unit([down[0], 0.6, 0.0]), 0.055, 0.048, 0.0036))

    ends = tuple(_end(m, thigh, word) for thigh in HIP_OF)
    return Garment(Material.TROUSERS, solids, 0.035 * k, 0.0125, ends, tuple(folds), 0.030)


def _end(m: Measures, thigh: Bone, word: str) -> End:
    """Where a leg ends."""
    hip, knee, ankle = m.leg(thigh)
    reach = 0.16 * m.k * m.girths.legs
    if word == "shorts":
        return End(hip + _SHORT * (knee - hip), knee - hip, reach)
    return End(ankle - 0.045 * (ankle - knee), ankle - knee, reach)


def legwear_trimmings(m: Measures, word: str, garment: Garment, fineness: float) -> list[Skin]:
    """The legs' rounded hems; under shorts the socks'."""
    radius = 0.0075 if word == "jeans" else 0.006
    hems = []
    for thigh in HIP_OF:
        hems += garment.hem(_end(m, thigh, word), radius * m.k, fineness)
        if word == "shorts":
            hems += sock(m, thigh).hem(_sock_top(m, thigh), 0.005 * m.k, fineness)
    return hems


def _sock_top(m: Measures, thigh: Bone) -> End:
    """Where a sock ends."""
    _, knee, ankle = m.leg(thigh)
    return End(ankle + 0.30 * (knee - ankle), knee - ankle)


def sock(m: Measures, thigh: Bone) -> Garment:
    """A sock under shorts."""
    ankle, top = m.leg(thigh)[2], _sock_top(m, thigh)
    k = m.k * m.girths.legs
    solid = cone(top.at + 0.13 * (top.at - ankle), ankle, 0.0490 * k, 0.0430 * k)
    return Garment(Material.FELT, [(Bone(thigh + 1), solid)], 0.02, 0.011, (top,))
