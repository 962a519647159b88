"""What is worn on the head: headphones, glasses, a beanie; a ponytail's band. Axes as in `head_shape`."""

from collections.abc import Callable, Mapping

import numpy as np

from station.motion.kinematics.look import Look
from station.render.figure.bones import Bone
from station.render.figure.expression import EYE_M
from station.render.figure.face import cuts
from station.render.figure.skin import Skin, hung, rigid_skin, skin_of
from station.render.geometry.implicit import Array, Field, cut, egg, plane, surface, united
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, joined, lathe, tube
from station.render.geometry.transforms import frame, rotation, translation


def headwear_skins(look: Look, fineness: float) -> list[Skin]:
    """Everything that the head wears."""
    skins = [_WORN[name](fineness) for name in look.worn if name in _WORN]
    if look.hair == "ponytail":
        band = lathe(_band(0.0, 0.0235, 0.010, 0.005), cuts(16, fineness), Material.BAND)
        skins.append(rigid_skin(band.moved(frame([0, -0.112, 0.179], [0, -1, 0.03], [1, 0, 0])).on_bone(Bone.HEAD)))
    return skins


def _band(at: float, radius: float, half: float, thickness: float) -> Array:
    """The profile of a soft band round z: from `at − half` to `at + half`, `thickness` over `radius`."""
    a = np.linspace(-np.pi / 2, np.pi / 2, 7)
    return np.stack([radius + thickness * np.cos(a) ** 0.5, at + half * np.sin(a)], axis=1)


def _headphones(fineness: float) -> Skin:
    angle = np.linspace(0.10, np.pi - 0.10, max(9, round(30 / fineness)))
    band = np.stack([0.098 * np.cos(angle), np.full_like(angle, -0.006), 0.100 + 0.132 * np.sin(angle)], axis=1)
    parts: list[Mesh] = [
        tube(band + np.array([0, dy, 0]), 0.0065, Material.HEADPHONES, cuts(6, fineness)) for dy in (-0.009, 0.0, 0.009)
    ]
    segments = max(10, round(28 / fineness))
    cup = [(0.0, 0.0), (0.030, 0.0), (0.041, 0.006), (0.042, 0.018), (0.036, 0.027), (0.020, 0.031), (0.0, 0.031)]
    ring = [(0.0265, 0.0300), (0.0265, 0.0312), (0.0215, 0.0322)]
    for side in (-1.0, 1.0):
        at = translation([side * 0.079, -0.006, 0.088]) @ rotation([0, 1, 0], side * np.pi / 2)
        parts.append(lathe(cup, segments, Material.HEADPHONES).moved(at))
        parts.append(lathe(ring, segments, Material.GLOW).moved(at))
    return rigid_skin(joined(parts).on_bone(Bone.HEAD))


def _glasses(fineness: float) -> Skin:
    """Round rims before the eyes, a bridge, and temples back to the ears."""
    a = np.linspace(0, 2 * np.pi, cuts(24, fineness) + 1)
    thin = 0.0019
    parts: list[Mesh] = []
    for side in (-1.0, 1.0):
        x, y, z = EYE_M * [side, 1, 1] + [side * 0.001, 0.030, -0.002]
        rim = np.stack(
            [x + 0.0245 * np.cos(a), y - 0.35 * np.abs(x + 0.0245 * np.cos(a)) ** 2 * 9, z + 0.0215 * np.sin(a)], axis=1
        )
        parts.append(tube(rim, thin, Material.BLACK, cuts(6, fineness)))
        ear = np.array(
            [[side * 0.058, y - 0.012, z + 0.004], [side * 0.0655, 0.056, z + 0.004], [side * 0.0815, -0.002, z]]
        )
        parts.append(tube(ear, thin, Material.BLACK, cuts(6, fineness)))
    t = np.linspace(-1, 1, 7)
    x, y, z = EYE_M + np.array([0, 0.031, -0.002])
    bridge = np.stack([0.0105 * t, np.full_like(t, y), z + 0.006 + 0.003 * (1 - t**2)], axis=1)
    parts.append(tube(bridge, thin, Material.BLACK, cuts(6, fineness)))
    return rigid_skin(joined(parts).on_bone(Bone.HEAD))


def _beanie(fineness: float) -> Skin:
    """A knitted cap that sits on the back of the head, its rim turned up."""
    dome: list[Field] = [egg((0, -0.018, 0.152), (0.094, 0.106, 0.098)), egg((0, -0.046, 0.206), (0.060, 0.060, 0.058))]
    low = plane((0, 0.0, 0.128), (0, 0.22, -1.0))
    cap = cut(united(dome, 0.05), low)
    roll = cut(
        cut(egg((0, -0.018, 0.145), (0.1005, 0.113, 0.105)), low, 0.008), plane((0, 0, 0.164), (0, -0.22, 1.0)), 0.008
    )
    whole = united([cap, roll], 0.004)
    cell = 0.0075 * fineness
    ribs = 0.0016 if cell < 0.009 else 0.0

    def knitted(p: Array) -> Array:
        return np.asarray(whole(p) + ribs * np.sin(30 * np.arctan2(p[:, 0], p[:, 1] + 0.018)), np.float64)

    mesh = surface(knitted, (-0.125, -0.15, 0.06), (0.125, 0.12, 0.30), cell)
    ao = np.clip(0.7 + 3 * (mesh.position[:, 2] - 0.13), 0.6, 1)
    return skin_of(mesh, hung(Bone.HEAD, len(mesh.position)), Material.TRIM, ao)


_WORN: Mapping[str, Callable[[float], Skin]] = {"headphones": _headphones, "glasses": _glasses, "beanie": _beanie}
