"""The hi-hat's openness and grabbed cymbals, scored where the kit can tell them.

A kit tells openness by a pedal position or by the number of the note. Open and half open answer for each other, as
everywhere in the station; a closed hat for an open one does not, nor the other way round. A kit that only ever says
wide open or shut cannot tell half open. A kit that was never heard to send a choke, and of which nobody knows whether
it can, leaves open whether cymbals were grabbed.
"""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.technique.estimates import Estimate, figure
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.match_classes import match_classes

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

HALF_FROM, OPEN_FROM = 0.25, 0.75
"""Openness from which a hi-hat is half open, and open (our choice: the middles between 0, ½ and 1)."""

LATEST_CHOKE_MS = 250.0
"""A grab so far from where it is written is another one (our choice: an eighth at 120 bpm)."""


class Opening(IntEnum):
    """How open a hi-hat is, in words."""

    CLOSED = 0
    HALF = 1
    OPEN = 2


@dataclass(frozen=True, eq=False)
class HihatOpenness:
    """`written` strokes of the hi-hat that ask for an openness, `matched` ones, `judged` where the kit sent enough.

    `right` of the judged are as written, half open and open being one; `confusion` (3, 3) counts them, row = written,
    column = played. `openness` (by `Opening`) is what was played for each, 0 closed … 1 open.
    """

    written: int
    matched: int
    judged: int
    right: int
    confusion: NDArray[np.int64]
    openness: dict[Opening, Estimate]


@dataclass(frozen=True, slots=True)
class Chokes:
    """`written` grabs, those whose stroke was `matched`, of these `judged` could be told and `made` were.

    `ring_ms` how much longer than written the cymbals rang.
    """

    written: int
    matched: int
    judged: int
    made: int
    ring_ms: Estimate


def openings(openness: NDArray[np.generic]) -> NDArray[np.int64]:
    """The `Opening` of each openness (n,); NaN is `CLOSED`, look first."""
    values = np.nan_to_num(openness.astype(np.float64), nan=0.0)
    return np.digitize(values, (HALF_FROM, OPEN_FROM)).astype(np.int64)


def hat_faults(score: Score, performance: Performance, alignment: Alignment) -> tuple[Flags, Flags]:
    """Which notes (n,) had their openness judged, and which of these are wrong."""
    notes = score.notes
    asked = (notes["piece"] == Piece.HIHAT) & ~np.isnan(notes["openness"]) & (alignment.note_label == Label.MATCH)
    played = _of_hits(performance.hits["openness"], alignment)
    judged = asked & ~np.isnan(played)
    if not _sends_half(performance):
        judged &= openings(notes["openness"]) != Opening.HALF
    wrong = (openings(notes["openness"]) == Opening.CLOSED) != (openings(played) == Opening.CLOSED)
    return judged, judged & wrong


def hats(score: Score, performance: Performance, alignment: Alignment) -> HihatOpenness | None:
    """How the hi-hat's openness was kept; None for a score that asks for none."""
    notes = score.notes
    asked = (notes["piece"] == Piece.HIHAT) & ~np.isnan(notes["openness"]) & ~score.is_grace
    if not asked.any():
        return None
    judged, wrong = hat_faults(score, performance, alignment)
    written, played = openings(notes["openness"]), _of_hits(performance.hits["openness"], alignment)
    table = np.zeros((len(Opening), len(Opening)), np.int64)
    np.add.at(table, (written[judged], openings(played)[judged]), 1)
    shown = {k: judged & (written == k) for k in Opening}
    shares = {k: figure(played[here], notes["tick"][here]) for k, here in shown.items() if here.any()}
    matched = asked & (alignment.note_label == Label.MATCH)
    return HihatOpenness(
        int(asked.sum()), int(matched.sum()), int(judged.sum()), int((judged & ~wrong).sum()), table, shares
    )


def _of_hits(values: NDArray[np.generic], alignment: Alignment) -> Floats:
    """A hit's value for each note (n,), NaN where nobody answered."""
    own = np.full(len(alignment.note_label), np.nan)
    paired = alignment.hit_of_note >= 0
    own[paired] = values[alignment.hit_of_note[paired]]
    return own


def _sends_half(performance: Performance) -> bool:
    """Whether the kit was heard to say anything between shut and wide open."""
    openness = performance.hits["openness"][performance.hits["piece"] == Piece.HIHAT]
    openness = openness[~np.isnan(openness)]
    return bool(((openness > 0.0) & (openness < 1.0)).any())


# --- grabbed cymbals --------------------------------------------------------------------------------------------------


def choke_faults(
    score: Score, performance: Performance, alignment: Alignment, tells: bool | None
) -> tuple[Flags, Flags, Floats]:
    """Which notes (n,) had their grab judged, which of these were not grabbed, and how much longer they rang in ms."""
    asked = (score.notes["choke_ticks"] > 0) & (alignment.note_label == Label.MATCH)
    can_tell = tells if tells is not None else len(performance.chokes) > 0
    judged, ring_ms = asked & bool(can_tell), np.full(len(score), np.nan)
    classes = match_classes()
    grab_class, grab_ns = classes[performance.chokes["piece"]], _score_ns(performance, alignment)
    for row in np.flatnonzero(judged).tolist():
        note, hit = score.notes[row], int(alignment.hit_of_note[row])
        rang_ns = grab_ns[grab_class == classes[performance.hits["piece"][hit]]] - alignment.hit_score_ns[hit]
        start, end = score.tempo_map.ns_at(np.array([note["tick"], note["tick"] + note["choke_ticks"]])).tolist()
        longer = (rang_ns[rang_ns > 0] - (end - start)) / NS_PER_MS
        if len(longer) and abs(nearest := float(longer[np.argmin(np.abs(longer))])) <= LATEST_CHOKE_MS:
            ring_ms[row] = nearest
    return judged, judged & np.isnan(ring_ms), ring_ms


def chokes(score: Score, performance: Performance, alignment: Alignment, tells: bool | None) -> Chokes | None:
    """How cymbals were grabbed; None for a score that asks for none. `tells`: whether the kit can say, None unknown."""
    asked = score.notes["choke_ticks"] > 0
    if not asked.any():
        return None
    judged, missed, ring_ms = choke_faults(score, performance, alignment, tells)
    made = judged & ~missed
    counts = (asked, asked & (alignment.note_label == Label.MATCH), judged, made)
    written, matched, known, grabbed = (int(each.sum()) for each in counts)
    return Chokes(written, matched, known, grabbed, figure(ring_ms[made], score.notes["tick"][made]))


def _score_ns(performance: Performance, alignment: Alignment) -> Floats:
    """Score time of each grab, between the hits around it; beyond the last hit time goes on as written."""
    at_ns, grabs = performance.hits["at_ns"], performance.chokes["at_ns"]
    if not len(at_ns):
        return grabs.astype(np.float64)
    before = np.maximum(np.searchsorted(at_ns, grabs, side="right") - 1, 0)
    after = np.minimum(before + 1, len(at_ns) - 1)
    gap, passed = at_ns[after] - at_ns[before], alignment.hit_score_ns[after] - alignment.hit_score_ns[before]
    same = (gap > 0) & (passed > 0) & (alignment.segment[after] == alignment.segment[before])
    pace = np.where(same, passed / np.where(gap > 0, gap, 1), 1.0)
    return np.asarray(alignment.hit_score_ns[before] + (grabs - at_ns[before]) * pace)
