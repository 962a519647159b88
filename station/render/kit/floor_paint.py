"""What is painted on the floor: oak boards, as a tile that repeats, and a quarter of a rug, which is its own mirror.

Both are formulas over metres, shape (rows, columns, 3), sRGB 0–1. Every edge is a distance in metres that is blurred
over one texel, so that a picture from near shows soft edges and no steps.
"""

import numpy as np
from numpy.typing import NDArray

RUG_HALF = (1.52, 1.25)
"""Half the rug, its fringe included, in metres."""
BOARDS_M = (1.12, 2.70)
"""What a tile of boards covers: eight boards across, two along."""
TEXELS = 1024
"""Of each side of each picture: a texel of the rug is 1.5 mm, of a board 1.1 mm across."""
_FRINGE_M = 0.07
_BOARD_M, _BOARD_LENGTH_M = 0.14, 1.35
_JOINT_M = 0.003

Array = NDArray[np.float32]
_RED, _NAVY, _CREAM, _GOLD, _OAK = (
    np.array(colour, np.float32)
    for colour in (
        (0.43, 0.10, 0.12),
        (0.12, 0.16, 0.27),
        (0.78, 0.69, 0.55),
        (0.76, 0.50, 0.24),
        (0.42, 0.31, 0.235),
    )
)


def boards_picture(texels: int = TEXELS) -> Array:
    """Dark oak: each board has a tone and a grain of its own, and a thin joint."""
    x, y = _grid(BOARDS_M, texels)
    columns, rows = round(BOARDS_M[0] / _BOARD_M), round(BOARDS_M[1] / _BOARD_LENGTH_M)
    lot = np.random.default_rng(3)
    shift, tones = lot.random(columns) * _BOARD_LENGTH_M, 0.80 + 0.34 * lot.random((columns, rows))
    column = np.minimum((x / _BOARD_M).astype(int), columns - 1)
    along = np.mod(y + shift[column], BOARDS_M[1]).astype(np.float32)
    row = np.minimum((along / _BOARD_LENGTH_M).astype(int), rows - 1)
    beside = _BOARD_M * (0.5 - np.abs(np.mod(x / _BOARD_M, 1) - 0.5))
    before = _BOARD_LENGTH_M * (0.5 - np.abs(np.mod(along / _BOARD_LENGTH_M, 1) - 0.5))
    texel = BOARDS_M[0] / texels
    joint = np.maximum(_beyond(_JOINT_M / 2 - beside, texel), _beyond(_JOINT_M / 2 - before, 2 * texel))
    grain = 0.65 * _streaks(lot, texels, 220, 12) + 0.35 * _streaks(lot, texels, 512, 40)
    shade = (tones[column, row] + 0.20 * grain) * (1 - 0.55 * joint)
    return np.asarray(shade[:, :, None] * _OAK, np.float32)


def rug_picture(texels: int = TEXELS) -> Array:
    """From the rug's middle to its corner: a medallion, a field of lozenges, two borders, and a fringe beyond."""
    x, y = _grid(RUG_HALF, texels)
    blur = RUG_HALF[0] / texels
    edge = np.minimum(RUG_HALF[0] - _FRINGE_M - x, RUG_HALF[1] - y)
    field, border = _beyond(edge - 0.245, blur), _between(edge, 0.056, 0.200, blur)
    scallop = 0.022 * np.cos(np.arctan2(y * 1.2, x) * 20)
    star = 1 - x / 0.80 - y / 0.66 + scallop.astype(np.float32)
    soft, outside = 2 * blur, field * _beyond(-0.5 * star - 0.03, blur)
    middle = _beyond(star - 0.60, soft)
    layers = (
        (field, _RED),
        (_between(edge, 0.028, 0.040, blur) + _between(edge, 0.216, 0.230, blur), _GOLD),
        (border * _lozenges(x, y, 0.0775, 0.34, blur), _CREAM),
        (border * _lozenges(x, y, 0.0775, 0.20, blur), _RED),
        (outside * _lozenges(x, y, 0.24, 0.20, blur), _GOLD),
        (outside * _lozenges(x, y, 0.24, 0.12, blur), _NAVY),
        (outside * _lozenges(x + 0.12, y + 0.12, 0.24, 0.10, blur), _RED * 0.7),
        (_beyond(star, soft), _NAVY),
        (_between(star, 0.055, 0.115, soft), _CREAM),
        (_beyond(star - 0.20, soft) * _lozenges(x, y, 0.24, 0.30, blur), _RED),
        (_between(star, 0.52, 0.60, soft), _GOLD),
        (middle, _RED),
        (middle * _lozenges(x + 0.06, y + 0.06, 0.12, 0.16, blur), _CREAM),
    )
    paint = np.broadcast_to(_NAVY, (texels, texels, 3)).copy()
    for share, colour in layers:
        paint += share[:, :, None] * (colour - paint)
    lot = np.random.default_rng(5)
    pile = 1 + 0.16 * (lot.random((texels, texels), np.float32) - 0.5) + 0.07 * _streaks(lot, texels, 48, 48)
    tassels = 0.25 + 0.75 * _beyond(0.007 - 0.028 * np.abs(np.mod(y / 0.028, 1) - 0.5), blur)
    fringe = (_beyond(-edge, blur) * (edge < 0))[:, :, None]
    paint += fringe * (tassels[:, :, None] * _CREAM * 0.85 - paint)
    return np.asarray(paint * pile[:, :, None], np.float32)


def _grid(size_m: tuple[float, float], texels: int) -> tuple[Array, Array]:
    """The middles of a picture's texels, in metres."""
    x, y = ((np.arange(texels, dtype=np.float32) + 0.5) / texels * np.float32(size) for size in size_m)
    across, along = np.meshgrid(x, y)
    return np.asarray(across, np.float32), np.asarray(along, np.float32)


def _beyond(distance: Array, blur: float) -> Array:
    return np.asarray(np.clip(distance / np.float32(blur) + np.float32(0.5), 0, 1), np.float32)


def _between(distance: Array, low: float, high: float, blur: float) -> Array:
    return _beyond(distance - np.float32(low), blur) - _beyond(distance - np.float32(high), blur)


def _lozenges(x: Array, y: Array, cell_m: float, reach: float, blur: float) -> Array:
    """A lattice of lozenges that reach so far from the middle of their cells, in cells."""
    away = np.abs(np.mod(x / np.float32(cell_m), 1) - 0.5) + np.abs(np.mod(y / np.float32(cell_m), 1) - 0.5)
    return _beyond((reach - away) * np.float32(cell_m / np.sqrt(2)), blur)


def _streaks(lot: np.random.Generator, texels: int, across: int, along: int) -> Array:
    """Smooth noise −0.5 … 0.5 of so many waves across and along the picture; it repeats with the picture."""
    coarse = lot.random((along, across)).astype(np.float32) - np.float32(0.5)
    return _stretched(_stretched(coarse, texels).T, texels).T


def _stretched(rows: Array, length: int) -> Array:
    """The rows (n, m) between which lines are drawn until there are `length` of them."""
    at = np.arange(length, dtype=np.float32) * (len(rows) / length)
    low = at.astype(int)
    share = (at - low)[:, None].astype(np.float32)
    return np.asarray(rows[low] * (1 - share) + rows[(low + 1) % len(rows)] * share, np.float32)
