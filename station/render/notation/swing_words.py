"""Where notation writes "swing" over straight cells, and where "straight": as the strokes themselves say it.

Triplets say themselves how they lie; strokes that no notes can write carry how much later than written they are played.
"""

import numpy as np

from station.core.units import PPQ
from station.music.score import Score

SWING, STRAIGHT = "swing", "straight"


def swing_words(score: Score) -> dict[int, str]:
    """The word over each bar, from 0, from which on another feel holds than before; straight at first."""
    words: dict[int, str] = {}
    late: set[int] = set()
    for bar in np.unique(score.bar).tolist():
        rows = score.notes[score.bar == bar]
        cells = (rows["tick"] - rows["swing_ticks"] - score.tempo_map.bar_start(bar)) % PPQ
        swung = set(cells[rows["swing_ticks"] > 0].tolist())
        if swung and not late:
            words[bar] = SWING
        elif late and not swung and late & set(cells.tolist()):
            words[bar], late = STRAIGHT, set()
        late |= swung
    return words
