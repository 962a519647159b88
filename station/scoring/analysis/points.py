"""The score from 0 to 100.

    score = 100 · mean credit of the notes · precision²

A note's credit is the credit of its timing (`windows`), of which a fifth is at stake for dynamics where dynamics are
judged, and a tenth for a hi-hat's openness or a grabbed cymbal where the kit tells them, and for a grace stroke that is
softer than its main stroke; a miss and a wrong piece earn
nothing. Precision is matched / (matched + extras + wrong pieces). Notes of which the kit cannot tell whether they were
played are left out.

* Feel is free: each piece's own lean, up to 25 ms, is taken off before timing is credited, and swung offbeats are
  judged against the ratio that the player holds if it lies within 1.3–3.5; a lesson may ask for less (`Feel`).
* A grace stroke earns its credit by being played, softly: its spacing is the hand's choice.
* It never rises when a note is missed, a hit is added or moved away from its note, and it is 100 for a performance
  without fault, 0 for silence.
* It is hard to cheat: who hammers all eight pads on every 16th of a bar of 13 notes hits everything and has 115 extras,
  precision 0.10, score 1.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.music import passages
from station.music.judgement import Label
from station.music.score import Score
from station.scoring.analysis.loudness import dynamic_credit
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.hit_windows import Windows

FREE_LEAN_MS = 25.0
"""A stable lean of a piece up to this is feel (issue of taste; HUMANS: just noticed in a mix from 19–28 ms)."""

FREE_SWING = (1.3, 3.5)
"""Long:short ratios that are feel (HUMANS: players hold 1:1 to 3.5:1 by tempo; below 1.3 nobody hears swing)."""

DYNAMICS_SHARE = 0.2
"""Our choice: time first."""


ARTICULATION_SHARE = 0.1
"""Our choice: a hat that is open for closed is heard, the groove stands."""

_STRAIGHTEST, _SHARPEST = 0.05, 0.95


@dataclass(frozen=True, slots=True)
class Feel:
    """What costs nothing: leans up to `lean_ms`; swing within `FREE_SWING`, or `swing_error` about what is written."""

    lean_ms: float = FREE_LEAN_MS
    swing_error: float | None = None

    def allows(self, held: float, written: float) -> bool:
        """Whether the ratio `held` is feel where `written` stands."""
        if self.swing_error is not None:
            return abs(held - written) <= self.swing_error
        return FREE_SWING[0] <= held <= FREE_SWING[1]


ALL_FREE = Feel()


@dataclass(frozen=True, eq=False)
class Judged:
    """What beside timing is judged, over the notes (n,).

    `off_db` beyond the player's own level, NaN where not judged (None: nowhere); `faulty` where the openness, the grab
    or the grace stroke's softness is wrong; `unobservable` where it is unknown.
    """

    off_db: NDArray[np.float64] | None
    faulty: NDArray[np.bool_]
    unobservable: NDArray[np.bool_]


def ratio_of_place(place: float) -> float:
    """Long to short of an offbeat that lies at this fraction of its unit."""
    inside = min(max(place, _STRAIGHTEST), _SHARPEST)
    return inside / (1 - inside)


def free_ms(score: Score, alignment: Alignment, feel: Feel = ALL_FREE) -> NDArray[np.float64]:
    """The part of each note's asynchrony that is feel and costs nothing, ms, shape (n,)."""
    off, timed = asynchrony_ms(alignment), timed_notes(score, alignment)
    swung = passages.swung(score)
    leans = np.zeros(len(score))
    for piece in np.unique(score.notes["piece"][timed]):
        here = score.notes["piece"] == piece
        straight = here & timed & ~swung.flags
        counted = straight if straight.any() else here & timed
        leans[here] = np.clip(np.median(off[counted]), -feel.lean_ms, feel.lean_ms)
    counted = swung.flags & timed
    if not counted.any():
        return leans
    shift = float(np.median((off - leans)[counted] / swung.span_ms[counted]))
    inside = swung.flags.copy()
    for place in np.unique(swung.places[swung.flags]).tolist():
        inside &= (swung.places != place) | feel.allows(ratio_of_place(place + shift), ratio_of_place(place))
    leans[inside] += shift * swung.span_ms[inside]
    return leans


def points(
    score: Score, alignment: Alignment, judged: Judged | None, windows: Windows, feel: Feel = ALL_FREE
) -> float | None:
    """0–100 as the module's head says; None for a score without notes, or of which nothing is observable.

    `judged` None: timing alone is judged.
    """
    judged = judged or Judged(None, np.zeros(len(score), np.bool_), np.zeros(len(score), np.bool_))
    observable = ~judged.unobservable
    if not observable.any():
        return None
    matched = alignment.note_label == Label.MATCH
    off = np.where(score.is_grace, 0.0, asynchrony_ms(alignment) - free_ms(score, alignment, feel))
    timing = windows.credit(np.where(matched, off, np.inf))
    loudness = 1.0 if judged.off_db is None else dynamic_credit(judged.off_db)
    credit = timing * (1 - DYNAMICS_SHARE + DYNAMICS_SHARE * loudness)
    credit = np.where(judged.faulty, (1 - ARTICULATION_SHARE) * credit, credit)
    answered = int(matched.sum())
    heard = answered + alignment.count(Label.EXTRA) + alignment.count(Label.WRONG_PIECE)
    precision = answered / heard if heard else 0.0
    return 100.0 * float(credit[observable].mean()) * precision**2
