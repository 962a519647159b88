"""A turn as the judge hears it: its strokes in one table, and the shapes of its bars and beats.

A beat has `SLOTS` slots, so that cells of any division lie on whole ones. A shape (slots, instruments) has 1 where
something is struck, and less beside it, so that a stroke moved by a slot still resembles itself: a beat read as a
triplet here and as sixteenths there is no other beat.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.practice.battle.improvising.played_beats import Beats, Instrument, beats_of, landing_of
from station.practice.battle.phrase import Turn
from station.scoring.analysis.loudness import level_db

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

SLOTS = 24
"""Slots of a beat: the least number that 3, 4, 6 and 8 divide."""
BLUR = (1.0, 2 / 3, 1 / 3)
"""What of a stroke is seen 0, 1 and 2 slots from it: a triangle as wide as a 1/32 triplet on either side, by which a
triplet's second stroke and a sixteenth's (8 and 6 slots) still resemble each other a little (our choice)."""


@dataclass(frozen=True, eq=False)
class HeardTurn:
    """The strokes (n,) of a turn in order of beat, cell and instrument.

    `beat` counts from the turn's first, `slot` 0 … 23 within the beat, `level_db` against full scale, `late_ms` after
    the cell, `cell_ms` how long its cell is. `landing_late_ms` (m,) are strokes on the downbeat after the last bar.
    """

    bars: int
    beats_a_bar: int
    beat: Ints
    slot: Ints
    instrument: Ints
    level_db: Floats
    late_ms: Floats
    cell_ms: Floats
    landing_late_ms: Floats

    def __len__(self) -> int:
        return len(self.beat)

    @property
    def beats(self) -> int:
        """How many beats the turn has."""
        return self.bars * self.beats_a_bar

    @property
    def bar(self) -> Ints:
        """The bar (n,) of each stroke."""
        return np.asarray(self.beat // self.beats_a_bar)

    @property
    def moment(self) -> Ints:
        """The slot (n,) of each stroke from the turn's first: those of one moment are struck together."""
        return np.asarray(self.beat * SLOTS + self.slot)

    @cached_property
    def bar_shapes(self) -> Floats:
        """(bars, slots, instruments)."""
        return self._shapes.reshape(self.bars, self.beats_a_bar * SLOTS, len(Instrument))

    @cached_property
    def beat_shapes(self) -> Floats:
        """(beats, slots, instruments)."""
        return self._shapes.reshape(self.beats, SLOTS, len(Instrument))

    @cached_property
    def _shapes(self) -> Floats:
        sharp = np.zeros((self.beats * SLOTS, len(Instrument)))
        sharp[self.moment, self.instrument] = 1.0
        blurred = sharp.copy()
        for by, share in enumerate(BLUR[1:], 1):
            blurred[by:] += share * sharp[:-by]
            blurred[:-by] += share * sharp[by:]
        return blurred

    @cached_property
    def bar_sounds(self) -> Flags:
        """In which bars (bars,) anything is struck."""
        return np.asarray(np.bincount(self.bar, minlength=self.bars) > 0)

    @cached_property
    def beat_sounds(self) -> Flags:
        """In which beats (beats,) anything is struck."""
        return np.asarray(np.bincount(self.beat, minlength=self.beats) > 0)


@lru_cache(maxsize=64)
def heard(turn: Turn) -> HeardTurn:
    """What the judge hears of a turn; of turns heard lately it remembers the answer, for each is asked about again."""
    beats = beats_of(turn)
    beat, cell, instrument = np.nonzero(beats.struck)
    at = beat, cell, instrument
    division = beats.division[beat]
    landing = landing_of(turn)
    return HeardTurn(
        turn.bars,
        beats.beats_a_bar,
        beat,
        cell * SLOTS // division,
        instrument,
        level_db(beats.velocity[at]),
        beats.late_ms[at].astype(np.float64),
        _beat_ms(turn, beats)[beat] / division,
        landing.late_ms[0, 0][landing.struck[0, 0]].astype(np.float64),
    )


def _beat_ms(turn: Turn, beats: Beats) -> Floats:
    """How long each beat (b,) lasts; the last of a bar may be short."""
    ground = turn.ground
    starts = np.arange(beats.beats_a_bar) * ground.beat_ticks
    ends = np.minimum(starts + ground.beat_ticks, ground.bar_ticks)
    lengths = (ground.tempo_map.ns_at(ends) - ground.tempo_map.ns_at(starts)) / NS_PER_MS
    return np.tile(lengths, turn.bars)
