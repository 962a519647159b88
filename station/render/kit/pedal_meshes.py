"""The pedals: boards, frames, beaters and what links them; a double pedal's slave and its shaft; the hi-hat's pull rod.

A beater's felt meets the kick's head when its angle is 0; `pedal_rig` moves what moves. Metres.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kinematics.pedal_motion import BEATER_HALF_M, BEATER_LENGTH_M
from station.motion.kit.kit import Kit, Pedal
from station.motion.kit.piece import KitPiece
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, ball, box, joined, lathe, rod
from station.render.geometry.transforms import frame, translation, unit
from station.render.kit.pedal_rig import TUBE_M, PedalBones, along, axle_of, slave_axle

Vector = NDArray[np.float64]

_POST_M = 0.052
"""Half the breadth of a pedal's frame, a little over half its board's (our choice)."""


def pedal_meshes(kit: Kit, bones: PedalBones) -> list[Mesh]:
    """All pedals at rest: what moves on its bone, the rest on the world's."""
    kick, hat = kit.pedals[Piece.KICK], kit.pedals[Piece.HIHAT_PEDAL]
    parts = [_board(p).on_bone(b) for p, b in zip(kit.pedals_by_foot, bones[:2], strict=True)]
    parts += [_base(kick), _base(hat), _strap().on_bone(bones.kick_strap), _beater(axle_of(kit)).on_bone(bones.beater)]
    low = high = axle_of(kit)
    if kit.slave is not None:
        second = axle_of(kit) + kit.second_beater_m
        low, high = sorted((low, second), key=lambda p: float(p[0]))
        parts += [
            _board(kit.slave).on_bone(bones.slave_board),
            _base(kit.slave),
            _strap().on_bone(bones.slave_strap),
            _beater(second).on_bone(bones.slave_beater),
            *_shaft(kit, kit.slave),
        ]
    out = np.array([_POST_M, 0.0, 0.0])
    parts += _frame(low - out, high + out)
    if (pulled := kit.pulled_hat) is not None:
        parts += [_strap().on_bone(bones.hat_strap), _pull_rod(pulled).on_bone(bones.hat_rod), _hat_frame(pulled, hat)]
    return parts


# --- parts ------------------------------------------------------------------------------------------------------------


def _side(pedal: Pedal) -> Vector:
    """To the right of the board."""
    return unit(np.cross(along(pedal), [0.0, 0.0, 1.0]))


def _board(pedal: Pedal) -> Mesh:
    """The footboard lying flat; the top of its grip is where the sole is."""
    heel, toe = np.array(pedal.heel_m), np.array(pedal.toe_m)
    way, side = along(pedal), _side(pedal)
    length = float(np.linalg.norm(toe - heel))
    down = np.array([0.0, 0.0, -1.0])
    plate = box((0.085, 0.012, length), Material.STEEL, 0.004)
    grip = box((0.06, 0.004, length * 0.55), Material.RUBBER, 0.001)
    return joined(
        [
            plate.moved(frame((heel + toe) / 2 + 0.008 * down, way, side)),
            grip.moved(frame(heel + way * length * 0.62 + 0.002 * down, way, side)),
        ]
    )


def _base(pedal: Pedal) -> Mesh:
    heel, toe = np.array(pedal.heel_m), np.array(pedal.toe_m)
    way, side = along(pedal), _side(pedal)
    length = float(np.linalg.norm(toe - heel))
    middle = (heel + toe) / 2
    plate = box((0.10, 0.008, length + 0.06), Material.BLACK, 0.002)
    block = box((0.09, 0.02, 0.05), Material.STEEL, 0.004)
    return joined(
        [
            plate.moved(frame([middle[0], middle[1], 0.006], way, side)),
            block.moved(frame(heel - way * 0.035 - np.array([0, 0, 0.012]), way, side)),
        ]
    )


def _beater(axle: Vector) -> Mesh:
    top, half = axle + np.array([0, 0, BEATER_LENGTH_M]), BEATER_HALF_M
    felt = [(0, -half), (0.02, -half), (0.025, -half / 2), (0.025, half / 2), (0.02, half), (0, half)]
    hub = [(0, -0.012), (0.013, -0.012), (0.013, 0.012), (0, 0.012)]
    return joined(
        [
            rod(axle, top, 0.0045, Material.STEEL, 6),
            lathe(felt, 14, Material.FELT).moved(frame(top, [0, 1, 0], [1, 0, 0])),
            lathe(hub, 10, Material.BLACK).moved(frame(axle, [1, 0, 0], [0, 1, 0])),
        ]
    )


