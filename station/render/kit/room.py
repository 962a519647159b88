"""The room: a round wall and a floor, how light falls on the floor, and the picture on the wall.

Instruments cast a soft dark on the ground under an overcast sky: a disc of radius r at height h hides the share
r² / (r² + h² + d²) of it from a point that lies d beside its foot (the form factor of a small disc). What is painted on
the floor `floor_paint` knows. Values are sRGB 0–255.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.render.geometry.light import Light
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, joined, lathe, new_mesh
from station.render.kit.floor_paint import BOARDS_M, RUG_HALF

FLOOR_HALF_M = 5.0
"""The floor reaches from −5 m to +5 m beside and before the room's middle."""
WALL_RADIUS_M = 5.0
WALL_HEIGHT_M = 3.6
WALL_TEXELS = (2048, 384)
LIGHT_TEXELS = 512
"""Of the floor's light: a texel is two centimetres, and light on a floor is softer than that."""
CENTRE_Y = 0.45
"""The middle of floor, rug and wall: between the throne and the bass drum."""
_RUG_HIGH_M = 0.003
"""How thick the rug is: no more than what feet and pedals stand off the floor (our choice)."""

Disc = tuple[float, float, float, float]
"""x, y, height and radius of something that shades the floor."""


def floor_mesh() -> Mesh:
    """The square floor; its uv count tiles of boards."""
    return _level((FLOOR_HALF_M, FLOOR_HALF_M), 0.0, BOARDS_M)


def rug_mesh() -> Mesh:
    """The rug; its uv go from −1 to 1, so that each quarter shows `rug_picture`."""
    return _level(RUG_HALF, _RUG_HIGH_M, RUG_HALF)


