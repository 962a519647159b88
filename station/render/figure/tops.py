"""Tops by their words in `look.WORDS`: a tee, a tank top, a shirt with rolled sleeves, a hoodie."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from station.motion.kinematics.figure import Joint
from station.render.figure.bones import Bone
from station.render.figure.garments import Crease, End, Garment, Solid
from station.render.figure.measures import Measures
from station.render.figure.skin import Skin, rigid_skin, skin_of
from station.render.geometry.implicit import Array, Field, cone, egg
from station.render.geometry.materials import Material
from station.render.geometry.mesh import ball, grid_mesh, joined, tube
from station.render.geometry.transforms import unit

_ARMS = (Bone.RIGHT_UPPER_ARM, Bone.LEFT_UPPER_ARM)


@dataclass(frozen=True, slots=True)
class Cut:
    """How a top is cut.

    `sleeve`: how far sleeves go down the arm, 1 to the elbow, 2 to the wrist, 0 not at all; `hole_m` of the neck: how
    far before the neck its middle is, half its breadth, half its length; `hem_m` how thick hems are; `loose`, `width`
    of trunk and sleeves beside a tee's.
    """

    sleeve: float
    width: float
    hole_m: tuple[float, float, float]
    hem_m: float
    loose: float


CUTS: Mapping[str, Cut] = {
    "tee": Cut(0.58, 1.0, (0.012, 0.082, 0.072), 0.0055, 1.0),
    "tank": Cut(0.0, 1.0, (0.010, 0.092, 0.082), 0.0045, 0.95),
    "shirt": Cut(1.30, 1.14, (0.016, 0.072, 0.066), 0.0085, 1.0),
    "hoodie": Cut(1.55, 1.04, (0.004, 0.066, 0.060), 0.0120, 1.06),
}


def arm_begins(word: str) -> float:
    """Where the bare arm begins, a little above the sleeve's end: 0 is the shoulder, 1 the elbow, 2 the wrist."""
    return max(CUTS[word].sleeve - 0.12, 0.0)


def top(m: Measures, word: str) -> Garment:
    """The top itself."""
    k, g, style = m.k, m.girths, CUTS[word]
    pelvis, spine, neck = m.joints[Joint.PELVIS], m.joints[Joint.SPINE], m.joints[Joint.NECK]
    chest = spine + 0.56 * (neck - spine)
    loose = style.loose
    wide, deep = k * g.chest * loose, k * (0.4 + 0.6 * g.chest) * loose
    waist, hips = k * g.waist * loose, k * g.hips * loose
    solids: list[tuple[Bone, Solid]] = [
        (Bone.WAIST, egg(pelvis + m.by(0, 0.002, 0.035), np.array([0.182 * hips, 0.134 * hips, 0.112 * k]))),
        (Bone.WAIST, egg(spine + m.by(0, 0.006, -0.045), np.array([0.163 * waist, 0.121 * waist, 0.165 * k]))),
        (Bone.CHEST, egg(chest + m.by(0, 0.002, 0.0), np.array([0.172 * wide, 0.120 * deep, 0.160 * k]))),
        (Bone.CHEST, cone(neck + m.by(0.02, -0.022, 0.012), neck + m.by(-0.02, -0.022, 0.012), 0.072 * k, 0.072 * k)),
    ]
    for side in (1.0, -1.0):
        breast = chest + m.by(side * 0.070, 0.062 + 0.018 * g.bust, 0.040 - 0.022 * g.bust)
        size = m.by(0.070, 0.056 + 0.010 * g.bust, 0.064)
        solids.append((Bone.CHEST, egg(breast, size)))
    for upper in _ARMS:
        solids += _shoulder(m, upper, style)
    if word == "hoodie":
        solids += _hood(m)
    return Garment(
        Material.SHIRT,
        solids,
        0.042 * k,
        0.0125,
        (_hole(m, style), _waist(m), *(_sleeve_end(m, upper, style) for upper in _ARMS if style.sleeve > 0)),
        _folds(m, style),
        0.028,
        (float(pelvis[2]) + 0.02 * k, float(chest[2]) + 0.02 * k),
    )


