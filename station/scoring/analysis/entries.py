"""Who came in beside the click: a beat late, half a beat early, and then played on steadily.

The way of the hits by the click (`following.offline`) says by how many beats each uninterrupted run is off it. Its
strokes are judged where they are meant, so that a late entry is one fault and no row of wrong pads; what the player
then had no time for is `passed`: its notes are missed, and named by the entry alone. Without a click there is no entry.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.matching.alignment import Alignment, Reference

Flags = NDArray[np.bool_]

LEAST_BEATS = 0.4
"""Quarters: less is no other place (our choice: under the half of a beat that is looked for, beyond any lean)."""

_EARLY_TICKS = PPQ // 8
"""A stroke so little before a bar belongs to it (our choice, as where a jump lands in `journey`)."""

STEADY_SHARE, STEADY_HITS = 0.7, 16
"""So much of what is played beside the click is right there, else it is no entry but something else that is played: of
another lesson's strokes a quarter are, of a beginner's more than eight in ten (benchmarks/late_entries.py). While it is
played as many strokes are looked at, and half as many at least (our choice: two bars of eighths)."""

_STRAYS = 3
"""Strokes of before the beginning that are not yet a beginning (our choice)."""

_WHOLE = 0.1
"""Bars by which whole bars may be missed (our choice: under half a beat of five)."""


@dataclass(frozen=True, slots=True)
class Entry:
    """From `hit` on, in `bar` of the score (from 0), the player is so many quarters behind the click; negative ahead.

    `strokes` were played so.
    """

    hit: int
    bar: int
    quarters: float
    strokes: int


def entries(score: Score, performance: Performance, alignment: Alignment) -> tuple[Entry, ...]:
    """Each run of strokes beside the click, in order; whole bars are an entry at the beginning alone.

    Elsewhere whole bars were left out or played again, and who begins more than a bar ahead began in another bar.
    """
    if alignment.reference is not Reference.CLICK or not len(performance):
        return ()
    found, before = list[Entry](), 0.0
    for first, hits in _runs(alignment):
        behind = _behind(score, performance, alignment, hits)
        place = int(score.tempo_map.ticks_at_ns(max(int(alignment.hit_score_ns[first]), 0))) + _EARLY_TICKS
        bar_quarters = score.tempo_map.meter_at(place).bar_ticks / PPQ
        quarters = behind - round(before / bar_quarters) * bar_quarters  # against the bars that were left out or again
        if abs(behind - before) >= LEAST_BEATS and abs(quarters) >= LEAST_BEATS:
            is_entry = _is_entry(score, performance, first, quarters, bar_quarters)
            if is_entry and is_right_there(alignment.hit_label[hits].tolist()):
                bar = min(int(score.tempo_map.bars_at(place)), score.bar_count - 1)
                found.append(Entry(first, bar, quarters, len(hits)))
        before = behind
    return tuple(found)


def is_right_there(labels: Sequence[int]) -> bool:
    """Whether strokes that were judged so are played where they are judged."""
    return sum(label == Label.MATCH for label in labels) >= STEADY_SHARE * max(len(labels), 1)


def _is_entry(score: Score, performance: Performance, first: int, quarters: float, bar_quarters: float) -> bool:
    """Whether a run from hit `first` on is one that came in so late: no more than a bar, but at the beginning."""
    bars = quarters / bar_quarters
    if quarters > 0 and _is_beginning(score, performance, first, quarters):
        return True
    is_whole = abs(bars - round(bars)) < _WHOLE
    return abs(bars) < 1 + _WHOLE and (not is_whole or (quarters < 0 and first <= _STRAYS))


def _is_beginning(score: Score, performance: Performance, first: int, quarters: float) -> bool:
    """Whether the run that begins with hit `first` is the beginning: nothing was played before it could be due.

    In a loop of bars that are alike the first strokes of who is a bar late fit the second bar as well.
    """
    due_ns = int(score.tempo_map.ns_at(max(round(quarters * PPQ) - PPQ // 2, 0)))
    written, played = (int((at_ns < due_ns).sum()) for at_ns in (score.onset_ns, performance.hits["at_ns"]))
    return played <= _STRAYS and (first <= _STRAYS or written > _STRAYS)


def _runs(alignment: Alignment) -> list[tuple[int, NDArray[np.int64]]]:
    """The first hit and the hits of each segment."""
    edges = np.flatnonzero(np.diff(alignment.segment, prepend=-1))
    runs = np.split(np.arange(len(alignment.segment)), edges[1:])
    return [(int(run[0]), run) for run in runs]


def _behind(score: Score, performance: Performance, alignment: Alignment, hits: NDArray[np.int64]) -> float:
    """Quarters by which the hits lie behind the click."""
    played, meant = performance.hits["at_ns"][hits], alignment.hit_score_ns[hits]
    tick = int(score.tempo_map.ticks_at_ns(max(int(np.median(meant)), 0)))
    return float(np.median(played - meant)) / 1e9 * score.tempo_map.bpm_at(tick) / 60


def no_time_left(score: Score, alignment: Alignment, found: tuple[Entry, ...]) -> Flags:
    """Notes (n,) for which an entry left no time: the first of who came in ahead, the last of who is behind."""
    passed = np.zeros(len(score), np.bool_)
    if not found:
        return passed
    slack = PPQ // 8
    ticks, place = score.notes["tick"], score.tempo_map.ticks_at_ns(np.maximum(alignment.hit_score_ns, 0))
    first, last = found[0], found[-1]
    if first.hit == 0 and first.quarters < 0:
        passed |= ticks < min(int(place[0]), -first.quarters * PPQ) - slack
    if last.quarters > 0 and last.hit + last.strokes == len(place):
        passed |= ticks > max(int(place.max()), score.end_tick - last.quarters * PPQ) + slack
    return passed


def in_words(quarters: float, beat_ticks: int, bar_ticks: int) -> str:
    """So many quarters, as people say it who count beats: "half a beat", "two beats", "a bar", "an eighth"."""
    beats, bar_beats = quarters * PPQ / beat_ticks, bar_ticks / beat_ticks
    bars = beats / bar_beats
    if abs(bars - round(bars)) < _WHOLE and round(bars) >= 1:
        return "a bar" if round(bars) == 1 else f"{round(bars)} bars"
    halves = round(2 * beats)
    if abs(beats - halves / 2) > _OFF_HALF or not halves or (halves % 2 and beat_ticks % PPQ):
        eighths = round(2 * quarters)
        return "an eighth" if eighths == 1 else f"{_NUMBERS.get(eighths, str(eighths))} eighths"
    whole = _NUMBERS.get(halves // 2, str(halves // 2))
    if halves == 1:
        return "half a beat"
    half = " and a half" if halves % 2 else ""
    return f"{whole} beat{half}" if halves // 2 == 1 else f"{whole}{half} beats"


_OFF_HALF = 0.1
_NUMBERS = {1: "a", 2: "two", 3: "three"}
