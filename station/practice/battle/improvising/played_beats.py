"""What was played, beat by beat: the one answer for whoever listens, continues or judges.

Every beat has a division of its own (3, 4, 6 or 8 cells), so that shuffles, sextuplets and thirty-seconds stand beside
sixteenths. Nine instruments are told apart; a kit's other pieces are read as the nearest of them. The grace strokes of
flams and drags belong to their main stroke. How a division is found: `played_divisions`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from enum import IntEnum
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CLOSED, HALF_OPEN, OPEN, Articulation, Ornament, Piece
from station.core.stand_ins import stand_in
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.transcription.strokes.ornament_finder import found_ornaments
from station.music.as_played import score_as_played
from station.music.performance import Performance
from station.music.score import MAX_LATE_MS, Note
from station.practice.battle.ground import Ground
from station.practice.battle.improvising.played_divisions import MOST_CELLS, PlayedCells, beat_spans, cells_played
from station.practice.battle.phrase import Turn


class Instrument(IntEnum):
    """What is told apart: the axis of nine in `Beats`. The pedal's chick is a closed hi-hat, its splash an open one."""

    KICK = 0
    SNARE = 1
    CLOSED_HIHAT = 2
    OPEN_HIHAT = 3
    HIGH_TOM = 4
    MID_TOM = 5
    FLOOR_TOM = 6
    CRASH = 7
    RIDE = 8


STRUCK_PIECES: Mapping[Instrument, Piece] = MappingProxyType(
    {
        Instrument.KICK: Piece.KICK,
        Instrument.SNARE: Piece.SNARE,
        Instrument.CLOSED_HIHAT: Piece.HIHAT,
        Instrument.OPEN_HIHAT: Piece.HIHAT,
        Instrument.HIGH_TOM: Piece.TOM_1,
        Instrument.MID_TOM: Piece.TOM_2,
        Instrument.FLOOR_TOM: Piece.FLOOR_TOM_1,
        Instrument.CRASH: Piece.CRASH_1,
        Instrument.RIDE: Piece.RIDE,
    }
)
"""The piece that each instrument is when it is played back."""


@dataclass(frozen=True, eq=False)
class Beats:
    """Whole bars of `beats_a_bar` beats, from a downbeat on; n beats in all.

    `division` (n,) of 3, 4, 6 or 8 is how many cells a beat has. By beat, cell and `Instrument` (n, 8, 9): `struck`,
    `velocity` 1–127, `late_ms` after the cell (before it if negative, a whole take's lean included) and `ornament` of
    `Ornament`. Cells beyond the division, and where nothing is struck, are 0.
    """

    beats_a_bar: int
    division: NDArray[np.int64]
    struck: NDArray[np.bool_]
    velocity: NDArray[np.uint8]
    late_ms: NDArray[np.float32]
    ornament: NDArray[np.uint8]

    def __post_init__(self) -> None:
        assert len(self.division) % self.beats_a_bar == 0, "whole bars"

    def __len__(self) -> int:
        return len(self.division)

    @classmethod
    def silent(cls, beats: int, beats_a_bar: int, division: int = 4) -> "Beats":
        """So many beats in which nothing is struck; the arrays may be written to."""
        shape = (beats, MOST_CELLS, len(Instrument))
        return cls(
            beats_a_bar,
            np.full(beats, division, np.int64),
            struck=np.zeros(shape, np.bool_),
            velocity=np.zeros(shape, np.uint8),
            late_ms=np.zeros(shape, np.float32),
            ornament=np.zeros(shape, np.uint8),
        )

    @property
    def bars(self) -> int:
        """How many bars they are."""
        return len(self) // self.beats_a_bar

    def of_bars(self, first: int, last: int) -> "Beats":
        """The bars from `first` up to, but without, `last`."""
        rows = slice(first * self.beats_a_bar, last * self.beats_a_bar)
        return Beats(self.beats_a_bar, *(getattr(self, name)[rows] for name in _ARRAYS))


_ARRAYS = tuple(field.name for field in fields(Beats))[1:]


def joined(parts: Sequence[Beats]) -> Beats:
    """One after the other, at least one; all have as many beats a bar."""
    assert len({part.beats_a_bar for part in parts}) == 1, "one meter"
    columns = (np.concatenate([getattr(part, name) for part in parts]) for name in _ARRAYS)
    return Beats(parts[0].beats_a_bar, *columns)


def beats_of(turn: Turn) -> Beats:
    """The beats of the turn's bars."""
    beats = _read(turn)
    return beats.of_bars(0, turn.bars)


