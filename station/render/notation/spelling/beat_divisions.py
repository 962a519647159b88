"""The ways to divide a beat that notation has: plain, as tuplets, and with tuplets in a part of it.

Which number and which note a tuplet has follows the usual rule: n notes in the time of the next smaller number of
plain ones of the same kind (Gould, "Behind Bars", 2011, on tuplets); in a compound beat those plain numbers are three
times a power of two. Duplets and quadruplets there are of eighths, and come before the dotted values that would do.
"""

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import product

from station.core.units import PPQ
from station.music.beat_groups import COMPOUND

_SIMPLE_TUPLETS = (6, 5, 7, 12, 9, 10, 14, 11, 13, 15, 24)
_COMPOUND_TUPLETS = (5, 7, 9, 8, 10, 14, 11, 13, 15)
"""Beside triplets, duplets and quadruplets, which come before: the commoner first."""
_FINEST_BASE = 128
"""No value is shorter (our choice: none was printed shorter than this)."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part of a beat in `slots` equal steps, each a 1/`base` note; `number` in the time of `of`, 0 where plain.

    `start` and `end` are shares of the beat.
    """

    start: Fraction
    end: Fraction
    slots: int
    base: int
    number: int = 0
    of: int = 0

    def slot_at(self, slot: int) -> Fraction:
        """Where a slot begins, as a share of the beat."""
        return self.start + (self.end - self.start) * slot / self.slots


@dataclass(frozen=True, slots=True, eq=False)
class Division:
    """One way to divide a beat: its parts in order. Each is made once, and is itself its identity."""

    parts: tuple[Part, ...]

    @property
    def tuplet(self) -> int:
        """The number of a tuplet that is the whole beat; 0 where it is plain, or in several parts."""
        return self.parts[0].number if len(self.parts) == 1 else 0


@lru_cache(maxsize=1 << 10)
def divisions(length: int) -> tuple[Division, ...]:
    """The divisions of a beat `length` ticks long, the simplest first.

    Beats are quarters or dotted quarters, or halves, quarters … of either; what is left of a bar that was cut short is
    divided into thirty-seconds as far as it goes.
    """
    for halved in range(7):
        if length * 2**halved == PPQ * 8:
            return tuple(_simple(Fraction(2) ** (halved - 1)))
        if length * 2**halved == COMPOUND * 8:
            return tuple(_compound(Fraction(2) ** (halved - 1)))
    steps = (Fraction(length, PPQ) * count for count in (1, 2, 4, 8, 16, 32))
    plain = [(int(n), 4 * n * PPQ / length) for n in steps if n.denominator == 1]
    fitting = [_whole(count, int(base)) for count, base in plain]
    return tuple(fitting) or (_whole(max(round(8 * length / PPQ), 1), 32),)


@lru_cache(maxsize=1 << 10)
def tuplets_over(length: int, counts: tuple[int, ...]) -> tuple[Division, ...]:
    """Tuplets of these counts over several beats, `length` a quarter times a power of two; each doubled comes after."""
    beat = Fraction(4 * PPQ, length)
    found = (_tuplet(count * more, beat) for more in (1, 2) for count in counts)
    return tuple(division for division in found if division is not None)


@lru_cache(maxsize=1 << 12)
def slot_ticks(division: Division, length: int) -> tuple[int, ...]:
    """The tick of every slot of a beat `length` ticks long, and the beat's end."""
    return (*(round(part.slot_at(k) * length) for part in division.parts for k in range(part.slots)), length)


def nearest_slot(division: Division, length: int, tick: int) -> int:
    """The slot nearest to a tick of the beat; the number of slots where its end is nearest."""
    places = slot_ticks(division, length)
    after = min(bisect_left(places, tick), len(places) - 1)
    return after - 1 if after and tick - places[after - 1] <= places[after] - tick else after


# --- beats ------------------------------------------------------------------------------------------------------------


def _simple(beat: Fraction) -> Iterator[Division]:
    """Of a beat that is a 1/`beat` note."""
    yield from _plain((1, 2, 4), beat)
    yield from _some(_tuplet(3, beat))
    yield from _plain((8,), beat)
    yield from _mixed(2, (1, 2, 4), (3, 6), beat * 2)
    yield from _some(*(_tuplet(count, beat) for count in _SIMPLE_TUPLETS))
    yield from _plain((16, 32), beat)


def _compound(beat: Fraction) -> Iterator[Division]:
    """Of a beat that is a dotted 1/`beat` note."""
    third = beat * 2
    yield from _plain((3,), third / 3)
    if third.denominator == 1:
        yield _whole(2, int(third), 2, 3)
        yield _whole(4, int(third), 4, 3)
    yield from _plain((6, 12), third / 3)
    yield from _mixed(3, (1, 2, 4), (3, 6), third)
    for count in _COMPOUND_TUPLETS:
        of = 3 << ((count // 3).bit_length() - 1)
        base = third * of / 3
        if base.denominator == 1 and base <= _FINEST_BASE:
            yield _whole(count, int(base), count, of)
    yield from _plain((24,), third / 3)


def _mixed(parts: int, plain: tuple[int, ...], tuplets: tuple[int, ...], beat: Fraction) -> Iterator[Division]:
    """Several equal parts, each a 1/`beat` note, at least one of them a tuplet."""
    if beat.denominator != 1 or beat * 4 > _FINEST_BASE:
        return
    for counts in product((*plain, *tuplets), repeat=parts):
        if any(count in tuplets for count in counts):
            yield Division(
                tuple(
                    _shifted(_tuplet(n, beat) if n in tuplets else _whole(n, int(beat) * n), k, parts)
                    for k, n in enumerate(counts)
                )
            )


def _shifted(division: Division | None, k: int, parts: int) -> Part:
    assert division is not None, "no part of a beat is too short for its tuplet"
    (part,) = division.parts
    return Part(Fraction(k, parts), Fraction(k + 1, parts), part.slots, part.base, part.number, part.of)


def _plain(counts: tuple[int, ...], unit: Fraction) -> Iterator[Division]:
    for count in counts:
        base = unit * count
        if base.denominator == 1 and base <= _FINEST_BASE:
            yield _whole(count, int(base))


def _tuplet(count: int, beat: Fraction) -> Division | None:
    of = 1 << (count.bit_length() - 1)
    base = beat * of
    return _whole(count, int(base), count, of) if base.denominator == 1 and base <= _FINEST_BASE else None


def _some(*found: Division | None) -> Iterator[Division]:
    yield from (division for division in found if division is not None)


def _whole(slots: int, base: int, number: int = 0, of: int = 0) -> Division:
    return Division((Part(Fraction(0), Fraction(1), slots, base, number, of),))