def _strap() -> Mesh:
    """A strap from z = 0 to 1, which its bone stretches between its ends."""
    return box((0.018, 0.004, 1.0), Material.STEEL, 0.0).moved(translation([0.0, 0.0, 0.5]))


def _frame(left: Vector, right: Vector) -> list[Mesh]:
    """Two posts and the axle between them."""
    posts = [rod([x, y, 0.01], [x, y, z], 0.011, Material.BLACK, 8) for x, y, z in (left, right)]
    return [*posts, rod(left, right, 0.007, Material.STEEL, 8)]


def _shaft(kit: Kit, slave: Pedal) -> list[Mesh]:
    """The slave's own frame, and the shaft with a joint at each end that turns the second beater."""
    axle, side = slave_axle(kit, slave), _side(slave)
    inward = side if kit.second_beater_m[0] < 0 else -side
    near = axle + (_POST_M + 0.02) * inward
    far = axle_of(kit) + kit.second_beater_m * (1 + (_POST_M + 0.02) / np.linalg.norm(kit.second_beater_m))
    way = unit(far - near)
    return [
        *_frame(axle - _POST_M * side, axle + _POST_M * side),
        rod(axle, near, 0.007, Material.STEEL, 8),
        ball(near, 0.014, Material.BLACK, 8),
        ball(far, 0.014, Material.BLACK, 8),
        rod(near, near + 0.55 * (far - near), 0.0085, Material.BLACK, 8),
        rod(near + 0.5 * (far - near), far, 0.006, Material.CHROME, 8),
        rod(near + way * 0.1, near + way * 0.115, 0.012, Material.CHROME, 8),
    ]


def _hat_frame(piece: KitPiece, pedal: Pedal) -> Mesh:
    """What stands about the hi-hat's strap: two posts beside the pole, wider than a shoe, and the bridge over them."""
    side = _side(pedal)
    top = np.array([piece.centre_m[0], piece.centre_m[1], TUBE_M])
    low = top * [1, 1, 0] + [0, 0, 0.012]
    posts = [
        rod(low + s * _POST_M * side, top + 0.8 * s * _POST_M * side, 0.007, Material.BLACK, 8) for s in (-1.0, 1.0)
    ]
    foot = box((2.3 * _POST_M, 0.03, 0.012), Material.BLACK, 0.003).moved(frame(low, [0, 0, 1], side))
    bridge = box((1.9 * _POST_M, 0.03, 0.028), Material.BLACK, 0.005).moved(frame(top, [0, 0, 1], side))
    return joined([*posts, foot, bridge])


def _pull_rod(piece: KitPiece) -> Mesh:
    """The rod with the clutch's upper half, the board lying flat; below it runs in the tube."""
    top, normal = piece.centre, piece.normal
    x, y, _ = piece.centre_m
    clutch = [(0, 0.0), (0.011, 0.0), (0.011, 0.034), (0.006, 0.040), (0, 0.040)]
    return joined(
        [
            rod([x, y, TUBE_M + 0.01], top - 0.05 * normal, 0.004, Material.STEEL, 6),
            rod(top - 0.05 * normal, top + 0.20 * normal, 0.004, Material.STEEL, 6),
            lathe(clutch, 10, Material.CHROME).moved(frame(top + CLUTCH_M * normal, normal, piece.axes[0])),
            rod(
                top + (CLUTCH_M + 0.022) * normal,
                top + (CLUTCH_M + 0.022) * normal - 0.03 * piece.axes[0],
                0.004,
                Material.CHROME,
                6,
            ),
        ]
    )


CLUTCH_M = 0.044
"""The clutch's upper half sits so high over the upper cymbal's bow, on the felts over its bell."""


def clutch_foot(piece: KitPiece) -> Mesh:
    """What of the clutch is the upper cymbal's: the felts over its bell and the nut under it."""
    felts = [(0, 0.016), (0.017, 0.016), (0.017, 0.036), (0.008, 0.038), (0.008, CLUTCH_M), (0, CLUTCH_M)]
    return lathe(felts, 12, Material.FELT).moved(frame(piece.centre, piece.normal, piece.axes[0]))
