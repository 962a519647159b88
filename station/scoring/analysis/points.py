"""The score from 0 to 100.

    score = 100 · mean credit of the notes · precision²

A note's credit is the credit of its timing (`TIMING`), of which a fifth is at stake for dynamics where dynamics are
judged, and a tenth for a hi-hat's openness or a grabbed cymbal where the kit tells them, and for a grace stroke that is
softer than its main stroke; a miss and a wrong piece earn nothing. Precision is matched / (matched + extras + wrong
pieces). Notes of which the kit cannot tell whether they were played are left out. The scale is one for all students and
lessons, so that nobody who improves sees it fall.

* Feel is free: asynchronies are measured from where each piece leans, up to 25 ms, and swung offbeats from the ratio
  that is held, within 1.3–3.5, beyond which less and less is free; a lesson may ask for less (`Feel`). Of a piece's
  leans that one counts that earns most: a maximum of continuous functions is continuous, so that there is no threshold
  beyond which a lean is suddenly dear, and a stroke that moves by 1 ms moves the score by about its own credit.
* Without a click nobody leans and nobody drifts: the trend of the whole is set apart (`common_sway_ms`), so that the
  same take has the same score wherever in its file it begins, and less sway never has less.
* A grace stroke earns its credit by being played, softly: its spacing is the hand's choice.
* It never rises when a note is missed, a hit is added or moved away from its note, and it is 100 for a performance
  without fault, 0 for silence.
* It is hard to cheat: who hammers all eight pads on every 16th of a bar of 13 notes hits everything and has 115 extras,
  precision 0.10, score 1.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.music import passages
from station.music.judgement import Label
from station.music.score import Score
from station.scoring.analysis.loudness import dynamic_credit
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Alignment, Reference
from station.scoring.matching.slow_drift import half_width, local_trend, robust_sd

Floats = NDArray[np.float64]

TIMING = ((10.0, 25.0, 40.0, 70.0), (1.0, 0.75, 0.4, 0.0))
"""Distances in ms, either side, and what a stroke earns there; straight lines between (HUMANS: full marks within 10 ms,
mild to 25, clear fault beyond 40; nothing from 70 on, where players stop calling a stroke theirs: DTXMania's and YARG's
windows)."""

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

    def ratios(self, written: float) -> tuple[float, float]:
        """The least and the greatest ratio that is feel where `written` stands, which always is."""
        if self.swing_error is not None:
            return written - self.swing_error, written + self.swing_error
        return min(FREE_SWING[0], written), max(FREE_SWING[1], written)

    def allows(self, held: float, written: float) -> bool:
        """Whether the ratio `held` is feel where `written` stands."""
        low, high = self.ratios(written)
        return low <= held <= high


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


def place_of_ratio(ratio: float) -> float:
    """Where in its unit, 0 … 1, an offbeat lies that makes this ratio of long to short."""
    long = max(ratio, 0.0)
    return long / (1 + long)


def credit(off_ms: Floats) -> Floats:
    """What strokes so far off earn for their timing, 1 … 0, the shape of `off_ms`."""
    return np.asarray(np.interp(np.abs(off_ms), *TIMING))


def common_sway_ms(score: Score, alignment: Alignment) -> Floats:
    """Where the player as a whole stands at each note, ms, (n,): set apart where no click says where to stand.

    The running trend of what was played, the leans of pieces and of swung offbeats apart.
    """
    rows = np.flatnonzero(timed_notes(score, alignment))
    off = asynchrony_ms(alignment)[rows]
    if alignment.reference is Reference.CLICK or not len(rows):
        return np.zeros(len(score))
    common = _middle(off)
    group = np.unique(score.notes["piece"][rows] * 2 + passages.swung(score).flags[rows], return_inverse=True)[1]
    leans = np.array([_middle(off[group == k]) for k in range(int(group.max()) + 1)])
    off = off - (leans[group] - common)
    at_s = score.onset_s[rows]
    trend = local_trend(at_s, off, half_width(at_s), max(robust_sd(off) or 0.0, 1.0))
    return np.interp(score.onset_s, at_s, trend)


def _middle(off_ms: Floats) -> float:
    """The mean of values (n,), those far from the median drawn in; 0 of none. One value moves it by its share."""
    if not len(off_ms):
        return 0.0
    median = float(np.median(off_ms))
    return median + float(np.clip(off_ms - median, -_FAR_MS, _FAR_MS).mean())


_FAR_MS = 50.0
"""A stroke farther from the middle counts as one so far (our choice: beyond a clear fault it is a slip)."""

_LEAN_STEP_MS = 2.5
"""Free leans are tried in such steps: half of one is an eighth of what earns full marks."""

_WAY_BACK = 1.5
"""Beyond the ratios that are free, what is free shrinks so many times as fast as the held one leaves them: a written
2:1 that is held at 1:1 is judged against 2:1, for nothing is left of the swing."""


def free_ms(score: Score, alignment: Alignment, feel: Feel = ALL_FREE, worth: Floats | None = None) -> Floats:
    """The part of each note's asynchrony that costs nothing: common sway, swing, the piece's lean; ms, shape (n,).

    Of a piece's leans the one with which its strokes earn most counts, each weighed by its `worth` (n,), all alike
    where None.
    """
    sway = common_sway_ms(score, alignment)
    free = sway + _free_swing_ms(score, asynchrony_ms(alignment) - sway, timed_notes(score, alignment), feel)
    off, timed = asynchrony_ms(alignment) - free, timed_notes(score, alignment)
    worth = np.ones(len(off)) if worth is None else worth
    steps = np.linspace(-1, 1, 2 * math.ceil(feel.lean_ms / _LEAN_STEP_MS) + 1) * feel.lean_ms
    leans = steps[np.argsort(np.abs(steps), kind="stable")]  # of equally good ones the smallest
    for piece in np.unique(score.notes["piece"][timed]):
        own = score.notes["piece"] == piece
        played = own & timed
        earned = worth[played] @ credit(off[played, None] - leans)
        free[own] += leans[int(earned.argmax())]
    return free


def _free_swing_ms(score: Score, off: Floats, timed: NDArray[np.bool_], feel: Feel) -> Floats:
    """By how much the free part of the held swing delays each note, ms, (n,); `off` (n,) is known where `timed`."""
    swung = passages.swung(score)
    free = np.zeros(len(score))
    late = off - _middle(off[timed & ~swung.flags])
    offbeats = swung.flags & timed
    if not offbeats.any():
        return free
    usual_ms = float(np.median(swung.span_ms[offbeats]))
    held = _middle(late[offbeats] / swung.span_ms[offbeats] * usual_ms) / usual_ms
    for place in np.unique(swung.places[swung.flags]).tolist():
        low, high = (place_of_ratio(ratio) - place for ratio in feel.ratios(ratio_of_place(place)))
        inside = min(max(held, low), high)
        left = max(abs(inside) - _WAY_BACK * abs(held - inside), 0.0)
        here = swung.flags & (swung.places == place)
        free[here] = math.copysign(left, inside) * swung.span_ms[here]
    return free


def points(score: Score, alignment: Alignment, judged: Judged | None, feel: Feel = ALL_FREE) -> float | None:
    """0–100 as the module's head says; None for a score without notes, or of which nothing is observable.

    `judged` None: timing alone is judged.
    """
    judged = judged or Judged(None, np.zeros(len(score), np.bool_), np.zeros(len(score), np.bool_))
    observable = ~judged.unobservable
    if not observable.any():
        return None
    matched = alignment.note_label == Label.MATCH
    loudness = 1.0 if judged.off_db is None else dynamic_credit(judged.off_db)
    worth = (matched & observable) * (1 - DYNAMICS_SHARE + DYNAMICS_SHARE * loudness)
    worth = np.where(judged.faulty, (1 - ARTICULATION_SHARE) * worth, worth)
    off = np.where(matched & ~score.is_grace, asynchrony_ms(alignment) - free_ms(score, alignment, feel, worth), 0.0)
    answered = int(matched.sum())
    heard = answered + alignment.count(Label.EXTRA) + alignment.count(Label.WRONG_PIECE)
    precision = answered / heard if heard else 0.0
    return 100.0 * float(worth @ credit(off)) / int(observable.sum()) * precision**2
