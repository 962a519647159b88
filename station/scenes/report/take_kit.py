"""Which kit stands in a take: one on which every written piece has a drum or cymbal of its own, where it can be."""

import numpy as np

from station.core.pieces import Piece
from station.motion.kit.kit import DEFAULT_KIT, Kit, load_kit
from station.practice.session.plan import Plan

FULLER_KIT = "seven_piece"
"""The default kit with a second rack tom and a second crash."""


def take_kit(plan: Plan) -> Kit:
    """The plan's kit; where that is the default one and lacks pieces of the music that the fuller one has, that.

    Two toms that are told apart by ear are so by eye. A kit that the lesson or the settings name stays.
    """
    kit, pieces = plan.kit, {Piece(piece) for piece in np.unique(plan.section.notes["piece"]).tolist()}
    if kit.name != DEFAULT_KIT or not pieces - {Piece.HIHAT_PEDAL} - set(kit.pieces):
        return kit
    fuller = load_kit(FULLER_KIT)
    if not (pieces - set(kit.pieces)) & set(fuller.pieces):
        return kit
    return fuller.mirrored if kit.left_handed else fuller
