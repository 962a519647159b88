"""The score from 0 to 100.

    score = 100 · mean credit of the notes · precision²

A note's credit is the credit of its timing (`windows`), of which a fifth is at stake for dynamics where dynamics are
judged; a miss and a wrong piece earn nothing. Precision is matched / (matched + extras + wrong pieces).

* Feel is free: each piece's own lean, up to 25 ms, is taken off before timing is credited.
* A grace stroke earns its credit by being played: its spacing is the hand's choice.
* It never rises when a note is missed, a hit is added or moved away from its note, and it is 100 for a performance
  without fault, 0 for silence.
* It is hard to cheat: who hammers all eight pads on every 16th of a bar of 13 notes hits everything and has 115 extras,
  precision 0.10, score 1.
"""

import numpy as np
from numpy.typing import NDArray

from station.music.judgement import Label
from station.music.score import Score
from station.scoring.alignment import Alignment
from station.scoring.dynamics import Dynamics, dynamic_credit
from station.scoring.timing import asynchrony_ms, timed_notes
from station.scoring.windows import Windows

FREE_LEAN_MS = 25.0
"""A stable lean of a piece up to this is feel (issue of taste; HUMANS: just noticed in a mix from 19–28 ms)."""

DYNAMICS_SHARE = 0.2
"""Our choice: time first."""


def free_leans_ms(score: Score, alignment: Alignment) -> NDArray[np.float64]:
    """The part of each note's asynchrony that is its piece's own lean and costs nothing, ms, shape (n,)."""
    off = asynchrony_ms(alignment)
    leans = np.zeros(len(score))
    timed = timed_notes(score, alignment)
    for piece in np.unique(score.notes["piece"][timed]):
        here = score.notes["piece"] == piece
        leans[here] = np.clip(np.median(off[here & timed]), -FREE_LEAN_MS, FREE_LEAN_MS)
    return leans


def points(score: Score, alignment: Alignment, dynamics: Dynamics | None, windows: Windows) -> float | None:
    """0–100 as the module's head says; None for a score without notes. `dynamics` None: they cannot be told."""
    if not len(score):
        return None
    matched = alignment.note_label == Label.MATCH
    off = np.where(score.is_grace, 0.0, asynchrony_ms(alignment) - free_leans_ms(score, alignment))
    timing = windows.credit(np.where(matched, off, np.inf))
    loudness = 1.0 if dynamics is None else dynamic_credit(dynamics.off_db)
    credit = timing * (1 - DYNAMICS_SHARE + DYNAMICS_SHARE * loudness)
    answered = int(matched.sum())
    heard = answered + alignment.count(Label.EXTRA) + alignment.count(Label.WRONG_PIECE)
    precision = answered / heard if heard else 0.0
    return 100.0 * float(credit.mean()) * precision**2
