"""The lag with which most notes are answered: what `click_offset` is for a lean, this is for a device.

Equipment may be late by more than a sixteenth lasts; what speaks against the next sixteenth are strokes that would
stay unanswered there, and not a count of votes.
"""

import math

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.matching.match_classes import match_classes

Floats = NDArray[np.float64]

_REACH_MS, _STEP_MS = 200, 4
_SD_MS, _PLAYED, _STRAYS_HZ = 40.0, 0.9, 0.3
"""A beginner's spread, the notes they play, their strays a second on a class of pieces (our choice, for looking)."""
_PRIOR_MS = 100.0
"""SD of lags before anything is played (our choice): against it a lag needs but two unanswered notes."""


def likely_lag_ms(score: Score, performance: Performance) -> float:
    """The lag within ±200 ms with which most notes are answered, at any number of tempi; hits are in score time.

    A note is answered as `docs/scoring.md` has it, ln(1 + r); a lag pays ½(lag / 100 ms)². Of even strokes all lags
    that are one note apart answer as many; other pads and other tempi tell which it is.
    """
    classes = match_classes()
    note_class, hit_class = classes[score.notes["piece"]], classes[performance.hits["piece"]]
    notes_ms, hits_ms = score.onset_ns / NS_PER_MS, performance.hits["at_ns"] / NS_PER_MS
    lags = np.arange(-_REACH_MS, _REACH_MS + 1, _STEP_MS, dtype=np.float64)
    worth = -0.5 * (lags / _PRIOR_MS) ** 2
    for each in np.intersect1d(note_class, hit_class).tolist():
        written, played = np.unique(notes_ms[note_class == each]), np.sort(hits_ms[hit_class == each])
        worth = worth + _answers(written, played, lags)
    return float(lags[worth.argmax()])


def _answers(written: Floats, played: Floats, lags: Floats) -> Floats:
    """What each of `lags` (k,) brings: notes answered by hits, and hits that have a note, each of them by half."""
    peak = _PLAYED / (_STRAYS_HZ * 1e-3 * _SD_MS * math.sqrt(2 * math.pi))
    total = np.zeros(len(lags))
    for near, of, sign in ((played, written, 1.0), (written, played, -1.0)):
        asked = of[None, :] + sign * lags[:, None]
        right = np.searchsorted(near, asked)
        after = np.abs(near[np.minimum(right, len(near) - 1)] - asked)
        before = np.abs(near[np.maximum(right - 1, 0)] - asked)
        total += 0.5 * np.log1p(peak * np.exp(-0.5 * (np.minimum(after, before) / _SD_MS) ** 2)).sum(axis=1)
    return total
