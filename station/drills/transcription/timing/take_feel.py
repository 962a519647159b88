"""How a take was played as a whole: how late, how evenly, and with what swing.

Each is the one under which its strokes are read at least cost (`rhythm_words.read`). Lean and spread are those of the
errors that are left; a swing must explain what straight notes and triplets do not, and a ratio that people name costs
less than one that they do not.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from math import log
from types import MappingProxyType

import numpy as np

from station.core.units import NS_PER_S, PPQ
from station.drills.transcription.timing.beat_spans import BeatSpans, Floats, Ints
from station.drills.transcription.timing.rhythm_words import Reading, cells_of, played_places, read
from station.drills.transcription.timing.take_fit import SLIP, strokes_at
from station.music.swing import STRAIGHT, TRIPLETS, Swing

USUAL_SPREAD_S = 0.015
"""Where a search begins: between a professional's 10 ms and the 26 ms of the Groove MIDI Dataset (HUMANS, Timing)."""
MIN_SPREAD_S, MAX_SPREAD_S = 0.003, 0.035
"""Below lies a machine's jitter; above, sixteenths at 120 bpm could be anything."""
LEANS_S = tuple(ms / 1000 for ms in (0, -10, 10, -20, 20, -30, 30, -40, 40))
"""Leans to begin with; HUMANS, Timing: static lean SD 11 ms, professionals to 16 ms early."""
LEAN_SD_S = 0.015
"""How far takes lean as a rule (HUMANS, Timing: 11 ms, and 16 for another)."""
LEAN_STROKES, SWING_STROKES = 300, 600
"""A lean shows in so many strokes, and whether music swings; how much it does, all tell."""

