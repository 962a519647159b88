"""What strokes ask of whoever repeats them: who plays, and what is asked of loudness and touch."""

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Ornament, Piece


class Coordination(IntEnum):
    """Who plays."""

    HANDS = 0
    WITH_KICK = 1
    KIT = 2
    FOUR_LIMBS = 3


class Dynamics(IntEnum):
    """What is asked of loudness and touch."""

    FLAT = 0
    ACCENTS = 1
    GHOSTS = 2
    ORNAMENTS = 3


def coordination_of(rows: NDArray[np.void]) -> Coordination:
    """Who plays in these rows (n,)."""
    pieces = set(rows["piece"].tolist())
    if Piece.HIHAT_PEDAL in pieces or (rows["limb"] == Limb.LEFT_FOOT).any():
        return Coordination.FOUR_LIMBS
    hands = pieces - {Piece.KICK}
    if len(hands) > 1:
        return Coordination.KIT
    return Coordination.WITH_KICK if Piece.KICK in pieces else Coordination.HANDS


def dynamics_of(rows: NDArray[np.void]) -> Dynamics:
    """What these rows (n,) ask of loudness and touch."""
    if np.isin(rows["ornament"], (Ornament.FLAM, Ornament.DRAG, Ornament.DIDDLE, Ornament.ROLL)).any():
        return Dynamics.ORNAMENTS
    if (rows["dynamic"] == Dynamic.GHOST).any():
        return Dynamics.GHOSTS
    return Dynamics.ACCENTS if len(np.unique(rows["dynamic"])) > 1 else Dynamics.FLAT
