"""A turn as the judge hears it: its strokes in one table, and the shapes of its bars and beats.

A beat has `SLOTS` slots, so that cells of any division lie on whole ones. A shape (slots, instruments) is high
where something is struck, less so beside it, so that a stroke moved by a slot still resembles itself: a beat read as a
triplet here and as sixteenths there is no other beat.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.performance import Performance
from station.practice.battle.improvising.played_beats import Instrument, beats_of
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
FAMILIES = (
    (Instrument.KICK,),
    (Instrument.SNARE, Instrument.HIGH_TOM, Instrument.MID_TOM, Instrument.FLOOR_TOM),
    (Instrument.CLOSED_HIHAT, Instrument.OPEN_HIHAT, Instrument.RIDE, Instrument.CRASH),
)
TIMEKEEPERS = frozenset({Instrument.CLOSED_HIHAT, Instrument.OPEN_HIHAT, Instrument.RIDE})


@dataclass(frozen=True, eq=False)
class HeardTurn:
    """The strokes (n,) of a turn in order of beat, cell and instrument.

    `beat` counts from the turn's first, `slot` 0 … 23 within the beat, `level_db` against full scale, `late_ms` after
    the cell, which is `cell_ms` and `cell_slots` long. `landing_late_ms` (m,) are the strokes on the downbeat after the
    last bar.
    """

    bars: int
    beats_a_bar: int
    beat: Ints
    slot: Ints
    instrument: Ints
    level_db: Floats
    late_ms: Floats
    cell_ms: Floats
    cell_slots: Ints
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
        return _blurred(self._sharp.reshape(self.bars, self.beats_a_bar * SLOTS, len(Instrument)))

    @cached_property
    def beat_shapes(self) -> Floats:
        """(beats, slots, instruments)."""
        return _blurred(self._sharp.reshape(self.beats, SLOTS, len(Instrument)))

    @cached_property
    def bar_family_shapes(self) -> Floats:
        """(bars, slots, families): kick, drums, cymbals, whichever of them it is."""
        bars = self._sharp.reshape(self.bars, self.beats_a_bar * SLOTS, len(Instrument))
        return _blurred(np.stack([bars[:, :, list(family)].max(axis=2) for family in FAMILIES], axis=2))

    @cached_property
    def displaced_bar_shapes(self) -> tuple[Floats, ...]:
        """(bars, slots, instruments) with all but the timekeeping half a beat or a beat earlier or later in its bar."""
        bars = self._sharp.reshape(self.bars, self.beats_a_bar * SLOTS, len(Instrument))
        moved = [i for i in Instrument if i not in TIMEKEEPERS]
        shapes = []
        for by in (-SLOTS, -SLOTS // 2, SLOTS // 2, SLOTS):
            displaced = bars.copy()
            displaced[:, :, moved] = np.roll(bars[:, :, moved], by, axis=1)
            shapes.append(_blurred(displaced))
        return tuple(shapes)

    @cached_property
    def bar_shapes_as_played(self) -> Floats:
        """(bars, slots, instruments) by when the strokes came, less the mean lean, whatever cells they are read as."""
        late = self.late_ms - self.late_ms.mean() if len(self) else self.late_ms
        moment = self.moment + np.rint(late / self.cell_ms * self.cell_slots).astype(np.int64)
        bar_slots = self.beats_a_bar * SLOTS
        inside = np.clip(moment, self.bar * bar_slots, (self.bar + 1) * bar_slots - 1)
        return _blurred(self._struck_at(inside).reshape(self.bars, bar_slots, len(Instrument)))

    @cached_property
    def _sharp(self) -> Floats:
        return self._struck_at(self.moment)

    def _struck_at(self, moment: Ints) -> Floats:
        sharp = np.zeros((self.beats * SLOTS, len(Instrument)))
        sharp[moment, self.instrument] = 1.0
        return sharp

    @cached_property
    def bar_sounds(self) -> Flags:
        """In which bars (bars,) anything is struck."""
        return np.asarray(np.bincount(self.bar, minlength=self.bars) > 0)

    @cached_property
    def beat_sounds(self) -> Flags:
        """In which beats (beats,) anything is struck."""
        return np.asarray(np.bincount(self.beat, minlength=self.beats) > 0)


def _blurred(sharp: Floats) -> Floats:
    """Shapes (n, slots, instruments), each blurred within itself, and each instrument's mean taken off.

    So what is struck evenly all the time is like nothing: only where it is struck and where not makes a shape.
    """
    blurred = sharp.copy()
    for by, share in enumerate(BLUR[1:], 1):
        blurred[:, by:] += share * sharp[:, :-by]
        blurred[:, :-by] += share * sharp[:, by:]
    return np.asarray(blurred - blurred.mean(axis=1, keepdims=True))


@lru_cache(maxsize=64)
def heard(turn: Turn) -> HeardTurn:
    """What the judge hears of a turn; of turns heard lately it remembers the answer, for each is asked about again."""
    read = beats_of(_with_landing(turn))
    beats, after = read.of_bars(0, turn.bars), read.of_bars(turn.bars, turn.bars + 1)
    beat, cell, instrument = np.nonzero(beats.struck)
    at = beat, cell, instrument
    division = beats.division[beat]
    return HeardTurn(
        turn.bars,
        beats.beats_a_bar,
        beat,
        cell * SLOTS // division,
        instrument,
        level_db(beats.velocity[at]),
        beats.late_ms[at].astype(np.float64),
        _beat_ms(turn)[beat] / division,
        SLOTS // division,
        after.late_ms[0, 0][after.struck[0, 0]].astype(np.float64),
    )


def _with_landing(turn: Turn) -> Turn:
    """The turn with a bar more, in which there is nothing but its landing: so both are read at once."""
    end_ns = turn.length_ns + int(turn.ground.tempo_map.ns_at(turn.ground.beat_ticks // 2))
    played = Performance.from_array(turn.played.hits[turn.played.hits["at_ns"] < end_ns])
    return Turn(turn.ground, turn.bars + 1, played)


def _beat_ms(turn: Turn) -> Floats:
    """How long each beat (b,) lasts; the last of a bar may be short."""
    ground = turn.ground
    starts = np.arange(ground.beats_a_bar) * ground.beat_ticks
    ends = np.minimum(starts + ground.beat_ticks, ground.bar_ticks)
    lengths = (ground.tempo_map.ns_at(ends) - ground.tempo_map.ns_at(starts)) / NS_PER_MS
    return np.tile(lengths, turn.bars)