def landing_of(turn: Turn) -> Beats:
    """A bar that has what the turn plays after its last bar: on the downbeat there, and at most half a beat behind."""
    return _read(turn).of_bars(turn.bars, turn.bars + 1)


def strokes_of(beats: Beats, ground: Ground) -> list[Note]:
    """The strokes in order of time, ornaments as words without their grace strokes; nobody has said the limbs yet.

    Strokes on a cell's tick, which sound `late_ms` after it, at most `MAX_LATE_MS`. `with_graces` adds grace strokes.
    """
    assert beats.beats_a_bar == ground.beats_a_bar, "the beats of this ground"
    spans = beat_spans(ground, beats.bars)
    starts, lengths = spans.starts, spans.lengths
    return [
        _note(beats, (beat, cell, instrument), int(starts[beat] + round(lengths[beat] * cell / beats.division[beat])))
        for beat, cell, instrument in np.argwhere(beats.struck).tolist()
    ]


def _note(beats: Beats, at: tuple[int, int, int], tick: int) -> Note:
    instrument = Instrument(at[2])
    openness = {Instrument.CLOSED_HIHAT: CLOSED, Instrument.OPEN_HIHAT: OPEN}.get(instrument)
    return Note(
        tick,
        STRUCK_PIECES[instrument],
        velocity=int(beats.velocity[at]),
        openness=openness,
        ornament=Ornament(int(beats.ornament[at])),
        late_ms=float(np.clip(beats.late_ms[at], -MAX_LATE_MS, MAX_LATE_MS)),
    )


# --- reading ----------------------------------------------------------------------------------------------------------


def instrument_of(piece: Piece, openness: float | None, articulation: Articulation) -> Instrument:
    """What a stroke is read as; a hi-hat whose openness is not told is closed."""
    if piece is Piece.HIHAT_PEDAL:
        return Instrument.OPEN_HIHAT if articulation is Articulation.SPLASH else Instrument.CLOSED_HIHAT
    nearest = stand_in(piece, _PIECES)
    is_open = nearest is Piece.HIHAT and openness is not None and openness >= HALF_OPEN
    return Instrument.OPEN_HIHAT if is_open else _INSTRUMENTS[nearest]


_PIECES = frozenset(STRUCK_PIECES.values())
_INSTRUMENTS: Mapping[Piece | None, Instrument] = MappingProxyType(
    {piece: instrument for instrument, piece in STRUCK_PIECES.items() if instrument is not Instrument.OPEN_HIHAT}
)


def _read(turn: Turn) -> Beats:
    """The beats of the turn, and a bar more for the landing."""
    mains = _main_strokes(turn)
    bar_ns = turn.ground.ns_of_bars(1)
    times_s = (turn.ground.tempo_map.ns_at(np.array([m.tick for m in mains], np.int64)) - bar_ns) / NS_PER_S
    cells = cells_played(times_s, np.array([m.piece for m in mains], np.int64), turn.ground, turn.bars)
    return _filled(mains, cells, turn.ground.beats_a_bar)


def _main_strokes(turn: Turn) -> tuple[Note, ...]:
    """The turn's strokes in order of time, each at its own tick a bar later; what is beyond the turn is none of it."""
    ground = turn.ground
    half_ns = int(ground.tempo_map.ns_at(ground.beat_ticks // 2))
    hits = turn.played.hits
    inside = (hits["at_ns"] >= -half_ns) & (hits["at_ns"] < turn.length_ns + half_ns)
    played = Performance.from_array(hits[inside]).shifted(ground.ns_of_bars(1))
    mains = found_ornaments(score_as_played(played, ground.tempo_map)).mains
    first = ground.bar_ticks - ground.beat_ticks * _EARLIEST
    return tuple(sorted((main for main in mains if main.tick >= first), key=lambda main: main.tick))


_EARLIEST = 1 / 8
"""So much of a beat before the turn a stroke is still its downbeat's: half a sixteenth. An earlier one is a place of
the bar before, which somebody who plays on into their turn has struck."""


def _filled(mains: Sequence[Note], cells: PlayedCells, beats_a_bar: int) -> Beats:
    beats = Beats.silent(len(cells.division), beats_a_bar)
    beats.division[:] = cells.division
    for main, beat, cell, late_ms in zip(
        mains, cells.beat.tolist(), cells.cell.tolist(), (cells.late_s * NS_PER_S / NS_PER_MS).tolist(), strict=True
    ):
        at = beat, cell, instrument_of(main.piece, main.openness, main.articulation)
        if main.velocity > beats.velocity[at]:  # of two that share a cell, the louder
            beats.struck[at], beats.velocity[at], beats.late_ms[at] = True, main.velocity, late_ms
            beats.ornament[at] = main.ornament
    return beats
