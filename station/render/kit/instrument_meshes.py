"""Meshes of single instruments in their own axes: struck surface at the origin, z its normal.

Sizes come from the kit; what a kit file does not say (hoops, lugs, bells) has the proportions of common hardware.
"""

from dataclasses import dataclass

import numpy as np

from station.motion.kit.piece import BELL_ABOVE_BOW_M, RIM_ABOVE_HEAD_M
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, box, joined, lathe, rod
from station.render.geometry.transforms import rotation, translation

HAT_GAP_M = 0.006
"""How far the lower hi-hat's edge lies below the upper one's plane when closed."""
_HOOP_M = 0.010
"""How far a hoop stands out of the shell."""


@dataclass(frozen=True, slots=True)
class Detail:
    """How finely round things are cut: segments of a drum's circle, and whether small hardware is there."""

    segments: int
    hardware: bool


def drum(radius: float, depth: float, lugs: int, detail: Detail) -> Mesh:
    """A snare or tom: head, hoops, shell, lugs and tension rods, from z = RIM_ABOVE_HEAD_M down to −depth."""
    n = detail.segments
    parts = [
        _head(radius, n),
        _hoop(radius, RIM_ABOVE_HEAD_M, n),
        lathe([(radius, -depth + 0.012), (radius, -0.012)], n, Material.SHELL),
        _hoop(radius, -depth + 0.022, n),
        lathe([(0, -depth), (radius * 0.98, -depth)], n, Material.HEAD).shaded(0.35),
    ]
    if detail.hardware:
        parts += [_lug_column(radius, depth, 2 * np.pi * (k + 0.5) / lugs) for k in range(lugs)]
    return joined(parts)


def _head(radius: float, segments: int) -> Mesh:
    """The skin: white, a little darker towards the hoop, with a bearing edge."""
    profile = [(radius * 1.0, -0.006), (radius * 0.965, 0.0), (radius * 0.90, 0.0), (radius * 0.45, 0.0), (0.0, 0.0)]
    mesh = lathe(profile, segments, Material.HEAD)
    edge = np.hypot(mesh.position[:, 0], mesh.position[:, 1]) > radius * 0.93
    return mesh.shaded(np.where(edge, 0.6, 1.0))


def _hoop(radius: float, top: float, segments: int, material: Material = Material.CHROME) -> Mesh:
    """A triple-flanged hoop whose upper edge lies at height `top`."""
    outer, inner = radius + _HOOP_M, radius * 0.975
    profile = [
        (radius + 0.002, top - 0.036),
        (outer + 0.003, top - 0.036),
        (outer + 0.004, top - 0.031),
        (radius + 0.004, top - 0.027),
        (radius + 0.004, top - 0.006),
        (outer, top - 0.001),
        (outer - 0.003, top + 0.001),
        (inner + 0.002, top - 0.004),
        (inner, top - 0.014),
    ]
    return lathe(profile, segments, material)


def _lug_column(radius: float, depth: float, angle: float) -> Mesh:
    turn = rotation([0, 0, 1], angle)
    out = radius + 0.011
    long = depth > 0.18
    size = min(0.055, depth * 0.32)
    heights = (-0.075, -depth + 0.075) if long else (-depth / 2,)
    parts = [box((0.022, 0.016, size), Material.CHROME, 0.005).moved(translation([out, 0, z])) for z in heights]
    top, bottom = -0.018, -depth + 0.008
    ends = [(top, heights[0]), (heights[-1], bottom)]
    parts += [rod([out + 0.002, 0, b], [out + 0.002, 0, a], 0.003, Material.STEEL, 5) for a, b in ends]
    return joined(parts).moved(turn)


def kick(radius: float, depth: float, detail: Detail) -> Mesh:
    """A bass drum whose batter head faces z; the front head, at −depth, bears the ring of the house."""
    n = detail.segments
    hoop = [
        (radius, -0.03),
        (radius + 0.018, -0.03),
        (radius + 0.018, 0.012),
        (radius * 0.99, 0.012),
        (radius * 0.985, 0),
    ]
    front_hoop = [(r, -depth - z) for r, z in reversed(hoop)]
    parts = [
        lathe([(radius * 0.99, 0), (radius * 0.5, 0), (0, 0)], n, Material.HEAD),
        lathe(hoop, n, Material.SHELL, smooth=False),
        lathe([(radius, -depth + 0.02), (radius, -0.02)], n, Material.SHELL),
        lathe(front_hoop, n, Material.SHELL, smooth=False),
        *_front_head(radius, -depth, n),
    ]
    if detail.hardware:
        parts += [_claw(radius, depth, 2 * np.pi * (k + 0.5) / 8) for k in range(8)]
    return joined(parts)


