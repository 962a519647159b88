"""Spells rhythm: which note values, rests, beams and tuplets write a bar's onsets in one voice.

A bar falls into beat groups: quarters, or the groups of the meter where they are eighths (6/8, 7/8 as 3+2+2). Each
group takes the simplest division that its onsets fit; a stroke lasts to the next one or to the group's end, as drum
parts are written.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from station.core.units import PPQ
from station.music.tempo import MeterChange

_EXACT_TICKS = PPQ // 240
"""Onsets so close to a division are on it: one tick of a 240 PPQ file (our choice)."""
_LOOSENESS = 0.012
"""A played, unquantised group may leave the grid by so much of a beat more for each step of simplicity (our choice)."""
_QUARTER_DIVISIONS = (1, 2, 4, 3, 6, 8, 5, 7, 12, 16, 9, 10, 14, 11, 13, 15, 24, 32)
_COMPOUND_DIVISIONS = (3, 6, 12, 24, 5, 7, 9, 10, 14)
_OTHER_TUPLETS = (3, 5, 6, 7, 9, 10, 12, 14)
"""Divisions tried, simplest first, of a quarter, of a dotted quarter, and after plain ones of longer groups."""


@dataclass(frozen=True, slots=True)
class Value:
    """A note value: 1/`base` note with `dots`."""

    base: int
    dots: int = 0

    @property
    def beams(self) -> int:
        """How many beams or flags it has."""
        return max(self.base.bit_length() - 3, 0)


@dataclass(frozen=True, slots=True)
class TimedValue:
    """A stroke or a rest of `value` at `tick` from the bar's start; strokes keep the tick that they were played at.

    `is_tied`: no stroke, but how the one before it goes on.
    """

    tick: int
    value: Value
    is_tied: bool = False


@dataclass(frozen=True, slots=True)
class BeatGroup:
    """One beat group of one voice: ticks from the bar's start; `tuplet` the number to write, 0 for none."""

    start: int
    end: int
    strokes: tuple[TimedValue, ...]
    rests: tuple[TimedValue, ...]
    tuplet: int = 0


def beat_groups(meter: MeterChange, length: int) -> list[tuple[int, int]]:
    """Start and end of the beat groups of a bar `length` ticks long (the last bar before a change may be short)."""
    if meter.unit >= 8 and max(meter.felt_groups) > 1:
        return [(start, min(end, length)) for start, end in meter.pulses if start < length]
    groups = [(start, min(start + PPQ, length)) for start in range(0, length, PPQ)]
    if meter.unit == 8 and len(groups) > 1 and groups[-1][1] - groups[-1][0] == PPQ // 2:
        groups[-2:] = [(groups[-2][0], length)]  # 7/8 reads 2 + 2 + 3 where nothing else is said
    return groups


def spell(onsets: Sequence[int], start: int, end: int, until: int | None = None) -> BeatGroup:
    """The group [start, end) with strokes at `onsets` (ticks from the bar's start, rising).

    `until` is where the first of them ends, if not at the next or with the group: what one value does not write is
    tied.
    """
    length = end - start
    if not onsets:
        return BeatGroup(start, end, (), tuple(_rests(0, length, start, _smallest_unit(length), 0)))
    divisions = _divisions(length)
    ends = [] if until is None or until in onsets else [until]
    division = _best_division([tick - start for tick in sorted([*onsets, *ends])], length, divisions)
    unit, unit_base, tuplet = _unit(length, division)
    slots = [min(round((o - start) / unit), division - 1) for o in onsets]
    strokes: list[TimedValue] = []
    rests = _rests(0, slots[0] * unit, start, unit, unit_base)
    for i, (onset, slot) in enumerate(zip(onsets, slots, strict=True)):
        gap = (slots[i + 1] if i + 1 < len(slots) else division) - slot
        value, taken = _value(max(gap if until is None or i else _slots(until - start, unit) - slot, 1), unit_base)
        strokes.append(TimedValue(onset, value))
        while until is not None and i == 0 and slot + taken < _slots(until - start, unit):
            value, more = _value(_slots(until - start, unit) - slot - taken, unit_base)
            strokes.append(TimedValue(start + round((slot + taken) * unit), value, is_tied=True))
            taken += more
        rests += _rests((slot + taken) * unit, (slot + gap) * unit, start, unit, unit_base)
    return BeatGroup(start, end, tuple(strokes), tuple(rests), tuplet)


def _slots(ticks: int, unit: float) -> int:
    return round(ticks / unit)


def _divisions(length: int) -> tuple[int, ...]:
    if length == 3 * PPQ // 2:
        return _COMPOUND_DIVISIONS
    if length == PPQ:
        return _QUARTER_DIVISIONS
    eighths = 2 * length / PPQ
    plain = tuple(int(eighths * k) for k in (0.5, 1, 2, 4, 8) if eighths * k >= 1 and (eighths * k).is_integer())
    return plain + tuple(count for count in _OTHER_TUPLETS if count not in plain)


def _best_division(offsets: list[int], length: int, divisions: tuple[int, ...]) -> int:
    """The simplest division that fits exactly, else the one that fits best, simpler ones favoured."""
    best, best_cost = divisions[0], float("inf")
    for rank, division in enumerate(divisions):
        unit = length / division
        worst = max(abs(o - round(o / unit) * unit) for o in offsets)
        slots = {round(o / unit) for o in offsets}
        if worst <= _EXACT_TICKS and len(slots) == len(offsets):
            return division
        merged = len(offsets) - len(slots) + (division in slots)
        cost = worst / PPQ + _LOOSENESS * rank + merged
        if cost < best_cost:
            best, best_cost = division, cost
    return best


def _unit(length: int, division: int) -> tuple[float, int, int]:
    """Ticks of one slot, the base of the note that writes it, and the tuplet's number."""
    unit = length / division
    base = 4 * PPQ / unit
    if base == int(base) and (int(base) & (int(base) - 1)) == 0:
        return unit, int(base), 0
    lower = 1 << (int(base).bit_length() - 1)
    return unit, lower, division


_VALUES = {8: (8, 0), 6: (4, 1), 4: (4, 0), 3: (2, 1), 2: (2, 0), 1: (1, 0)}
"""Slots that one note can last: (what the slot's base is divided by, dots)."""


def _value(slots: int, unit_base: int) -> tuple[Value, int]:
    """The longest single value of at most `slots` slots, and how many it takes."""
    for taken, (divisor, dots) in _VALUES.items():
        if taken <= slots and unit_base // divisor >= 4:
            return Value(unit_base // divisor, dots), taken
    return Value(unit_base), 1


def _smallest_unit(length: int) -> int:
    """A slot that fills a silent group: the group itself as a quarter, a dotted quarter, or eighths."""
    return length if length in (PPQ, 3 * PPQ // 2) else PPQ // 2


def _rests(first: float, last: float, start: int, unit: float, unit_base: int) -> list[TimedValue]:
    """Rests from `first` to `last` (ticks in the group), each on a multiple of its own length."""
    if unit_base == 0:
        dots = 1 if unit == 3 * PPQ // 2 else 0
        return [
            TimedValue(start + round(k * unit), Value(8 if unit < PPQ else 4, dots))
            for k in range(round((last - first) / unit))
        ]
    rests: list[TimedValue] = []
    slot, end = round(first / unit), round(last / unit)
    while slot < end:
        size = 1
        while slot % (2 * size) == 0 and slot + 2 * size <= end and unit_base // (2 * size) >= 4:
            size *= 2
        rests.append(TimedValue(start + round(slot * unit), Value(unit_base // size)))
        slot += size
    return rests
