"""What every step of a player through a score costs, in nats: the one table of following, live and final.

The model. A player goes through what is written at a tempo of their own, or the click's. Each note that they pass is
played with probability `PLAYED`, its hit normal about its time with `SD_S`; strays come at `STRAYS_A_S` a second of
each class of pieces. Now and then they are suddenly elsewhere: a `Price` says how rarely. A way through the score is
worth

    Σ heard(distance of each hit from the nearest note of its class) − MISS · notes passed − Σ prices of its jumps,

the logarithm of its likelihood against hits that are all strays. `heard` gives back the miss of the note that it
answers, so that a way is right when its hits have notes *and* its notes have hits.
"""

from dataclasses import dataclass
from enum import Enum
from math import log, pi, sqrt
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

# --- what hits and notes say ------------------------------------------------------------------------------------------

SD_S = 0.03
"""Scatter that is believed before it is known: the Groove MIDI Dataset's 26 ms (HUMANS), a little wider."""

PLAYED = 0.9
"""Share of the notes that are played (our choice: a student leaves out one in ten, TEACHING's pass)."""

STRAYS_A_S = 0.1
"""Strays a second on one class of pieces (our choice: five in a hundred strokes, eight a second, over four pieces)."""

MISS = -log(1 - PLAYED)
"""Nats against a note that nobody hit."""

_AT_BEST = PLAYED / (SD_S * sqrt(2 * pi) * STRAYS_A_S)

POSSIBLE = log(1 + _AT_BEST)
"""Nats that a hit exactly on its note brings, its note's price paid."""


BOUNCES_A_S = 8.0
"""Bounces a second that are heard while a buzz is written (our choice: a stick bounces 30 times a second, a kit sends
some, few or none of it, and the fewer are looked for, the less a buzz claims of doubles that are written elsewhere)."""

BOUNCED = log(BOUNCES_A_S / STRAYS_A_S)
"""Nats that a hit which may be a bounce brings where a buzz is written: less than `POSSIBLE`, so that whoever plays
exactly what is written is nowhere likelier to be than where they are."""


def heard(distance_s: ArrayLike) -> Floats:
    """Nats for a hit so far from a note of its class, any shape; the note's `MISS` given back."""
    likelier = _AT_BEST * np.exp(-0.5 * np.square(np.asarray(distance_s, np.float64) / SD_S))
    return np.asarray(np.log1p(likelier) + MISS * likelier / (1 + likelier))


# --- what a change of place costs -------------------------------------------------------------------------------------


class When(Enum):
    """When a player may turn out to be elsewhere."""

    BEGIN = "at the first hit"
    PAUSE = "after a silence that is not written"
    ON = "without a pause"


class Where(Enum):
    """Where they may turn out to be."""

    START = "at the beginning of the score"
    STOPPED = "where they stopped"
    ON_TIME = "where they would be had they played on"
    BARS = "whole bars away, at the beginning on a one"
    BEATS = "whole beats away"
    SLIPPED = "half a beat away or less: a stumble, or the clock had slipped"
    BESIDE_CLICK = "half a beat away, by the click"
    ELSEWHERE = "anywhere else"


PRICES = MappingProxyType(
    {
        (When.BEGIN, Where.START): 1.0,
        (When.BEGIN, Where.ON_TIME): 0.0,
        (When.BEGIN, Where.BARS): 6.0,
        (When.BEGIN, Where.BEATS): 8.0,
        (When.BEGIN, Where.ELSEWHERE): 10.0,
        (When.PAUSE, Where.STOPPED): 0.0,
        (When.PAUSE, Where.START): 2.0,
        (When.PAUSE, Where.ON_TIME): 3.0,
        (When.PAUSE, Where.BARS): 4.0,
        (When.PAUSE, Where.BEATS): 7.0,
        (When.PAUSE, Where.ELSEWHERE): 10.0,
        (When.ON, Where.ON_TIME): 0.0,
        (When.ON, Where.SLIPPED): 12.0,
        (When.ON, Where.BARS): 15.0,
        (When.ON, Where.BEATS): 20.0,
        (When.ON, Where.BESIDE_CLICK): 24.0,
        (When.ON, Where.ELSEWHERE): 24.0,
    }
)
"""Nats (our choice): a skip of bars about once in three million hits as chance would have it, for a groove that a
drummer varies speaks for a wrong bar by some 15; who has just stopped may be anywhere: little is asked then."""

