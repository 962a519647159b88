"""The names of the figure's bones."""

from enum import IntEnum

from station.core.pieces import Limb
from station.render.figure.hand_bones import DIGITS, JOINTS


class Bone(IntEnum):
    """What moves as one; right before left."""

    WAIST = 0
    CHEST = 1
    NECK = 2
    HEAD = 3
    RIGHT_UPPER_ARM = 4
    RIGHT_FOREARM = 5
    RIGHT_TWIST = 6  # the forearm's far half, which turns with the palm
    RIGHT_HAND = 7
    LEFT_UPPER_ARM = 8
    LEFT_FOREARM = 9
    LEFT_TWIST = 10
    LEFT_HAND = 11
    RIGHT_THIGH = 12
    RIGHT_SHANK = 13
    RIGHT_FOOT = 14
    LEFT_THIGH = 15
    LEFT_SHANK = 16
    LEFT_FOOT = 17
    RIGHT_TOES = 18  # before the ball, where a shoe bends
    LEFT_TOES = 19
    RIGHT_EYE = 20  # from here on bones of the face, which hang on the head (`expression`)
    LEFT_EYE = 21
    UPPER_LIDS = 22
    LOWER_LIDS = 23
    RIGHT_BROW = 24
    LEFT_BROW = 25
    JAW = 26
    UPPER_LIP = 27
    LOWER_LIP = 28
    RIGHT_CORNER = 29
    LEFT_CORNER = 30


FACE_BONES = tuple(bone for bone in Bone if bone >= Bone.RIGHT_EYE)
BODY_BONES = tuple(bone for bone in Bone if bone < Bone.RIGHT_EYE)
FINGERS = {Bone.RIGHT_HAND: len(Bone), Bone.LEFT_HAND: len(Bone) + DIGITS * JOINTS}
"""Where the bones of each hand's digits begin: they follow those that have names."""
BONES = len(Bone) + 2 * DIGITS * JOINTS


def _digits(hand: Bone) -> range:
    return range(FINGERS[hand], FINGERS[hand] + DIGITS * JOINTS)


LIMB_BONES: dict[Limb, tuple[int, ...]] = {
    Limb.RIGHT_HAND: (*range(Bone.RIGHT_UPPER_ARM, Bone.RIGHT_HAND + 1), *_digits(Bone.RIGHT_HAND)),
    Limb.LEFT_HAND: (*range(Bone.LEFT_UPPER_ARM, Bone.LEFT_HAND + 1), *_digits(Bone.LEFT_HAND)),
    Limb.RIGHT_FOOT: (Bone.RIGHT_THIGH, Bone.RIGHT_SHANK, Bone.RIGHT_FOOT, Bone.RIGHT_TOES),
    Limb.LEFT_FOOT: (Bone.LEFT_THIGH, Bone.LEFT_SHANK, Bone.LEFT_FOOT, Bone.LEFT_TOES),
}
"""The bones of each limb, a hand's digits with it."""