def _level(half: tuple[float, float], z: float, tile: tuple[float, float]) -> Mesh:
    corners = np.array([[x * half[0], y * half[1], z] for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    mesh = new_mesh(corners, np.tile([0.0, 0, 1], (4, 1)), np.array([[0, 1, 2], [0, 2, 3]], np.uint32), Material.FLOOR)
    return replace(mesh, position=corners + np.array([0, CENTRE_Y, 0]), uv=corners[:, :2] / tile)


def wall_mesh(segments: int = 64) -> Mesh:
    """The round wall and a ceiling; their uv address the wall's picture."""
    wall = lathe([(WALL_RADIUS_M, WALL_HEIGHT_M), (WALL_RADIUS_M, 0)], segments, Material.WALL)
    ceiling = lathe([(0, WALL_HEIGHT_M), (WALL_RADIUS_M, WALL_HEIGHT_M)], segments, Material.WALL)
    wall_uv = np.stack([wall.uv[:, 1], wall.position[:, 2] / WALL_HEIGHT_M], axis=1)
    ceiling_uv = np.stack([ceiling.uv[:, 1], np.full(len(ceiling.uv), 0.999)], axis=1)
    both = joined([replace(wall, uv=wall_uv), replace(ceiling, uv=ceiling_uv)])
    return replace(both, position=both.position + np.array([0, CENTRE_Y, 0]))


# --- light on the floor -----------------------------------------------------------------------------------------------


def floor_light(discs: Iterable[Disc], light: Light) -> NDArray[np.uint8]:
    """How light falls on the floor, shape (texels, texels, 4), row 0 at the smallest y, in 255ths.

    The key light's share where nothing is in its way, the share of open sky, and what the warm and the cool lamps at
    the wall give.
    """
    n = LIGHT_TEXELS
    axis = np.asarray((np.arange(n) + 0.5) / n * 2 * FLOOR_HALF_M - FLOOR_HALF_M, np.float32)
    x, y = axis[None, :], np.asarray(axis[:, None] + CENTRE_Y, np.float32)
    shares = [light.on_floor(x, y), _open_sky(x, y, discs), _from_lamps(x, y, warm=True), _from_lamps(x, y, warm=False)]
    return np.asarray(np.clip(np.rint(np.stack(shares, axis=2) * 255), 0, 255), np.uint8)


def _open_sky(x: NDArray[np.float32], y: NDArray[np.float32], discs: Iterable[Disc]) -> NDArray[np.float32]:
    """The share of the sky that each point of the floor sees past the discs, darker far from the room's middle."""
    share = np.ones((y.shape[0], x.shape[1]), np.float32)
    for cx, cy, height, radius in discs:
        across = (x - np.float32(cx)) ** 2 + (y - np.float32(cy)) ** 2
        hidden = radius**2 / (radius**2 + height**2 + across)
        share *= 1 - np.float32(0.62) * hidden.astype(np.float32)
    aside_2 = x**2 + (y - CENTRE_Y) ** 2
    return np.asarray(share * (0.30 + 0.70 * np.exp(-aside_2 / _LIT_M**2)), np.float32)


def _from_lamps(x: NDArray[np.float32], y: NDArray[np.float32], *, warm: bool) -> NDArray[np.float32]:
    """A pool of light before each lamp of that tone."""
    share = np.zeros((y.shape[0], x.shape[1]), np.float32)
    for lamp in LAMPS:
        if lamp.warm is warm:
            angle = np.deg2rad(lamp.azimuth_deg)
            away = (x - WALL_RADIUS_M * np.cos(angle)) ** 2 + (y - CENTRE_Y - WALL_RADIUS_M * np.sin(angle)) ** 2
            share += np.float32(lamp.strength) * np.exp(-away / _POOL_M**2).astype(np.float32)
    return share


_LIT_M = 2.6
"""How far from its middle the room is lit: what lies beyond is dusk, so that one looks at the drummer (our choice)."""
_POOL_M = 1.5
"""How far a lamp's light reaches along the floor (our choice)."""


# --- the wall's picture -----------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Lamp:
    """A light at the wall's foot that shines up: where, its tone, how strong, and whether a tube stands over it."""

    azimuth_deg: float
    warm: bool
    strength: float
    tube: bool = False


LAMPS = (
    Lamp(8, True, 0.45),
    Lamp(40, False, 0.50),
    Lamp(68, True, 0.70, True),
    Lamp(90, False, 0.60),
    Lamp(112, True, 0.70, True),
    Lamp(140, False, 0.50),
    Lamp(172, True, 0.45),
    Lamp(200, False, 0.70),
    Lamp(220, True, 0.80),
    Lamp(234, False, 1.00, True),
    Lamp(250, True, 1.00, True),
    Lamp(266, False, 1.00, True),
    Lamp(284, True, 1.00, True),
    Lamp(302, False, 1.00, True),
    Lamp(324, True, 0.80),
    Lamp(345, False, 0.60),
)
"""Strongest behind the drummer's back (270°), where the view from the front sees them (our choice)."""
_WARM, _COOL = np.array([1.0, 0.50, 0.20], np.float32), np.array([0.14, 0.46, 0.80], np.float32)
_PLASTER = np.array([0.075, 0.085, 0.130], np.float32)


def wall_picture() -> NDArray[np.uint8]:
    """Slatted panels in the light of lamps at their feet, shape (height, width, 3), row 0 at the floor."""
    width, height = WALL_TEXELS
    azimuth = np.asarray((np.arange(width) + 0.5)[None, :] / width * 360, np.float32)
    z = np.asarray((np.arange(height) + 0.5)[:, None] / height * WALL_HEIGHT_M, np.float32)
    wash = np.zeros((height, width, 3), np.float32)
    tubes = np.zeros((height, width, 3), np.float32)
    for lamp in LAMPS:
        tone = _WARM if lamp.warm else _COOL
        wash += (lamp.strength * _wash(azimuth, z, lamp.azimuth_deg))[:, :, None] * tone
        if lamp.tube:
            tubes += _tube(azimuth, z, lamp.azimuth_deg)[:, :, None] * tone
    from_above = (1.15 - 0.55 * z / WALL_HEIGHT_M)[:, :, None]
    lit = (_PLASTER * from_above) ** 2 + 0.22 * wash
    seen = np.sqrt(lit * (_relief(azimuth, z) ** 2)[:, :, None] + np.square(tubes))
    return np.asarray(np.clip(np.rint(seen * 255), 0, 255), np.uint8)


def _relief(azimuth: NDArray[np.float32], z: NDArray[np.float32]) -> NDArray[np.float32]:
    """How bright the wall's shape makes it: slats within panels, a ledge above and a skirting board below."""
    slat, panel = np.mod(azimuth / 1.25, 1), np.mod(azimuth + 2, 30)
    rounded = 0.55 + 0.45 * np.sqrt(np.clip(1 - (2 * slat - 1) ** 2 * 1.15, 0, 1))
    in_panel = (panel > 1.6) & (z > 0.22) & (z < 3.0)
    edge = (np.abs(panel - 0.8) < 0.12) | (np.abs(z - 3.02) < 0.02) | (np.abs(z - 0.20) < 0.012)
    return np.where(in_panel, rounded, np.where(edge, 0.45, 0.92)).astype(np.float32)


def _across(azimuth: NDArray[np.float32], at_deg: float) -> NDArray[np.float32]:
    """How far beside a lamp each column is, in metres."""
    return np.asarray((np.mod(azimuth - at_deg + 180, 360) - 180) * np.float32(np.pi / 180 * WALL_RADIUS_M), np.float32)


def _wash(azimuth: NDArray[np.float32], z: NDArray[np.float32], at_deg: float) -> NDArray[np.float32]:
    """A beam up the wall that widens and fades, and the scatter round it."""
    across, spread = _across(azimuth, at_deg), 0.16 + 0.24 * z
    beam = np.exp(-((across / spread) ** 2)) * np.exp(-z / 1.5) * (0.2 / spread) ** 0.5
    return np.asarray(beam + 0.16 * np.exp(-(across**2) / 1.8 - z / 1.1), np.float32)


def _tube(azimuth: NDArray[np.float32], z: NDArray[np.float32], at_deg: float) -> NDArray[np.float32]:
    """A bright standing tube with a narrow halo."""
    across, beside = _across(azimuth, at_deg), np.maximum(np.abs(z - 1.75) - 0.75, 0)
    tube = 0.95 * np.clip((0.024 - np.abs(across)) / 0.010, 0, 1) * np.clip((0.03 - beside) / 0.02, 0, 1)
    return np.asarray(tube + 0.20 * np.exp(-(across**2) / 0.035 - beside**2 / 0.05), np.float32)
