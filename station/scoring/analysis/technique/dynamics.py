"""Dynamics: each pad's own classes, their contrast, evenness, the balance of the hands, crescendos.

Levels are in dB, 40·log10(velocity/127) (HUMANS), and compared on one pad with this player's own strokes there, so that
pads and students may differ. Contrast is judged on marked notes and the unmarked ones beside them alone; evenness is
what is left of unmarked strokes when pad and place in the bar are taken out, for shaping a repeated hat strong–weak is
free. A crescendo is a run on one piece whose written loudness only rises (or only falls).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Dynamic, Piece
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.loudness import judged_notes, level_db
from station.scoring.analysis.sparse_model import Effect
from station.scoring.analysis.technique.estimates import Estimate, Scatter, difference, figure, scatter
from station.scoring.analysis.timing_spread import MIN_SLOTS, slope
from station.scoring.matching.alignment import Alignment

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

LEAST_STROKES, LEAST_RISE_DB, LEAST_STEPS = 6, 6.0, 4
"""A crescendo has so many strokes, rises by so much and in so many steps (our choice: mf to f, no single accent)."""


@dataclass(frozen=True, slots=True)
class Contrast:
    """How much louder `loud` strokes were than `soft` ones of the pad: `played_db` with interval, and as written."""

    piece: Piece
    loud: Dynamic
    soft: Dynamic
    strokes: tuple[int, int]
    played_db: float
    ci: tuple[float, float] | None
    written_db: float


@dataclass(frozen=True, slots=True)
class Balance:
    """By how many dB the left hand is louder, pads and marks apart (`habits`), its interval, over so many slots."""

    louder_db: float
    ci: tuple[float, float]
    slots: int


@dataclass(frozen=True, slots=True)
class Crescendo:
    """A written rise or fall (`written_db` signed) over `bars` (first, last, from 0) on `piece`.

    `played_db` the same by the line fitted to what was played, with its interval; `bend_db` how much louder its middle
    third was than its ends, beyond what is written: negative, it came late. None of fewer than `LEAST_STROKES` heard.
    """

    piece: Piece
    bars: tuple[int, int]
    strokes: int
    written_db: float
    played_db: float | None
    ci: tuple[float, float] | None
    bend_db: float | None


@dataclass(frozen=True, eq=False)
class PadDynamics:
    """`own` level in dB of each class on each pad; contrasts; evenness; crescendos in order.

    `left_less_right` the left hand's strokes against the right hand's; None where no sticking is written.
    """

    own: Mapping[Piece, Mapping[Dynamic, Estimate]]
    contrasts: tuple[Contrast, ...]
    evenness_db: Scatter
    crescendos: tuple[Crescendo, ...]
    left_less_right: Balance | None


def pad_dynamics(score: Score, performance: Performance, alignment: Alignment, hands: Effect | None) -> PadDynamics:
    """The dynamics of what was matched, no grace strokes; `hands` is what `habits` says of the left hand's level."""
    heard = (alignment.note_label == Label.MATCH) & ~score.is_grace
    level = np.full(len(score), np.nan)
    level[heard] = level_db(performance.fine_velocity[alignment.hit_of_note[heard]])
    return PadDynamics(
        _own(score, level, heard),
        _contrasts(score, level, heard & judged_notes(score)),
        _evenness(score, level, heard),
        tuple(_crescendo(score, level, rows) for rows in crescendo_runs(score)),
        _balance(hands),
    )


def _balance(hands: Effect | None) -> Balance | None:
    if hands is None or hands.slots <= MIN_SLOTS:
        return None
    return Balance(hands.value, hands.ci, hands.slots)


def _own(score: Score, level: Floats, heard: Flags) -> dict[Piece, dict[Dynamic, Estimate]]:
    notes = score.notes
    table: dict[Piece, dict[Dynamic, Estimate]] = {}
    for piece in np.unique(notes["piece"][heard]).tolist():
        for dynamic in Dynamic:
            here = heard & (notes["piece"] == piece) & (notes["dynamic"] == dynamic)
            if here.any():
                table.setdefault(Piece(piece), {})[dynamic] = figure(level[here], notes["tick"][here])
    return table


def _contrasts(score: Score, level: Floats, judged: Flags) -> tuple[Contrast, ...]:
    notes, found = score.notes, []
    for piece in np.unique(notes["piece"][judged]).tolist():
        own = {d: np.flatnonzero(judged & (notes["piece"] == piece) & (notes["dynamic"] == d)) for d in Dynamic}
        classes = [d for d in (Dynamic.ACCENT, Dynamic.NORMAL, Dynamic.GHOST) if len(own[d])]
        for loud, soft in pairwise(classes):
            found.append(_contrast(score, level, Piece(piece), (loud, own[loud]), (soft, own[soft])))
    return tuple(found)


