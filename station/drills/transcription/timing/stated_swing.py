"""Times of a part whose file states its swing: they are read straight, and swung again by just that swing.

So a ratio that nobody would guess from the offbeats (GrooveScribe's 30 % is 13:7) is the lesson's to the last digit.
What lies between the swung cells moves with them, as a lesson's grid has it; tuplets stay straight.
"""

from bisect import bisect_right
from dataclasses import replace

from station.drills.grid.cell_strokes import BarClock
from station.drills.transcription.timing.grid_times import GridTimes, quantised_times
from station.music.score import Score
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoMap

_DECIMALS = 3
"""Of a ratio: what that rounds is 0.03 ms at 120 beats a minute, a hundredth of what an ear tells (our choice)."""


def readable(swing: Swing) -> Swing:
    """The swing with a ratio that a teacher would write: other programs count in shares that make long fractions."""
    return replace(swing, ratio=round(swing.ratio, _DECIMALS))


def stated_times(score: Score, swing: Swing) -> GridTimes:
    """`score`, whose strokes have their `swing_ticks`, with every row on a cell of the grid and swung by `swing`."""
    times = quantised_times(score.as_written, is_played=False)
    return replace(times, score=_swung(times, swing), swing=swing)


def _swung(times: GridTimes, swing: Swing) -> Score:
    score = times.score
    clock = BarClock(_bars(score.tempo_map, score.bar_count), swing)
    starts = [beat.tick for beat in times.beats]
    rows = score.notes.copy()
    for row in rows:
        beat = times.beats[max(bisect_right(starts, int(row["tick"])) - 1, 0)]
        swings = beat.cells & (beat.cells - 1) == 0
        place = clock.place(int(row["tick"]), swings)
        for name in ("duration_ticks", "choke_ticks"):
            if row[name]:
                row[name] = clock.place(int(row["tick"] + row[name]), swings).played - place.played
        row["tick"], row["swing_ticks"] = place.played, place.swing_ticks
    return Score.from_array(rows, score.tempo_map, score.end_tick, score.title, score.loudness)


def _bars(tempo_map: TempoMap, count: int) -> list[MeterChange]:
    starts = [tempo_map.bar_start(bar) for bar in range(count)]
    return [replace(tempo_map.meter_at(tick), tick=tick) for tick in starts]
