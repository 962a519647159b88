"""Eyes, lids, lashes, brows, lips and mouth, each on the bones that move it (`expression`); axes as in `head_shape`."""

import numpy as np

from station.motion.kinematics.look import Girths
from station.render.figure.bones import Bone
from station.render.figure.expression import EYE_M, LID_OPEN_RAD, LOWER_LID_RAD, MOUTH_M
from station.render.figure.head_shape import front
from station.render.figure.skin import Skin, hung, rigid_skin, skin_of
from station.render.geometry.implicit import Array
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, ball, grid_mesh, joined, lathe, tube
from station.render.geometry.transforms import frame, translation

_BALL_M, _LID_M = 0.0185, 0.0206
"""Radii of the eyeball and of the lids over it."""


def face_skins(girths: Girths, fineness: float) -> list[Skin]:
    """All features of the face."""
    lips = _Lips(girths, fineness)
    return [*_eyes(fineness), *_lids(girths, fineness), *_brows(girths, fineness), *lips.skins()]


def cuts(most: int, fineness: float) -> int:
    """Into how many pieces a round is cut: `most`, less where the surface is cut coarser than usual."""
    return max(5, round(most * min(1.0, 1.8 / fineness)))


# --- eyes -------------------------------------------------------------------------------------------------------------


def _eyes(fineness: float) -> list[Skin]:
    """White balls that stay, and on them iris, pupil and a glint, which turn."""
    parts = []
    rounds = cuts(18, fineness)
    for side, bone in ((1.0, Bone.RIGHT_EYE), (-1.0, Bone.LEFT_EYE)):
        centre = EYE_M * [side, 1, 1]
        ahead = frame(centre, [side * 0.03, 1, 0.0], [1, 0, 0])
        white = _cap(_BALL_M, 1.45, rounds, 6, Material.EYE_WHITE).moved(ahead)
        iris = _cap(_BALL_M + 0.0005, 0.60, rounds, 3, Material.IRIS).moved(ahead)
        rim = _ring(_BALL_M + 0.0006, 0.53, 0.62, rounds, Material.EYE).moved(ahead)
        pupil = _cap(_BALL_M + 0.0009, 0.32, rounds, 2, Material.EYE).moved(ahead)
        glint = ball((-0.0042, -0.0048, _BALL_M - 0.0022), 0.0021, Material.EYE_WHITE, 6).moved(
            frame(centre, [0, 1, 0], [1, 0, 0])
        )
        parts.append(rigid_skin(white.on_bone(Bone.HEAD)))
        parts.append(rigid_skin(joined([iris, rim, pupil, glint]).on_bone(bone)))
    return parts


def _cap(radius: float, reach: float, segments: int, rings: int, material: Material) -> Mesh:
    """A ball's cap about z, out to the angle `reach` from it."""
    return _ring(radius, 0.0, reach, segments, material, rings)


def _ring(radius: float, low: float, high: float, segments: int, material: Material, rings: int = 1) -> Mesh:
    """What of a ball lies between two angles from z."""
    a = np.linspace(high, low, rings + 1)
    return lathe(np.stack([radius * np.sin(a), radius * np.cos(a)], axis=1), segments, material)


def _lids(girths: Girths, fineness: float) -> list[Skin]:
    """Slices of a ball a little larger than the eyes', like an orange's, that turn about the line through both eyes."""
    wide, high = cuts(12, fineness), cuts(6, fineness)
    parts = []
    for side in (-1.0, 1.0):
        centre = EYE_M * [side, 1, 1]
        for bone, edge, back in ((Bone.UPPER_LIDS, LID_OPEN_RAD, 2.6), (Bone.LOWER_LIDS, LOWER_LID_RAD, -1.9)):
            along = np.linspace(-1.45, 1.45, wide + 1)
            over = np.linspace(edge, back, high + 1)
            tilt = 0.10 * side * np.sin(along)  # the outer corners stand a little higher
            grid = _slice(_LID_M, along[:, None], over[None, :] + tilt[:, None])
            skin = Material.SKIN
            lid = grid_mesh(grid if bone is Bone.LOWER_LIDS else grid[::-1], skin).moved(translation(centre))
            parts.append(rigid_skin(lid.on_bone(bone)))
            if bone is Bone.UPPER_LIDS or girths.bust > 0:
                rim = _slice(_LID_M + 0.0003, along[1:-1], edge + tilt[1:-1])
                thick = 0.0013 if bone is Bone.UPPER_LIDS else 0.0006
                lash = tube(rim, thick * (1 + 0.45 * girths.bust), Material.EYE, cuts(5, fineness))
                parts.append(rigid_skin(lash.moved(translation(centre)).on_bone(bone)))
    return parts


