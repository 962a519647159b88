"""Shoes by their words in `look.WORDS`: an upper, a sole with a real edge, laces.

In the stance of `skeleton` a foot points along y, the ground an ankle's height below the ankle.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from station.motion.kinematics.figure import Joint
from station.render.figure.bones import Bone
from station.render.figure.garments import End, Garment, Solid
from station.render.figure.measures import HIP_OF, Measures
from station.render.figure.skin import Skin, hung, rigid_skin, skin_of
from station.render.geometry.implicit import Array, cone
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, grid_mesh, joined, tube


@dataclass(frozen=True, slots=True)
class Make:
    """How a shoe is made, in metres: how high its shaft and its sole are, how far the sole stands out."""

    shaft: float
    sole: float
    welt: float


MAKES: Mapping[str, Make] = {"trainers": Make(0.104, 0.026, 0.002), "boots": Make(0.122, 0.030, 0.004)}
_CIRCLES = ((0.000, -0.022, 0.0435), (0.005, 0.118, 0.0490), (-0.002, 0.192, 0.0385))
"""Heel, ball and toes of a right foot from above: x outward, y, radius."""


def shoe(m: Measures, foot: Bone, word: str) -> Garment:
    """The upper of a shoe."""
    place, k, make = _Place(m, foot), m.foot, MAKES[word]
    toes = _toes_of(foot)
    solids: list[tuple[Bone, Solid]] = [
        (foot, cone(place(0, -0.022, 0.044), place(0.004, 0.118, 0.038), 0.0405 * k, 0.0435 * k)),
        (toes, cone(place(0.004, 0.118, 0.038), place(-0.002, 0.190, 0.031), 0.0435 * k, 0.0325 * k)),
        (foot, cone(place(0, -0.014, 0.05), place(0, -0.010, make.shaft), 0.043 * k, 0.0425 * k)),
        (foot, cone(place(0, 0.0, 0.078), place(0, 0.105, 0.046), 0.037 * k, 0.037 * k)),
    ]
    floor = End(place(0, 0, 0.012), np.array([0.0, 0.0, -1.0]))
    return Garment(Material.SHOE, solids, 0.028 * k, 0.010, (floor, _mouth(place, make)))


def _mouth(place: "_Place", make: Make) -> End:
    """Where the foot goes in."""
    return End(place(0, -0.009, make.shaft), np.array([0.0, -0.10, 1.0]))


def shoe_trimmings(m: Measures, foot: Bone, word: str, upper: Garment, fineness: float) -> list[Skin]:
    """Sole, laces, and the padded edge round the ankle."""
    place, make = _Place(m, foot), MAKES[word]
    edge = upper.hem(_mouth(place, make), 0.0055 * m.foot, fineness)
    laces = [
        _lace(upper, place, y, (1.0 if i % 2 else -1.0), fineness)
        for i, y in enumerate(np.linspace(0.066, 0.120, max(2, round(4 / fineness**0.5))))
    ]
    sole = _sole(place, make, fineness)
    ahead = (sole.position[:, 1] - place.origin[1]) / place.k - _BALL_M
    bends = np.clip(0.5 + ahead / _BEND_M, 0.0, 1.0)
    toes = bends * bends * (3 - 2 * bends)
    return [
        *edge,
        skin_of(sole, hung(foot, len(toes), {_toes_of(foot): toes})),
        rigid_skin(joined(laces).on_bone(foot)),
    ]


_BALL_M, _BEND_M = 0.134, 0.05
"""A sole bends under the ball, half a foot before the ankle, over so much of its length (our choice)."""


def _toes_of(foot: Bone) -> Bone:
    return Bone.RIGHT_TOES if foot is Bone.RIGHT_FOOT else Bone.LEFT_TOES


class _Place:
    """Points of a foot, from offsets designed for the median man's: outward, forward, up from the ground."""

    def __init__(self, m: Measures, foot: Bone) -> None:
        first = HIP_OF[Bone(foot - 2)]
        ankle, toe = m.joints[first + 2], m.joints[first + 3]
        self.origin = np.array([ankle[0], ankle[1], toe[2]])
        self.k, self.side = m.foot, 1.0 if first is Joint.RIGHT_HIP else -1.0

    def __call__(self, x: float, y: float, z: float) -> Array:
        return np.asarray(self.origin + self.k * np.array([self.side * x, y, z]), np.float64)


def _sole(place: _Place, make: Make, fineness: float) -> Mesh:
    """A sole from its outline, rounded below, with a groove round it; the toes' end stands up a little."""
    a = np.linspace(0, 2 * np.pi, max(16, round(44 / fineness)) + 1)
    way = np.stack([np.cos(a), np.sin(a)], axis=1)
    circles = np.array(_CIRCLES)
    support = way @ circles[:, :2].T + circles[:, 2]
    best = circles[support.argmax(axis=1)]
    out, high = make.welt, make.sole
    rows = [
        (-0.030, 0.0),
        (-0.006, 0.0005),
        (out - 0.001, 0.0045),
        (out, 0.45 * high),
        (out - 0.0016, 0.55 * high),
        (out, 0.65 * high),
        (out, high - 0.003),
        (out - 0.002, high),
        (-0.012, high + 0.002),
    ]
    grid = np.empty((len(rows), len(a), 3))
    for i, (more, z) in enumerate(rows):
        xy = best[:, :2] + (best[:, 2:] + more) * way
        spring = 0.010 * np.clip((xy[:, 1] - 0.15) / 0.09, 0, 1) ** 2
        arch = 0.004 * np.exp(-(((xy[:, 1] - 0.055) / 0.03) ** 2)) * (z < 0.002)
        for j, (x, y) in enumerate(xy):
            grid[i, j] = place(x, y, z + spring[j] + arch[j])
    middle = grid[:1].mean(axis=1, keepdims=True)
    whole = np.concatenate([middle + 0.02 * (grid[:1] - middle), grid])
    return grid_mesh(whole if place.side < 0 else whole[:, ::-1], Material.SOLE)


def _lace(upper: Garment, place: _Place, y: float, slant: float, fineness: float) -> Mesh:
    """One crossing of the laces over the instep."""
    t = np.linspace(-1, 1, max(4, round(7 / fineness)))
    points = np.array([place(0.021 * s, y + 0.004 * slant * s, 0.04) for s in t])
    low, high = points[:, 2].copy(), points[:, 2] + 0.12
    for _ in range(18):
        middle = (low + high) / 2
        inside = upper.whole(np.column_stack([points[:, :2], middle])) < 0
        low, high = np.where(inside, middle, low), np.where(inside, high, middle)
    points[:, 2] = low + 0.0012
    return tube(points, 0.0032 * place.k, Material.TRIM, max(4, round(6 / fineness)))