def _contrast(
    score: Score, level: Floats, piece: Piece, loud: tuple[Dynamic, Indices], soft: tuple[Dynamic, Indices]
) -> Contrast:
    one, other = (figure(level[rows], score.notes["tick"][rows]) for rows in (loud[1], soft[1]))
    assert one.mean is not None, "a class without strokes is left out"
    assert other.mean is not None, "a class without strokes is left out"
    written = level_db(score.notes["velocity"])
    return Contrast(
        piece,
        loud[0],
        soft[0],
        (one.count, other.count),
        one.mean - other.mean,
        difference(one, other),
        float(written[loud[1]].mean() - written[soft[1]].mean()),
    )


def _evenness(score: Score, level: Floats, heard: Flags) -> Scatter:
    """What is left of unmarked strokes when pad and place in the bar are taken out."""
    notes = score.notes
    plain = heard & (notes["dynamic"] == Dynamic.NORMAL) & (notes["articulation"] != Articulation.BUZZ)
    rows = np.flatnonzero(plain & ~_in_crescendo(score))
    starts = np.array([score.tempo_map.bar_start(bar) for bar in np.unique(score.bar[rows]).tolist()], np.int64)
    within = notes["tick"][rows] - starts[np.unique(score.bar[rows], return_inverse=True)[1]] if len(rows) else rows
    places = np.stack([within, notes["piece"][rows], notes["velocity"][rows]], 1).astype(np.int64)
    group = np.unique(places, axis=0, return_inverse=True)[1].reshape(-1) if len(rows) else rows
    return scatter(level[rows], group, notes["tick"][rows])


# --- crescendos -------------------------------------------------------------------------------------------------------


def crescendo_runs(score: Score) -> list[Indices]:
    """The rows of each written crescendo and diminuendo, in order."""
    found = []
    written = level_db(score.notes["velocity"])
    for piece in np.unique(score.notes["piece"]).tolist():
        own = np.flatnonzero((score.notes["piece"] == piece) & ~score.is_grace)
        step = np.sign(np.diff(written[own]))
        start, way = 0, 0.0
        for k in range(len(step) + 1):
            turns = k < len(step) and step[k] != 0 and way != 0 and step[k] != way
            if turns or k == len(step):
                found += _trimmed(own[start : k + 1], written)
                start, way = k, 0.0
            if k < len(step) and step[k] != 0:
                way = float(step[k])
    return sorted(found, key=lambda rows: int(rows[0]))


def _trimmed(run: Indices, written: Floats) -> list[Indices]:
    """The run without the level segments at its ends, if it is a crescendo."""
    moves = np.flatnonzero(np.diff(written[run]) != 0)
    if not len(moves):
        return []
    run = run[moves[0] : moves[-1] + 2]
    rises = abs(float(written[run[-1]] - written[run[0]])) >= LEAST_RISE_DB
    return [run] if rises and len(run) >= LEAST_STROKES and len(moves) >= LEAST_STEPS else []


def _in_crescendo(score: Score) -> Flags:
    inside = np.zeros(len(score), np.bool_)
    for rows in crescendo_runs(score):
        inside[rows] = True
    return inside


def _crescendo(score: Score, level: Floats, rows: Indices) -> Crescendo:
    written = level_db(score.notes["velocity"])
    rise = float(written[rows[-1]] - written[rows[0]])
    place = Piece(score.notes["piece"][rows[0]]), (int(score.bar[rows[0]]), int(score.bar[rows[-1]]))
    heard = rows[~np.isnan(level[rows])]
    share = slope(written[heard], level[heard])  # 1 as written
    if len(heard) < LEAST_STROKES or share is None:
        return Crescendo(*place, len(heard), rise, None, None, None)
    ci = None if share.ci is None else (min(rise * end for end in share.ci), max(rise * end for end in share.ci))
    return Crescendo(*place, len(heard), rise, rise * share.value, ci, _bend(level[heard] - written[heard]))


def _bend(off: Floats) -> float:
    """Middle third of what was played beyond what is written, less its ends."""
    third = len(off) // 3
    return float(off[third : len(off) - third].mean() - (off[:third].mean() + off[len(off) - third :].mean()) / 2)
