"""What holds the kit up, where a kit file is silent: stands, legs, spurs, tom arms and the throne.

All of it follows from where the pieces are, in the kit's own axes; metres.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kit.kit import Kit
from station.motion.kit.piece import KitPiece
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, ball, box, joined, lathe, rod, tube
from station.render.geometry.transforms import frame, translation, unit
from station.render.kit import instrument_meshes
from station.render.kit.instrument_meshes import Detail
from station.render.kit.pedal_meshes import TUBE_M, legs_turn

_FLOOR_TOMS = frozenset({Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_2})
_POLE_M = 0.0125


def stands(kit: Kit, piece: KitPiece, detail: Detail) -> Mesh:
    """What holds a piece up."""
    n = 10 if detail.hardware else 6
    if piece.kind == "kick":
        return _spurs(piece, n)
    if piece.kind == "hihat":
        return _hat_stand(kit, piece, detail, n)
    if piece.kind in ("cymbal", "block"):
        top = piece.centre - 0.012 * piece.normal
        return _stand_of(top, piece.normal, n)
    if piece.piece in _FLOOR_TOMS:
        return _legs(piece, n)
    if piece.piece is Piece.SNARE:
        return _snare_stand(kit, piece, n)
    return _tom_holder(kit, piece, n)


def _tripod(x: float, y: float, spread: float, height: float, segments: int, turn: float = 0.5) -> list[Mesh]:
    """Three double legs with rubber feet and the collar that they meet in."""
    parts = [lathe([(0, 0), (0.02, 0), (0.02, 0.05), (0, 0.05)], 10, Material.BLACK).moved(translation([x, y, height]))]
    for k in range(3):
        a = turn + 2 * np.pi * k / 3
        foot = np.array([x + spread * np.cos(a), y + spread * np.sin(a), 0.012])
        parts.append(rod([x, y, height + 0.02], foot, 0.0085, Material.CHROME, segments))
        parts.append(
            rod([x, y, height - 0.14], (foot * 2 + [x, y, height + 0.02]) / 3, 0.006, Material.CHROME, segments)
        )
        parts.append(ball(foot, 0.017, Material.RUBBER, 8))
    return parts


def _stand_of(top: NDArray[np.float64], normal: NDArray[np.float64], segments: int) -> Mesh:
    """A straight stand under `top`, its last inch along `normal`."""
    joint = top - 0.06 * normal
    x, y = float(joint[0]), float(joint[1])
    parts = _tripod(x, y, 0.27, 0.36, segments, turn=float(np.arctan2(y, x)))
    middle = 0.36 + 0.45 * (joint[2] - 0.36)
    parts += [
        rod([x, y, 0.16], [x, y, middle], _POLE_M, Material.CHROME, segments),
        rod([x, y, middle], joint, _POLE_M * 0.72, Material.CHROME, segments),
        rod([x, y, middle - 0.02], [x, y, middle + 0.02], _POLE_M * 1.6, Material.BLACK, segments),
        ball(joint, 0.017, Material.BLACK, 10),
        rod(joint, top, 0.005, Material.STEEL, segments),
        lathe([(0, 0), (0.018, 0), (0.018, 0.010), (0, 0.010)], 10, Material.FELT).moved(
            frame(top - 0.006 * normal, normal, [1, 0, 0])
        ),
    ]
    return joined(parts)


def _hat_stand(kit: Kit, piece: KitPiece, detail: Detail, segments: int) -> Mesh:
    top, normal = piece.centre, piece.normal
    x, y = float(top[0]), float(top[1])
    low = top - normal * instrument_meshes.HAT_GAP_M
    parts = [
        instrument_meshes.hat_bottom(piece.radius_m, detail).moved(frame(low, normal, piece.axes[0])),
        *_tripod(x, y, 0.26, 0.30, segments, turn=legs_turn(kit, x, y, 0.26)),
        rod([x, y, TUBE_M], [x, y, low[2] - 0.05], _POLE_M, Material.CHROME, segments),
        lathe([(0, 0), (0.03, 0.0), (0.03, 0.014), (0, 0.014)], 14, Material.FELT).moved(
            translation([x, y, low[2] - 0.052])
        ),
    ]
    return joined(parts)


def _spurs(piece: KitPiece, segments: int) -> Mesh:
    parts = []
    for side in (-1.0, 1.0):
        hold = piece.centre + np.array([side * piece.radius_m * 0.93, piece.depth_m * 0.72, -piece.radius_m * 0.36])
        foot = np.array([hold[0] + side * 0.13, hold[1] + 0.12, 0.01])
        parts += [rod(hold, foot, 0.009, Material.CHROME, segments), ball(foot, 0.015, Material.RUBBER, 8)]
    return joined(parts)


def _legs(piece: KitPiece, segments: int) -> Mesh:
    """Three legs of a floor tom, held by brackets on its shell."""
    right, away, normal = piece.axes
    parts = []
    for k in range(3):
        a = np.pi / 2 + 2 * np.pi * k / 3
        out = np.cos(a) * right + np.sin(a) * away
        hold = piece.centre + out * (piece.radius_m + 0.022) - normal * piece.depth_m * 0.45
        knee = hold - normal * max(piece.depth_m * 0.62, 0.05)
        foot = np.array([knee[0] + 0.05 * out[0], knee[1] + 0.05 * out[1], 0.014])
        parts += [
            rod(hold + normal * 0.10, knee, 0.0065, Material.CHROME, segments),
            rod(knee, foot, 0.0065, Material.CHROME, segments),
            ball(foot, 0.017, Material.RUBBER, 8),
            box((0.035, 0.05, 0.06), Material.CHROME, 0.008).moved(frame(hold - 0.01 * out, normal, out)),
        ]
    return joined(parts)


_SNARE_LEGS_M = 0.20
"""A snare stand's legs reach so far out: between the pedals there is no more room (our choice)."""


