"""The room: a round wall and a floor, and the two pictures that are painted on them.

Both pictures are made of formulas. The floor's holds wooden boards, a rug, and the soft dark that instruments cast
on the ground under an overcast sky: a disc of radius r at height h hides the share r² / (r² + h² + d²) of it from a
point that lies d beside its foot (the form factor of a small disc). Values are sRGB 0–255.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.render.geometry.light import Light
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, joined, lathe, new_mesh

FLOOR_HALF_M = 5.0
"""The floor's picture covers x and y from −5 m to +5 m, so that a texel is about a centimetre."""
WALL_RADIUS_M = 5.0
WALL_HEIGHT_M = 3.6
WALL_TEXELS = (1024, 256)
_CENTRE_Y = 0.45
"""The middle of rug and wall: between the throne and the bass drum."""
_RUG_HALF = (1.45, 1.25)
_BOARD_M = 0.14
_FRINGE_M = 0.07

Disc = tuple[float, float, float, float]
"""x, y, height and radius of something that shades the floor."""


def floor_mesh() -> Mesh:
    """The square floor, cut finely enough to light it corner by corner; its uv address the floor's picture."""
    steps = np.linspace(-FLOOR_HALF_M, FLOOR_HALF_M, 17)
    x, y = np.meshgrid(steps, steps + _CENTRE_Y)
    corners = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    up = np.tile([0.0, 0.0, 1.0], (len(corners), 1))
    a = (np.arange(16)[:, None] * 17 + np.arange(16)).ravel()
    quads = np.stack([a, a + 1, a + 18, a + 17], axis=1)
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.uint32)
    floor = new_mesh(corners, up, faces, Material.FLOOR)
    return replace(floor, uv=(corners[:, :2] - [0, _CENTRE_Y]) / (2 * FLOOR_HALF_M) + 0.5)


def wall_mesh(segments: int = 64) -> Mesh:
    """The round wall and a ceiling; their uv address the wall's picture."""
    wall = lathe([(WALL_RADIUS_M, WALL_HEIGHT_M), (WALL_RADIUS_M, 0)], segments, Material.WALL)
    ceiling = lathe([(0, WALL_HEIGHT_M), (WALL_RADIUS_M, WALL_HEIGHT_M)], segments, Material.WALL)
    wall_uv = np.stack([wall.uv[:, 1], wall.position[:, 2] / WALL_HEIGHT_M], axis=1)
    ceiling_uv = np.stack([ceiling.uv[:, 1], np.full(len(ceiling.uv), 0.999)], axis=1)
    both = joined([replace(wall, uv=wall_uv), replace(ceiling, uv=ceiling_uv)])
    return replace(both, position=both.position + np.array([0, _CENTRE_Y, 0]))


# --- the floor's picture ----------------------------------------------------------------------------------------------


def floor_picture(discs: Iterable[Disc], light: Light, texels: int) -> NDArray[np.uint8]:
    """The lit floor, shape (texels, texels, 4), row 0 at the smallest y.

    Red, green and blue as they look where the key light falls; the fourth channel is the share that goes where it does
    not.
    """
    axis = np.asarray((np.arange(texels) + 0.5) / texels * 2 * FLOOR_HALF_M - FLOOR_HALF_M, np.float32)
    x, y = axis[None, :], np.asarray(axis[:, None] + _CENTRE_Y, np.float32)
    colour = _boards(x, y)
    across, along = (np.flatnonzero(np.abs(axis) < half + _FRINGE_M) for half in _RUG_HALF)
    rug = np.ix_(along, across)
    patch = colour[rug]
    _lay_rug(patch, x[:, across], np.asarray(y[along] - _CENTRE_Y, np.float32))
    colour[rug] = patch
    key = light.on_floor(x, y)[:, :, None] * np.array(light.colour, np.float32)
    sky = _open_sky(x, y, discs)[:, :, None] * np.array(light.sky, np.float32)
    whole, dark = film(colour**2 * (key + sky)), film(colour**2 * sky)
    lost = 1 - (dark.sum(axis=2) + 1e-4) / (whole.sum(axis=2) + 1e-4)
    picture = np.concatenate([whole, lost[:, :, None]], axis=2)
    return np.asarray(np.clip(np.rint(picture * 255), 0, 255), np.uint8)


def film(c: NDArray[np.float32]) -> NDArray[np.float32]:
    """Linear light to the screen: the same curve as the shader's."""
    c = np.maximum(c - np.float32(0.004), 0)
    return np.asarray((c * (6.2 * c + 0.5)) / (c * (6.2 * c + 1.7) + 0.06), np.float32)


def _boards(x: NDArray[np.float32], y: NDArray[np.float32]) -> NDArray[np.float32]:
    """Dark oak: each board has a tone and a grain of its own, and a thin joint."""
    row = np.floor(x / _BOARD_M).astype(np.int64)
    length = 1.35
    shift = _random(row, 3) * length
    board = np.floor((y + shift) / length).astype(np.int64)
    tone = 0.82 + 0.30 * _random(row * 131 + board, 7)
    grain = 0.035 * np.sin(
        70 * x / _BOARD_M * 0.35 + 9 * _random(row * 131 + board, 11) + 1.5 * np.sin(2.1 * y + 5 * tone)
    )
    gap_x = np.abs(x / _BOARD_M - np.round(x / _BOARD_M)) * _BOARD_M
    gap_y = np.abs((y + shift) / length - np.round((y + shift) / length)) * length
    joint = np.where((gap_x < 0.0035) | (gap_y < 0.0035), 0.62, 1.0)
    shade = ((tone + grain) * joint).astype(np.float32)
    return shade[:, :, None] * np.array([0.36, 0.27, 0.21], np.float32)


