"""How the pedals' bones move: boards about their hinges, beaters about their axle, straps between the two, the rod.

The hi-hat's rod goes down with its board; its clutch takes the upper cymbal along, or leaves it lying where the foot
has dropped it. Metres.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kinematics.pedal_motion import BEATER_HALF_M, BEATER_LENGTH_M, OPEN_GAP_M
from station.motion.kinematics.pose import Pose
from station.motion.kit.kit import Kit, Pedal
from station.render.geometry.transforms import Matrix, frames, unit

Vector = NDArray[np.float64]

TUBE_M = 0.20
"""Height at which the hi-hat's frame holds its tube, into which the board's strap pulls the rod (our choice)."""
_AXLE_AHEAD_M = 0.045
"""From the slave's toe end to the axle that its strap turns (our choice)."""
_CAM_M = 0.02
"""A strap's end is so far above its axle (our choice)."""


class PedalBones(NamedTuple):
    """The numbers of the bones that move with the feet; a strap's reaches from its first to its second end."""

    right_board: int
    left_board: int
    slave_board: int
    beater: int
    slave_beater: int
    kick_strap: int
    slave_strap: int
    hat_strap: int
    hat_rod: int

    @classmethod
    def of(cls, first: int) -> "PedalBones":
        """The bones from `first` on."""
        return cls(*range(first, first + len(cls._fields)))


_BONES = PedalBones.of(0)
_TURNING = slice(_BONES.right_board, _BONES.slave_beater + 1)


def axle_of(kit: Kit) -> Vector:
    """The middle of the bass pedal's axle: right below the beater's rest on the head, a beater's length under it."""
    head = kit.pieces[Piece.KICK].centre
    return np.array([head[0], head[1] - BEATER_HALF_M, head[2] - BEATER_LENGTH_M])


def slave_axle(kit: Kit, slave: Pedal) -> Vector:
    """The middle of the slave's axle, as high as the kick's."""
    x, y, _ = np.array(slave.toe_m) + _AXLE_AHEAD_M * along(slave)
    return np.array([x, y, axle_of(kit)[2]])


def along(pedal: Pedal) -> Vector:
    """From heel to toe, the board lying flat."""
    return unit(np.array(pedal.toe_m) - np.array(pedal.heel_m))


@dataclass(frozen=True, eq=False)
class PedalRig:
    """What of the pedals does not move.

    `pivot` (5, 3) and `spin` (5, 3, 3), the axis as a skew matrix, of what turns, in `PedalBones`' order; of each strap
    its bone, the board it hangs from, its `toe` (s, 3) there and its other end `top` (s, 3); how far the `lift` (3,) of
    the hi-hat's rod is with its board raised by a radian, and the place of that board.
    """

    pivot: Vector
    spin: Vector
    straps: list[int]
    boards: list[int]
    toe: Vector
    top: Vector
    lift: Vector
    hat_board: int

    @classmethod
    def of(cls, kit: Kit) -> "PedalRig":
        """The rig of `kit`; what it lacks stays where it is."""
        axle, cam = axle_of(kit), np.array([0.0, 0.0, _CAM_M])
        right, left = kit.pedals_by_foot
        slave, hat_board = kit.slave or left, _BONES.right_board if kit.left_handed else _BONES.left_board
        boards = (right, left, slave)
        pivot = np.array([*(p.heel_m for p in boards), axle, axle + kit.second_beater_m])
        axes = np.array([*(_across(p) for p in boards), (1.0, 0.0, 0.0), (1.0, 0.0, 0.0)])
        ends = [(_BONES.kick_strap, 1 - hat_board, axle + cam)]
        if kit.slave is not None:
            ends.append((_BONES.slave_strap, _BONES.slave_board, slave_axle(kit, slave) + cam))
        lift = np.zeros(3)
        if (piece := kit.pulled_hat) is not None:
            raised = kit.pedals[Piece.HIHAT_PEDAL].raised_rad
            ends.append((_BONES.hat_strap, hat_board, np.array([*piece.centre_m[:2], TUBE_M])))
            lift = piece.normal * (OPEN_GAP_M / raised if raised else 0.0)
        bones, hung, top = zip(*ends, strict=True)
        toe = np.array([boards[board].toe_m for board in hung])
        return cls(pivot, _skew(axes), list(bones), list(hung), toe, np.array(top), lift, hat_board)

    def matrices(self, pose: Pose) -> Matrix:
        """The matrices of `PedalBones`, (9, 4, 4)."""
        m = np.zeros((len(_BONES), 4, 4))
        m[:] = np.eye(4)
        slave, slave_beater = pose.slave_rad
        angle = np.array([*pose.footboard_rad, slave, pose.beater_rad, slave_beater])[:, None, None]
        turn = np.eye(3) + np.sin(angle) * self.spin + (1.0 - np.cos(angle)) * (self.spin @ self.spin)
        m[_TURNING, :3, :3] = turn
        m[_TURNING, :3, 3] = self.pivot - (turn @ self.pivot[:, :, None])[:, :, 0]
        lifted = self.lift * angle[self.hat_board, 0, 0]
        m[_BONES.hat_rod, :3, 3] = lifted
        start = (turn[self.boards] @ self.toe[:, :, None])[:, :, 0] + m[self.boards, :3, 3]
        way = self.top - start
        if self.straps[-1] == _BONES.hat_strap:
            way[-1] += lifted
        straps = frames(start, way, np.broadcast_to([1.0, 0.0, 0.0], way.shape))
        straps[:, :3, 2] = way
        m[self.straps] = straps
        return m


def _across(pedal: Pedal) -> Vector:
    """The axis about which a board turns up."""
    x, y, _ = along(pedal)
    return np.array([y, -x, 0.0])


def _skew(axes: Vector) -> Vector:
    """The matrices (n, 3, 3) of the vector products with unit `axes` (n, 3)."""
    m = np.zeros((len(axes), 3, 3))
    x, y, z = unit(axes).T
    m[:, 0, 1], m[:, 0, 2], m[:, 1, 2] = -z, y, -x
    m[:, 1, 0], m[:, 2, 0], m[:, 2, 1] = z, -y, x
    return m