NEARER = 0.3
"""Nats more for each bar of a jump, up to `MOST_FOR_DISTANCE`: of bars that are alike the nearest is believed."""

MOST_FOR_DISTANCE = 6.0

UNHEARD_END = 5.0
"""Nats at most against a performance that ends before the score does: most play to the end (our choice)."""

LEAN_MOVES = 4.0
"""Nats against a player's lean from the click having moved by a 24th of a beat from one beat to the next: ½(4.2/SD)² at
a tempo whose SD is 1.5 % (HUMANS: professionals hold ±1–2 %)."""

TEMPO_SD = 0.3
"""SD of log tempo against what is written, at the beginning: who practises plays at 70 % more readily than at half."""

NEW_TEMPO_SD = 0.1
"""SD of log tempo against the tempo so far, after a pause."""


@dataclass(frozen=True, slots=True)
class Prices:
    """What places of one score cost; `bar` and `beat` are the quarters of each, `start` that of the first note."""

    bar: float
    beat: float
    start: float

    def begin(self, beats: Floats, on_time: float) -> Floats:
        """Nats against a first hit at `beats`, any shape; `on_time` is its beat if the recording shares the score's."""
        cost = np.where(_is_whole(beats / self.bar), PRICES[When.BEGIN, Where.BARS], self._of_beats(When.BEGIN, beats))
        cost = cost + np.minimum(np.abs(beats - self.start) / self.bar, MOST_FOR_DISTANCE)
        shared = 0.0 if abs(on_time - self.start) < _FIRST_BEATS * self.beat else _ON_BASE
        cost = np.where(np.abs(beats - self.start) < _SAME, PRICES[When.BEGIN, Where.START], cost)
        return np.where(np.abs(beats - on_time) < _NEARLY, shared + PRICES[When.BEGIN, Where.ON_TIME], cost)

    def pause(self, beats: Floats, last: float, on_time: float) -> Floats:
        """Nats against going on at `beats` (any shape) after a pause; `last` is the beat of the last hit before it."""
        cost = np.where(_is_whole(beats / self.bar), PRICES[When.PAUSE, Where.BARS], self._of_beats(When.PAUSE, beats))
        cost = cost + self._far(beats - last)
        cost = np.where(np.abs(beats - on_time) < _SAME, PRICES[When.PAUSE, Where.ON_TIME], cost)
        cost = np.where(np.abs(beats - self.start) < _SAME, np.minimum(PRICES[When.PAUSE, Where.START], cost), cost)
        went_on = (beats > last - _SAME) & (beats < last + 1.0 + _SAME)
        return np.where(went_on, PRICES[When.PAUSE, Where.STOPPED], cost)

    def on(self, offsets: Floats) -> Floats:
        """Nats against being suddenly so many beats away, any shape."""
        bars = _is_whole(offsets / self.bar)
        beats = np.where(np.abs(offsets) < _SLIP * self.beat, _SLIPPED, self._of_beats(When.ON, offsets))
        cost = np.where(bars, PRICES[When.ON, Where.BARS], beats) + self._far(offsets)
        cost = cost + np.where(offsets < 0.0, _BACK, 0.0)
        return np.where(offsets == 0.0, PRICES[When.ON, Where.ON_TIME], cost)

    def _of_beats(self, when: When, beats: Floats) -> Floats:
        return np.where(_is_whole(beats / self.beat), PRICES[when, Where.BEATS], PRICES[when, Where.ELSEWHERE])

    def _far(self, beats: Floats) -> Floats:
        return np.minimum(NEARER * np.abs(beats) / self.bar, MOST_FOR_DISTANCE)


_BACK = 1.0
"""Nats more against going back than forward: who plays a score to its end plays its notes once (our choice)."""

_ON_BASE = 4.0
"""Nats against a recording on the score's own time base that leaves out its beginning."""

_FIRST_BEATS, _NEARLY = 0.6, 0.1
"""Beats that may be left out at the beginning of a recording on the score's own time base at no price, and how near to
that base it must lie."""

_SAME = 0.3
"""Beats: so near is the same place (our choice: a little more than a 16th)."""


def _is_whole(values: Floats) -> NDArray[np.bool_]:
    return np.asarray(np.abs(values - np.rint(values)) < _SLACK)


_SLIPPED = PRICES[When.ON, Where.SLIPPED]
_SLIP = 0.6
"""Beats: so far a stumble or a slip of the clock may lead (our choice: half a beat, and a little)."""

_SLACK = 0.13
"""Beats by which a player's place may be off a whole one (our choice: an eighth)."""
