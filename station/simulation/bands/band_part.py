"""What the virtual band's drummer plays: grooves, fills, breaks and crashes over verses and choruses."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from station.core.pieces import Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoChange, TempoMap

SIXTEENTH = PPQ // 4
BAR_BEATS = 4
Groove = Mapping[Piece, str]
"""Of each piece sixteen sixteenths of a bar: `x` a stroke, `X` a loud one."""

GROOVES: tuple[Groove, ...] = tuple(
    MappingProxyType(dict(zip((Piece.KICK, Piece.SNARE, hand), lines, strict=True)))
    for hand, lines in (
        (Piece.HIHAT, ("X.......X.......", "....X.......X...", "x.x.x.x.x.x.x.x.")),
        (Piece.HIHAT, ("X.....x.X.x.....", "....X..x....X...", "x.x.x.x.x.x.x.x.")),
        (Piece.RIDE, ("X..x..x.X..x....", "....X.......X..x", "x...x.x.x...x.x.")),
        (Piece.HIHAT, ("X.......X.x.....", "....X.......X...", "xxxxxxxxxxxxxxxx")),
        (Piece.HIHAT, ("X...x...X...x...", "....X.......X...", "..x...x...x...x.")),
        (Piece.FLOOR_TOM_1, ("X.....x.........", "........X.......", "x.x.x.x.x.x.x.x.")),
    )
)
FILL: Groove = MappingProxyType(
    {Piece.SNARE: "XxxxXx..........", Piece.TOM_1: "......xxXx......", Piece.FLOOR_TOM_1: "..........xxXxxx"}
)
NO_GROOVE: Groove = MappingProxyType({})
SECTION_BARS = 8
_ZONES = MappingProxyType({Piece.HIHAT: Zone.BOW, Piece.RIDE: Zone.BOW, Piece.CRASH_1: Zone.EDGE})


def band_part(bars: int, written_bpm: float, rng: np.random.Generator, breaks: bool = True) -> Score:
    """A part of `bars` bars of 4/4: every eight bars another groove or a break, a fill before it, a crash on it."""
    notes: list[Note] = []
    for section in range(0, bars, SECTION_BARS):
        is_break = breaks and section > 0 and rng.random() < 0.15
        groove = NO_GROOVE if is_break else GROOVES[rng.integers(len(GROOVES))]
        length = min(SECTION_BARS, bars - section)
        for bar in range(section, section + length):
            is_fill = not is_break and bar == section + length - 1
            notes += _bar(bar, FILL if is_fill and rng.random() < 0.7 else groove)
        if not is_break:
            notes.append(_note(section * BAR_BEATS * PPQ, Piece.CRASH_1, 110))
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, written_bpm)])
    return Score.from_notes(notes, tempo_map, bars * BAR_BEATS * PPQ)


def _bar(bar: int, groove: Groove) -> list[Note]:
    first = bar * BAR_BEATS * PPQ
    return [
        _note(first + i * SIXTEENTH, piece, 115 if sign == "X" else 80)
        for piece, line in groove.items()
        for i, sign in enumerate(line)
        if sign != "."
    ]


def _note(tick: int, piece: Piece, velocity: int) -> Note:
    return Note(tick, piece, _ZONES.get(piece, Zone.HEAD), velocity)
