"""Whether triplets are a shuffle: what a teacher calls swing and writes straight, though every note lies on a triplet.

The ear goes by the piece that keeps time: if the notes that it plays between the beats all stand on the last of three,
the music swings, whatever triplets the others play. Where pieces play full triplets alone, they are triplets.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType

import numpy as np

from station.core.units import PPQ
from station.drills.transcription.timing.beat_spans import BeatSpans, Floats, Ints
from station.music.swing import TRIPLETS, Swing

MIN_BEATS = 3
"""A shuffle is heard when three beats have gone by with it (our choice)."""
MAX_OTHERS = 0.2
"""Of a time-keeper's beats so many may have other strokes: fills, pushes. Our choice."""
MIN_SHARE = 0.4
"""Of the beats with strokes between them so many must swing with all their strokes; in a half-time shuffle, which is
written in triplets, none do, and in jazz comping about half (the lessons that ship with the station)."""
_FINEST = 24

_LATE: Mapping[int, frozenset[Fraction]] = MappingProxyType(
    {
        PPQ // 2: frozenset({Fraction(2, 3)}),
        PPQ // 4: frozenset({Fraction(1, 3), Fraction(1, 2), Fraction(5, 6)}),
    }
)
"""Where in a quarter the second of each pair of eighths, or of sixteenths, falls when they swing as triplets do; and
the eighth between two pairs of sixteenths."""
_TELLING: Mapping[int, frozenset[Fraction]] = MappingProxyType(
    {PPQ // 2: frozenset({Fraction(2, 3)}), PPQ // 4: frozenset({Fraction(5, 6)})}
)
"""The place among them that every such beat has."""


@dataclass(frozen=True, slots=True)
class _Beats:
    """Of the beats in which one piece has strokes between the beats: how many swing, and how many do not."""

    swung: int
    others: int


def triplet_swing(spans: BeatSpans, span: Ints, place: Floats, piece: Ints) -> Swing:
    """The swing of strokes on `piece` (n,), at `place` of their `span`: 2:1 of eighths or of sixteenths, or none."""
    quarters = (spans.lengths[span] == PPQ) & ~spans.is_ternary[span]
    between: dict[tuple[int, int], set[Fraction]] = {}
    for s, p, x in zip(span[quarters].tolist(), piece[quarters].tolist(), place[quarters].tolist(), strict=True):
        fraction = Fraction(x).limit_denominator(_FINEST)
        if 0 < fraction < 1:
            between.setdefault((p, s), set()).add(fraction)
    for unit in _LATE:
        if not _prevails(between, unit):
            continue
        if any(_keeps_time(_beats(between, p, unit)) for p in np.unique(piece).tolist()):
            return Swing(TRIPLETS, unit)
    return Swing()


def _beats(between: Mapping[tuple[int, int], set[Fraction]], piece: int, unit: int) -> _Beats:
    own = [places for (p, _), places in between.items() if p == piece]
    swung = sum(_swings(places, unit) for places in own)
    return _Beats(swung, len(own) - swung)


def _prevails(between: Mapping[tuple[int, int], set[Fraction]], unit: int) -> bool:
    """Whether enough of the beats swing with all that is struck in them."""
    beats: dict[int, set[Fraction]] = {}
    for (_, span), places in between.items():
        beats.setdefault(span, set()).update(places)
    swung = sum(_swings(places, unit) for places in beats.values())
    return swung >= MIN_SHARE * len(beats)


def _swings(places: set[Fraction], unit: int) -> bool:
    return places <= _LATE[unit] and bool(places & _TELLING[unit])


def _keeps_time(beats: _Beats) -> bool:
    return beats.swung >= MIN_BEATS and beats.others <= MAX_OTHERS * (beats.swung + beats.others)
