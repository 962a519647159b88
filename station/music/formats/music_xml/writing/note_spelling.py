"""Which note values write a voice of a bar, exactly: values, dots and tuplets, beat group by beat group.

The places where strokes begin or end say how a group is divided: the coarsest plain values that meet them all, else a
triplet, sextuplet, quintuplet or septuplet, else the same for each half of it, else rarer tuplets. A stroke lasts to
the next place or the group's end, as drum parts are written. All lengths are exact fractions of ticks.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain

from station.core.units import PPQ

_USUAL_TUPLETS, _RARE_TUPLETS = (3, 6, 5, 7), (9, 10, 12, 14, 11, 13, 15)
_COARSE, _FINE = (2, 4, 8, 16, 32), (64, 128, 256)
CLOSE = 2
"""Ticks that a place may lie beside its value: places of elevenths and such are rounded."""
_SNAP_BASE = 64


@dataclass(frozen=True, slots=True)
class Span:
    """[start, end) of a bar, divided in slots of `unit` ticks, each a 1/`base` note.

    In a tuplet `actual` of them stand in the time of `normal`. `is_exact`: all places lie on slots.
    """

    start: Fraction
    end: Fraction
    unit: Fraction
    base: int
    actual: int = 1
    normal: int = 1
    is_exact: bool = True

    @property
    def slots(self) -> int:
        """How many slots it has."""
        return round((self.end - self.start) / self.unit)

    def slot(self, place: int) -> int:
        """The slot that `place` is nearest to, `slots` for its end."""
        return round((place - self.start) / self.unit)

    def holds(self, places: Sequence[int]) -> bool:
        """Whether all `places` lie on slots."""
        return all(abs(self.start + self.slot(p) * self.unit - p) <= CLOSE for p in places)


@dataclass(frozen=True, slots=True)
class Value:
    """One note or rest: a 1/`base` note with `dots`, from `start` for `length`; `span` says its tuplet."""

    start: Fraction
    length: Fraction
    base: int
    dots: int
    span: Span

    @property
    def flags(self) -> int:
        """How many flags or beams it has."""
        return max(self.base.bit_length() - 3, 0)


def spans_of(start: Fraction, end: Fraction, places: Sequence[int]) -> list[Span]:
    """How [start, end) is divided so that all `places` in it, its ends aside, lie on slots; snapped if nothing fits."""
    found = _fitting(start, end, [p for p in places if start - CLOSE < p < end + CLOSE])
    return found or [_snapped(start, end)]


def _fitting(start: Fraction, end: Fraction, places: Sequence[int]) -> list[Span]:
    if simple := _first(chain(_plain(start, end, _COARSE), _tuplets(start, end, _USUAL_TUPLETS)), places):
        return [simple]
    if parts := _split(start, end, places):
        return parts
    rest = _first(chain(_tuplets(start, end, _RARE_TUPLETS), _plain(start, end, _FINE)), places)
    return [rest] if rest else []


def _first(spans: Iterable[Span], places: Sequence[int]) -> Span | None:
    return next((span for span in spans if span.holds(places)), None)


def _plain(start: Fraction, end: Fraction, bases: Sequence[int]) -> Iterator[Span]:
    for base in bases:
        unit = Fraction(4 * PPQ, base)
        if ((end - start) / unit).denominator == 1:
            yield Span(start, end, unit, base)


def _tuplets(start: Fraction, end: Fraction, counts: Sequence[int]) -> Iterator[Span]:
    plain = {span.slots: span.base for span in _plain(start, end, (*_COARSE, *_FINE))}
    for count in counts:
        normal = max((slots for slots in plain if slots < count), default=0)
        if normal and count not in plain:
            yield Span(start, end, (end - start) / count, plain[normal], count, normal)


def _split(start: Fraction, end: Fraction, places: Sequence[int]) -> list[Span]:
    """The halves, or the eighths of a group that has no halves, each divided on its own; empty if one of them fails."""
    length, eighth = end - start, Fraction(PPQ, 2)
    if length < eighth:
        return []
    halves = ((length / PPQ).denominator <= 2 and (length / eighth).numerator % 2 == 0) or length == eighth
    step = length / 2 if halves else eighth
    found: list[Span] = []
    while start < end:
        until = min(start + step, end)
        part = _fitting(start, until, [p for p in places if start - CLOSE < p < until + CLOSE])
        if not part:
            return []
        found += part
        start = until
    return found


def _snapped(start: Fraction, end: Fraction) -> Span:
    """Sixty-fourths, wherever the places lie."""
    unit = Fraction(4 * PPQ, _SNAP_BASE)
    slots = max(round((end - start) / unit), 1)
    return Span(start, end, (end - start) / slots, _SNAP_BASE, is_exact=False)


def values(span: Span, first: int, last: int) -> list[Value]:
    """Note values that fill the slots [first, last), the longest first."""
    found = []
    while first < last:
        slots, base, dots = _longest(last - first, span.base)
        found.append(Value(span.start + first * span.unit, slots * span.unit, base, dots, span))
        first += slots
    return found


def rests(span: Span, first: int, last: int) -> list[Value]:
    """Rests that fill the slots [first, last), each on a multiple of its own length."""
    if (first, last) == (0, span.slots):
        return values(span, first, last)
    found = []
    while first < last:
        size = 1
        while first % (2 * size) == 0 and first + 2 * size <= last and span.base // (2 * size) >= 2:
            size *= 2
        found.append(Value(span.start + first * span.unit, size * span.unit, span.base // size, 0, span))
        first += size
    return found


def _longest(slots: int, base: int) -> tuple[int, int, int]:
    """How many of `slots` slots of 1/`base` notes one value writes, its base and its dots."""
    size = 1
    while 2 * size <= slots and base // (2 * size) >= 2:
        size *= 2
    if 3 * size // 2 <= slots and size > 1:
        return 3 * size // 2, base // size, 1
    return size, base // size, 0
