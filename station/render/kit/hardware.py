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
from station.render.kit.pedal_rig import TUBE_M
from station.render.kit.rack import rack, tower
from station.render.kit.standing_room import StandingRoom, toes

_FLOOR_TOMS = frozenset({Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_2})
_POLE_M = 0.0125
_TILTER_M = 0.06
"""How far under a cymbal its tilter is."""
_TRIPODS_M = {"cymbal": (0.27, 0.36), "hihat": (0.26, 0.26), "snare": (0.24, 0.24), "throne": (0.25, 0.24)}
"""How far each tripod's legs reach, and how high they meet (common hardware)."""


def hardware(kit: Kit, detail: Detail) -> list[Mesh]:
    """All that holds the kit and the drummer up; each stand where it is in nothing's way."""
    n = 10 if detail.hardware else 6
    room = StandingRoom.of(kit)
    parts = [throne(kit.seat_m, detail, room)]
    parts += [_floor_hardware(kit, p, n, room) for p in kit.pieces.values() if p.kind == "kick" or _has_legs(p)]
    ordered = sorted(kit.pieces.values(), key=lambda p: (p.piece is not Piece.SNARE, p.kind != "hihat", p.centre_m[2]))
    if kit.make == "electronic":
        snare = kit.pieces[Piece.SNARE]
        return [*parts, _snare_stand(snare, n, room.without(snare)), *rack(kit, detail)]
    return parts + [_stand(kit, p, detail, room.without(p)) for p in ordered if p.kind != "kick" and not _has_legs(p)]


def _has_legs(piece: KitPiece) -> bool:
    return piece.piece in _FLOOR_TOMS and not piece.electronic


def _floor_hardware(kit: Kit, piece: KitPiece, segments: int, room: StandingRoom) -> Mesh:
    """Spurs or a tower for the kick, legs for a floor tom; in the way of all stands."""
    if piece.kind != "kick":
        return _legs(piece, segments, room)
    return tower(piece, segments) if piece.electronic else _spurs(piece, segments, room)


def _stand(kit: Kit, piece: KitPiece, detail: Detail, room: StandingRoom) -> Mesh:
    """What holds a snare, a rack tom, a cymbal or a cowbell up."""
    n = 10 if detail.hardware else 6
    if piece.kind == "hihat":
        return _hat_stand(kit, piece, detail, n, room)
    if piece.kind == "cymbal":
        on_it = instrument_meshes.nut(detail).moved(frame(piece.centre, piece.normal, piece.axes[0]))
        return joined([_stand_of(piece.centre, piece.normal, n, room), on_it])
    if piece.kind == "block":
        return _hoop_arm(kit, piece, n)
    return _snare_stand(piece, n, room) if piece.piece is Piece.SNARE else _tom_holder(kit, piece, n, room)


def _tripod(x: float, y: float, spread: float, height: float, segments: int, turn: float) -> list[Mesh]:
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


def _stand_of(top: NDArray[np.float64], normal: NDArray[np.float64], segments: int, room: StandingRoom) -> Mesh:
    """A stand under `top`, its last inches along `normal`: straight, or with a boom where a pole has no room."""
    joint = top - _TILTER_M * normal
    spread, height = _TRIPODS_M["cymbal"]
    standing = room.place(joint, spread, height)
    x, y, _ = standing.foot
    high = standing.pole_top
    middle = height + 0.45 * (high[2] - height)
    parts = _tripod(x, y, spread, height, segments, standing.turn)
    parts += [
        rod([x, y, 0.16], [x, y, middle], _POLE_M, Material.CHROME, segments),
        rod([x, y, middle], high, _POLE_M * 0.72, Material.CHROME, segments),
        rod([x, y, middle - 0.02], [x, y, middle + 0.02], _POLE_M * 1.6, Material.BLACK, segments),
        ball(joint, 0.017, Material.BLACK, 10),
        rod(joint, top, 0.005, Material.STEEL, segments),
        lathe([(0, 0), (0.016, 0), (0.016, 0.010), (0, 0.010)], segments, Material.FELT).moved(
            frame(top - 0.008 * normal, normal, [1, 0, 0])
        ),
    ]
    boom = joint - high
    if np.hypot(boom[0], boom[1]) > 0.01:
        parts += [rod(high - 0.35 * boom, joint, 0.0075, Material.CHROME, segments)]
        parts += [ball(high, 0.022, Material.BLACK, 10), ball(high - 0.35 * boom, 0.016, Material.RUBBER, 8)]
    return joined(parts)


