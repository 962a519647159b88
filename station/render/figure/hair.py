"""Hair and beards as solids on the head, combed by waves on their surface; axes as in `head_shape`."""

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np

from station.motion.kinematics.look import Girths, Look
from station.render.figure.bones import Bone
from station.render.figure.head_shape import face_pull, shell
from station.render.figure.skin import Skin, hung, skin_of
from station.render.geometry.implicit import (
    Array,
    Field,
    Surface,
    cone,
    egg,
    plane,
    smooth_min,
    surface,
    united,
    without,
)
from station.render.geometry.materials import Material

_CELL_M = 0.0068
Wave = Callable[[Array], Array]
Haircut = tuple[Field, Wave, float, float]
"""A solid, a wave on it, the wave's depth and its length in metres."""


def hair_skins(look: Look, fineness: float) -> list[Skin]:
    """The hair on the head, and the beard where there is one."""
    parts = [_surface(look.hair, "beanie" in look.worn, fineness)]
    if look.beard != "none":
        parts.append(_beard(look.girths, fineness))
    return [skin_of(p, hung(Bone.HEAD, len(p.position), face_pull(p.position)), Material.HAIR, _sky(p)) for p in parts]


def _sky(part: Surface) -> Array:
    """Hair is darker below and behind than on top."""
    return np.asarray(np.clip(0.62 + 2.2 * (part.position[:, 2] - 0.08), 0.5, 1.0), np.float64)


@cache
def _surface(style: str, is_covered: bool, fineness: float) -> Surface:
    """The surface of a haircut; under a beanie only what looks out."""
    field, wave, depth, length = _HAIR[style]()
    if is_covered:
        field = _behind(field, plane((0, -0.02, 0.125), (0, 0.12, 1.0)))
    cell = _CELL_M * fineness
    return surface(_waved(field, wave, depth, length, cell), (-0.16, -0.21, -0.10), (0.16, 0.15, 0.29), cell)


@cache
def _beard(girths: Girths, fineness: float) -> Surface:
    """Cheeks below the ears, chin and moustache as a layer on the jaw, open at the lips."""
    line = united(
        [plane((0, 0.05, 0.046), (0, 0.42, 1.0)), cone((-0.026, 0.092, 0.044), (0.026, 0.092, 0.044), 0.008, 0.008)],
        0.006,
    )
    ears = plane((0, 0.004, 0.0), (0, -1.0, 0.0))
    region = united([_behind(_behind(line, ears), plane((0, 0, -0.016), (0, 0, -1))), _MOUSTACHE], 0.006)
    layer = shell(girths, 0.0085, region, 0.010)
    whole = without(layer, egg((0, 0.105, 0.0305), (0.0235, 0.030, 0.0085)), 0.004)
    cell = _CELL_M * fineness
    return surface(
        _waved(whole, _curly(150.0), 0.0015, 0.042, cell), (-0.10, -0.03, -0.05), (0.10, 0.14, 0.10), min(cell, 0.014)
    )


_MOUSTACHE = united(
    [cone((0.0, 0.098, 0.0440), (s * 0.030, 0.086, 0.0345), 0.0085, 0.0080) for s in (-1.0, 1.0)], 0.006
)


def _waved(field: Field, wave: Wave, depth: float, length: float, cell: float) -> Field:
    """A solid with waves on its surface, the flatter the fewer cells a wave has; with two it would be noise."""
    shown = depth * max(1 - 2 * cell / length, 0.0)
    return lambda p: np.asarray(field(p) + shown * wave(p), np.float64)


def _behind(field: Field, wall: Field) -> Field:
    """`field` where it is behind `wall`, with a soft edge."""
    return lambda p: -smooth_min(-field(p), -wall(p), 0.010)


# --- haircuts ------------------------------------------------------------------------------------------------------

_CAP = egg((0, -0.014, 0.134), (0.0855, 0.0985, 0.094))


def _hairline(front_y: float, front_z: float, neck_z: float) -> Field:
    """What lies behind the forehead's line and above the neck's, with whiskers before the ears."""
    return united([plane((0, front_y, front_z), (0, 0.86, -0.5)), plane((0, -0.002, neck_z), (0, 0.38, -0.92))], 0.018)


