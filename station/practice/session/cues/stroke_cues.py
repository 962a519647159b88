"""The strokes of a score as cues for the engine: what a demonstration sounds like.

Cues are rows (n,) of `CUE_DTYPE`, their times in ns.
"""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from station.engine.messages import CUE_DTYPE, Bus
from station.music.score import Score


def demonstration_cues(score: Score) -> NDArray[np.void]:
    """Every stroke of `score`, and a cue of velocity 0 wherever a cymbal is grabbed."""
    strokes = np.zeros(len(score), CUE_DTYPE)
    for name in ("piece", "zone", "articulation", "velocity", "openness"):
        strokes[name] = score.notes[name]
    strokes["at_ns"] = score.onset_ns
    strokes["bus"] = Bus.DEMONSTRATION
    grabbed = score.notes["choke_ticks"] > 0
    chokes = strokes[grabbed]
    chokes["at_ns"] = score.tempo_map.ns_at(score.notes["tick"][grabbed] + score.notes["choke_ticks"][grabbed])
    chokes["velocity"] = 0
    return np.concatenate([strokes, chokes])


def moved_by(cues: NDArray[np.void], by_ns: int) -> NDArray[np.void]:
    """The cues, each so much later; negative is earlier."""
    moved = cues.copy()
    moved["at_ns"] += by_ns
    return moved


def in_order(parts: Iterable[NDArray[np.void]]) -> NDArray[np.void]:
    """All cues of `parts` in order of time."""
    cues = np.concatenate(list(parts))
    return cues[np.argsort(cues["at_ns"], kind="stable")]
