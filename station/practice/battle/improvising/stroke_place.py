"""Where in bar and beat a stroke stands, as far as drummers' loudness and timing depend on it."""

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.played_beats import Beats


class StrokePlace(IntEnum):
    """Places that are played alike: the one, the beats that answer it, the others, the "and", before it, behind it."""

    ONE = 0
    BACKBEAT = 1
    BEAT = 2
    EARLY = 3
    HALF = 4
    LATE = 5


Struck = NDArray[np.int64]
"""Beat, cell and `Instrument` of strokes, (n, 3), in order of time."""


def struck_cells(beats: Beats) -> Struck:
    """All strokes of the beats."""
    return np.argwhere(beats.struck)


def places_of(beats: Beats, struck: Struck) -> NDArray[np.int64]:
    """The `StrokePlace` of each stroke (n,)."""
    beat, cell = struck[:, 0], struck[:, 1]
    in_bar, twice, division = beat % beats.beats_a_bar, 2 * cell, beats.division[beat]
    on_beat = np.where(in_bar == 0, StrokePlace.ONE, np.where(in_bar % 2 == 1, StrokePlace.BACKBEAT, StrokePlace.BEAT))
    off = np.where(twice < division, StrokePlace.EARLY, np.where(twice == division, StrokePlace.HALF, StrokePlace.LATE))
    return np.where(cell == 0, on_beat, off)


def moments_of(beats: Beats, struck: Struck) -> NDArray[np.int64]:
    """The number of the moment of each stroke (n,), from 0: what shares a place in a beat shares a moment."""
    places = np.rint(FINEST * (struck[:, 0] + struck[:, 1] / beats.division[struck[:, 0]])).astype(np.int64)
    return np.asarray(np.unique(places, return_inverse=True)[1], np.int64)


def spots_of(beats: Beats, struck: Struck) -> NDArray[np.int64]:
    """The spot of each stroke (n,): a number for its instrument and its place in the bar."""
    in_bar = struck[:, 0] % beats.beats_a_bar + struck[:, 1] / beats.division[struck[:, 0]]
    return np.rint(FINEST * in_bar).astype(np.int64) * 16 + struck[:, 2]


FINEST = 24
"""The least common multiple of the divisions 3, 4, 6 and 8."""
