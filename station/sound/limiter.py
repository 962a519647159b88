"""A limiter without look-ahead or memory: a soft clip that leaves quiet sound alone and never reaches full scale."""

import numpy as np

from station.sound.drum_kit import Frames

KNEE = 0.8
"""Linear up to here (−1.9 dBFS; our choice: the kit's own peaks stay below it)."""


def soft_clip(block: Frames) -> Frames:
    """`block` (any shape) with what exceeds ±`KNEE` bent along a tangent's curve towards ±1; written in place.

    The curve k + (1 − k)·tanh((|x| − k)/(1 − k)) is continuous with its slope at the knee. A block below the knee comes
    back untouched.
    """
    if block.size == 0 or (block.max() <= KNEE and block.min() >= -KNEE):
        return block
    size = np.abs(block)
    room = 1.0 - KNEE
    bent = KNEE + room * np.tanh((size - KNEE) / room)
    np.copyto(block, np.copysign(bent, block), where=size > KNEE)
    return block
