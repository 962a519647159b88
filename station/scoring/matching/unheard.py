"""Moments in which no stroke could be heard: what nobody answered in them is unknown, and counts neither way.

An engine that was killed, or a kit that was unplugged, hears nothing until it is back. A note that was answered all the
same is judged as ever; of one without a hit nobody knows whether it was played.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.music.score import Score
from station.scoring.matching.alignment import Alignment

Span = tuple[int, int]
"""From and until when, in ns of score time."""
STRAY_NS = 70 * NS_PER_MS
"""A stroke may lie so far from its note (HUMANS and `analysis.points`: from 70 ms on nobody calls it theirs)."""

Flags = NDArray[np.bool_]


def notes_within(score: Score, spans: Sequence[Span]) -> Flags:
    """Which notes (n,) may have been played within one of `spans`."""
    within = np.zeros(len(score), np.bool_)
    for begin_ns, end_ns in spans:
        within |= (score.onset_ns >= begin_ns - STRAY_NS) & (score.onset_ns <= end_ns + STRAY_NS)
    return within


def merged(spans: Iterable[Span]) -> tuple[Span, ...]:
    """The spans in order, those that overlap or touch as one."""
    found: list[Span] = []
    for begin_ns, end_ns in sorted(spans):
        if found and begin_ns <= found[-1][1]:
            found[-1] = (found[-1][0], max(end_ns, found[-1][1]))
        else:
            found.append((begin_ns, end_ns))
    return tuple(found)


def between_hits(alignment: Alignment, hit_ns: NDArray[np.int64], span: Span) -> Span:
    """The part of the score between the last of the hits (m,) before `span` and the first after it.

    `hit_ns` (m,) and `span` are on one axis: for a player without a click, whose hits alone say where they were.
    """
    begin, end = np.searchsorted(hit_ns, span[0], "right"), np.searchsorted(hit_ns, span[1])
    place = alignment.hit_score_ns
    after = int(place[end]) if end < len(place) else int(place[-1]) + span[1] - span[0] if len(place) else span[1]
    return (int(place[begin - 1]) if begin else span[0]), after


def with_unknown(alignment: Alignment, within: Flags) -> Alignment:
    """The alignment in which the missed notes of `within` (n,) are unknown."""
    unknown = within & (alignment.note_label == Label.MISS)
    label = np.where(unknown, Label.UNKNOWN, alignment.note_label).astype(np.uint8)
    return replace(alignment, note_label=label) if unknown.any() else alignment


def known_part(score: Score, alignment: Alignment) -> tuple[Score, Alignment, Flags]:
    """The score and its alignment without the unknown notes, and which of the notes (n,) are left."""
    known = alignment.note_label != Label.UNKNOWN
    if known.all():
        return score, alignment, known
    new_row = np.cumsum(known) - 1
    note_of_hit = alignment.note_of_hit
    return (
        replace(score, notes=score.notes[known]),
        replace(
            alignment,
            hit_of_note=alignment.hit_of_note[known],
            note_of_hit=np.where(note_of_hit >= 0, new_row[note_of_hit], -1),
            note_label=alignment.note_label[known],
            asynchrony_ns=alignment.asynchrony_ns[known],
        ),
        known,
    )