def _hat_stand(kit: Kit, piece: KitPiece, detail: Detail, segments: int, room: StandingRoom) -> Mesh:
    top, normal = piece.centre, piece.normal
    x, y = float(top[0]), float(top[1])
    spread, height = _TRIPODS_M["hihat"]
    turn = room.place(top - 0.06 * normal, spread, height, may_boom=False).turn
    low = top - normal * instrument_meshes.HAT_GAP_M
    parts = [
        instrument_meshes.hat_bottom(piece.radius_m, detail).moved(frame(low, normal, piece.axes[0])),
        *_tripod(x, y, spread, height, segments, turn),
        rod([x, y, TUBE_M], [x, y, low[2] - 0.05], _POLE_M, Material.CHROME, segments),
        lathe([(0, 0), (0.03, 0.0), (0.03, 0.014), (0, 0.014)], 14, Material.FELT).moved(
            translation([x, y, low[2] - 0.052])
        ),
    ]
    return joined(parts)


def _spurs(piece: KitPiece, segments: int, room: StandingRoom) -> Mesh:
    parts = []
    for side in (-1.0, 1.0):
        hold = piece.centre + np.array([side * piece.radius_m * 0.93, piece.depth_m * 0.72, -piece.radius_m * 0.36])
        foot = np.array([hold[0] + side * 0.13, hold[1] + 0.12, 0.01])
        parts += [rod(hold, foot, 0.009, Material.CHROME, segments), ball(foot, 0.015, Material.RUBBER, 8)]
        room.lines.append((hold, foot, 0.012))
    return joined(parts)


def _legs(piece: KitPiece, segments: int, room: StandingRoom) -> Mesh:
    """Three legs of a floor tom, held by brackets on its shell."""
    right, away, normal = piece.axes
    parts = []
    for k in range(3):
        a = np.pi / 2 + 2 * np.pi * k / 3
        out = np.cos(a) * right + np.sin(a) * away
        hold = piece.centre + out * (piece.radius_m + 0.022) - normal * piece.depth_m * 0.45
        knee = hold - normal * max(piece.depth_m * 0.62, 0.05)
        foot = np.array([knee[0] + 0.05 * out[0], knee[1] + 0.05 * out[1], 0.014])
        room.lines.extend([(hold, knee, 0.01), (knee, foot, 0.01)])
        parts += [
            rod(hold + normal * 0.10, knee, 0.0065, Material.CHROME, segments),
            rod(knee, foot, 0.0065, Material.CHROME, segments),
            ball(foot, 0.017, Material.RUBBER, 8),
            box((0.035, 0.05, 0.06), Material.CHROME, 0.008).moved(frame(hold - 0.01 * out, normal, out)),
        ]
    return joined(parts)


def _snare_stand(piece: KitPiece, segments: int, room: StandingRoom) -> Mesh:
    right, away, normal = piece.axes
    under = piece.centre - normal * (piece.depth_m + 0.015)
    hub = under - normal * 0.10
    x, y = float(hub[0]), float(hub[1])
    spread, height = _TRIPODS_M["snare"]
    parts = _tripod(x, y, spread, height, segments, room.place(hub, spread, height, may_boom=False).turn)
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


def _hoop_arm(kit: Kit, piece: KitPiece, segments: int) -> Mesh:
    """A bent rod from the kick's hoop to a cowbell, on whose closed end it is clamped."""
    base = kit.pieces[Piece.KICK]
    under = piece.centre - piece.normal * (piece.depth_m + 0.004) + piece.axes[1] * 0.5 * piece.radius_m
    angle = float(np.clip((under[0] - base.centre[0]) / base.radius_m, -0.7, 0.7))
    _, forth, up_m = np.eye(3)
    hoop = base.centre + (base.radius_m + 0.022) * np.array([angle, 0.0, np.sqrt(1 - angle**2)])
    knee = np.array([hoop[0], hoop[1] - 0.01, under[2] - 0.02])
    return joined(
        [
            box((0.03, 0.05, 0.045), Material.CHROME, 0.006).moved(translation(hoop)),
            tube([hoop, knee - 0.03 * up_m, knee - 0.02 * forth, under], 0.005, Material.CHROME, segments),
            ball(under, 0.013, Material.BLACK, 8),
        ]
    )


def _tom_holder(kit: Kit, piece: KitPiece, segments: int, room: StandingRoom) -> Mesh:
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
        return _stand_of(hold - np.array([0, 0, 0.02]), np.array([0.0, 0.0, 1.0]), segments, room)
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


def throne(seat_m: tuple[float, float, float], detail: Detail, room: StandingRoom) -> Mesh:
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
    spread, height = _TRIPODS_M["throne"]
    foot = np.array([x, y, 0.0])
    turn = np.pi / 2
    room.lines.extend([(np.array([x, y, height]), toe, 0.012) for toe in toes(foot, spread, turn)])
    parts = [
        lathe(cushion, detail.segments, Material.CUSHION).moved(translation([x, y, 0])),
        lathe(
            [(0.1765, z - 0.056), (0.1775, z - 0.05), (0.1765, z - 0.044)], detail.segments, Material.SHELL_RING
        ).moved(translation([x, y, 0])),
        rod([x, y, 0.10], [x, y, z - 0.08], 0.016, Material.CHROME, 10),
        *_tripod(x, y, spread, height, 8, turn),
    ]
    return joined(parts)