def _shoulder(m: Measures, upper: Bone, style: Cut) -> list[tuple[Bone, Solid]]:
    """From the neck over the shoulder, and the sleeve."""
    k, neck = m.k, m.joints[Joint.NECK]
    shoulder, elbow, wrist = m.arm(upper)
    broad = k * (0.5 + 0.5 * m.girths.chest)
    inner = neck + (shoulder - neck) * 0.24 + m.by(0, -0.018, 0.002)
    outer = shoulder - (shoulder - neck) * 0.18 - m.by(0, 0.004, 0.022)
    if style.sleeve == 0.0:
        strap = neck + (shoulder - neck) * 0.66 - m.by(0, 0.008, 0.016)
        return [(Bone.CHEST, cone(inner, strap, 0.062 * broad, 0.052 * broad))]
    r = k * m.girths.arms * style.width
    start = shoulder - (shoulder - neck) * 0.04 - m.by(0, 0, 0.012)
    parts: list[tuple[Bone, Solid]] = [(Bone.CHEST, cone(inner, outer, 0.066 * broad, 0.056 * broad))]
    ends = min(style.sleeve, 1.0)
    wide = 0.066 if style.sleeve < 1 else 0.054
    parts.append((upper, cone(start, shoulder + (elbow - shoulder) * (ends + 0.1 * (ends < 1)), 0.058 * r, wide * r)))
    if style.sleeve > 1:
        end = elbow + (wrist - elbow) * (style.sleeve - 1 + 0.06)
        parts.append((Bone(upper + 1), cone(elbow, end, 0.054 * r, 0.050 * r)))
    return parts


def _hood(m: Measures) -> list[tuple[Bone, Solid]]:
    """A hood that lies round the neck, heavy behind."""
    neck, k = m.joints[Joint.NECK], m.k
    a = np.linspace(-0.25, np.pi + 0.25, 7)
    ring = neck + m.k * np.stack([0.088 * np.cos(a), -0.012 - 0.066 * np.sin(a), 0.046 + 0.010 * np.sin(a)], axis=1)
    thick = k * (0.018 + 0.020 * np.clip(np.sin(a), 0, 1))
    parts: list[tuple[Bone, Solid]] = [
        (Bone.CHEST, cone(ring[i], ring[i + 1], thick[i], thick[i + 1])) for i in range(len(a) - 1)
    ]
    parts.append((Bone.CHEST, egg(neck + m.by(0, -0.108, -0.010), m.by(0.080, 0.040, 0.066))))
    return parts


def _hole(m: Measures, style: Cut) -> Field:
    """The neck's hole: an upright well with an oval mouth."""
    before, wide, long = (m.k * length for length in style.hole_m)
    centre = m.joints[Joint.NECK] + np.array([0, before, 0])
    floor = float(centre[2]) - 0.09 * m.k

    def field(p: Array) -> Array:
        x, y = (p[:, 0] - centre[0]) / wide, (p[:, 1] - centre[1]) / long
        return np.asarray(np.minimum((1 - np.hypot(x, y)) * min(wide, long), p[:, 2] - floor), np.float64)

    return field


def _collar(m: Measures, style: Cut, garment: Garment, count: int) -> Array:
    """The edge of the neck's hole on the cloth, (count + 1, 3)."""
    before, wide, long = (m.k * length for length in style.hole_m)
    centre = m.joints[Joint.NECK] + np.array([0, before, 0])
    a = np.linspace(0, 2 * np.pi, count + 1)
    edge = np.stack([centre[0] + wide * np.cos(a), centre[1] + long * np.sin(a), np.zeros_like(a)], axis=1)
    low, high = np.full(len(a), centre[2] - 0.25 * m.k), np.full(len(a), centre[2] + 0.15 * m.k)
    for _ in range(20):
        edge[:, 2] = (low + high) / 2
        inside = garment.whole(edge) < 0
        low, high = np.where(inside, edge[:, 2], low), np.where(inside, high, edge[:, 2])
    return edge


