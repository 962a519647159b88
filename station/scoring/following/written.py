"""A score as it is looked for: its notes by time and class, its beats, and what hits at a place would say.

`Beats` turns times into quarters and back. `Fits` is a table of what a hit of each class brings at each place, so that
a whole set of places costs one look-up a hit.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece
from station.core.units import PPQ
from station.music.score import Score
from station.scoring.following.prices import BOUNCED, MISS, SD_S, Prices, heard

Floats = NDArray[np.float64]
Nats = NDArray[np.float32]
Indices = NDArray[np.int64]

PARTS = 24
"""Places a beat in `Fits`: eighths, triplets and 16ths are whole numbers of them; 21 ms at 120 bpm."""

_REACH_SDS = 3.2
"""Farther off a hit says nothing for a note: as many strays come there."""

MAYBE_BOUNCE = max(Piece) + 1
"""So much more than the class of its piece is that of a hit that may be a bounce (`ignored_hits`): where its piece is
buzzed it may be one, and everywhere it may answer a note."""

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

    `buzz_s` (n,) is how long each is buzzed, NaN for a stroke. `bar` and `beat` are the quarters of the first bar and
    of its beat.
    """

    at_s: Floats
    classes: Indices
    buzz_s: Floats
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
    def answered(self) -> Indices:
        """The classes of hits that may answer something here: those of the notes, and of what may be their bounces."""
        buzzed = self.classes[~np.isnan(self.buzz_s)]
        return np.unique(np.concatenate((self.classes, buzzed + MAYBE_BOUNCE)))

    @cached_property
    def lanes(self) -> tuple[Floats, Indices]:
        """Times, rising, and classes of what hits may answer (k,): the notes, and for hits that may be bounces strokes.

        A buzz leads no clock by its bounces: where a class has no other strokes, the click alone can place them.
        """
        is_buzz = ~np.isnan(self.buzz_s)
        strokes = np.flatnonzero(np.isin(self.classes, self.classes[is_buzz]) & ~is_buzz)
        at_s = np.concatenate((self.at_s, self.at_s[strokes]))
        classes = np.concatenate((self.classes, self.classes[strokes] + MAYBE_BOUNCE))
        order = np.argsort(at_s, kind="stable")
        return at_s[order], classes[order]

    @cached_property
    def quarter_s(self) -> float:
        """How long its quarters usually last, in seconds."""
        return float(np.median(np.diff(self.beat_s)))

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
        fits = Fits(self.note_beats, self.classes, self.quarter_s, self.far_beats)
        buzzes = ~np.isnan(self.buzz_s)
        if buzzes.any():
            ends = self.beats.beat(self.at_s[buzzes] + self.buzz_s[buzzes] + _LATE_BOUNCE_S)
            fits.add_buzzes(self.note_beats[buzzes], ends, self.classes[buzzes])
        return fits

    def of_classes(self, classes: Indices) -> "Written":
        """Its notes that hits of these classes may answer: a part that is never played tells no place."""
        here = np.isin(self.classes, classes % MAYBE_BOUNCE)
        if here.all():
            return self
        return replace(self, at_s=self.at_s[here], classes=self.classes[here], buzz_s=self.buzz_s[here])

    def at_tempo(self, tempo: float) -> "Written":
        """The same played at `tempo` times what is written."""
        return replace(self, at_s=self.at_s / tempo, buzz_s=self.buzz_s / tempo, beat_s=self.beat_s / tempo)

    def next_of(self, match_class: int, place_s: float) -> float | None:
        """The time of the first note of a class behind `place_s` and what sounds there; None where none is left."""
        first = int(np.searchsorted(self.at_s, place_s + _NEXT_NOTE_S))
        after = self.classes[first:] == match_class
        return float(self.at_s[first + int(after.argmax())]) if after.any() else None


_LATE_BOUNCE_S = 2 * SD_S
"""So long after its written end a buzz may still bounce (our choice: whoever began it late)."""

_NEXT_NOTE_S = 0.05
"""Notes so soon after a place are still those of the place (our choice: 1.7 `SD_S`)."""


