"""Where every bone is and how it glows, as the one buffer that the shaders read.

The kit's bones come first, then the drummer's, the student's double's, and what the double holds.
"""

from dataclasses import dataclass, field

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.kinematics.pose import Pose
from station.render.figure.bones import BONES, LIMB_BONES
from station.render.figure.skeleton import Skeleton
from station.render.geometry.transforms import Matrix
from station.render.gpu.light_shader import MAX_BONES, RIPPLING_BONES
from station.render.kit import kit_rig
from station.render.kit.held_meshes import HELD_BONES, held_matrices
from station.render.kit.kit_rig import KitRig

_STILL_M = 1e-5
"""A head that gives way by less is still."""

Colour = NDArray[np.float64]
"""Linear red, green and blue, (3,)."""


@dataclass(frozen=True, eq=False)
class BoneFrame:
    """What changes from one picture to the next: poses of the drummer and of the student's double, and what glows.

    `pose` None: nobody plays; `double` None: no double. `glow` lights pieces, `double_glow` the double's limbs. They
    stand in so much `light`, 1 in the spotlight. `rival` is who plays beside them; behind both a crowd moves with the
    beat, which is at `crowd_beat`, None where there is none.
    """

    pose: Pose | None = None
    glow: dict[Piece, Colour] = field(default_factory=dict)
    double: Pose | None = None
    double_glow: dict[Limb, Colour] = field(default_factory=dict)
    light: float = 1.0
    rival: "BoneFrame | None" = None
    crowd_beat: float | None = None


class BonePalette:
    """The buffers of one kit and one figure: how they are now, and the kit at rest."""

    def __init__(self, ctx: moderngl.Context, rig: KitRig, skeleton: Skeleton) -> None:
        self._rig, self._skeleton = rig, skeleton
        self.figure = rig.bone_count
        self.double = self.figure + BONES
        self.double_sticks = self.double + BONES
        assert self.double_sticks + 2 * HELD_BONES <= MAX_BONES, "the kit has more pieces than a palette holds"
        self._matrices = np.tile(np.eye(4), (MAX_BONES, 1, 1))
        self._glow = np.zeros((MAX_BONES, 4), np.float32)
        self._ripple = np.zeros((RIPPLING_BONES, 4), np.float32)
        still = self._bytes()
        self._now = ctx.buffer(reserve=len(still), dynamic=True)
        self._rest = ctx.buffer(still)

    def set(self, frame: BoneFrame) -> None:
        """Pose all bones as `frame` says."""
        matrices, glow, rig = self._matrices, self._glow, self._rig
        glow[:] = 0.0
        matrices[: self.figure] = kit_rig.bone_matrices(rig, frame.pose)
        for piece, colour in frame.glow.items():
            glow[rig.piece_bones[piece], :3] = colour
        if frame.pose is not None:
            matrices[self.figure : self.double] = self._skeleton.matrices(frame.pose)
        if frame.double is not None:
            matrices[self.double : self.double_sticks] = self._skeleton.matrices(frame.double)
            held = held_matrices(frame.double, rig.kit)
            matrices[self.double_sticks : self.double_sticks + len(held)] = held
            for limb, colour in frame.double_glow.items():
                glow[[self.double + bone for bone in LIMB_BONES[limb]], :3] = colour
        self._set_ripples(frame.pose)
        self._now.write(self._bytes())

    @property
    def matrices(self) -> Matrix:
        """Where every bone is, (n, 4, 4)."""
        return self._matrices

    def _set_ripples(self, pose: Pose | None) -> None:
        self._ripple[:] = 0.0
        for (piece, bone), (depth_m, right, away, since_s) in zip(
            self._rig.piece_bones.items(), pose.ripple.tolist() if pose is not None else (), strict=pose is not None
        ):
            if depth_m > _STILL_M:
                part = self._rig.kit.pieces[piece]
                self._ripple[bone, :3] = part.centre + right * part.axes[0] + away * part.axes[1]
                self._ripple[bone, 3], self._glow[bone, 3] = depth_m, since_s

    def _bytes(self) -> bytes:
        return _rows(self._matrices) + self._glow.tobytes() + self._ripple.tobytes()

    def use(self) -> None:
        """Let the shaders read how the bones are now."""
        self._now.bind_to_uniform_block(0)

    def use_rest(self) -> None:
        """Let the shaders read the kit at rest and the figure as it was made."""
        self._rest.bind_to_uniform_block(0)


def _rows(matrices: Matrix) -> bytes:
    """The upper three rows of affine matrices (n, 4, 4), as the shaders' `mat3x4`."""
    return matrices[:, :3].astype(np.float32).tobytes()