def _waist(m: Measures) -> End:
    """The lower hem: low behind, in front above the thighs of one who sits."""
    return End(m.joints[Joint.PELVIS] + m.by(0, 0.0, 0.032), np.array([0.0, 0.36, -1.0]))


def _sleeve_end(m: Measures, upper: Bone, style: Cut) -> End:
    """A sleeve's hem."""
    shoulder, elbow, wrist = m.arm(upper)
    reach = 0.105 * m.k * m.girths.arms
    if style.sleeve <= 1:
        return End(shoulder + (elbow - shoulder) * style.sleeve, elbow - shoulder, reach)
    return End(elbow + (wrist - elbow) * (style.sleeve - 1), wrist - elbow, reach)


def _folds(m: Measures, style: Cut) -> tuple[Crease, ...]:
    """Where cloth folds: over the lap, in the sides, under the arms, along the sleeves."""
    pelvis, spine, neck = m.joints[Joint.PELVIS], m.joints[Joint.SPINE], m.joints[Joint.NECK]
    depth = 0.0034 * style.loose**6
    folds = [
        Crease(pelvis + m.by(0, 0.10, 0.10), unit([0.0, -0.25, 1.0]), 0.075 * m.k, 0.052, depth),
        Crease(spine + m.by(0, -0.10, -0.10), unit([0.15, 0.0, 1.0]), 0.080 * m.k, 0.060, 0.8 * depth),
    ]
    for side, upper in zip((1.0, -1.0), _ARMS, strict=True):
        folds.append(
            Crease(spine + m.by(side * 0.13, 0, -0.06), unit([side * 0.35, 0.1, 1.0]), 0.07 * m.k, 0.056, 0.7 * depth)
        )
        shoulder, elbow, wrist = m.arm(upper)
        pit = neck + (shoulder - neck) * 0.72 + m.by(0, 0.05, -0.10)
        folds.append(Crease(pit, unit([side * 0.8, 0.0, -0.7]), 0.055 * m.k, 0.056, 0.6 * depth))
        if style.sleeve > 0:
            folds.append(
                Crease(shoulder + 0.42 * (elbow - shoulder), unit(elbow - shoulder), 0.06 * m.k, 0.056, 0.7 * depth)
            )
        if style.sleeve > 1:
            folds.append(Crease(elbow, unit(wrist - shoulder), 0.05 * m.k, 0.042, 1.1 * depth))
            low = elbow + (style.sleeve - 1.1) * (wrist - elbow)
            folds.append(Crease(low, unit(wrist - elbow), 0.05 * m.k, 0.038, depth))
    return tuple(folds)


# --- hems, collars, prints --------------------------------------------------------------------------------------------


def top_trimmings(m: Measures, word: str, garment: Garment, fineness: float) -> list[Skin]:
    """Rounded hems at neck, sleeves and waist, and what tells this top from others."""
    style, k = CUTS[word], m.k
    trimmed = Material.SHIRT if word == "shirt" else Material.TRIM
    skins = garment.hem(_waist(m), 0.0065 * k, fineness)
    if word != "hoodie":
        edge = _collar(m, style, garment, max(12, round(36 / fineness)))
        thick = (1.5 if word == "shirt" else 1.1) * style.hem_m * k
        skins.append(garment.piping(edge, thick, fineness, trimmed))
    if style.sleeve > 0:
        for upper in _ARMS:
            skins += garment.hem(_sleeve_end(m, upper, style), style.hem_m * k, fineness, trimmed)
    if word == "tee":
        skins += [
            _ring_print(garment, m, 0.0, 0.060, -1.0, fineness),
            _ring_print(garment, m, 0.075, 0.024, 1.0, fineness),
        ]
    elif word == "shirt":
        skins.append(_buttons(garment, m, fineness))
    elif word == "hoodie":
        skins.append(_strings(garment, m, fineness))
    return skins


