"""The meter of music whose file says none: a MIDI file then counts as 4/4, whatever it holds.

Music comes back to the same strokes a bar later, all but those that keep time, which come back sooner. The lengths of
the meters below are tried, and one counts where far more of the strokes come back after it than after a bar of 4/4, and
after two.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.score import Score
from station.music.tempo import MeterChange, TempoMap

_EIGHTH, _EIGHTHS_OF_SIX = PPQ // 2, 6
_METERS: Mapping[int, tuple[int, int]] = MappingProxyType({6: (3, 4), 7: (7, 8), 10: (5, 4)})
"""The meters that a bar of so many eighths may be."""
_FOUR_FOUR = 8
_TIME_KEEPERS = (Piece.HIHAT, Piece.HIHAT_PEDAL, Piece.RIDE, Piece.RIDE_2)
_LEAST_BARS = 4
"""So many bars must have gone by (our choice)."""
_COMES_BACK, _MORE = 0.75, 0.25
"""The share of the strokes that come back a bar later, and by how much it is above that of 4/4 (our choice)."""


def with_heard_meter(score: Score) -> Score:
    """The score, which lies on a grid and whose file says no meter, under the meter that it is in."""
    eighths = _heard_eighths(score)
    if eighths is None:
        return score
    beats, unit = (6, 8) if eighths == _EIGHTHS_OF_SIX and _is_compound(score) else _METERS[eighths]
    tempo_map = TempoMap.build(score.tempo_map.tempos, [MeterChange(0, beats, unit)])
    return Score.from_array(score.notes, tempo_map, None, score.title, score.loudness)


def _heard_eighths(score: Score) -> int | None:
    """How many eighths a bar has; None for 4/4, and where it cannot be told."""
    ticks = score.notes["tick"] - score.notes["swing_ticks"]
    strokes = np.stack([ticks, score.notes["piece"]], axis=1)
    strokes = strokes[~score.is_grace & ~np.isin(score.notes["piece"], _TIME_KEEPERS)]
    fits = {n: _comes_back(strokes, n * _EIGHTH) for n in _METERS}
    best = max(fits, key=lambda n: fits[n])
    if not len(strokes) or np.ptp(ticks) < _LEAST_BARS * best * _EIGHTH or fits[best] < _COMES_BACK:
        return None
    rivals = max(_comes_back(strokes, n * _EIGHTH) for n in (_FOUR_FOUR, 2 * _FOUR_FOUR))
    return best if fits[best] - rivals >= _MORE else None


def _comes_back(strokes: NDArray[np.int64], later: int) -> float:
    """The share of the `strokes` (n, 2), each its place and its piece, that have a like so much later."""
    known = {(place, piece) for place, piece in strokes.tolist()}
    last = max((place for place, _ in known), default=0)
    early = [(place, piece) for place, piece in known if place + later <= last]
    return sum((place + later, piece) in known for place, piece in early) / max(len(early), 1)


def _is_compound(score: Score) -> bool:
    """Whether a bar of six eighths goes in two: they strike its fourth eighth more than the third and fifth."""
    kit = np.isin(score.notes["piece"], (Piece.KICK, Piece.SNARE))
    eighth = (score.notes["tick"][kit] % (_EIGHTHS_OF_SIX * _EIGHTH)) // _EIGHTH
    return bool(np.sum(eighth == 3) > np.sum((eighth == 2) | (eighth == 4)))
