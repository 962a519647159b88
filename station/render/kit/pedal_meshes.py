"""The two pedals: footboards, bases, the kick's axle and its beater.

The beater's felt meets the kick's head at its centre when its angle is 0; metres.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kit.kit import Kit, Pedal
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, box, joined, lathe, rod
from station.render.geometry.transforms import Matrix, frame, rotation_at, unit

_BEATER_LENGTH_M = 0.20
"""From the pedal's axle to the middle of the beater; common pedals set it to 19–22 cm."""
_BEATER_HALF_M = 0.016
"""Half the felt's thickness, from the shaft to the face that strikes (our choice)."""


def axle_of(kit: Kit) -> NDArray[np.float64]:
    """The middle of the bass pedal's axle: right below the beater's rest on the head, a beater's length under it."""
    head = kit.pieces[Piece.KICK].centre
    return np.array([head[0], head[1] - _BEATER_HALF_M, head[2] - _BEATER_LENGTH_M])


def pedal_meshes(kit: Kit, boards: tuple[int, int], beater: int, axle: NDArray[np.float64]) -> list[Mesh]:
    """Both pedals at rest: boards and beater on their bones, the rest on the world's."""
    kick, hat = kit.pedals[Piece.KICK], kit.pedals[Piece.HIHAT_PEDAL]
    parts = [_board(pedal).on_bone(bone) for pedal, bone in zip(pedals_by_foot(kit), boards, strict=True)]
    parts += [_base(kick), _base(hat)]
    x, y, z = axle
    for side in (-0.055, 0.055):
        parts.append(rod([x + side, y, 0.01], [x + side, y, z], 0.011, Material.BLACK, 8))
    parts.append(rod([x - 0.07, y, z], [x + 0.07, y, z], 0.007, Material.STEEL, 8))
    top, half = axle + np.array([0, 0, _BEATER_LENGTH_M]), _BEATER_HALF_M
    felt = [(0, -half), (0.02, -half), (0.025, -half / 2), (0.025, half / 2), (0.02, half), (0, half)]
    shaft = [
        rod(axle, top, 0.0045, Material.STEEL, 6),
        lathe(felt, 14, Material.FELT).moved(frame(top, [0, 1, 0], [1, 0, 0])),
    ]
    parts += [p.on_bone(beater) for p in shaft]
    return parts


def pedals_by_foot(kit: Kit) -> tuple[Pedal, Pedal]:
    """The pedals under the right and the left foot."""
    kick, hat = kit.pedals[Piece.KICK], kit.pedals[Piece.HIHAT_PEDAL]
    return (hat, kick) if kit.left_handed else (kick, hat)


def _board(pedal: Pedal) -> Mesh:
    """The footboard lying flat."""
    heel, toe = np.array(pedal.heel_m), np.array(pedal.toe_m)
    along = unit(toe - heel)
    length = float(np.linalg.norm(toe - heel))
    side = unit(np.cross(along, [0.0, 0.0, 1.0]))
    plate = box((0.085, 0.012, length), Material.STEEL, 0.004).moved(
        frame((heel + toe) / 2 - np.array([0, 0, 0.008]), along, side)
    )
    grip = box((0.06, 0.004, length * 0.55), Material.RUBBER, 0.001).moved(
        frame(heel + along * length * 0.62, along, side)
    )
    return joined([plate, grip])


def _base(pedal: Pedal) -> Mesh:
    heel, toe = np.array(pedal.heel_m), np.array(pedal.toe_m)
    along = unit(toe - heel)
    side = unit(np.cross(along, [0.0, 0.0, 1.0]))
    middle = (heel + toe) / 2
    length = float(np.linalg.norm(toe - heel))
    plate = box((0.10, 0.008, length + 0.06), Material.BLACK, 0.002).moved(
        frame([middle[0], middle[1], 0.006], along, side)
    )
    block = box((0.09, 0.02, 0.05), Material.STEEL, 0.004).moved(
        frame(heel - along * 0.035 - np.array([0, 0, 0.012]), along, side)
    )
    return joined([plate, block])


def raised(pedal: Pedal, angle_rad: float) -> Matrix:
    """A footboard turned up about its heel."""
    heel = np.array(pedal.heel_m)
    along = unit(np.array(pedal.toe_m) - heel)
    return rotation_at(heel, (along[1], -along[0], 0.0), angle_rad)