def _snare_stand(kit: Kit, piece: KitPiece, segments: int) -> Mesh:
    right, away, normal = piece.axes
    under = piece.centre - normal * (piece.depth_m + 0.015)
    hub = under - normal * 0.10
    x, y = float(hub[0]), float(hub[1])
    parts = _tripod(x, y, _SNARE_LEGS_M, 0.24, segments, turn=legs_turn(kit, x, y, _SNARE_LEGS_M))
    parts.append(rod([x, y, 0.10], hub, _POLE_M, Material.CHROME, segments))
    for k in range(3):
        a = np.pi / 2 + 2 * np.pi * k / 3
        out = np.cos(a) * right + np.sin(a) * away
        reach = under + out * (piece.radius_m + 0.016)
        parts.append(
            tube(
                [hub, under + out * piece.radius_m * 0.75 - normal * 0.012, reach, reach + normal * 0.03],
                0.006,
                Material.CHROME,
                segments,
            )
        )
        parts.append(ball(reach + normal * 0.03, 0.012, Material.RUBBER, 8))
    return joined(parts)


def _tom_holder(kit: Kit, piece: KitPiece, segments: int) -> Mesh:
    """An arm from the bass drum's top to the shell, or a stand where the bass drum is too far."""
    base = kit.pieces[Piece.KICK]
    post = np.array([base.centre[0], base.centre[1] + 0.5 * base.depth_m, base.centre[2] + base.radius_m])
    side = 1.0 if piece.centre[0] > post[0] else -1.0
    post = post + np.array([side * 0.05, 0.0, 0.0])
    shell = piece.centre - piece.normal * piece.depth_m * 0.5
    way = unit((post - shell) * [1, 1, 0])
    way = unit(way - piece.normal * np.dot(way, piece.normal))
    hold = shell + way * (piece.radius_m + 0.01)
    if np.linalg.norm((hold - post)[:2]) > _ARM_M:
        return _stand_of(hold - np.array([0, 0, 0.02]), np.array([0.0, 0.0, 1.0]), segments)
    elbow = np.array([post[0], post[1], max(hold[2], post[2] + 0.08)])
    return joined(
        [
            rod(post - np.array([0, 0, 0.05]), elbow, 0.0125, Material.CHROME, segments),
            ball(elbow, 0.022, Material.BLACK, 10),
            rod(elbow, hold, 0.0095, Material.CHROME, segments),
            box((0.03, 0.05, 0.07), Material.CHROME, 0.008).moved(frame(hold, piece.normal, way)),
            lathe([(0, 0), (0.035, 0), (0.03, 0.02), (0, 0.02)], 14, Material.CHROME).moved(
                translation(post - np.array([0, 0, 0.02]))
            ),
        ]
    )


_ARM_M = 0.45
"""The longest tom arm; farther toms stand on their own (our choice)."""


def throne(seat_m: tuple[float, float, float], detail: Detail) -> Mesh:
    """The seat: a round cushion on a tripod."""
    x, y, z = seat_m
    cushion = [
        (0, z - 0.085),
        (0.15, z - 0.085),
        (0.172, z - 0.075),
        (0.176, z - 0.05),
        (0.172, z - 0.02),
        (0.15, z - 0.004),
        (0.10, z),
        (0, z - 0.006),
    ]
    parts = [
        lathe(cushion, detail.segments, Material.CUSHION).moved(translation([x, y, 0])),
        lathe(
            [(0.1765, z - 0.056), (0.1775, z - 0.05), (0.1765, z - 0.044)], detail.segments, Material.SHELL_RING
        ).moved(translation([x, y, 0])),
        rod([x, y, 0.10], [x, y, z - 0.08], 0.016, Material.CHROME, 10),
        *_tripod(x, y, 0.25, 0.24, 8, turn=np.pi / 2),
    ]
    return joined(parts)
