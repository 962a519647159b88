"""The score from 0 to 100.

    score = 100 · mean credit of the notes · precision²

A note's credit is the credit of its timing (`windows`), of which a fifth is at stake for dynamics where dynamics are
judged; a miss and a wrong piece earn nothing. Precision is matched / (matched + extras + wrong pieces).

* Feel is free: each piece's own lean, up to 25 ms, is taken off before timing is credited, and swung offbeats are
  judged against the ratio that the player holds if it lies within 1.3–3.5.
* A grace stroke earns its credit by being played: its spacing is the hand's choice.
* It never rises when a note is missed, a hit is added or moved away from its note, and it is 100 for a performance
  without fault, 0 for silence.
* It is hard to cheat: who hammers all eight pads on every 16th of a bar of 13 notes hits everything and has 115 extras,
  precision 0.10, score 1.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music import passages
from station.music.judgement import Label
from station.music.score import Score
from station.scoring.alignment import Alignment
from station.scoring.dynamics import Dynamics, dynamic_credit
from station.scoring.timing import asynchrony_ms, timed_notes
from station.scoring.windows import Windows

FREE_LEAN_MS = 25.0
"""A stable lean of a piece up to this is feel (issue of taste; HUMANS: just noticed in a mix from 19–28 ms)."""

FREE_SWING = (1.3, 3.5)
"""Long:short ratios that are feel (HUMANS: players hold 1:1 to 3.5:1 by tempo; below 1.3 nobody hears swing)."""

DYNAMICS_SHARE = 0.2
"""Our choice: time first."""


def free_ms(score: Score, alignment: Alignment) -> NDArray[np.float64]:
    """The part of each note's asynchrony that is feel and costs nothing, ms, shape (n,)."""
    off, timed = asynchrony_ms(alignment), timed_notes(score, alignment)
    swung, spans, places = passages.swung(score)
    leans = np.zeros(len(score))
    for piece in np.unique(score.notes["piece"][timed]):
        here = score.notes["piece"] == piece
        told = here & timed & ~swung if (here & timed & ~swung).any() else here & timed
        leans[here] = np.clip(np.median(off[told]), -FREE_LEAN_MS, FREE_LEAN_MS)
    told = swung & timed
    if not told.any():
        return leans
    start = score.notes["tick"] - np.rint(places * spans).astype(np.int64)
    span_ms = (score.tempo_map.ns_at(start + spans) - score.tempo_map.ns_at(start)) / NS_PER_MS
    shift = float(np.median((off - leans)[told] / span_ms[told]))
    held = (places + shift) / (1 - places - shift)
    inside = swung & (held >= FREE_SWING[0]) & (held <= FREE_SWING[1])
    leans[inside] += shift * span_ms[inside]
    return leans


def points(score: Score, alignment: Alignment, dynamics: Dynamics | None, windows: Windows) -> float | None:
    """0–100 as the module's head says; None for a score without notes. `dynamics` None: they cannot be told."""
    if not len(score):
        return None
    matched = alignment.note_label == Label.MATCH
    off = np.where(score.is_grace, 0.0, asynchrony_ms(alignment) - free_ms(score, alignment))
    timing = windows.credit(np.where(matched, off, np.inf))
    loudness = 1.0 if dynamics is None else dynamic_credit(dynamics.off_db)
    credit = timing * (1 - DYNAMICS_SHARE + DYNAMICS_SHARE * loudness)
    answered = int(matched.sum())
    heard = answered + alignment.count(Label.EXTRA) + alignment.count(Label.WRONG_PIECE)
    precision = answered / heard if heard else 0.0
    return 100.0 * float(credit.mean()) * precision**2
