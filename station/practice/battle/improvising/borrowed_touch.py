"""The touch of one human phrase, lent to other notes: a velocity and a lateness for each stroke.

Of the phrases that somebody played (`human_phrases`) one is taken whose strokes are where the new ones are, at a like
tempo. A stroke is played as the human's on the same instrument at the same moment; where there is none, as the one
that is nearest in kind, with that phrase's clock at the new moment, so that what goes together still does.
"""

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from station.practice.battle.improvising.human_phrases import PHRASE_BARS, HumanPhrases, human_phrases, ticks_of
from station.practice.battle.improvising.human_playing import human_playing
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.stroke_place import FINEST, places_of, struck_cells

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
_TEMPO_WEIGHT = 0.5
"""What half or twice the tempo costs against the share of strokes that a phrase covers (our choice)."""
_OTHER_METER = 2.0
"""More than any cover is worth: another meter only where there is none of this one."""
_AMONG = 3
"""One of so many best is taken, so that two phrases on one groove differ (our choice)."""


@dataclass(frozen=True, eq=False)
class BorrowedTouch:
    """Of each stroke of `struck_cells` (n,) the `velocity`, and `late_ms` about the lender's `lean_ms`.

    `louder` is how much louder the lender's strokes are than is usual for their instruments and places.
    """

    velocity: Floats
    late_ms: Floats
    lean_ms: float
    louder: float


@dataclass(frozen=True, eq=False)
class _Strokes:
    """Where strokes are (n,): 24ths from the start, `Instrument`, 24ths in the bar, `StrokePlace`."""

    at: Ints
    instrument: Ints
    in_bar: Ints
    place: Ints


def borrowed_touch(beats: Beats, beats_a_minute: float, rng: Generator) -> BorrowedTouch:
    """The touch of a human phrase that is much like `beats`; at least one stroke."""
    phrases, struck = human_phrases(), struck_cells(beats)
    phrase_ticks = PHRASE_BARS * beats.beats_a_bar * FINEST
    new = _where(ticks_of(beats, struck) % phrase_ticks, struck[:, 2], beats.beats_a_bar)
    lender = _lender(phrases, new, beats.beats_a_bar, beats_a_minute, rng)
    rows = slice(int(phrases.first[lender]), int(phrases.first[lender + 1]))
    own = _where(phrases.at[rows].astype(np.int64), phrases.instrument[rows].astype(np.int64), beats.beats_a_bar)
    velocity, late = phrases.velocity[rows].astype(np.float64), phrases.late_ms[rows].astype(np.float64)
    source = _nearest(own, new, rng)
    usual_own, usual_new = _usual(own), _usual(new)
    is_other = own.instrument[source] != new.instrument
    played = velocity[source] + is_other * (usual_new - usual_own[source])
    lent = late[source] - _clock(own.at, late, own.at[source]) + _clock(own.at, late, new.at)
    lean = float(np.median(late))
    return BorrowedTouch(np.clip(played, 1, 127), lent - lean, lean, float((velocity - usual_own).mean()))


def _where(at: Ints, instrument: Ints, beats_a_bar: int) -> _Strokes:
    in_bar = at % (beats_a_bar * FINEST)
    beats = Beats.silent(beats_a_bar, beats_a_bar, FINEST)
    return _Strokes(at, instrument, in_bar, places_of(beats, np.column_stack([in_bar // FINEST, in_bar % FINEST])))


def _lender(phrases: HumanPhrases, new: _Strokes, beats_a_bar: int, beats_a_minute: float, rng: Generator) -> int:
    """The number of the phrase: one of those that have most of the strokes, with few others, at a like tempo."""
    keys = phrases.at.astype(np.int64) * len(Instrument) + phrases.instrument
    has = np.isin(keys, new.at * len(Instrument) + new.instrument)
    both = np.add.reduceat(has.astype(np.float64), phrases.first[:-1])
    cover = both / (np.diff(phrases.first) + len(new.at) - both)
    off = np.abs(np.log2(phrases.tempo / beats_a_minute))
    cost = _TEMPO_WEIGHT * off + _OTHER_METER * (phrases.beats_a_bar != beats_a_bar) - cover
    return int(rng.choice(np.argsort(cost, kind="stable")[:_AMONG]))


_OTHER_KIND, _OTHER_INSTRUMENT, _OTHER_PLACE, _OTHER_SPOT, _OTHER_MOMENT = 64.0, 32.0, 8.0, 4.0, 1.5
"""What makes another stroke less near: an instrument of another kind, another instrument, another `StrokePlace`,
another spot of the bar, another moment: each outweighs those after it (our choice). Among equals chance decides, or
all bars would have the velocities of one."""
_KINDS = np.array([0, 1, 2, 2, 3, 3, 3, 4, 2])
"""Kick, snare, what keeps time, toms, crash, by `Instrument`."""


def _nearest(own: _Strokes, new: _Strokes, rng: Generator) -> Ints:
    """Of each new stroke (n,) the index of the lender's stroke that is nearest in kind."""

    def differ(a: Ints, b: Ints) -> NDArray[np.bool_]:
        return np.asarray(a[:, None] != b[None, :])

    cost = _OTHER_KIND * differ(_KINDS[new.instrument], _KINDS[own.instrument])
    cost += _OTHER_INSTRUMENT * differ(new.instrument, own.instrument)
    cost += _OTHER_PLACE * differ(new.place, own.place) + _OTHER_SPOT * differ(new.in_bar, own.in_bar)
    cost += _OTHER_MOMENT * differ(new.at, own.at) * (1 + rng.random(cost.shape))
    return np.asarray(np.argmin(cost, axis=1))


_CLOCK_BEATS = 0.5
"""Over so much on both sides the clock is a mean, weighted by a Gaussian: strokes of one moment differ less from it
than the clock from itself two beats later (our choice)."""


def _clock(at: Ints, late: Floats, asked: Ints) -> Floats:
    """How late all limbs of the lender are about the moments `asked` (n,)."""
    weight = np.exp(-(((asked[:, None] - at[None, :]) / (_CLOCK_BEATS * FINEST)) ** 2) / 2)
    weight += 1e-9  # where nothing is near, the mean of all
    return np.asarray(weight @ late / weight.sum(axis=1))


def _usual(strokes: _Strokes) -> Floats:
    """The middle velocity of drummers in general there."""
    return np.asarray(human_playing().velocity[strokes.instrument, strokes.place])
