"""What the drummer wears and is made of, as smoothly blended solids on bones: shirt, trousers, arms, shoes, bands.

Metres in the stance of `skeleton`, designed for the median figure; `k` scales it to another stature. A corner of the
skin follows the bones whose solids are near it, by a soft minimum of their distances, so that weights and shape come
from one description.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from station.motion.kinematics.figure import Joint
from station.render.figure.skeleton import Bone, Skeleton
from station.render.geometry.implicit import Array, Cone, Egg, Field, cone, cut, egg, plane, united
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, lathe
from station.render.geometry.transforms import unit

Solid = Cone | Egg

_SOFTNESS_M = 0.022
"""How far beyond the nearest solid another bone still pulls the skin (our choice: a third of an arm's width)."""


@dataclass(frozen=True, eq=False)
class Garment:
    """One garment or stretch of skin: its solids by bone, how they join, what is cut off, the cell it is cut with."""

    material: Material
    solids: Sequence[tuple[Bone, Solid]]
    blend: float
    cell: float
    trim: Callable[[Field], Field] = lambda f: f

    @property
    def field(self) -> Field:
        """The whole shape."""
        return self.trim(united([s for _, s in self.solids], self.blend))

    def bounds(self) -> tuple[Array, Array]:
        """A box that holds every solid and its rounding."""
        lows, highs = zip(*(_extent(s) for _, s in self.solids), strict=True)
        margin = 0.4 * self.blend + 2.5 * self.cell
        return np.min(lows, axis=0) - margin, np.max(highs, axis=0) + margin

    def weights(self, p: Array) -> Array:
        """How strongly each bone pulls each point, (n, bones), rows summing to 1."""
        distance = np.full((len(p), len(Bone)), np.inf)
        for bone, solid in self.solids:
            distance[:, bone] = np.minimum(distance[:, bone], solid(p))
        pull = np.exp(-(distance - distance.min(axis=1, keepdims=True)) / _SOFTNESS_M)
        return np.asarray(pull / pull.sum(axis=1, keepdims=True), np.float64)


def _extent(solid: Solid) -> tuple[Array, Array]:
    if isinstance(solid, Egg):
        return solid.centre - solid.half, solid.centre + solid.half
    reach = max(solid.radii)
    return np.minimum(solid.start, solid.end) - reach, np.maximum(solid.start, solid.end) + reach


def body_parts(skeleton: Skeleton, scale: float) -> list[Garment]:
    """All of the body but head and hands."""
    parts = [_shirt(skeleton, scale), _trousers(skeleton, scale), _neck(skeleton, scale)]
    for arm, leg in ((Bone.RIGHT_UPPER_ARM, Bone.RIGHT_THIGH), (Bone.LEFT_UPPER_ARM, Bone.LEFT_THIGH)):
        parts += [_arm(skeleton, scale, arm), *_shoe(skeleton, scale, Bone(leg + 2))]
    return parts


_SHOULDER_OF = {Bone.RIGHT_UPPER_ARM: Joint.RIGHT_SHOULDER, Bone.LEFT_UPPER_ARM: Joint.LEFT_SHOULDER}
_HIP_OF = {Bone.RIGHT_THIGH: Joint.RIGHT_HIP, Bone.LEFT_THIGH: Joint.LEFT_HIP}
_SLEEVE = 0.56
"""The sleeve's end as a share of the upper arm."""


def _shirt(skeleton: Skeleton, k: float) -> Garment:
    j = skeleton.bind.joints_m
    pelvis, spine, neck = j[Joint.PELVIS], j[Joint.SPINE], j[Joint.NECK]
    chest = spine + 0.56 * (neck - spine)
    solids: list[tuple[Bone, Solid]] = [
        (Bone.WAIST, egg(pelvis + np.array([0, 0.004, 0.045]) * k, np.array([0.166, 0.128, 0.105]) * k)),
        (Bone.WAIST, egg(spine + np.array([0, 0.006, -0.06]) * k, np.array([0.146, 0.112, 0.14]) * k)),
        (Bone.CHEST, egg(chest + np.array([0, 0.004, 0.0]) * k, np.array([0.172, 0.120, 0.165]) * k)),
        (
            Bone.CHEST,
            cone(
                neck + np.array([0.02, -0.022, 0.0]) * k,
                neck + np.array([-0.02, -0.022, 0.0]) * k,
                0.070 * k,
                0.070 * k,
            ),
        ),
    ]
    hems = []
    for upper in (Bone.RIGHT_UPPER_ARM, Bone.LEFT_UPPER_ARM):
        shoulder, elbow = j[_SHOULDER_OF[upper]], j[_SHOULDER_OF[upper] + 1]
        inner = neck + (shoulder - neck) * 0.36 + np.array([0, -0.014, -0.020]) * k
        outer = shoulder - (shoulder - neck) * 0.20 - np.array([0, 0.004, 0.028]) * k
        start = shoulder - (shoulder - neck) * 0.06 - np.array([0, 0, 0.018]) * k
        end = shoulder + (elbow - shoulder) * (_SLEEVE + 0.12)
        solids.append((Bone.CHEST, cone(inner, outer, 0.066 * k, 0.054 * k)))
        solids.append((upper, cone(start, end, 0.052 * k, 0.063 * k)))
        way = unit(elbow - shoulder)
        hems.append((plane(shoulder + (elbow - shoulder) * _SLEEVE, way), shoulder))
    collar = plane(neck + np.array([0, 0.0, 0.040]) * k, [0, 0.42, 1])

    def trim(field: Field) -> Field:
        for hem, shoulder in hems:
            field = cut(field, _only_near(hem, shoulder, 0.33 * k), 0.014 * k)
        return cut(field, collar, 0.012 * k)

    return Garment(Material.SHIRT, solids, 0.045 * k, 0.0125, trim)


def _only_near(wall: Field, centre: Array, reach: float) -> Field:
    """A cutting plane that cuts beside the body alone: far inside for points on the other side of the centre."""
    side = np.sign(centre[0])

    def field(p: Array) -> Array:
        beside = (np.abs(centre[0]) * 0.86 - side * p[:, 0]) * 3
        far = np.linalg.norm(p - centre, axis=1) - reach
        return np.asarray(np.minimum(wall(p), -np.maximum(beside, far)), np.float64)

    return field


def _trousers(skeleton: Skeleton, k: float) -> Garment:
    j = skeleton.bind.joints_m
    solids: list[tuple[Bone, Solid]] = [
        (Bone.WAIST, egg(j[Joint.PELVIS] + np.array([0, 0.0, -0.005]) * k, np.array([0.160, 0.125, 0.095]) * k))
    ]
    planes = []
    for thigh, hip in _HIP_OF.items():
        a, knee, ankle = j[hip], j[hip + 1], j[hip + 2]
        solids.append((thigh, cone(a + np.array([0, 0.01, 0.0]) * k, knee, 0.091 * k, 0.069 * k)))
        solids.append((Bone(thigh + 1), cone(knee, knee + (ankle - knee) * 0.5, 0.068 * k, 0.062 * k)))
        solids.append((Bone(thigh + 1), cone(knee + (ankle - knee) * 0.5, ankle, 0.062 * k, 0.054 * k)))
        planes.append(plane(ankle - (ankle - knee) * 0.04, ankle - knee))

    def trim(field: Field) -> Field:
        for end in planes:
            field = cut(field, end, 0.014 * k)
        return field

    return Garment(Material.TROUSERS, solids, 0.035 * k, 0.0125, trim)


def _neck(skeleton: Skeleton, k: float) -> Garment:
    j = skeleton.bind.joints_m
    neck, head = j[Joint.NECK], j[Joint.HEAD]
    low, high = neck - np.array([0, 0.012, 0.02]) * k, head + np.array([0, 0.004, 0.05]) * k
    middle = (neck + head) / 2
    return Garment(
        Material.SKIN,
        [
            (Bone.CHEST, cone(low, neck + (middle - neck) * 0.2, 0.062 * k, 0.054 * k)),
            (Bone.NECK, cone(neck + (middle - neck) * 0.2, head - (head - neck) * 0.2, 0.054 * k, 0.051 * k)),
            (Bone.HEAD, cone(head - (head - neck) * 0.2, high, 0.051 * k, 0.05 * k)),
        ],
        0.02 * k,
        0.010,
    )


def _arm(skeleton: Skeleton, k: float, upper: Bone) -> Garment:
    j = skeleton.bind.joints_m
    shoulder, elbow, wrist = (j[_SHOULDER_OF[upper] + i] for i in range(3))
    start = shoulder + (elbow - shoulder) * 0.45
    middle = elbow + (wrist - elbow) * 0.45
    belly = elbow + (wrist - elbow) * 0.22
    return Garment(
        Material.SKIN,
        [
            (upper, cone(start, elbow, 0.048 * k, 0.040 * k)),
            (Bone(upper + 1), cone(elbow, belly, 0.040 * k, 0.043 * k)),
            (Bone(upper + 1), cone(belly, middle, 0.043 * k, 0.039 * k)),
            (Bone(upper + 2), cone(middle, wrist + (wrist - elbow) * 0.03, 0.039 * k, 0.0265 * k)),
        ],
        0.02 * k,
        0.0095,
    )


def bands(skeleton: Skeleton, k: float, upper: Bone, segments: int) -> list[Mesh]:
    """The sleeve's hem and a sweatband, which also hides where hand and forearm meet."""
    length = float(np.linalg.norm(np.subtract(*(skeleton.bind.joints_m[_SHOULDER_OF[upper] + i] for i in (1, 0)))))
    reach = float(np.linalg.norm(np.subtract(*(skeleton.bind.joints_m[_SHOULDER_OF[upper] + i] for i in (2, 1)))))
    hem = _ring(length * _SLEEVE - 0.008 * k, 0.0565 * k, 0.012 * k, 0.0055 * k)
    band = _ring(reach - 0.030 * k, 0.0315 * k, 0.027 * k, 0.006 * k)
    return [
        lathe(hem, segments, Material.SHIRT).moved(skeleton.frames[upper]).on_bone(upper),
        lathe(band, segments, Material.BAND).moved(skeleton.frames[upper + 2]).on_bone(upper + 2),
    ]


def _ring(at: float, radius: float, half: float, thickness: float) -> Array:
    """The profile of a soft band round z: from `at − half` to `at + half`, `thickness` over `radius`."""
    a = np.linspace(-np.pi / 2, np.pi / 2, 9)
    z = at + half * np.sign(np.sin(a)) * np.abs(np.sin(a)) ** 0.7
    return np.stack([radius + thickness * np.cos(a) ** 0.5, z], axis=1)


def _shoe(skeleton: Skeleton, k: float, foot: Bone) -> list[Garment]:
    """A trainer and its sole: in this stance the foot points along y, the sole an ankle's height below the ankle."""
    hip = _HIP_OF[Bone(foot - 2)]
    ankle, toe = skeleton.bind.joints_m[hip + 2], skeleton.bind.joints_m[hip + 3]
    ground = float(toe[2])
    side = float(np.sign(ankle[0]))

    def at(x: float, y: float, z: float) -> Array:
        return np.array([ankle[0] + x * k, ankle[1] + y * k, ground + z * k])

    upper: list[tuple[Bone, Solid]] = [
        (foot, cone(at(0, -0.022, 0.042), at(0.004 * side, 0.12, 0.036), 0.040 * k, 0.042 * k)),
        (foot, cone(at(0.004 * side, 0.12, 0.036), at(0, 0.192, 0.028), 0.042 * k, 0.030 * k)),
        (foot, cone(at(0, -0.014, 0.05), at(0, -0.010, 0.094), 0.042 * k, 0.046 * k)),
        (foot, cone(at(0, 0.0, 0.075), at(0, 0.10, 0.045), 0.036 * k, 0.036 * k)),
    ]
    sole: list[tuple[Bone, Solid]] = [
        (foot, cone(at(0, -0.022, 0.02), at(0.004 * side, 0.12, 0.02), 0.046 * k, 0.050 * k)),
        (foot, cone(at(0.004 * side, 0.12, 0.02), at(0, 0.196, 0.02), 0.050 * k, 0.037 * k)),
    ]
    floor, top = plane(at(0, 0, 0.004), [0, 0, -1]), plane(at(0, 0, 0.026), [0, 0, 1])
    mouth = plane(at(0, 0, 0.104), [0, 0, 1])
    return [
        Garment(Material.SHOE, upper, 0.03 * k, 0.010, lambda f: cut(cut(f, floor), mouth)),
        Garment(Material.SOLE, sole, 0.02 * k, 0.010, lambda f: cut(cut(f, floor), top)),
    ]
