"""Rolls: open ones by their evenness, buzz rolls by start, end, continuity and shape, never by count.

An *open roll* is a run of strokes on one drum, evenly written and faster than one hand plays singles. Its evenness is
the scatter of the played intervals, each as a share of the written one. In doubles the second stroke is told apart: how
far it lies from the middle between the stroke before and the one after it, and how much softer it is than the first.

A *buzz* is one note; the hits of its piece that follow the press and answer no other note are its bounces. It lasts
until the next bounce would have come. It has a hole where the next bounce takes much longer than the others did; its
shape is how much louder its second half is than its first, the press left out. A module that sends one hit a buzz tells
nothing of all that.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import TOMS, Articulation, Piece
from station.core.units import NS_PER_MS
from station.music import passages
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.loudness import level_db
from station.scoring.analysis.technique.estimates import Estimate, Scatter, figure, scatter
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.ignored_hits import BUZZ_REACH_NS

Indices = NDArray[np.int64]

DRUMS = (Piece.SNARE, *TOMS)
SLOWEST_MS = 250.0
"""Beyond, one hand plays singles at ease (HUMANS: 5–7 strokes a second at most) and nothing rolls (our choice)."""
LEAST_STROKES = 5
"""The shortest rudimental roll has five strokes (PAS 40, number 7)."""
_EVENLY = 0.02
"""Written intervals that differ by so much are one interval: ticks are rounded."""

HOLE_GAPS, LEAST_HOLE_MS = 2.5, 60.0
"""A gap so many times the usual one, and no less than the second, is a hole (our choice: two bounces are missing, and
it is long enough to hear strokes apart)."""
_FEWEST_BOUNCES = 2
_FEWEST_FOR_SHAPE = 4


@dataclass(frozen=True, slots=True)
class OpenRolls:
    """`rolls` written and how even they were.

    `intervals_pct` the scatter of the intervals in percent of the written ones; second strokes of doubles against the
    middle between their neighbours (`second_ms`), and against the first stroke beyond what is written (`second_db`).
    """

    rolls: int
    intervals_pct: Scatter
    second_ms: Estimate
    second_db: Estimate


@dataclass(frozen=True, slots=True)
class BuzzRolls:
    """`written` buzzes, of which `heard` have a press; the rest is None or empty where the kit sends no bounces.

    `start_ms` and `end_ms` played − written; `continuous` of `judged` buzzes have no hole; `longest_gap_ms` between two
    bounces; `shape_db` the second half's level less the first's. `tells_bounces` whether the kit sends any.
    """

    written: int
    heard: int
    tells_bounces: bool
    start_ms: Estimate
    end_ms: Estimate
    judged: int
    continuous: int | None
    longest_gap_ms: float | None
    shape_db: Estimate


def open_rolls(score: Score, performance: Performance, alignment: Alignment) -> OpenRolls | None:
    """How even the open rolls are; None for a score without any."""
    runs = open_roll_runs(score)
    if not runs:
        return None
    timed = timed_notes(score, alignment)
    shares, run_of, slot = [], [], []
    for k, run in enumerate(runs):
        both = timed[run[:-1]] & timed[run[1:]]
        written, played = np.diff(score.onset_ns[run]), np.diff(score.onset_ns[run] + alignment.asynchrony_ns[run])
        shares.append((100 * played / written)[both])
        run_of.append(np.full(int(both.sum()), k))
        slot.append(score.notes["tick"][run[1:]][both])
    intervals = scatter(np.concatenate(shares), np.concatenate(run_of), np.concatenate(slot))
    return OpenRolls(len(runs), intervals, *_seconds(score, performance, alignment, runs))


def open_roll_runs(score: Score) -> list[Indices]:
    """The rows of each open roll, in order."""
    notes, runs = score.notes, []
    for piece in DRUMS:
        own = np.flatnonzero((notes["piece"] == piece) & ~score.is_grace & (notes["articulation"] != Articulation.BUZZ))
        gaps = np.diff(score.onset_ns[own]) / NS_PER_MS
        changes = np.abs(np.diff(gaps)) > _EVENLY * gaps[:-1]
        start = 0
        for k in range(len(gaps)):
            ends = k + 1 == len(gaps) or changes[k]
            if ends:
                run = own[start : k + 2]
                if len(run) >= LEAST_STROKES and 0 < gaps[k] <= SLOWEST_MS:
                    runs.append(run)
                start = k + 1
    return sorted(runs, key=lambda run: int(run[0]))


def _seconds(
    score: Score, performance: Performance, alignment: Alignment, runs: list[Indices]
) -> tuple[Estimate, Estimate]:
    """How second strokes of doubles stand in time and loudness."""
    second = passages.second_of_doubles(score)
    off, timed = asynchrony_ms(alignment), timed_notes(score, alignment)
    level = np.full(len(score), np.nan)
    level[timed] = level_db(performance.fine_velocity[alignment.hit_of_note[timed]])
    level -= level_db(score.notes["velocity"])
    off[~timed] = np.nan
    trios = np.concatenate([np.stack([run[:-2], run[1:-1], run[2:]], 1) for run in runs])
    trios = trios[second[trios[:, 1]]]
    ticks = score.notes["tick"][trios[:, 1]]
    in_ms = off[trios[:, 1]] - (off[trios[:, 0]] + off[trios[:, 2]]) / 2
    return figure(in_ms, ticks), figure(level[trios[:, 1]] - level[trios[:, 0]], ticks)


# --- buzz rolls -------------------------------------------------------------------------------------------------------


def buzz_rolls(score: Score, performance: Performance, alignment: Alignment) -> BuzzRolls | None:
    """How the buzz rolls went; None for a score without any."""
    rows = np.flatnonzero((score.notes["articulation"] == Articulation.BUZZ) & ~score.is_grace)
    if not len(rows):
        return None
    heard = rows[alignment.note_label[rows] == Label.MATCH]
    hits = [_hits_of_buzz(score, performance, alignment, int(row)) for row in heard]
    sending = {int(score.notes["piece"][r]) for r, h in zip(heard, hits, strict=True) if len(h) > _FEWEST_BOUNCES}
    judged = [i for i, row in enumerate(heard) if int(score.notes["piece"][row]) in sending]
    bounced = [i for i in judged if len(hits[i]) > _FEWEST_BOUNCES]
    gaps = {i: np.diff(performance.hits["at_ns"][hits[i]]) / NS_PER_MS for i in bounced}
    whole = sum(_has_no_hole(gaps[i]) for i in bounced)
    ticks = score.notes["tick"]
    ends = np.array([_end_ms(score, alignment, int(heard[i]), hits[i], gaps[i]) for i in bounced])
    shapes = np.array([_shape_db(performance, hits[i]) for i in bounced])
    return BuzzRolls(
        written=len(rows),
        heard=len(heard),
        tells_bounces=bool(sending),
        start_ms=figure(asynchrony_ms(alignment)[heard], ticks[heard]),
        end_ms=figure(ends, ticks[heard[bounced]]),
        judged=len(judged),
        continuous=int(whole) if judged else None,
        longest_gap_ms=max((float(gap.max()) for gap in gaps.values()), default=None),
        shape_db=figure(shapes, ticks[heard[bounced]]),
    )


def _hits_of_buzz(score: Score, performance: Performance, alignment: Alignment, row: int) -> Indices:
    """The press and its bounces: hits of its piece up to the next that answers a note, in order."""
    note, press = score.notes[row], int(alignment.hit_of_note[row])
    end_ns = int(score.tempo_map.ns_at(int(note["tick"] + note["duration_ticks"]))) + BUZZ_REACH_NS
    mine = [press]
    for hit in range(press + 1, len(performance)):
        if alignment.hit_score_ns[hit] > end_ns or alignment.segment[hit] != alignment.segment[press]:
            break
        if performance.hits["piece"][hit] == performance.hits["piece"][press]:
            if alignment.note_of_hit[hit] >= 0:
                break
            mine.append(hit)
    return np.array(mine)


def _has_no_hole(gaps_ms: NDArray[np.float64]) -> bool:
    return bool(gaps_ms.max() <= max(HOLE_GAPS * float(np.median(gaps_ms)), LEAST_HOLE_MS))


def _end_ms(score: Score, alignment: Alignment, row: int, hits: Indices, gaps_ms: NDArray[np.float64]) -> float:
    """Where the next bounce would have come, less the written end."""
    note = score.notes[row]
    written_ns = int(score.tempo_map.ns_at(int(note["tick"] + note["duration_ticks"])))
    return float(alignment.hit_score_ns[hits[-1]] - written_ns) / NS_PER_MS + float(np.median(gaps_ms))


def _shape_db(performance: Performance, hits: Indices) -> float:
    """Second half of the bounces less the first in dB; NaN of too few."""
    bounces = level_db(performance.fine_velocity[hits[1:]])
    half = len(bounces) // 2
    return float(bounces[-half:].mean() - bounces[:half].mean()) if len(bounces) >= _FEWEST_FOR_SHAPE else np.nan
