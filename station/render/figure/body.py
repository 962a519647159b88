"""The drummer's body: a stylised hero in clothes, made of smoothly blended solids in the stance of `skeleton`.

Garments, hands and head come from modules of their own; here they become one table of corners with their bones. What is
worn and how thick the body is are the figure's `look`. Metres.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from station.motion.kinematics.figure import Figure
from station.render.figure import flesh, legwear, shoes, tops
from station.render.figure.bones import FINGERS, Bone
from station.render.figure.face import face_skins
from station.render.figure.garments import Garment
from station.render.figure.hair import hair_skins
from station.render.figure.hand_solid import hand_skin
from station.render.figure.head_shape import head_skins
from station.render.figure.headwear import headwear_skins
from station.render.figure.measures import Measures
from station.render.figure.skeleton import HEAD_M, Skeleton
from station.render.figure.skin import INFLUENCES, Skin, joined_skins, skin_of
from station.render.geometry.implicit import Array, Surface
from station.render.geometry.materials import Material

_ARMS = (Bone.RIGHT_UPPER_ARM, Bone.LEFT_UPPER_ARM)
_LEGS = (Bone.RIGHT_THIGH, Bone.LEFT_THIGH)


def build_body(figure: Figure, fineness: float) -> Skin:
    """The skin of `figure`; `fineness` multiplies the cells that its surfaces are cut with (1 is fine, 2 coarse)."""
    skeleton = Skeleton(figure)
    m = Measures.of(figure, skeleton)
    dressed = _Dressed(m, figure, fineness)
    skins = [_part_skin(part, fineness * m.k, dressed.parts) for part in dressed.parts]
    skins += dressed.trimmings
    skins += [hand_part(skeleton, fineness, side) for side in (Bone.RIGHT_HAND, Bone.LEFT_HAND)]
    look = figure.look
    head = [
        *head_skins(look.girths, fineness),
        *face_skins(look.girths, fineness),
        *hair_skins(look, fineness),
        *headwear_skins(look, fineness),
    ]
    at = skeleton.frames[Bone.HEAD]
    skins += [skin.scaled(figure.head_m / HEAD_M).moved(at) for skin in head]
    return joined_skins(skins)


class _Dressed:
    """The `parts` that a figure's body is made of, and their `trimmings`."""

    def __init__(self, m: Measures, figure: Figure, fineness: float) -> None:
        look = figure.look
        shirt, trousers = tops.top(m, look.top), legwear.legwear(m, look.legs)
        self.parts: list[Garment] = [shirt, trousers, *flesh.torso(m, look.top == "tank")]
        self.trimmings: list[Skin] = [
            *tops.top_trimmings(m, look.top, shirt, fineness),
            *legwear.legwear_trimmings(m, look.legs, trousers, fineness),
        ]
        for upper in _ARMS:
            if look.top != "tank":
                self.parts.append(flesh.arm(m, upper, tops.arm_begins(look.top)))
            if "sweatbands" in look.worn:
                self.trimmings.append(tops.sweatband(m, upper, fineness))
        for thigh in _LEGS:
            foot = Bone(thigh + 2)
            upper_shoe = shoes.shoe(m, foot, look.shoes)
            self.parts.append(upper_shoe)
            self.trimmings += shoes.shoe_trimmings(m, foot, look.shoes, upper_shoe, fineness)
            if look.legs == "shorts":
                self.parts += [flesh.shank(m, thigh), legwear.sock(m, thigh)]


# --- from parts to skin -----------------------------------------------------------------------------------------------


def _part_skin(part: Garment, fineness: float, whole: Sequence[Garment]) -> Skin:
    cell = part.cell * fineness
    mesh = part.surface(cell)
    return skin_of(mesh, part.weights(mesh.position), part.material, _open_sky(mesh, whole))


_AO_STEPS_M = (0.02, 0.05, 0.10, 0.16)


def _open_sky(mesh: Surface, whole: Sequence[Garment]) -> Array:
    """How little the body stands in its own way: distance to it along the normal, against the way gone (Evans 2006)."""
    closed = np.zeros(len(mesh.position))
    for i, step in enumerate(_AO_STEPS_M):
        p = mesh.position + step * mesh.normal
        near = np.full(len(p), step)
        for part in whole:
            low, high = part.bounds(0.0)
            beside = np.flatnonzero(((p > low - step) & (p < high + step)).all(axis=1))
            if len(beside):
                near[beside] = np.minimum(near[beside], part.whole(p[beside]))
        closed += 0.5**i * np.clip((step - near) / step, 0, 1)
    return np.asarray(np.clip(1 - 0.62 * closed / sum(0.5**i for i in range(len(_AO_STEPS_M))) * 1.6, 0.15, 1))


def hand_part(skeleton: Skeleton, fineness: float, hand: Bone) -> Skin:
    """The skin of one hand, in the stance of `skeleton`."""
    made = hand_skin(fineness)
    n = len(made.position)
    bones, weights = np.zeros((n, INFLUENCES), np.uint8), np.zeros((n, INFLUENCES))
    strongest = np.argsort(-made.weights, axis=1)
    own = np.where(made.bones > 0, FINGERS[hand] + made.bones - 1, hand)
    bones[:, :2] = np.take_along_axis(own, strongest, axis=1)
    weights[:, :2] = np.take_along_axis(made.weights, strongest, axis=1)
    material = np.full(n, Material.SKIN, np.uint8)
    skin = Skin(made.position, made.normal, bones, weights, material, made.ao, made.faces)
    if hand is Bone.LEFT_HAND:
        mirror = np.array([-1.0, 1.0, 1.0])
        skin = replace(skin, position=skin.position * mirror, normal=skin.normal * mirror, faces=skin.faces[:, ::-1])
    return skin.scaled(skeleton.hand_scale).moved(skeleton.frames[hand])
