"""Bars as single strokes on a grid of 24 to a beat, and back: what motifs are turned round on."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from station.core.pieces import Articulation, Dynamic, Ornament, Piece
from station.music.stroke_velocities import USUAL_VELOCITIES
from station.practice.battle.ground import Ground
from station.practice.battle.improvising.played_beats import Beats, Instrument, instrument_of
from station.practice.battle.improvising.played_divisions import MOST_CELLS
from station.practice.battle.vocabulary.lesson_bars import LessonBars

GRID = 24
"""The least common multiple of the divisions 3, 4, 6 and 8."""
_PLAINEST = (4, 3, 8, 6)
"""Divisions in the order in which a beat's strokes are written."""


@dataclass(frozen=True, slots=True)
class GridStroke:
    """One stroke `at` so many 24ths of a beat from the first one on."""

    at: int
    instrument: Instrument
    velocity: int
    ornament: Ornament = Ornament.NONE


def grid_strokes(beats: Beats) -> list[GridStroke]:
    """The strokes of `beats` in order of time."""
    return [
        GridStroke(
            beat * GRID + cell * GRID // int(beats.division[beat]),
            Instrument(instrument),
            int(beats.velocity[beat, cell, instrument]),
            Ornament(int(beats.ornament[beat, cell, instrument])),
        )
        for beat, cell, instrument in np.argwhere(beats.struck).tolist()
    ]


def beats_with(strokes: Iterable[GridStroke], beats: int, beats_a_bar: int, usual: int = 4) -> Beats:
    """So many beats with these strokes, each beat in the plainest cells that hold its own; `usual` where it has none.

    What no cells hold goes to the nearest; of two in one cell the louder counts; what is beyond the beats is left out.
    """
    found = Beats.silent(beats, beats_a_bar, usual)
    by_beat: dict[int, list[GridStroke]] = {}
    for stroke in strokes:
        if 0 <= stroke.at < beats * GRID:
            by_beat.setdefault(stroke.at // GRID, []).append(stroke)
    for beat, some in by_beat.items():
        order = (usual, *_PLAINEST)
        division = next((d for d in order if all(s.at % (GRID // d) == 0 for s in some)), MOST_CELLS)
        found.division[beat] = division
        for stroke in some:
            where = beat, min(round(stroke.at % GRID * division / GRID), division - 1), stroke.instrument
            if stroke.velocity > found.velocity[where]:
                found.struck[where], found.velocity[where] = True, stroke.velocity
                found.ornament[where] = stroke.ornament
    return found


def beats_of_lesson(bars: LessonBars, ground: Ground) -> Beats:
    """The bars of a lesson as beats of `ground`, whose meter they have; grace strokes belong to their main strokes."""
    rows = bars.rows[bars.rows["lead_ms"] <= 0]
    a_bar = ground.beats_a_bar
    bar, inside = np.divmod(rows["tick"], ground.bar_ticks)
    beat, rest = np.divmod(inside, ground.beat_ticks)
    length = np.minimum(ground.beat_ticks, ground.bar_ticks - beat * ground.beat_ticks)  # a last beat may be short
    at = (bar * a_bar + beat) * GRID + np.rint(rest * GRID / length).astype(np.int64)
    strokes = [
        GridStroke(
            int(when),
            instrument_of(Piece(row["piece"]), float(row["openness"]), Articulation(row["articulation"])),
            USUAL_VELOCITIES[Dynamic(row["dynamic"])],
        )
        for when, row in zip(at.tolist(), rows, strict=True)
    ]
    return beats_with(strokes, bars.bars * a_bar, a_bar)
