"""What things are made of, as numbers that the shader reads.

Colours are sRGB 0–1 as one would pick them on a screen; the shader works with their squares, which is linear light
closely enough. `roughness` 0 mirror … 1 chalk, `metal` 0 or 1, `coat` a clear varnish, `grain` how far highlights
stretch across the tangent (lathe grooves), `sheen` the soft rim of cloth and skin, `emission` light of its own.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import IntEnum, unique

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.look import Colours


@unique
class Material(IntEnum):
    """Index into `TABLE`."""

    FLOOR = 0
    WALL = 1
    SHELL = 2
    CHROME = 3
    HEAD = 4
    FRONT_HEAD = 5
    BRONZE = 6
    BLACK = 7
    RUBBER = 8
    WOOD = 9
    FELT = 10
    CUSHION = 11
    STEEL = 12
    SHIRT = 13
    TROUSERS = 14
    SHOE = 15
    SOLE = 16
    SKIN = 17
    HAIR = 18
    EYE_WHITE = 19
    EYE = 20
    LIP = 21
    HEADPHONES = 22
    GLOW = 23
    SHELL_RING = 24
    BAND = 25
    IRIS = 26
    TRIM = 27
    MOUTH = 28
    TEETH = 29
    MAPLE = 30
    LACQUER = 31
    PAD = 32
    MESH_HEAD = 33
    SCREEN = 34


@dataclass(frozen=True, slots=True)
class SurfaceLook:
    """How one material answers light; see the module's head."""

    colour: tuple[float, float, float]
    roughness: float
    metal: float = 0.0
    coat: float = 0.0
    grain: float = 0.0
    sheen: float = 0.0
    emission: float = 0.0


TABLE: dict[Material, SurfaceLook] = {
    Material.FLOOR: SurfaceLook((1.00, 1.00, 1.00), 0.75, coat=0.05),
    Material.WALL: SurfaceLook((0.17, 0.19, 0.26), 1.0),
    Material.SHELL: SurfaceLook((0.06, 0.36, 0.42), 0.35, coat=1.0),
    Material.CHROME: SurfaceLook((0.90, 0.91, 0.93), 0.12, metal=1.0),
    Material.HEAD: SurfaceLook((0.93, 0.92, 0.88), 0.60, coat=0.12),
    Material.FRONT_HEAD: SurfaceLook((0.08, 0.09, 0.11), 0.30, coat=0.5),
    Material.BRONZE: SurfaceLook((0.93, 0.74, 0.40), 0.28, metal=1.0, grain=1.0),
    Material.BLACK: SurfaceLook((0.07, 0.07, 0.08), 0.45, coat=0.3),
    Material.RUBBER: SurfaceLook((0.06, 0.06, 0.07), 0.85),
    Material.WOOD: SurfaceLook((0.85, 0.66, 0.42), 0.50, coat=0.25),
    Material.FELT: SurfaceLook((0.82, 0.80, 0.74), 1.0, sheen=0.4),
    Material.CUSHION: SurfaceLook((0.12, 0.12, 0.14), 0.60, sheen=0.3),
    Material.STEEL: SurfaceLook((0.62, 0.64, 0.68), 0.25, metal=1.0),
    Material.SHIRT: SurfaceLook((0.91, 0.49, 0.20), 0.90, sheen=0.55),
    Material.TROUSERS: SurfaceLook((0.21, 0.26, 0.38), 0.92, sheen=0.40),
    Material.SHOE: SurfaceLook((0.80, 0.22, 0.20), 0.60, coat=0.15, sheen=0.2),
    Material.SOLE: SurfaceLook((0.93, 0.92, 0.90), 0.70),
    Material.SKIN: SurfaceLook((0.86, 0.62, 0.48), 0.55, sheen=0.55),
    Material.HAIR: SurfaceLook((0.20, 0.13, 0.10), 0.55, grain=0.25, sheen=0.35),
    Material.EYE_WHITE: SurfaceLook((0.97, 0.97, 0.98), 0.25, coat=0.6),
    Material.EYE: SurfaceLook((0.08, 0.06, 0.06), 0.10, coat=1.0),
    Material.LIP: SurfaceLook((0.62, 0.34, 0.30), 0.60),
    Material.HEADPHONES: SurfaceLook((0.14, 0.15, 0.18), 0.35, coat=0.5),
    Material.GLOW: SurfaceLook((1.00, 0.60, 0.24), 1.0, emission=1.0),
    Material.SHELL_RING: SurfaceLook((0.97, 0.55, 0.20), 0.35, coat=0.8),
    Material.BAND: SurfaceLook((0.06, 0.36, 0.42), 0.95, sheen=0.6),
    Material.MAPLE: SurfaceLook((0.72, 0.45, 0.22), 0.35, coat=0.9),
    Material.LACQUER: SurfaceLook((0.10, 0.10, 0.12), 0.30, coat=1.0),
    Material.PAD: SurfaceLook((0.17, 0.17, 0.18), 0.80, coat=0.1),
    Material.MESH_HEAD: SurfaceLook((0.80, 0.81, 0.83), 0.85),
    Material.SCREEN: SurfaceLook((0.25, 0.62, 0.95), 1.0, emission=1.0),
    Material.IRIS: SurfaceLook((0.30, 0.42, 0.46), 0.15, coat=1.0),
    Material.TRIM: SurfaceLook((0.10, 0.30, 0.36), 0.85, sheen=0.5),
    Material.MOUTH: SurfaceLook((0.22, 0.06, 0.06), 0.60),
    Material.TEETH: SurfaceLook((0.95, 0.93, 0.88), 0.30, coat=0.4),
}


_WORN_BY: Mapping[Material, str] = {
    Material.SKIN: "skin",
    Material.LIP: "lips",
    Material.HAIR: "hair",
    Material.IRIS: "iris",
    Material.SHIRT: "top",
    Material.TRIM: "trim",
    Material.TROUSERS: "legs",
    Material.SHOE: "shoes",
    Material.SOLE: "soles",
    Material.BAND: "band",
}
"""Which of a drummer's colours a material has."""


_DEFAULT = Colours()


def shader_table(colours: Colours = _DEFAULT) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Two arrays (materials, 4): linear colour and roughness; metal, coat + 2·emission, grain, sheen.

    `colours` are those of the drummer's skin, hair and clothes.
    """
    own = {material: getattr(colours, name) for material, name in _WORN_BY.items()}
    looks = [replace(TABLE[m], colour=own.get(m, TABLE[m].colour)) for m in Material]
    first = np.array([(*(c * c for c in look.colour), look.roughness) for look in looks], np.float32)
    second = np.array([(k.metal, k.coat + 2 * k.emission, k.grain, k.sheen) for k in looks], np.float32)
    return first, second
