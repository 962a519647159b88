"""What garments are cut to: a figure's joints in the stance of `skeleton`, its scale and girths."""

from dataclasses import dataclass

import numpy as np

from station.motion.kinematics.figure import MEDIAN_STATURE_M, Figure, Joint
from station.motion.kinematics.look import Girths
from station.render.figure.bones import Bone
from station.render.figure.skeleton import Skeleton
from station.render.geometry.implicit import Array

SHOULDER_OF = {Bone.RIGHT_UPPER_ARM: Joint.RIGHT_SHOULDER, Bone.LEFT_UPPER_ARM: Joint.LEFT_SHOULDER}
HIP_OF = {Bone.RIGHT_THIGH: Joint.RIGHT_HIP, Bone.LEFT_THIGH: Joint.LEFT_HIP}
_MEDIAN_FOOT_M = 0.152 * MEDIAN_STATURE_M


@dataclass(frozen=True, eq=False)
class Measures:
    """`joints` (21, 3) in metres; `k` the stature and `foot` the foot's length beside a median man's; `girths`."""

    joints: Array
    k: float
    foot: float
    girths: Girths

    @classmethod
    def of(cls, figure: Figure, skeleton: Skeleton) -> "Measures":
        """Those of a figure."""
        k = figure.stature_m / MEDIAN_STATURE_M
        return cls(skeleton.bind.joints_m, k, figure.foot_m / _MEDIAN_FOOT_M, figure.look.girths)

    def arm(self, upper: Bone) -> tuple[Array, Array, Array]:
        """Shoulder, elbow and wrist of the arm that begins with this bone."""
        first = SHOULDER_OF[upper]
        return self.joints[first], self.joints[first + 1], self.joints[first + 2]

    def leg(self, thigh: Bone) -> tuple[Array, Array, Array]:
        """Hip, knee and ankle of the leg that begins with this bone."""
        first = HIP_OF[thigh]
        return self.joints[first], self.joints[first + 1], self.joints[first + 2]

    def by(self, x: float, y: float, z: float) -> Array:
        """An offset designed for the median man."""
        return self.k * np.array([x, y, z])
