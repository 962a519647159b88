"""A lesson's music as paper has it: swing stands in words above the staff, and the cells below it are straight.

Triplets say a ratio of 2 exactly, and in such a lesson some are triplets indeed, so there they stay. No other ratio can
be written in notes that anyone reads: what sounds where a straight cell swings to is written as that cell.
"""

import numpy as np

from station.drills.grid.swing import STRAIGHT, Swing
from station.drills.lesson import Lesson
from station.music.score import Score
from station.music.tempo import MeterChange

TRIPLETS = 2.0


def as_printed(lesson: Lesson) -> Score:
    """All bars of `lesson` and its landing, straight where they swing by another ratio than 2."""
    score = lesson.played_once
    notes, tempo_map = score.notes.copy(), score.tempo_map
    bars = tempo_map.bars_at(notes["tick"])
    for bar in np.unique(bars).tolist():
        swing, start = lesson.swing_of_bar(bar), tempo_map.bar_start(bar)
        if swing.ratio in (STRAIGHT, TRIPLETS):
            continue
        cells = straight_cells(swing, tempo_map.meter_at(start))
        here = bars == bar
        notes["tick"][here] = [start + cells.get(tick - start, tick - start) for tick in notes["tick"][here].tolist()]
    return Score.from_array(notes, tempo_map, score.end_tick, score.title)


def straight_cells(swing: Swing, meter: MeterChange) -> dict[int, int]:
    """Where in a bar of `meter` each cell of half a swung unit is played -> where it is written, both in ticks."""
    return {swing.swung(tick, meter): tick for tick in range(0, meter.bar_ticks, swing.unit_ticks // 2)}