def _quiff() -> Haircut:
    """Short sides, and locks combed up and over from one side."""
    locks = [
        cone((-0.050, 0.048, 0.188), (0.030, 0.074, 0.226), 0.024, 0.021),
        cone((-0.018, 0.058, 0.198), (0.056, 0.076, 0.214), 0.023, 0.013),
        cone((-0.054, 0.020, 0.202), (0.030, 0.036, 0.232), 0.026, 0.022),
        cone((-0.050, -0.014, 0.208), (0.040, -0.004, 0.222), 0.027, 0.024),
        cone((-0.040, -0.050, 0.200), (0.040, -0.044, 0.206), 0.028, 0.026),
    ]
    sides = _behind(_CAP, _hairline(0.060, 0.150, 0.072))
    return united([sides, united(locks, 0.010)], 0.016), _combed(0.0, 0.35), 0.0022, 0.033


def _cropped() -> Haircut:
    """Short all over, a little longer in front."""
    front = egg((0.004, 0.040, 0.200), (0.056, 0.034, 0.024))
    return united([_behind(_CAP, _hairline(0.058, 0.152, 0.066)), front], 0.02), _curly(120.0), 0.0013, 0.052


def _ponytail() -> Haircut:
    """Combed back from the forehead to a band, from where a tail hangs to the shoulders; two locks beside the face."""
    cap = _behind(egg((0, -0.014, 0.134), (0.0865, 0.100, 0.0955)), _hairline(0.066, 0.142, 0.062))
    fringe = [
        cone((0.012, 0.070, 0.204), (0.066, 0.058, 0.150), 0.017, 0.014),
        cone((0.066, 0.058, 0.150), (0.080, 0.036, 0.085), 0.014, 0.007),
        cone((0.004, 0.070, 0.204), (-0.058, 0.062, 0.160), 0.016, 0.014),
        cone((-0.058, 0.062, 0.160), (-0.080, 0.040, 0.075), 0.014, 0.006),
    ]
    tail = [
        cone((0, -0.095, 0.178), (0, -0.128, 0.180), 0.018, 0.022),
        cone((0, -0.128, 0.180), (0.004, -0.158, 0.120), 0.026, 0.033),
        cone((0.004, -0.158, 0.120), (0.0, -0.158, 0.040), 0.033, 0.029),
        cone((0.0, -0.158, 0.040), (0.006, -0.144, -0.050), 0.029, 0.010),
    ]
    return united([united([cap, *fringe], 0.014), united(tail, 0.012)], 0.008), _combed(0.5, 1.0), 0.0018, 0.033


def _curls() -> Haircut:
    """A round mass of curls, high and wide, open at the face."""
    mass = united(
        [
            egg((0, -0.030, 0.172), (0.134, 0.130, 0.116)),
            egg((0.0, 0.036, 0.216), (0.096, 0.060, 0.056)),
        ],
        0.04,
    )
    line = united([plane((0, 0.064, 0.158), (0, 0.90, -0.44)), plane((0, -0.020, 0.080), (0, 0.62, -0.78))], 0.02)
    return _behind(mass, line), _curly(105.0), 0.0080, 0.060


def _combed(lean: float, across: float) -> Wave:
    """Strands that run from front to back, bent a little."""
    return lambda p: np.asarray(
        np.sin(190 * (across * p[:, 0] + (1 - across) * p[:, 1] + 0.35 * lean * p[:, 2]) + 2.5 * np.sin(30 * p[:, 2])),
        np.float64,
    )


def _curly(per_m: float) -> Wave:
    """Bumps in all directions (a gyroid, whose knots look like curls)."""

    def wave(p: Array) -> Array:
        x, y, z = (per_m * p).T
        return np.asarray(np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x), np.float64)

    return wave


_HAIR: Mapping[str, Callable[[], Haircut]] = {
    "quiff": _quiff,
    "ponytail": _ponytail,
    "curls": _curls,
    "cropped": _cropped,
}
