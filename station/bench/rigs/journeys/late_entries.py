"""People who come in beside the click and play on: late by half a beat, a beat, two, a bar, or a beat early.

Shipped lessons in loops of one to four bars, played by the virtual student, who knows 1/f timing, misses and wrong
pads, and takes of the Groove MIDI Dataset in their drummers' own timing. What an ear could know is asked of the strokes
alone: how many of them meet a note of their piece if they are meant here or there. Nothing is shared with what judges.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.journeys.journey_music import gmd_takes, quantised
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.library import find_lesson, lesson_names
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Score
from station.simulation.student_spec import PLAYERS, StudentSpec
from station.simulation.virtual_student import VirtualStudent

SHIFTS = ("-1", "0", "1/2", "1", "2", "bar")
"""Beats late that are tried; negative is early."""

LEVELS = {name: PLAYERS[name] for name in ("pro", "intermediate", "beginner")} | {
    "lost": replace(
        PLAYERS["beginner"], miss_pct=20.0, extra_pct=15.0, wrong_piece_pct=15.0, sd_interval_pct=14.0, player=""
    )
}
"""Who plays; "lost" gets one stroke in three wrong."""

_EARLIEST_S, _TAIL_S = 0.25, 1.0
"""What a session hears before its first bar and after its last."""
_NEAR_NS = 60 * NS_PER_MS
"""So near an ear takes a stroke for a note's."""
_TOLD = 0.2
"""An ear tells two places where so many more of all strokes and notes meet in one."""


@dataclass(frozen=True, eq=False)
class EntryTake:
    """One take: who plays what, how late in quarters, and whether an ear could tell that from no shift."""

    name: str
    level: str
    shift: str
    score: Score
    performance: Performance
    quarters: float
    beat_ticks: int
    can_be_told: bool


def lesson_take(seed: int, level: str = "", shift: str = "") -> EntryTake:
    """A take of a shipped lesson: bars and passes drawn by `seed`, and `level` and `shift` where they are not said."""
    rng = np.random.default_rng([seed, 1])
    names = lesson_names()
    lesson = find_lesson(names[int(rng.integers(len(names)))])
    bars = min(int(rng.choice([1, 2, 4])), lesson.score.bar_count)
    first = int(rng.integers(lesson.score.bar_count - bars + 1))
    score = lesson.score.bars(first, first + bars - 1).repeated(int(rng.integers(2, 5)))
    level = level or str(rng.choice(list(LEVELS)))
    spec: StudentSpec = replace(LEVELS[level], seed=seed)
    played = VirtualStudent(spec).play(score).performance
    return _shifted(lesson.name, level, shift or str(rng.choice(SHIFTS)), score, played, lesson.beat_ticks)


OTHER = "another lesson"
"""Who plays something else than the score, as an intermediate player, on the click."""


def other_take(seed: int) -> EntryTake:
    """The strokes of one lesson over the score of another."""
    one, other = (lesson_take(k, "intermediate", "0") for k in (2 * seed, 2 * seed + 1))
    return replace(one, level=OTHER, performance=other.performance)


def gmd_entries(seed: int) -> Iterator[EntryTake]:
    """Each take of the dataset with a shift that was drawn, in its drummer's own timing; none where it is not there."""
    rng = np.random.default_rng([seed, 2])
    for path in gmd_takes():
        score, own_s = quantised(path)
        if own_s is None or not len(score):
            continue
        hits = np.zeros(len(score), HIT_DTYPE)
        hits["at_ns"] = score.onset_ns + np.rint(own_s * NS_PER_S).astype(np.int64)
        hits["piece"], hits["velocity"], hits["position"], hits["limb"] = score.notes["piece"], 80, np.nan, -1
        hits["openness"] = np.nan
        played = Performance.from_array(hits[np.argsort(hits["at_ns"], kind="stable")])
        yield _shifted(path.stem, "gmd", str(rng.choice(SHIFTS)), score, played, PPQ)


def _shifted(name: str, level: str, shift: str, score: Score, played: Performance, beat_ticks: int) -> EntryTake:
    meter, tempo_map = score.tempo_map.meter_at(0), score.tempo_map
    ticks = meter.bar_ticks if shift == "bar" else round(float(beats_of(shift)) * beat_ticks)
    hits = played.hits.copy()
    at_s = hits["at_ns"] / NS_PER_S
    by_s = float(np.sign(ticks)) * float(tempo_map.seconds_at(abs(ticks)))
    hits["at_ns"] += round(by_s * NS_PER_S)
    end_s = score.length_ns / NS_PER_S
    heard = hits[(at_s + by_s >= -_EARLIEST_S) & (at_s + by_s <= end_s + _TAIL_S)]
    performance = Performance.from_array(heard)
    here, there = (_met(score, heard, by_ns) for by_ns in (0, round(by_s * NS_PER_S)))
    return EntryTake(name, level, shift, score, performance, ticks / PPQ, beat_ticks, there - here >= _TOLD)


def beats_of(shift: str) -> float:
    """The number that a shift says."""
    return 0.5 if shift == "1/2" else float(shift)


def _met(score: Score, hits: NDArray[np.void], by_ns: int) -> float:
    """Share of all strokes and notes that meet if the strokes are meant so much earlier: F1 of pairs in order."""
    met = 0
    for piece in np.unique(hits["piece"]):
        due = np.sort(score.onset_ns[score.notes["piece"] == piece])
        at = np.sort(hits["at_ns"][hits["piece"] == piece]) - by_ns
        met += _in_order(due.tolist(), at.tolist())
    return 2 * met / max(len(score) + len(hits), 1)


def _in_order(due: list[int], at: list[int]) -> int:
    met = k = 0
    for stroke in at:
        while k < len(due) and due[k] < stroke - _NEAR_NS:
            k += 1
        if k < len(due) and due[k] <= stroke + _NEAR_NS:
            met, k = met + 1, k + 1
    return met
