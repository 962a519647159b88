"""Meshes of single instruments in their own axes: struck surface at the origin, z its normal.

Sizes come from the kit; what a kit file does not say (hoops, lugs, bells) has the proportions of common hardware.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.motion.kit.piece import BELL_ABOVE_BOW_M, RIM_ABOVE_HEAD_M
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, box, joined, lathe, rod
from station.render.geometry.transforms import rotation, translation

HOLE_M = BELL_ABOVE_BOW_M
"""How high a cymbal's hole is over its plane: there it hangs and tips."""
HAT_GAP_M = 0.006
"""How far the lower hi-hat's edge lies below the upper one's plane when closed."""
_HOOP_M = 0.010
"""How far a hoop stands out of the shell."""


@dataclass(frozen=True, slots=True)
class Detail:
    """How finely round things are cut: segments of a drum's circle, whether small hardware is there, and `grooves`.

    Grooves are rings of a cymbal's own: it swings, so that without a graphics card they cost time in every picture,
    where hardware on what stands still costs none.
    """

    segments: int
    hardware: bool
    grooves: bool = True

    @property
    def has_grooves(self) -> bool:
        """Whether a cymbal's sides have all their rings."""
        return self.hardware and self.grooves


def drum(radius: float, depth: float, lugs: int, detail: Detail, shell: int = Material.SHELL) -> Mesh:
    """A snare or tom: head, hoops, shell, lugs and tension rods, from z = RIM_ABOVE_HEAD_M down to −depth."""
    n = detail.segments
    parts = [
        head(radius, detail),
        _hoop(radius, RIM_ABOVE_HEAD_M, n),
        lathe([(radius, -depth + 0.012), (radius, -0.012)], n, shell),
        _hoop(radius, -depth + 0.022, n),
        lathe([(0, -depth), (radius * 0.98, -depth)], n, Material.HEAD).shaded(0.35),
    ]
    if detail.hardware:
        parts += [_lug_column(radius, depth, 2 * np.pi * (k + 0.5) / lugs) for k in range(lugs)]
    return joined(parts)


def _rings(radius: float, detail: Detail) -> list[float]:
    """The radii of a head's rings from `radius` to its middle, fine enough for ripples where those are drawn."""
    count = detail.segments // 6 if detail.hardware else 2
    return [radius * k / count for k in range(count, -1, -1)]


def head(radius: float, detail: Detail, material: int = Material.HEAD) -> Mesh:
    """The skin: white, a little darker towards the hoop, with a bearing edge."""
    profile = [(radius, -0.006), (radius * 0.965, 0.0), *((r, 0.0) for r in _rings(0.90 * radius, detail))]
    mesh = lathe(profile, detail.segments, material)
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


def kick(radius: float, depth: float, detail: Detail, shell: int = Material.SHELL) -> Mesh:
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
        lathe([(r, 0.0) for r in _rings(0.99 * radius, detail)], n, Material.HEAD),
        lathe(hoop, n, shell, smooth=False),
        lathe([(radius, -depth + 0.02), (radius, -0.02)], n, shell),
        lathe(front_hoop, n, shell, smooth=False),
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


def cymbal(radius: float, detail: Detail, bell: float = 0.19, is_china: bool = False) -> Mesh:
    """A cymbal whose bow lies in the plane z = 0 at 0.6 of its radius; the bell rises above, the edge falls below."""
    rise = 0.055 * radius
    r = np.array(
        [1.0, 0.985, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, bell * 1.15, bell, bell * 0.9, bell * 0.6, bell * 0.25]
    )
    if detail.has_grooves:
        r = np.sort(np.concatenate([r, np.linspace(bell * 1.3, 0.97, 22)]))[::-1]
    bow = rise * (1 - (r / 0.98) ** 2) - rise * (1 - (0.6 / 0.98) ** 2)
    dome = np.where(r < bell, (BELL_ABOVE_BOW_M - 0.4 * rise) * np.sqrt(np.clip(1 - (r / bell) ** 2, 0, 1)), 0)
    top = np.stack([r * radius, bow + dome + (china_lip(radius, r) if is_china else 0.0)], axis=1)
    under = top[::-1] - [0.0, 0.0015]
    if not detail.has_grooves:
        top, under = top[_TOP], top[_UNDER][::-1] - [0.0, 0.0015]
    mesh = joined(
        [
            _grooved(lathe(top, detail.segments, Material.BRONZE), detail),
            lathe(under, detail.segments, Material.BRONZE).shaded(0.55),
        ]
    )
    return mesh


def china_lip(radius: float, r: NDArray[np.float64]) -> NDArray[np.float64]:
    """How much higher a china is than a crash at shares `r` of its radius: its rim is turned up."""
    return np.asarray(np.where(r > _LIP, 0.16 * radius * (r - _LIP) / (1 - _LIP), 0.0))


_LIP = 0.80
"""The share of the radius at which a china's rim begins (our choice: common ones)."""


def nut(detail: Detail) -> Mesh:
    """What holds a cymbal on its stand, from its plane up: rod, felt and wing nut."""
    n = 10 if detail.hardware else 6
    felt = [(0, 0), (0.015, 0), (0.015, 0.010), (0, 0.010)]
    parts = [
        rod([0, 0, -0.012], [0, 0, HOLE_M + 0.040], 0.004, Material.STEEL, 6),
        lathe(felt, n, Material.FELT).moved(translation([0, 0, HOLE_M + 0.001])),
        rod([0, 0, HOLE_M + 0.011], [0, 0, HOLE_M + 0.026], (0.008, 0.006), Material.CHROME, n),
        box((0.040, 0.005, 0.012), Material.CHROME, 0.002 if detail.hardware else 0.0).moved(
            translation([0, 0, HOLE_M + 0.026])
        ),
    ]
    return joined(parts)


def _grooved(mesh: Mesh, detail: Detail) -> Mesh:
    """Every other ring reflects a little less: the tonal grooves of the lathe, broad bands where rings are few."""
    ring = np.arange(len(mesh.position)) // (detail.segments + 1)
    return mesh.shaded(np.where(ring % 2 == 0, 1.0, 0.80 if detail.has_grooves else 0.72))


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
    """A cowbell, its top at z = 0: wider and deeper at its mouth, which is turned to the player (−y)."""
    mesh = box((1.5 * radius, 2 * radius, depth), Material.BLACK, 0.004).moved(translation([0, 0, -depth / 2]))
    narrows = 1 - _COWBELL_NARROWS * (mesh.position[:, 1:2] / (2 * radius) + 0.5)
    mouth = box((1.2 * radius, 0.002, 0.75 * depth), Material.RUBBER).moved(
        translation([0, -radius - 0.0005, -depth / 2])
    )
    return joined([replace(mesh, position=mesh.position * np.hstack((narrows, narrows * 0 + 1, narrows))), mouth])


_COWBELL_NARROWS = 0.35
"""How much narrower a cowbell's closed end is (our choice)."""
