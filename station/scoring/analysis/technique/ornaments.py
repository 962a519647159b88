"""Flams and drags: how far the grace strokes lead, how steadily, how softly, and by which hand.

The main stroke carries the time and is judged like any other; here is only what belongs to the ornament. A good grace
stroke is softer than its main stroke and leads by much the same each time. How far is the hand's choice: HUMANS has
flams of 15–40 ms and drags whose strokes are 40–70 ms apart, which is told and not demanded. Hands are known only where
the sticks say who struck.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Ornament
from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.loudness import level_db
from station.scoring.analysis.technique.estimates import Estimate, figure
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.played_graces import main_of_grace

USUAL_MS: Mapping[Ornament, tuple[float, float]] = MappingProxyType(
    {Ornament.FLAM: (15.0, 40.0), Ornament.DRAG: (40.0, 70.0)}
)
"""How far the strokes of an ornament are usually apart (HUMANS, Timing)."""


@dataclass(frozen=True, slots=True)
class Ornaments:
    """All flams, or all drags.

    `graces` written, `heard` with their main stroke. `spacing_ms` from each grace stroke to the next stroke of its
    ornament, and how many of them lie within `USUAL_MS`. `level_db` grace less main stroke, `softer` so many of the
    heard are softer. `hand_order`: so many of so many whose hands are known were led by the written one; None if none.
    """

    graces: int
    heard: int
    spacing_ms: Estimate
    usual: int
    level_db: Estimate
    softer: int
    hand_order: tuple[int, int] | None


def ornaments(score: Score, performance: Performance, alignment: Alignment) -> dict[Ornament, Ornaments]:
    """What there is to say of each kind of ornament that the score has."""
    main = main_of_grace(score)
    kinds = np.unique(score.notes["ornament"][main >= 0]).tolist()
    return {
        Ornament(kind): _of_kind(score, performance, alignment, main, Ornament(kind))
        for kind in kinds
        if Ornament(kind) in USUAL_MS
    }


def loud_graces(score: Score, performance: Performance, alignment: Alignment) -> NDArray[np.bool_]:
    """Which grace strokes (n,) were as loud as their main stroke or louder, where they are written softer."""
    loud, graces = np.zeros(len(score), np.bool_), np.flatnonzero(score.is_grace)
    if not len(graces):
        return loud
    main, matched = main_of_grace(score), alignment.note_label == Label.MATCH
    graces = graces[(main[graces] >= 0) & matched[graces] & matched[main[graces]]]
    graces = graces[score.notes["velocity"][graces] < score.notes["velocity"][main[graces]]]
    played, hit = performance.fine_velocity, alignment.hit_of_note
    loud[graces] = played[hit[graces]] >= played[hit[main[graces]]]
    return loud


def _of_kind(
    score: Score, performance: Performance, alignment: Alignment, main: NDArray[np.int64], kind: Ornament
) -> Ornaments:
    graces = np.flatnonzero((main >= 0) & (score.notes["ornament"] == kind))
    matched, ticks = alignment.note_label == Label.MATCH, score.notes["tick"]
    heard = graces[matched[graces] & matched[main[graces]]]
    hits, hit = performance.hits, alignment.hit_of_note
    following = np.where(np.roll(main, -1)[heard] == main[heard], heard + 1, main[heard])
    spacing, known = np.full(len(heard), np.nan), matched[following]
    spacing[known] = (hits["at_ns"][hit[following[known]]] - hits["at_ns"][hit[heard[known]]]) / NS_PER_MS
    low, high = USUAL_MS[kind]
    limbs = np.full(len(score), Limb.UNKNOWN, np.int8)
    limbs[matched] = hits["limb"][hit[matched]]
    level = level_db(performance.fine_velocity)
    softness = level[hit[heard]] - level[hit[main[heard]]]
    return Ornaments(
        graces=len(graces),
        heard=len(heard),
        spacing_ms=figure(spacing, ticks[heard]),
        usual=int(((spacing >= low) & (spacing <= high)).sum()),
        level_db=figure(softness, ticks[heard]),
        softer=int((softness < 0).sum()),
        hand_order=_hand_order(score.notes["limb"], limbs, main, heard),
    )


def _hand_order(
    written: NDArray[np.int8], played: NDArray[np.int8], main: NDArray[np.int64], heard: NDArray[np.int64]
) -> tuple[int, int] | None:
    """Of the grace strokes whose own and main hands are both written and known: how many are as written, and all."""
    mains = main[heard]
    strokes = np.stack([written[heard], written[mains], played[heard], played[mains]])
    known = (strokes != Limb.UNKNOWN).all(axis=0)
    right = known & (strokes[0] == strokes[2]) & (strokes[1] == strokes[3])
    return (int(right.sum()), int(known.sum())) if known.any() else None
