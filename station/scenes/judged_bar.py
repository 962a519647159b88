"""What became of one bar as somebody played it: each judgement with the stroke that it is about, in the bar's time.

The bar of a session that is over is judged as its report has it; that of an earlier one, of which only the strokes are
left, by the same alignment over the bar alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.music.judgement import Judgement, Label
from station.music.performance import Performance
from station.music.score import Score
from station.practice.session.session import SessionResult
from station.render.snapshot import ExtraHit, mark, no_marks
from station.scoring.align import align
from station.scoring.matching.alignment import Alignment, judgements


@dataclass(frozen=True, slots=True)
class JudgedStroke:
    """A `judgement` whose note counts from the bar's first, and the hit that it is about, None for a miss.

    `at_ns` from the bar's beginning, `piece` what was struck.
    """

    judgement: Judgement
    at_ns: int | None
    piece: Piece | None


def own_bar(result: SessionResult, bar: int) -> list[JudgedStroke]:
    """The `bar`, from 0, of the result's score, judged as in its report."""
    tempo_map = result.score.tempo_map
    ticks = [tempo_map.bar_start(bar), tempo_map.bar_start(bar + 1)]
    first, after = np.searchsorted(result.score.notes["tick"], ticks).tolist()
    start_ns, end_ns = (int(ns) for ns in tempo_map.ns_at(ticks))
    found = []
    for stroke in _judged(result.score, result.performance, result.alignment):
        note, at_ns = stroke.judgement.note_index, stroke.at_ns
        if note is not None and first <= note < after:
            own = replace(stroke.judgement, note_index=note - first)
            found.append(JudgedStroke(own, None if at_ns is None else at_ns - start_ns, stroke.piece))
        elif note is None and at_ns is not None and start_ns <= at_ns < end_ns:
            found.append(JudgedStroke(stroke.judgement, at_ns - start_ns, stroke.piece))
    return found


def played_bar(score: Score, performance: Performance) -> list[JudgedStroke]:
    """A bar, `score`, judged by itself as it was played from its beginning on."""
    return _judged(score, performance, align(score, performance, clocked=True))


def _judged(score: Score, performance: Performance, alignment: Alignment) -> list[JudgedStroke]:
    at_ns, pieces = performance.hits["at_ns"].tolist(), performance.hits["piece"].tolist()
    return [
        JudgedStroke(said, None, None)
        if said.hit_index is None
        else JudgedStroke(said, at_ns[said.hit_index], Piece(pieces[said.hit_index]))
        for said in judgements(score, performance, alignment)
    ]


def marks_of(score: Score, strokes: Sequence[JudgedStroke], loudness: bool) -> NDArray[np.void]:
    """The marks of the bar's notes, dtype `MARK_DTYPE`; without `loudness` nothing is said of how hard they were."""
    marks = no_marks(score)
    for stroke in strokes:
        mark(marks, stroke.judgement, loudness)
    return marks


def extras_of(strokes: Sequence[JudgedStroke]) -> tuple[ExtraHit, ...]:
    """The strokes too many."""
    return tuple(
        ExtraHit(stroke.at_ns / NS_PER_S, stroke.piece)
        for stroke in strokes
        if stroke.judgement.label is Label.EXTRA and stroke.at_ns is not None and stroke.piece is not None
    )