def _random(index: NDArray[np.int64], salt: int) -> NDArray[np.float32]:
    """A number in 0–1 that depends on `index` alone."""
    mixed = np.sin(index.astype(np.float64) * 12.9898 + salt * 78.233) * 43758.5453
    return np.asarray(mixed - np.floor(mixed), np.float32)


def _lay_rug(colour: NDArray[np.float32], x: NDArray[np.float32], y: NDArray[np.float32]) -> None:
    """A woven rug with two borders, a field of lozenges and a medallion."""
    hx, hy = _RUG_HALF
    edge = np.minimum(hx - np.abs(x), hy - np.abs(y))
    field, border = np.array([0.40, 0.13, 0.15], np.float32), np.array([0.13, 0.17, 0.26], np.float32)
    cream, gold = np.array([0.74, 0.64, 0.50], np.float32), np.array([0.70, 0.44, 0.20], np.float32)
    lozenge = np.abs(np.mod(x / 0.24, 1) - 0.5) + np.abs(np.mod(y / 0.24, 1) - 0.5)
    star = np.abs(x) / 0.80 + np.abs(y) / 0.66
    zigzag = np.abs(np.mod((x + y) / 0.11, 1) - 0.5) + np.abs(np.mod((x - y) / 0.11, 1) - 0.5)
    layers = (
        (edge > 0, border),
        ((edge > 0.030) & (edge < 0.042), gold),
        ((edge > 0.06) & (edge < 0.20) & (zigzag < 0.30), cream),
        ((edge > 0.06) & (edge < 0.20) & (zigzag < 0.17), field),
        ((edge > 0.215) & (edge < 0.230), gold),
        (edge > 0.245, field),
        ((edge > 0.245) & (lozenge < 0.20) & (star > 1.06), gold * 0.85),
        ((edge > 0.245) & (lozenge < 0.11) & (star > 1.06), border),
        (star < 1.0, border),
        ((star < 0.94) & (star > 0.88), cream),
        ((star < 0.80) & (lozenge < 0.24), field),
        (star < 0.42, field),
        ((star < 0.36) & (star > 0.31), gold),
    )
    weave = 0.93 + 0.07 * np.sin(x * 500) * np.sin(y * 500)
    for where, paint in layers:
        np.copyto(colour, paint * weave[:, :, None], where=np.broadcast_to(where[:, :, None], colour.shape))
    fringe = (np.abs(y) < hy) & (np.abs(x) >= hx) & (np.abs(x) < hx + _FRINGE_M) & (np.mod(y / 0.028, 1) < 0.55)
    np.copyto(colour, cream * 0.8, where=np.broadcast_to(fringe[:, :, None], colour.shape))


def _open_sky(x: NDArray[np.float32], y: NDArray[np.float32], discs: Iterable[Disc]) -> NDArray[np.float32]:
    """The share of the sky that each point of the floor sees past the discs."""
    share = np.ones((y.shape[0], x.shape[1]), np.float32)
    for cx, cy, height, radius in discs:
        across = (x - np.float32(cx)) ** 2 + (y - np.float32(cy)) ** 2
        hidden = radius**2 / (radius**2 + height**2 + across)
        share *= 1 - np.float32(0.85) * hidden.astype(np.float32)
    return share


# --- the wall's picture -----------------------------------------------------------------------------------------------

_LAMP_AZIMUTHS_DEG = (248, 262, 278, 292, 68, 112)
"""Light tubes: four behind the drummer's back (270°), two beyond the kit."""


def wall_picture() -> NDArray[np.uint8]:
    """Slatted panels, light tubes and their glow, shape (height, width, 3), row 0 at the floor."""
    width, height = WALL_TEXELS
    azimuth = np.asarray((np.arange(width) + 0.5)[None, :] / width * 360, np.float32)
    z = np.asarray((np.arange(height) + 0.5)[:, None] / height * WALL_HEIGHT_M, np.float32)
    night = np.array([0.060, 0.068, 0.098], np.float32)
    base = night * (1.05 - 0.18 * z / WALL_HEIGHT_M)[:, :, None] * np.ones((1, width, 1), np.float32)
    slat = np.mod(azimuth / 1.6, 1)
    panel = (np.mod(azimuth, 40) > 3) & (np.mod(azimuth, 40) < 37) & (z > 0.25) & (z < 2.9)
    base *= np.where(panel & (slat < 0.30), 0.72, np.where(panel, 1.12, 1.0))[:, :, None].astype(np.float32)
    glow = np.zeros((height, width, 3), np.float32)
    for k, lamp in enumerate(_LAMP_AZIMUTHS_DEG):
        tone = np.array([1.0, 0.55, 0.22] if k % 2 == 0 else [0.20, 0.55, 0.85], np.float32)
        glow += _lamp(azimuth, z, lamp)[:, :, None] * tone
    picture = base + glow * (0.75 + 0.5 * (~panel))[:, :, None].astype(np.float32)
    return np.asarray(np.clip(np.rint(picture * 255), 0, 255), np.uint8)


def _lamp(azimuth: NDArray[np.float32], z: NDArray[np.float32], at_deg: float) -> NDArray[np.float32]:
    """A soft standing glow and the bright tube in its middle."""
    across = (np.mod(azimuth - at_deg + 180, 360) - 180) * np.float32(np.pi / 180 * WALL_RADIUS_M)
    beside = np.maximum(np.abs(z - 1.35) - 0.75, 0)
    halo = 0.16 * np.exp(-(across**2) / 0.28 - beside**2 / 0.30) + 0.05 * np.exp(-(across**2) / 1.6 - beside**2 / 0.9)
    tube = 0.85 * np.clip((0.030 - np.abs(across)) / 0.012, 0, 1) * np.clip((0.03 - beside) / 0.02, 0, 1)
    return np.asarray(halo + tube, np.float32)
