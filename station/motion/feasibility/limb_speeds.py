"""How fast one hand and one foot strike: the one answer for lessons, which know no kit, and for the drummer on a kit.

Rates in strokes a second, spans in seconds from the first of so many strokes to the last.
"""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.pieces import Limb

_CHAMPION_HZ: Mapping[bool, float] = MappingProxyType({True: 10.0, False: 11.0})
"""Strokes a second of one hand (Fujii 2009) and one foot (HUMANS) that champions reach, by whether it is a hand."""
_OVER: Mapping[int, float] = MappingProxyType({3: 1.25, 6: 1.05})
"""By so much may three strokes in a row be quicker than a champion's mean, for players' timing varies; six, half a
second's worth, hardly vary in their mean (our choice)."""
_NEXT_S: Mapping[bool, float] = MappingProxyType({True: 0.045, False: 0.07})
"""The stroke after the next: a hand's rebound comes after 50–90 ms (HUMANS, Heights); the foot's doubles of the Groove
MIDI Dataset's drummers come down to 75 ms, and what is closer there looks like a bouncing beater. Our choice below."""

RUNS = tuple(_OVER)
"""So many strokes on end have a fastest rate."""


def fastest_hz(is_hand: bool, strokes: int) -> float:
    """The rate of so many strokes (of `RUNS`) of one hand or foot that nobody exceeds."""
    return _CHAMPION_HZ[is_hand] * _OVER[strokes]


def spans_s(is_hand: bool) -> Mapping[int, float]:
    """By the number of strokes of one hand or foot, the least time from the first to the last."""
    return {2: _NEXT_S[is_hand], **{strokes: (strokes - 1) / fastest_hz(is_hand, strokes) for strokes in RUNS}}


SPANS_S: Mapping[Limb, Mapping[int, float]] = MappingProxyType(
    {limb: spans_s(limb.is_hand) for limb in Limb if limb is not Limb.UNKNOWN}
)
"""The spans of each limb."""
