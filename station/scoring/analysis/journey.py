"""The way through the score: where the player stopped and began again, left bars out, or played bars twice.

It is read from the alignment: where each hit lies in the score, over when it was played. From hit to hit score time
passes as fast as time does, times the player's pace; where it does not by `LEAST_BEATS` or more, there is a *jump*.
Back after a pause, or back to where the run began, the player stopped and began again; back by whole bars without a
pause, bars were repeated; on, they were left out. Bars in which nothing was struck were left out, too, or the player
stopped and came in again on the click: the data cannot tell.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.entries import Entry, entries, no_time_left
from station.scoring.matching.alignment import Alignment

Flags = NDArray[np.bool_]
Floats = NDArray[np.float64]

LEAST_BEATS = 0.75
"""A shorter jump is a slip in time (our choice: more than an offbeat, less than a beat)."""

PAUSE_BEATS = 0.75
"""Silence by so much longer than written is a pause (our choice)."""

EMPTY_NOTES = 4
"""A bar without any of so many strokes was left out; of fewer chance may take all (a tenth left out: 1 in 10,000)."""


MOST_AT_END = 2
"""So many silent bars at the end were left out somewhere, in music whose bars are alike; more, and the take was ended
(our choice)."""


@dataclass(frozen=True, slots=True)
class Jump:
    """`fault` is `stopped`, `left_out_bars` or `repeated_bars`; in `bar` of the score (from 0), on to `to_bar`.

    `bars` how many bars were left out or repeated, 0 for a stop. `rivals` other words that the data allow.
    """

    fault: str
    bar: int
    to_bar: int
    bars: float
    rivals: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Journey:
    """All jumps in order.

    `passed` (n,) are notes that were left out with their bar or for which a late entry left no time, `again` (m,) hits
    of bars that were played more than once and that answer nothing; `entries` say who came in beside the click.
    """

    jumps: tuple[Jump, ...]
    passed: Flags
    again: Flags
    entries: tuple[Entry, ...] = ()


def journey(score: Score, performance: Performance, alignment: Alignment) -> Journey:
    """The way of `performance` through `score`."""
    passed, again = np.zeros(len(score), np.bool_), np.zeros(len(performance), np.bool_)
    came_in = entries(score, performance, alignment)
    entered = {entry.hit for entry in came_in}
    jumps: list[Jump] = []
    at, place = performance.hits["at_ns"].astype(np.float64), alignment.hit_score_ns.astype(np.float64)
    if len(at) > 2 and (alignment.note_of_hit >= 0).any():
        beat_ns = float(score.tempo_map.ns_at(PPQ))
        passing, moving = np.diff(at), np.diff(place)
        pace = _pace(passing, moving, beat_ns)
        run = 0
        for k in np.flatnonzero(np.abs(moving - pace * passing) >= LEAST_BEATS * beat_ns).tolist():
            span = (place[k], place[k + 1])
            jump = None if k + 1 in entered else _jump(score, span, pace * passing[k], place[run], beat_ns)
            if jump is not None:
                jumps.append(jump)
            low, high = min(span), max(span)
            if span[1] < span[0]:
                again |= (place >= low - beat_ns) & (place <= high + beat_ns) & (alignment.hit_label == Label.EXTRA)
            elif jump is not None and jump.fault == "left_out_bars":
                passed |= (score.onset_ns > low) & (score.onset_ns < high)
            run = k + 1
    back = sum(max(jump.bars, 1.0) for jump in jumps if jump.fault != "left_out_bars")
    bar_quarters = score.tempo_map.meter_at(0).bar_ticks / PPQ
    back += sum(entry.quarters / bar_quarters for entry in came_in[-1:] if entry.quarters > 0)
    jumps += _silent_bars(score, alignment, passed, ceil(back))
    passed |= no_time_left(score, alignment, came_in)
    return Journey(tuple(sorted(jumps, key=lambda jump: jump.bar)), passed, again, came_in)


def _pace(passing: Floats, moving: Floats, beat_ns: float) -> float:
    """Score time that passes in a second of the player's, as it mostly does."""
    steady = (passing > beat_ns / 16) & (moving > beat_ns / 16)
    return float(np.median(moving[steady] / passing[steady])) if steady.any() else 1.0


def _jump(
    score: Score, span: tuple[float, float], passed_ns: float, run_began_ns: float, beat_ns: float
) -> Jump | None:
    """What a jump of the place from `span[0]` to `span[1]` is, while `passed_ns` of score time should have passed."""
    at_ticks = score.tempo_map.ticks_at_ns(np.maximum(np.array(span) + beat_ns / 8, 0).astype(np.int64))
    left, came = score.tempo_map.bars_at(at_ticks).tolist()
    start, end = (int(score.tempo_map.ns_at(score.tempo_map.bar_start(left + k))) for k in (0, 1))
    bars = (span[1] - span[0] - passed_ns) / (end - start)
    later = score.onset_ns[score.onset_ns > span[0] + beat_ns / 16]
    written_ns = float(later[0]) - span[0] if len(later) else 0.0
    paused = passed_ns - written_ns > PAUSE_BEATS * beat_ns
    to_start = span[1] <= run_began_ns + 1.5 * beat_ns
    if span[1] < span[0] - beat_ns / 4:
        whole = round(-(span[1] - span[0] - written_ns) / (end - start))
        is_whole = whole >= 1 and abs((span[0] + written_ns - span[1]) / (end - start) - whole) < 0.2
        if paused or not is_whole:
            return Jump("stopped", left, came, 0.0, ("repeated_bars",) if is_whole else ())
        return Jump("repeated_bars", came, came, float(whole), ("stopped",) if to_start else ())
    if paused and bars < 0:
        return Jump("stopped", left, came, 0.0)
    if bars > 0.4:
        skipped = left + 1 if came > left else left
        return Jump("left_out_bars", skipped, came, max(round(bars), 1.0), ("stopped",) if paused else ())
    return None


def _silent_bars(score: Score, alignment: Alignment, passed: Flags, back: float) -> list[Jump]:
    """Bars in which nothing was struck after others in which something was; their notes are added to `passed`.

    Silent bars at the end are those for which no time was left, if the player went `back` by as many.
    """
    main, answered = ~score.is_grace, alignment.hit_of_note >= 0
    bars = score.bar
    heard = np.bincount(bars, weights=answered, minlength=score.bar_count) > 0
    written = np.bincount(bars, weights=main & ~passed, minlength=score.bar_count)
    if not heard.any():
        return []
    played = np.flatnonzero(heard)
    silent = np.flatnonzero(~heard & (written >= EMPTY_NOTES))
    ended = int((silent > played[-1]).sum()) > max(MOST_AT_END, back)
    silent = silent[(silent > played[0]) & ((silent < played[-1]) | (not ended))]
    passed |= np.isin(bars, silent)
    if int((silent > played[-1]).sum()) <= back:
        silent = silent[silent < played[-1]]
    runs = np.split(silent, np.flatnonzero(np.diff(silent) > 1) + 1) if len(silent) else []
    return [Jump("left_out_bars", int(run[0]), int(run[-1]) + 1, float(len(run)), ("stopped",)) for run in runs]