def _surface_y(garment: Garment, x: Array, z: Array, way: float, middle: float) -> Array:
    """Where the garment's surface lies in y at (x, z), before (`way` 1) or behind (−1) its `middle`."""
    near, far = np.zeros_like(x), np.full_like(x, 0.30)
    for _ in range(20):
        half = (near + far) / 2
        inside = garment.whole(np.stack([x, middle + way * half, z], axis=1)) < 0
        near, far = np.where(inside, half, near), np.where(inside, far, half)
    return middle + way * near


def _ring_print(garment: Garment, m: Measures, aside: float, radius: float, way: float, fineness: float) -> Skin:
    """A ring as on the bass drum's head, printed on the chest (`way` 1) or the back (−1)."""
    spine, neck = m.joints[Joint.SPINE], m.joints[Joint.NECK]
    centre = spine + (0.66 if way < 0 else 0.72) * (neck - spine)
    a = np.linspace(0, 2 * np.pi, max(14, round(40 / fineness)) + 1)
    rings = []
    for r in (0.70 * radius * m.k, radius * m.k):
        x, z = centre[0] - aside * m.k + r * np.cos(a), centre[2] + r * np.sin(a)
        y = _surface_y(garment, x, z, way, float(centre[1])) + 0.0016 * way
        rings.append(np.stack([x, y, z], axis=1))
    mesh = grid_mesh(np.stack(rings[:: int(-way)]), Material.TRIM)
    return skin_of(mesh, garment.weights(mesh.position), ao=0.9)


def _buttons(garment: Garment, m: Measures, fineness: float) -> Skin:
    """A placket with buttons down the front."""
    pelvis, neck = m.joints[Joint.PELVIS], m.joints[Joint.NECK]
    z = np.linspace(float(pelvis[2]) + 0.09 * m.k, float(neck[2]) - 0.030 * m.k, 13)
    x = np.zeros_like(z)
    y = _surface_y(garment, x, z, 1.0, float(pelvis[1]))
    path = np.stack([x, y - 0.001, z], axis=1)
    parts = [
        tube(path + np.array([s * 0.012, 0, 0]), 0.0022, Material.SHIRT, max(4, round(6 / fineness)))
        for s in (-1.0, 1.0)
    ]
    parts += [
        ball(path[i] + [0, 0.001, 0], 0.0052, Material.TRIM, max(5, round(8 / fineness))) for i in range(1, 13, 2)
    ]
    mesh = joined(parts)
    return skin_of(mesh, garment.weights(mesh.position))


def _strings(garment: Garment, m: Measures, fineness: float) -> Skin:
    """Two cords that hang from the hood."""
    neck = m.joints[Joint.NECK]
    parts = []
    for side, length in ((1.0, 0.13), (-1.0, 0.15)):
        z = np.linspace(float(neck[2]) + 0.010 * m.k, float(neck[2]) - length * m.k, 8)
        x = side * m.k * (0.040 + 0.004 * np.sin(np.linspace(0, 4, 8)))
        y = _surface_y(garment, x, z, 1.0, float(neck[1]) - 0.02) + 0.0025
        path = np.stack([x, y, z], axis=1)
        parts += [
            tube(path, 0.0028, Material.TRIM, max(4, round(6 / fineness))),
            ball(path[-1], 0.0052, Material.TRIM, 8),
        ]
    mesh = joined(parts)
    return skin_of(mesh, garment.weights(mesh.position))


def sweatband(m: Measures, upper: Bone, fineness: float) -> Skin:
    """A band round the wrist, which also hides where hand and forearm meet."""
    _, elbow, wrist = m.arm(upper)
    way = unit(wrist - elbow)
    a = np.linspace(-np.pi / 2, np.pi / 2, 9)
    along = 0.027 * np.sign(np.sin(a)) * np.abs(np.sin(a)) ** 0.7
    thick = m.k * (0.0315 + 0.006 * np.cos(a) ** 0.5)
    mesh = tube(wrist + m.k * (along[:, None] - 0.030) * way, thick, Material.BAND, max(10, round(24 / fineness)))
    return rigid_skin(mesh.on_bone(Bone(upper + 2)))