NAMED_RATIOS: Mapping[float, float] = MappingProxyType({1.5: 5.0, 2.0: 3.0, 3.0: 6.0})
"""What a swing costs that a teacher would name: light swing, triplets, dotted; our choice."""
_OTHER_RATIO_COST = 6.0
_LEAST_RATIO, _MOST_RATIO, _RATIO_STEP = 1.2, 3.0, 0.1
"""Below is the unevenness of straight playing, above a dotted figure; in finer steps nobody names a ratio."""
_HARD_SIXTEENTHS_COST = 6.0
"""Sixteenths swing less than eighths do: beyond triplets hardly ever."""
_FIRST_SWINGS = (Swing(), Swing(1.5), Swing(2.0), Swing(1.5, PPQ // 4))
_SWINGS = tuple(Swing(ratio, unit) for ratio in (1.3, 1.5, 1.75, 2.0, 2.5, 3.0) for unit in (PPQ // 2, PPQ // 4))
"""Eighths swing, or sixteenths; finer ratios are found about the best of these."""
_FINALISTS = 3


@dataclass(frozen=True, slots=True)
class Feel:
    """How a take was played: so much late (s, early below 0), with errors of `spread_s`, and its swing."""

    lean_s: float = 0.0
    spread_s: float = USUAL_SPREAD_S
    swing: Swing = field(default_factory=Swing)


@dataclass(frozen=True, eq=False)
class Take:
    """The strokes of a take in order of time (shape (n,)): when, and on what piece, over the beats of `spans`."""

    times_s: Floats
    piece: Ints
    spans: BeatSpans

    def read(self, feel: Feel, max_words: int = 0) -> Reading:
        """The likeliest reading of the take with that feel."""
        strokes = strokes_at(self.times_s - feel.lean_s, self.piece, self.spans, feel.spread_s)
        return read(strokes, feel.swing, max_words)

    def errors_s(self, feel: Feel, reading: Reading) -> Floats:
        """How late each stroke is beside its place, lean and all."""
        span, place = self.spans.places(self.times_s - feel.lean_s)
        return (place - reading.place) * self.spans.lengths_s[span] + feel.lean_s

    def first(self, count: int) -> "Take":
        """The take's first strokes, at most so many."""
        return replace(self, times_s=self.times_s[:count], piece=self.piece[:count])


def feel_of(take: Take) -> Feel:
    """How the take was played."""
    feel = _cheapest(take.first(LEAN_STROKES), [Feel(lean, swing=swing) for lean in LEANS_S for swing in _FIRST_SWINGS])
    feel = settled(take, feel)
    rivals = [replace(feel, swing=s) for s in {Swing(), feel.swing, *_SWINGS}]
    rivals = sorted(rivals, key=lambda f: cost_of(take.first(SWING_STROKES), f))[:_FINALISTS]
    rivals = [settled(take, rival) for rival in rivals]
    return _cheapest(take, [_refined(take, r) if r.swing.ratio != STRAIGHT else settled(take, r) for r in rivals])


def _cheapest(take: Take, feels: Iterable[Feel]) -> Feel:
    return min(feels, key=lambda f: cost_of(take, f))


def cost_of(take: Take, feel: Feel) -> float:
    """What the take costs with that feel, itself included."""
    return take.read(feel).cost + len(take.piece) * log(feel.spread_s) + prior_cost(feel)


def prior_cost(feel: Feel) -> float:
    """What lean and swing cost before a stroke is heard."""
    ratio = feel.swing.ratio
    swing = 0.0 if ratio == STRAIGHT else NAMED_RATIOS.get(ratio, _OTHER_RATIO_COST)
    if ratio > TRIPLETS and feel.swing.unit_ticks < PPQ // 2:
        swing += _HARD_SIXTEENTHS_COST
    return swing + (feel.lean_s / LEAN_SD_S) ** 2 / 2


def settled(take: Take, feel: Feel) -> Feel:
    """The feel with the lean and the spread that its errors have."""
    errors = take.errors_s(feel, take.read(feel))
    lean = mean_error(errors, feel.spread_s)
    return replace(feel, lean_s=lean, spread_s=_spread(errors - lean))


def _spread(errors: Floats) -> float:
    """The standard deviation of errors about 0, of which the furthest count as slips."""
    middle = 1.4826 * float(np.median(np.abs(errors)))
    return min(max(float(np.sqrt(np.mean(clipped_errors(errors, middle) ** 2))), MIN_SPREAD_S), MAX_SPREAD_S)


def clipped_errors(errors: Floats, spread_s: float) -> Floats:
    """The errors, slips no further than they begin."""
    return np.clip(errors, -SLIP * spread_s, SLIP * spread_s)


def _refined(take: Take, feel: Feel) -> Feel:
    """The feel with the ratio that suits best the cells on which its strokes are read, each with a lean of its own."""
    reading = take.read(feel)
    span, place = take.spans.places(take.times_s - feel.lean_s)
    cells = cells_of(take.spans, span, reading, feel.swing)
    length_s = take.spans.lengths_s[span]

    def at(ratio: float) -> tuple[float, Feel]:
        swing = replace(feel.swing, ratio=ratio)
        places = played_places(take.spans, span, cells, reading.cells[span], swing)
        errors = (place - places) * length_s
        lean = mean_error(errors, feel.spread_s)
        z = np.minimum(np.abs(errors - lean) / feel.spread_s, SLIP)
        found = replace(feel, swing=swing, lean_s=feel.lean_s + lean, spread_s=_spread(errors - lean))
        return float(z @ z) / 2 + prior_cost(found), found

    steps = [round(x, 1) for x in np.arange(_LEAST_RATIO, _MOST_RATIO + _RATIO_STEP / 2, _RATIO_STEP).tolist()]
    return min((at(ratio) for ratio in steps), key=lambda pair: pair[0])[1]


def mean_error(errors: Floats, spread_s: float) -> float:
    """The mean of the errors that are no slips; their middle where all are, two far apart."""
    if not len(errors):
        return 0.0
    middle = float(np.median(errors))
    near = errors[np.abs(errors - middle) <= SLIP * spread_s]
    return float(near.mean()) if len(near) else middle


def take_of(ns: Ints, piece: Ints, spans: BeatSpans) -> Take:
    """A take from the times of its strokes (shape (n,), in order)."""
    return Take(ns / NS_PER_S, piece.astype(np.int64), spans)
