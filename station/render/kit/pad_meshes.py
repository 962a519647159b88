"""Meshes of an electronic kit's pads in their own axes: struck surface at the origin, z its normal; and the module.

Proportions are those of common compact kits: mesh heads under rubber rims, rubber cymbals with a bell and an edge.
"""

import numpy as np

from station.motion.kit.piece import BELL_ABOVE_BOW_M, RIM_ABOVE_HEAD_M
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, box, joined, lathe, rod
from station.render.geometry.transforms import translation
from station.render.kit.instrument_meshes import Detail, head

_RIM_M = 0.016
"""How broad a rubber rim is."""
_THICK_M = 0.009
"""A rubber cymbal's thickness."""


def pad(radius: float, depth: float, detail: Detail) -> Mesh:
    """A mesh head with a rubber rim on a shallow black shell."""
    n = detail.segments
    top = RIM_ABOVE_HEAD_M
    inner, outer = radius * 0.975, radius + _RIM_M
    rim = [
        (outer - 0.004, -0.022),
        (outer, -0.016),
        (outer, top - 0.006),
        (outer - 0.004, top),
        (inner + 0.006, top),
        (inner, top - 0.006),
        (inner, -0.004),
    ]
    shell = [(0, -depth), (radius * 0.80, -depth), (radius * 0.98, -depth + 0.012), (radius + 0.006, -0.022)]
    parts = [
        head(radius, detail, Material.MESH_HEAD),
        lathe(rim, n, Material.RUBBER),
        lathe(shell, n, Material.LACQUER),
    ]
    return joined(parts)


def kick_pad(radius: float, depth: float, detail: Detail) -> Mesh:
    """The pad of a kick tower: a mesh head, a round frame, and the tower on two feet that it stands in.

    Its z axis looks at the player and its y axis up; the floor is where the caller says.
    """
    n = detail.segments
    frame = [(0, -depth), (radius + 0.025, -depth), (radius + 0.03, -depth + 0.01), (radius + 0.03, 0.006)]
    frame += [(radius + 0.02, 0.014), (radius * 0.99, 0.010), (radius * 0.985, 0.0)]
    return joined([head(radius, detail, Material.MESH_HEAD), lathe(frame, n, Material.LACQUER)])


def rubber_cymbal(radius: float, detail: Detail) -> Mesh:
    """A rubber cymbal: its bow in the plane z = 0 at 0.6 of its radius, a bell with a ring, and an edge that shows."""
    rise = 0.05 * radius
    bell, edge = 0.22, 0.93
    r = np.array([1.0, 0.985, edge, 0.8, 0.6, 0.4, bell * 1.2, bell, bell * 0.85, bell * 0.5, bell * 0.25])
    z = rise * (0.6**2 - r**2) + np.where(
        r < bell, (BELL_ABOVE_BOW_M - 0.36 * rise) * np.sqrt(np.clip(1 - (r / bell) ** 2, 0, 1)), 0.0
    )
    top = np.stack([r * radius, z], axis=1)
    bands = ((0, 3, Material.RUBBER), (2, 7, Material.PAD), (6, 8, Material.RUBBER), (7, 11, Material.PAD))
    parts = [lathe(top[a:b], detail.segments, material) for a, b, material in bands]
    low = float(z[0]) - _THICK_M
    under = [(0.02, low + 0.3 * rise), (radius * 0.97, low), (radius, low + 0.003), (radius, float(z[0]))]
    return joined([*parts, lathe(under, detail.segments, Material.RUBBER)])


def module(detail: Detail) -> Mesh:
    """The sound module, its face up and its upper side at +y: a lit screen, buttons and a wheel."""
    bevel = 0.006 if detail.hardware else 0.0
    parts = [
        box((0.23, 0.16, 0.045), Material.BLACK, bevel),
        box((0.125, 0.062, 0.002), Material.RUBBER).moved(translation([-0.03, 0.033, 0.0228])),
        box((0.110, 0.050, 0.002), Material.SCREEN).moved(translation([-0.03, 0.033, 0.0236])),
        rod([0.072, 0.030, 0.02], [0.072, 0.030, 0.034], (0.021, 0.019), Material.STEEL, 16),
    ]
    for k in range(6):
        lit = Material.GLOW if k == 1 else Material.STEEL
        parts.append(box((0.020, 0.011, 0.005), lit).moved(translation([-0.085 + 0.034 * k, -0.030, 0.024])))
    return joined(parts)
