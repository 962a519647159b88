"""Cues written down shortly."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece, Zone
from station.engine.messages import CUE_DTYPE, Bus, ClickVoice


def clicks(times_ns: Iterable[int], velocity: int = 127) -> NDArray[np.void]:
    """A click on the beat at each of `times_ns`."""
    rows = [(at, Bus.CLICK, ClickVoice.BEAT, 0, 0, velocity, np.nan) for at in times_ns]
    return np.array(rows, CUE_DTYPE)


def stroke_cue(at_ns: int, piece: Piece, velocity: int = 127, zone: Zone = Zone.HEAD) -> NDArray[np.void]:
    """One stroke of the demonstration; velocity 0 grabs the cymbal."""
    row = (at_ns, Bus.DEMONSTRATION, piece, zone, Articulation.NORMAL, velocity, np.nan)
    return np.array([row], CUE_DTYPE)
