"""When each stroke of a take is meant: meter, beat, swing, and the cells that its beats are cut into.

`quantised_times` is the only door. Times and ticks are those of `Score`; leans are positive where strokes come late.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.drills.quantise_time import at_bar_starts
from station.drills.transcription.beat_spans import spans_of
from station.drills.transcription.rhythm_words import MAX_WORDS, cells_of
from station.drills.transcription.take_feel import feel_of, take_of
from station.drills.transcription.triplet_swing import triplet_swing
from station.music.score import Score
from station.music.swing import Swing


@dataclass(frozen=True, slots=True)
class BeatCells:
    """The beat from `tick`, `length_ticks` long, is cut into `cells` equal cells."""

    tick: int
    length_ticks: int
    cells: int


@dataclass(frozen=True, slots=True, eq=False)
class GridTimes:
    """A score on the grid, and how it came there.

    `score` has the rows that were given, their ticks on cells, whole bars alone, `swing_ticks` where swing is written
    as a word; row `i` of it was row `origin[i]` (shape (n,)). `swing` is that of the whole piece and `beat_ticks` the
    beat that is counted. `beats` are the beats with strokes in order. `lean_ms` is how late the take is as a whole,
    and `spread_ms` the standard deviation about that; both 0 where the score was on the grid already.
    """

    score: Score
    origin: NDArray[np.int64]
    swing: Swing
    beat_ticks: int
    beats: tuple[BeatCells, ...]
    lean_ms: float = 0.0
    spread_ms: float = 0.0


def quantised_times(score: Score, is_played: bool) -> GridTimes:
    """`score` with every row on a cell of the grid.

    Rows are main strokes at their played ticks, grace rows (`lead_ms` > 0) on the tick of their main stroke, and
    buzzes, one row each with its duration. With `is_played` the times are known to be somebody's playing; without it
    they are taken so only if they lie on no grid. Raises `BadInput` where a change of meter cuts a bar at a place that
    no meter can name.
    """
    tempo_map = at_bar_starts(score)
    spans = spans_of(tempo_map, score.end_tick)
    rows = score.notes[np.argsort(score.notes["tick"], kind="stable")]
    take = take_of(tempo_map.ns_at(rows["tick"]), rows["piece"], spans)
    is_main = rows["lead_ms"] == 0
    mains = take_of(tempo_map.ns_at(rows["tick"][is_main]), rows["piece"][is_main], spans)
    feel = feel_of(mains)
    reading = mains.read(feel, MAX_WORDS)
    swing = feel.swing
    span, _ = spans.places(mains.times_s - feel.lean_s)
    if swing.ratio in (1.0, 2.0):
        swing = triplet_swing(spans, span, reading.place, mains.piece)
    ticks = spans.starts[span] + np.rint(reading.place * spans.lengths[span]).astype(np.int64)
    new = rows.copy()
    new["tick"][is_main] = ticks
    cell = cells_of(spans, span, reading, feel.swing)
    straight = spans.starts[span] + np.rint(cell * spans.lengths[span] / reading.cells[span]).astype(np.int64)
    if feel.swing.stands_in_words:
        new["swing_ticks"][is_main] = ticks - straight
    follow_mains(rows, new)
    end = score.end_tick
    if len(ticks) and ticks.max() >= end:
        end = tempo_map.bar_start(int(tempo_map.bars_at(ticks.max())) + 1)
    found = Score.from_array(new, tempo_map, end, score.title)
    return GridTimes(
        found,
        np.arange(len(rows)),
        swing,
        PPQ,
        tuple(BeatCells(int(a), int(b), int(c)) for a, b, c in zip(spans.starts, spans.lengths, reading.cells)),
        feel.lean_s * 1e3,
        feel.spread_s * 1e3,
    )


def follow_mains(rows, new):
    m = {(int(r["tick"]), int(r["piece"])): n for r, n in zip(rows, new) if r["lead_ms"] == 0}
    for r, n in zip(rows, new):
        if r["lead_ms"] > 0 and (int(r["tick"]), int(r["piece"])) in m:
            q = m[int(r["tick"]), int(r["piece"])]
            n["tick"], n["swing_ticks"] = q["tick"], q["swing_ticks"]
