"""Points from taps: a listener taps along with the band, from the first beat of a bar on."""

from collections.abc import Sequence
from itertools import pairwise
from statistics import median

from station.drills.songs.song import SongPoint
from station.music.score import Score


def tapped_points(score: Score, bar: int, taps_s: Sequence[float]) -> tuple[SongPoint, ...]:
    """The points of `taps_s`, which rise: the first is the first beat of `bar` (from 1), the others pulses after it.

    A pulse is what a foot taps (`MeterChange.pulses`). Taps that were left out are counted where the tempo says so, and
    what lies beyond the part is no point.
    """
    ticks = _pulses(score, bar - 1, len(taps_s))
    gaps = [after - before for before, after in pairwise(taps_s)]
    usual_s = median(gaps) if gaps else 1.0
    points, place = [], 0
    for index, at_s in enumerate(taps_s):
        place += max(1, round(gaps[index - 1] / usual_s)) if index else 0
        if place < len(ticks):
            points.append(_point(score, ticks[place], at_s))
    return tuple(points)


def _pulses(score: Score, bar: int, least: int) -> list[int]:
    """The ticks of pulses from the start of `bar` (from 0) on: all there are, or twice as many as are needed."""
    ticks: list[int] = []
    while bar < score.bar_count and len(ticks) < 2 * least:
        start = score.tempo_map.bar_start(bar)
        end = min(score.tempo_map.bar_start(bar + 1), score.end_tick)
        ticks += [start + first for first, _ in score.tempo_map.meter_at(start).pulses if start + first < end]
        bar += 1
    return ticks


def _point(score: Score, tick: int, at_s: float) -> SongPoint:
    place, meter = score.tempo_map.position_at(tick), score.tempo_map.meter_at(tick)
    return SongPoint(place.bar + 1, 1 + place.beat + place.tick / meter.beat_ticks, at_s)
