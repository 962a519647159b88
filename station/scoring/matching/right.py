"""What is right: the one answer for every page, live and at the end, in a pass, a bar and a whole session.

A note is *played* if it has its match. It is *right* if it is played within the outermost window of the level. When a
grace stroke comes before its main stroke is the hand's choice: it is right if it is played.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.judgement import Judgement, Label
from station.music.score import Score
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.hit_windows import Windows


def right_notes(score: Score, alignment: Alignment, windows: Windows) -> NDArray[np.bool_]:
    """Which notes of `score` (n,) are right."""
    played = alignment.note_label == Label.MATCH
    near = np.abs(alignment.asynchrony_ns) <= windows.edges_ms[-1] * NS_PER_MS
    return np.asarray(played & (near | score.is_grace))


def is_right(verdict: Judgement, is_grace: bool, windows: Windows) -> bool:
    """The same of one note's verdict, live; `is_grace`: the note is a grace stroke."""
    if verdict.label is not Label.MATCH:
        return False
    asynchrony_ns = verdict.asynchrony_ns
    return is_grace or (asynchrony_ns is not None and abs(asynchrony_ns) <= windows.edges_ms[-1] * NS_PER_MS)
