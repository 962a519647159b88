"""What the kit or the data leave open: one entry a matter, with how many strokes it concerns and why.

Of notes that nobody answered and that the kit might have swallowed it is unknown whether they were played. Two things
swallow strokes. A pad sends nothing below its threshold: a written ghost beneath the measured one may have
been played. And for its mask time after a stroke a pad hears no other (PEERS: 6 ms, 7–9 by pad): the second bounce of a
double, or the main stroke's grace, may have fallen into it where the student's other ones come nearly as close. What a
pad was heard to tell apart in this performance, it can tell apart.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Piece
from station.core.units import NS_PER_MS
from station.music import passages
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.technique.technique import Technique
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.slow_drift import robust_sd

USUAL_MASK_MS = 9.0
"""The longest that PEERS names; what is taken for a kit of which nobody has measured it."""

_NEAR_SDS = 2.0
"""So many SDs below the usual gap one stroke in forty falls."""

_FEWEST_GAPS = 4


class Swallowed(IntEnum):
    """Why it is unknown whether a note was played."""

    NO = 0
    THRESHOLD = 1
    MASK = 2


@dataclass(frozen=True, slots=True)
class KitFacts:
    """What is known of the student's kit, by measurement.

    `threshold` of a pad: the least velocity that it sends; `mask_ms` how long after a stroke it hears none;
    `tells_chokes` whether it sends them, None where that shows only in the playing.
    """

    threshold: Mapping[Piece, int] = field(default_factory=lambda: MappingProxyType({}))
    mask_ms: float = USUAL_MASK_MS
    tells_chokes: bool | None = None


def swallowed_notes(score: Score, performance: Performance, alignment: Alignment, kit: KitFacts) -> NDArray[np.uint8]:
    """`Swallowed` of each note (n,): `NO` for all that were answered and for what was surely left out."""
    swallowed = np.full(len(score), Swallowed.NO, np.uint8)
    missed, notes = alignment.note_label == Label.MISS, score.notes
    for piece, least in kit.threshold.items():
        soft = (notes["piece"] == piece) & (notes["dynamic"] == Dynamic.GHOST) & (notes["velocity"] < least)
        swallowed[missed & soft] = Swallowed.THRESHOLD
    close = _close_followers(score)
    if len(close) and missed.any():
        for piece in np.unique(notes["piece"][close[:, 1]]).tolist():
            pairs = close[notes["piece"][close[:, 1]] == piece]
            mask_ms = min(kit.mask_ms, _closest_ms(performance, piece))
            for kind in (True, False):
                own = pairs[score.is_grace[pairs[:, 0]] == kind]
                if len(own) and _nearest_usual_ms(score, performance, alignment, own) < mask_ms:
                    lost = own[missed[own].sum(axis=1) == 1]  # the other one was heard
                    swallowed[lost[missed[lost]]] = Swallowed.MASK
    return swallowed


def _close_followers(score: Score) -> NDArray[np.int64]:
    """Pairs (k, 2) of rows that one drop of the hands plays: grace and what follows it, first and second of doubles."""
    notes, second = score.notes, passages.second_of_doubles(score)
    order = np.lexsort((score.onset_ns, notes["piece"]))
    before, after = order[:-1], order[1:]
    same = notes["piece"][before] == notes["piece"][after]
    led = score.is_grace[before] & (notes["tick"][before] == notes["tick"][after])
    doubled = second[after] & ~score.is_grace[before] & ~score.is_grace[after]
    pairs: NDArray[np.int64] = np.stack([before, after], 1)[same & (led | doubled)]
    return pairs


def _closest_ms(performance: Performance, piece: int) -> float:
    """The smallest gap between two hits of a piece that were heard apart."""
    gaps = np.diff(performance.hits["at_ns"][performance.hits["piece"] == piece])
    return float(gaps.min()) / NS_PER_MS if len(gaps) else np.inf


def _nearest_usual_ms(score: Score, performance: Performance, alignment: Alignment, pairs: NDArray[np.int64]) -> float:
    """How close the two strokes of a pair come with this student, but for one in forty."""
    written = np.diff(score.onset_ns[pairs], axis=1)[:, 0] / NS_PER_MS
    heard = (alignment.note_label[pairs] == Label.MATCH).all(axis=1)
    played = np.diff(performance.hits["at_ns"][alignment.hit_of_note[pairs[heard]]], axis=1)[:, 0] / NS_PER_MS
    if len(played) < _FEWEST_GAPS:
        return float(written.min())
    usual = float(np.median(written) + np.median(played - written[heard]))
    return usual - _NEAR_SDS * (robust_sd(played - written[heard]) or 0.0)


@dataclass(frozen=True, slots=True)
class Unobservable:
    """`count` strokes, rolls … of which `what` is unknown, and why; `judged`: else it would have been scored."""

    what: str
    count: int
    why: str
    judged: bool = True


_CLOCK_OR_HAND = "whether your inner clock or your hands are what scatters"


def unobservable(technique: Technique, swallowed: NDArray[np.uint8]) -> tuple[Unobservable, ...]:
    """All that the kit or the data leave open; `swallowed` (n,) of the notes."""
    said = [
        Unobservable(what, int((swallowed == kind).sum()), why)
        for kind, what, why in (
            (Swallowed.THRESHOLD, "whether ghost notes were played", "they are written below the pad's threshold"),
            (Swallowed.MASK, "whether second strokes were played", "the pad hears none so soon after the first"),
        )
    ]
    if technique.buzz_rolls is not None and not technique.buzz_rolls.tells_bounces:
        said.append(Unobservable("how buzz rolls went on", technique.buzz_rolls.heard, "the kit sent one hit for each"))
    for found in technique.ornaments.values():
        if found.hand_order is None:
            said.append(Unobservable("which hand led", found.heard, "nothing says which stick struck", False))
            break
    if technique.hats is not None:
        unsaid = technique.hats.matched - technique.hats.judged
        said.append(Unobservable("how open the hi-hat was", unsaid, "the kit does not say it finely enough"))
    if technique.chokes is not None:
        unsaid = technique.chokes.matched - technique.chokes.judged
        said.append(Unobservable("whether cymbals were grabbed", unsaid, "the kit sent no choke at all"))
    if technique.keeper.cannot_tell is not None:
        said.append(Unobservable(_CLOCK_OR_HAND, technique.keeper.strokes, technique.keeper.cannot_tell.value, False))
    return tuple(one for one in said if one.count)
