"""The strokes of a take that a teacher may judge otherwise: notes that were asked for, and hits too many."""

from dataclasses import dataclass

import numpy as np

from station.music.judgement import Label
from station.practice.session.session import SessionResult
from station.scenes.hit_table import EveryHit, beat_label
from station.scoring.matching.right import right_notes


@dataclass(frozen=True, slots=True)
class StrokeLine:
    """One stroke in words, within its bar; `is_right` is how it was judged.

    `note` or `hit` is its index in the session's pairs.csv.

    `bar`, of the lesson, and `pass_number` count from 1.
    """

    words: str
    bar: int
    pass_number: int
    is_right: bool
    note: int | None = None
    hit: int | None = None


def stroke_lines(result: SessionResult, hits: EveryHit) -> tuple[StrokeLine, ...]:
    """All strokes of `result`, whose dots are `hits`: its notes in their order, then the hits too many."""
    right = right_notes(result.score, result.alignment, result.plan.level.windows).tolist()
    extra = np.flatnonzero(result.alignment.hit_label == Label.EXTRA).tolist()
    places = [*((note, None) for note in range(len(right))), *((None, hit) for hit in extra)]
    return tuple(
        StrokeLine(
            beat_label(dot, hits.on_time_ms),
            int(dot["bar"]),
            int(dot["pass"]),
            note is not None and right[note],
            note,
            hit,
        )
        for dot, (note, hit) in zip(hits.dots, places, strict=True)
    )