def _slice(radius: float, along: Array, over: Array) -> Array:
    """Points of a ball: `along` from its middle towards x, `over` up from straight ahead; (…, 3)."""
    x, ring = np.sin(along), np.cos(along)
    return radius * np.stack(np.broadcast_arrays(x, ring * np.cos(over), ring * np.sin(over)), axis=-1)


def _brows(girths: Girths, fineness: float) -> list[Skin]:
    t = np.linspace(0, 1, cuts(9, fineness))
    parts = []
    for side, bone in ((1.0, Bone.RIGHT_BROW), (-1.0, Bone.LEFT_BROW)):
        x = 0.012 + 0.042 * t
        z = 0.1252 + 0.0088 * np.sin(np.pi * (0.11 + 0.70 * t)) - 0.0035 * t
        y = front(girths, x, z) + 0.0015
        path = np.stack([side * x, y, z], axis=1)
        thick = 0.0050 * girths.brows * (0.72 + 0.5 * np.sin(np.pi * np.clip(0.25 + 0.75 * t, 0, 1)))
        thick[-1] *= 0.45
        mesh = tube(path, thick, Material.HAIR, cuts(7, fineness))
        ends = [ball(path[end], thick[end], Material.HAIR, cuts(7, fineness)) for end in (0, -1)]
        parts.append(rigid_skin(joined([mesh, *ends]).on_bone(bone)))
    return parts


# --- mouth ------------------------------------------------------------------------------------------------------------


class _Lips:
    """Two lips from corner to corner, and between them a mouth that is nothing while it is shut."""

    def __init__(self, girths: Girths, fineness: float) -> None:
        self.girths, self.fineness = girths, fineness
        self.out = 0.0007 * max(fineness - 1.0, 0.0)  # coarse cheeks stand out between their corners
        self.t = np.linspace(-1, 1, 2 * (cuts(9, fineness) // 2) + 1)
        self.x = MOUTH_M[0] * self.t
        self.z = MOUTH_M[2] - 0.0020 * (1 - self.t**2)

    def skins(self) -> list[Skin]:
        """Lips, dark inside, upper teeth."""
        full = 0.8 + 0.5 * self.girths.bust
        upper, lower = (
            self._lip(0.0012, 0.0021 * full, Bone.UPPER_LIP),
            self._lip(-0.0017, 0.0026 * full, Bone.LOWER_LIP),
        )
        return [
            self._between(0.0, 1.0, 0.0014, Material.MOUTH),
            self._between(0.02, 0.42, 0.0020, Material.TEETH),
            upper,
            lower,
        ]

    def _lip(self, above: float, thick: float, bone: Bone) -> Skin:
        middle = 1 - self.t**2
        z = self.z + above * middle
        path = np.stack([self.x, front(self.girths, self.x, z) + self.out, z], axis=1)
        radius = thick * (0.45 + 0.55 * middle)
        rounds = cuts(7, self.fineness)
        mesh = tube(path, radius, Material.LIP, rounds)
        t = np.repeat(self.t, rounds + 1)
        return skin_of(mesh, self._weights(t, {bone: np.ones_like(t)}))

    def _between(self, top: float, bottom: float, out: float, material: Material) -> Skin:
        """A sheet from `top` to `bottom` of the way from the upper to the lower lip."""
        share = np.linspace(top, bottom, 4)
        y = front(self.girths, self.x, self.z) + self.out + out
        line = np.stack([self.x, y, self.z], axis=1)
        mesh = grid_mesh(np.repeat(line[:, None], len(share), axis=1), material)
        forward = np.broadcast_to(np.array([0.0, 1.0, 0.0]), mesh.position.shape).copy()
        t, s = np.repeat(self.t, len(share)), np.tile(share, len(self.t))
        weights = self._weights(t, {Bone.UPPER_LIP: 1 - s, Bone.LOWER_LIP: s})
        skin = skin_of(mesh, weights, ao=0.9)
        return Skin(skin.position, forward, skin.bones, skin.weights, skin.material, skin.ao, skin.faces)

    @staticmethod
    def _weights(t: Array, lips: dict[Bone, Array]) -> Array:
        """The lips' own bones in the middle, the corners' at the ends."""
        end = np.abs(t) ** 2.2
        pull: dict[Bone, Array | float] = {bone: share * (1 - end) for bone, share in lips.items()}
        pull[Bone.RIGHT_CORNER], pull[Bone.LEFT_CORNER] = end * (t > 0), end * (t < 0)
        return hung(Bone.HEAD, len(t), pull)
