"""A score as it is looked for: its notes by time and class, its beats, and what hits at a place would say.

`Beats` turns times into quarters and back. `Fits` is a table of what a hit of each class brings at each place, so that
a whole set of places costs one look-up a hit.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.score import Score
from station.scoring.following.prices import MISS, SD_S, Prices, heard

Floats = NDArray[np.float64]
Nats = NDArray[np.float32]
Indices = NDArray[np.int64]

PARTS = 24
"""Places a beat in `Fits`: eighths, triplets and 16ths are whole numbers of them; 21 ms at 120 bpm."""

_REACH_SDS = 3.2
"""Farther off a hit says nothing for a note: as many strays come there."""

_AROUND_BEATS = 2
"""Empty beats kept before and after the score."""

_FAR_BEATS, _SHORT_BEATS, _LEAST_FAR_BEATS = 32, 256, 8
"""A player is looked for as many whole beats away, 8 bars of 4/4; everywhere, and as far as the third, in a score of no
more than the second."""


@dataclass(frozen=True, eq=False)
class Beats:
    """`at_s` (b,) when each quarter of the score begins, rising, at least two; before and after the tempo goes on."""

    at_s: Floats

    def beat(self, score_s: Floats) -> Floats:
        """Quarters from the score's beginning, of times of any shape."""
        i = np.clip(np.searchsorted(self.at_s, score_s, side="right") - 1, 0, len(self.at_s) - 2)
        return np.asarray(i + (score_s - self.at_s[i]) / (self.at_s[i + 1] - self.at_s[i]))

    def time(self, beat: Floats) -> Floats:
        """The times of quarters, any shape."""
        i = np.clip(np.floor(beat).astype(np.int64), 0, len(self.at_s) - 2)
        return np.asarray(self.at_s[i] + (beat - i) * (self.at_s[i + 1] - self.at_s[i]))


@dataclass(frozen=True, eq=False)
class Written:
    """The notes of a score: `at_s` (n,) rising, `classes` (n,); its quarters `beat_s` (b,).

    `bar` and `beat` are the quarters of the first bar and of its beat.
    """

    at_s: Floats
    classes: Indices
    beat_s: Floats
    bar: float
    beat: float

    @cached_property
    def beats(self) -> Beats:
        """Its quarters."""
        return Beats(self.beat_s)

    @cached_property
    def note_beats(self) -> Floats:
        """The quarter of each note (n,)."""
        return self.beats.beat(self.at_s)

    @cached_property
    def far_beats(self) -> int:
        """As far as this many quarters a player is looked for at the beat that they keep."""
        return max(int(np.ceil(self._length)), _LEAST_FAR_BEATS) if self.is_short else _FAR_BEATS

    @property
    def is_short(self) -> bool:
        """Whether a player is looked for everywhere."""
        return self._length <= _SHORT_BEATS

    @cached_property
    def _length(self) -> float:
        return float(self.note_beats[-1] - self.note_beats[0]) + self.bar

    @cached_property
    def prices(self) -> Prices:
        """What places in it cost."""
        return Prices(self.bar, self.beat, float(self.note_beats[0]))

    @cached_property
    def fits(self) -> "Fits":
        """What hits say at its places."""
        return Fits(self.note_beats, self.classes, float(np.median(np.diff(self.beat_s))), self.far_beats)

    def of_classes(self, classes: Indices) -> "Written":
        """Its notes of these classes alone: a part that is never played tells no place."""
        here = np.isin(self.classes, classes)
        return self if here.all() else Written(self.at_s[here], self.classes[here], self.beat_s, self.bar, self.beat)

    def at_tempo(self, tempo: float) -> "Written":
        """The same played at `tempo` times what is written."""
        return Written(self.at_s / tempo, self.classes, self.beat_s / tempo, self.bar, self.beat)

    def next_of(self, match_class: int, place_s: float) -> float | None:
        """The time of the first note of a class behind `place_s` and what sounds there; None where none is left."""
        first = int(np.searchsorted(self.at_s, place_s + _NEXT_NOTE_S))
        after = self.classes[first:] == match_class
        return float(self.at_s[first + int(after.argmax())]) if after.any() else None


_NEXT_NOTE_S = 0.05
"""Notes so soon after a place are still those of the place (our choice: 1.7 `SD_S`)."""


def written_of(score: Score, note_class: Indices) -> Written:
    """`score`, whose notes are of `note_class` (n,), as it is looked for."""
    order = np.argsort(score.onset_s, kind="stable")
    beats = np.arange(0, max(score.end_tick, PPQ) + 1, PPQ)
    meter = score.tempo_map.meter_at(0)
    quarters = score.tempo_map.seconds_at(beats)
    return Written(score.onset_s[order], note_class[order], quarters, meter.bar_ticks / PPQ, meter.beat_ticks / PPQ)


class Fits:
    """What hits at places of the score bring, in nats, and how many notes are passed on the way."""

    def __init__(self, note_beats: Floats, classes: Indices, beat_s: float, far_beats: int) -> None:
        self._first = int(np.floor(note_beats.min(initial=0.0))) - _AROUND_BEATS
        spot = self.spots(note_beats)
        self._last = int(spot.max(initial=0)) + _AROUND_BEATS * PARTS
        self._far = (far_beats + _AROUND_BEATS) * PARTS
        # whoever is farther outside than they may be moved finds nothing, wherever they are moved
        self._size = self._last + 1 + 4 * self._far
        reach = max(1, round(_REACH_SDS * SD_S / beat_s * PARTS))
        table = np.zeros((int(classes.max(initial=0)) + 1, self._size), np.float32)
        said = heard(np.arange(reach + 1) * beat_s / PARTS)
        middle = spot + 2 * self._far
        # to run beyond the end is no cheaper than to leave out notes
        table[:, : int(middle.min(initial=0)) - reach] = table[:, int(middle.max(initial=0)) + reach :] = -MISS
        for off in range(reach, -1, -1):  # the nearest note speaks last
            table[classes, np.minimum(middle + off, self._size - 1)] = said[off]
            table[classes, np.maximum(middle - off, 0)] = said[off]
        self._table = table.ravel()
        passed = np.concatenate(([0.0], np.cumsum(np.bincount(spot, minlength=self._last))))
        self._unanswered = np.float32(MISS) * passed.astype(np.float32)

    def spots(self, beats: Floats) -> Indices:
        """Which places of the table beats lie at, any shape; they may lie outside."""
        return np.rint((beats - self._first) * PARTS).astype(np.int64)

    def said(self, beats: Floats, classes: Indices, offsets: Indices) -> Nats:
        """What each hit (m,) at `beats` says if moved by each of `offsets` (s,) in parts of a beat; shape (m, s)."""
        spots = np.minimum(np.maximum(self.spots(beats), -self._far), self._last + self._far) + 2 * self._far
        return self._table.take((spots + classes * self._size)[:, None] + offsets)

    def unanswered(self, beats: Floats, offsets: Indices) -> Nats:
        """Nats against the notes before each of `beats` (k,), moved by `offsets` (s,); (k, s): differences count."""
        return self._unanswered.take(self.spots(beats)[:, None] + offsets, mode="clip")


def gained(said: Nats, unanswered: Nats, slack: int = 0) -> Floats:
    """What hits that together `said` so much gain over the notes that were passed, of the same shape.

    A note is answered once: where more hits lie near than notes were passed, and `slack`, the rest are strays.
    """
    most = (_MOST / MISS) * unanswered + slack * _MOST
    return np.asarray(np.minimum(said, most) - unanswered, np.float64)


_MOST = float(heard(0.0))