def written_of(score: Score, note_class: Indices) -> Written:
    """`score`, whose notes are of `note_class` (n,), as it is looked for."""
    order = np.argsort(score.onset_s, kind="stable")
    beats = np.arange(0, max(score.end_tick, PPQ) + 1, PPQ)
    meter = score.tempo_map.meter_at(0)
    quarters = score.tempo_map.seconds_at(beats)
    bar, beat = meter.bar_ticks / PPQ, meter.beat_ticks / PPQ
    return Written(score.onset_s[order], note_class[order], _buzz_s(score)[order], quarters, bar, beat)


def _buzz_s(score: Score) -> Floats:
    """How long each note (n,) is buzzed, in s; NaN for a stroke."""
    notes = score.notes
    lasts_s = score.tempo_map.seconds_at(notes["tick"] + notes["duration_ticks"])
    lasts_s = lasts_s - score.tempo_map.seconds_at(notes["tick"])
    return np.where((notes["articulation"] == Articulation.BUZZ) & ~score.is_grace, lasts_s, np.nan)


def may_bounce(classes: Indices, bounces: NDArray[np.bool_]) -> Indices:
    """The classes of hits (m,) of which `bounces` (m,) may be no strokes."""
    return np.where(bounces & (classes >= 0), classes + MAYBE_BOUNCE, classes)


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
        self._buzzed: Nats | None = None

    def add_buzzes(self, starts: Floats, ends: Floats, classes: Indices) -> None:
        """Buzzes of `classes` (k,) from `starts` to `ends`, in beats, where hits that may be bounces may be some."""
        strokes = self._table.reshape(-1, self._size)
        table = np.zeros((MAYBE_BOUNCE + int(classes.max()) + 1, self._size), np.float32)
        table[: len(strokes)] = strokes
        first, last = (np.clip(self.spots(beats) + 2 * self._far, 0, self._size - 1) for beats in (starts, ends))
        buzzed = np.zeros(self._size, np.bool_)
        for c in np.unique(classes).tolist():
            inside = _inside(first[classes == c], last[classes == c], self._size)
            table[MAYBE_BOUNCE + c] = np.maximum(strokes[c], np.where(inside, np.float32(BOUNCED), -np.inf))
            buzzed |= inside
        self._table = table.ravel()
        within = buzzed[2 * self._far : 2 * self._far + self._last + 1]
        self._buzzed = np.concatenate(([0.0], np.cumsum(within))).astype(np.float32)

    def may_bounce(self, edges: Floats, ends: Floats, hits: Indices, offsets: Indices) -> Nats | None:
        """How many of so many `hits` (k,) between `edges` and `ends` may be bounces (k, s); None without a buzz."""
        if self._buzzed is None:
            return None
        spots = self.spots(np.stack((edges, ends)))[:, :, None] + offsets
        before, after = self._buzzed.take(spots, mode="clip")
        return np.where(after > before, hits[:, None].astype(np.float32), np.float32(0.0))

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


def _inside(first: Indices, last: Indices, size: int) -> NDArray[np.bool_]:
    """Which of `size` spots lie in one of the spans `first` … `last` (k,), both included."""
    begun, ended = np.bincount(first, minlength=size + 1), np.bincount(last + 1, minlength=size + 1)
    return np.asarray(np.cumsum(begun - ended)[:size] > 0)


def gained(said: Nats, unanswered: Nats, slack: int = 0, bouncing: Nats | None = None) -> Floats:
    """What hits that together `said` so much gain over the notes that were passed, of the same shape.

    A note is answered once: where more hits lie near than notes were passed, and `slack`, the rest are strays; or
    bounces, where so many hits may be some (`bouncing`, of the same shape), one that came early among them.
    """
    most = (_MOST / MISS) * unanswered
    if bouncing is None:
        most = most + slack * _MOST
    else:
        most = most + np.where(bouncing > 0.0, BOUNCED * np.maximum(bouncing - unanswered / MISS, 0.0), slack * _MOST)
    return np.asarray(np.minimum(said, most) - unanswered, np.float64)


_MOST = float(heard(0.0))
