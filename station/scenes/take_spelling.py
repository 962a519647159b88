"""Where notation writes the strokes of a take that is shown as it was played: where its sheet has them."""

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.drills.transcription.strokes.ornament_finder import found_ornaments
from station.drills.transcription.timing.grid_times import GridTimes, quantised_times
from station.music.drum_part import DrumPart
from station.music.score import Score
from station.render.snapshot import TakeSpelling


def take_spelling(part: DrumPart) -> TakeSpelling | None:
    """The places of a played part's strokes on the sheet; None of a part that is on the grid, as lessons are.

    None too where no meter can name a bar, or where the sheet hears another tempo than the file says.
    """
    score = part.score
    if not len(score) or score.notes["swing_ticks"].any():
        return None
    mains = Score.from_notes(found_ornaments(score).mains, score.tempo_map, score.end_tick)
    try:
        found = quantised_times(mains, part.is_played)
    except BadInput:
        return None
    is_as_said = found.score.tempo_map.tempos == score.tempo_map.tempos
    if not found.spread_ms or not is_as_said or score.whole[1].any():
        return None
    return TakeSpelling(_places(score, mains, found), found.score)


def _places(score: Score, mains: Score, found: GridTimes) -> NDArray[np.int64]:
    """The tick of each row of `score`, shape (n,): that of its main stroke, the nearest one of its piece."""
    straight = np.empty(len(mains), np.int64)
    straight[found.origin] = found.score.notes["tick"] - found.score.notes["swing_ticks"]
    places = np.empty(len(score), np.int64)
    for piece in np.unique(score.notes["piece"]):
        rows = np.flatnonzero(score.notes["piece"] == piece)
        own = np.flatnonzero(mains.notes["piece"] == piece)
        away = np.abs(score.notes["tick"][rows][:, None] - mains.notes["tick"][own])
        places[rows] = straight[own[away.argmin(axis=1)]]
    return places