def _front_head(radius: float, z: float, segments: int) -> list[Mesh]:
    """A dark skin with a bright ring and a port."""
    bands = (
        (0.0, 0.30, Material.FRONT_HEAD),
        (0.30, 0.62, Material.FRONT_HEAD),
        (0.62, 0.68, Material.SHELL_RING),
        (0.68, 0.99, Material.FRONT_HEAD),
    )
    return [lathe([(radius * a, z), (radius * b, z)], segments, material) for a, b, material in bands]


def _claw(radius: float, depth: float, angle: float) -> Mesh:
    out = radius + 0.022
    parts = [rod([out, 0, -depth], [out, 0, 0], 0.004, Material.CHROME, 6)]
    parts += [
        box((0.014, 0.024, 0.05), Material.CHROME, 0.004).moved(translation([out, 0, z]))
        for z in (-0.01, -depth + 0.01)
    ]
    parts += [box((0.03, 0.02, 0.06), Material.CHROME, 0.006).moved(translation([radius + 0.014, 0, -depth / 2]))]
    return joined(parts).moved(rotation([0, 0, 1], angle))


_TOP, _UNDER = [0, 1, 3, 5, 7, 9, 10, 11, 12, 13], [0, 4, 10, 13]
"""The rings of a cymbal's sides where small things are left out; the underside is rarely seen."""


def cymbal(radius: float, detail: Detail, bell: float = 0.19) -> Mesh:
    """A cymbal whose bow lies in the plane z = 0 at 0.6 of its radius; the bell rises above, the edge falls below."""
    rise = 0.055 * radius
    r = np.array(
        [1.0, 0.985, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, bell * 1.15, bell, bell * 0.9, bell * 0.6, bell * 0.25]
    )
    if detail.hardware:
        r = np.sort(np.concatenate([r, np.linspace(bell * 1.3, 0.97, 22)]))[::-1]
    bow = rise * (1 - (r / 0.98) ** 2) - rise * (1 - (0.6 / 0.98) ** 2)
    dome = np.where(r < bell, (BELL_ABOVE_BOW_M - 0.4 * rise) * np.sqrt(np.clip(1 - (r / bell) ** 2, 0, 1)), 0)
    top = np.stack([r * radius, bow + dome], axis=1)
    under = top[::-1] - [0.0, 0.0015]
    if not detail.hardware:
        top, under = top[_TOP], top[_UNDER][::-1] - [0.0, 0.0015]
    mesh = joined(
        [
            _grooved(lathe(top, detail.segments, Material.BRONZE), detail),
            lathe(under, detail.segments, Material.BRONZE).shaded(0.55),
        ]
    )
    nut = lathe([(0.012, top[-1, 1]), (0.012, top[-1, 1] + 0.014), (0, top[-1, 1] + 0.016)], 10, Material.FELT)
    wing = rod([0, 0, top[-1, 1] + 0.014], [0, 0, top[-1, 1] + 0.034], 0.006, Material.CHROME, 8)
    return joined([mesh, nut, wing])


def _grooved(mesh: Mesh, detail: Detail) -> Mesh:
    """Every other ring reflects a little less: the tonal grooves of the lathe, broad bands where rings are few."""
    ring = np.arange(len(mesh.position)) // (detail.segments + 1)
    return mesh.shaded(np.where(ring % 2 == 0, 1.0, 0.80 if detail.hardware else 0.72))


def hat_bottom(radius: float, detail: Detail) -> Mesh:
    """The lower hi-hat cymbal, upside down, its edge at z = 0."""
    upper = cymbal(radius, Detail(detail.segments, hardware=False))
    keep = upper.material == Material.BRONZE
    turned = upper.moved(rotation([1, 0, 0], np.pi))
    kept = turned.faces[keep[turned.faces].all(axis=1)]
    low = float(turned.position[keep][:, 2].max())
    return Mesh(
        turned.position - [0, 0, low],
        turned.normal,
        turned.tangent,
        turned.uv,
        turned.material,
        turned.bone,
        turned.ao * 0.8,
        kept,
    )


def block(radius: float, depth: float) -> Mesh:
    """A cowbell or wood block: a box as wide as the piece, its top at z = 0."""
    mesh = box((1.3 * radius, 2 * radius, depth), Material.BLACK, 0.006)
    return mesh.moved(translation([0, 0, -depth / 2]))
