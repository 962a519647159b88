"""Spells rhythm: which note values, rests and tuplets write the onsets of one beat in one voice.

A beat takes the division that writes its onsets with the fewest signs; a stroke lasts to the next one or to the
beat's end, as drum parts are written, a roll as long as it is held.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

from station.core.units import PPQ
from station.music.beat_groups import COMPOUND
from station.render.notation.spelling.beat_divisions import (
    Division,
    Part,
    divisions,
    nearest_slot,
    slot_ticks,
)
from station.render.notation.spelling.nearest_division import nearest_division
from station.render.notation.spelling.note_values import BeatGroup, Stroke, TimedValue, Tuplet, Value

EXACT_TICKS = PPQ // 480
"""Onsets so close to a division are on it: one tick of a 480 PPQ file (our choice)."""
_TUPLET_COST = 1.0
"""A tuplet's number and bracket are as much to read as one more note (our choice)."""
_HALVED_COST = 1.5
"""And a sextuplet that hides the half beat, which is struck, is more to read than two triplets (our choice)."""

_FINE, _FINE_COST = 32, 3.0
"""Values finer than thirty-seconds are the last to be thought of (our choice)."""


def spell(strokes: Sequence[Stroke], start: int, end: int, first: int = 0) -> BeatGroup:
    """The beat [start, end) with `strokes` inside it, rising; the sources of its values count from `first`."""
    moved = tuple(
        replace(s, tick=s.tick - start, until=None if s.until is None else min(s.until, end) - start) for s in strokes
    )
    group = _spelled(moved, end - start)
    return BeatGroup(
        start,
        end,
        tuple(replace(v, tick=v.tick + start, source=v.source + first) for v in group.strokes),
        tuple(replace(v, tick=v.tick + start) for v in group.rests),
        tuple(replace(t, start=t.start + start, end=t.end + start) for t in group.tuplets),
    )


def spell_by(strokes: Sequence[Stroke], length: int, division: Division) -> BeatGroup | None:
    """A beat of `length` ticks from 0 under this division; None where a stroke is not on it."""
    slots = _slots_of(division, length, [s.tick for s in strokes])
    return None if slots is None else _Writing(strokes, length, division, slots).group()


@lru_cache(maxsize=1 << 14)
def _spelled(strokes: tuple[Stroke, ...], length: int) -> BeatGroup:
    if not strokes:
        return BeatGroup(0, length, (), tuple(_silence(length)))
    ends = [s.until for s in strokes if s.until is not None and s.until < length]
    onsets = [s.tick for s in strokes]
    for points in (onsets + ends, onsets):  # a roll's end that no division has is rounded
        fitting = [d for d in divisions(length) if _slots_of(d, length, points) is not None]
        coarse = [d for k, d in enumerate(fitting) if not any(_refines(d, before) for before in fitting[:k])]
        groups = [group for d in coarse if (group := spell_by(strokes, length, d)) is not None]
        if groups:
            return min(groups, key=lambda group: _cost(group, strokes))
    division = nearest_division(onsets, length)
    return _Writing(strokes, length, division, [nearest_slot(division, length, tick) for tick in onsets]).group()


def _refines(division: Division, other: Division) -> bool:
    """Whether one only divides the steps of the other again."""
    if len(division.parts) + len(other.parts) > 2 or bool(division.tuplet) != bool(other.tuplet):
        return False
    return division.parts[0].slots % other.parts[0].slots == 0


# --- places -----------------------------------------------------------------------------------------------------------


def _slots_of(division: Division, length: int, ticks: Sequence[int]) -> list[int] | None:
    """The slot of each tick; None where one is off them or two onsets share one."""
    places = slot_ticks(division, length)
    slots = [nearest_slot(division, length, tick) for tick in ticks]
    is_exact = all(abs(places[slot] - tick) <= EXACT_TICKS for slot, tick in zip(slots, ticks, strict=True))
    return slots if is_exact and len(set(slots)) >= len(set(ticks)) else None


# --- cost -------------------------------------------------------------------------------------------------------------


def _cost(group: BeatGroup, strokes: Sequence[Stroke]) -> float:
    """How much there is to read: signs, tuplets but for duplets and quadruplets, sextuplets over the half beat."""
    signs = len(group.strokes) + len(group.rests) + _TUPLET_COST * sum(t.of % 3 > 0 for t in group.tuplets)
    if (
        len(group.tuplets) == 1
        and group.tuplets[0].number == 6
        and (group.tuplets[0].start, group.tuplets[0].end) == (0, group.end)
    ):
        accents = [s.tick for s in strokes if s.is_accented]
        is_run = len(group.values) == 6
        in_halves = accents and {round(6 * tick / group.end) for tick in accents} == {0, 3}
        signs += 2 * _HALVED_COST if in_halves else 0.0 if is_run else _HALVED_COST
    return signs + _FINE_COST * (max(v.value.base for v in group.values) > _FINE)


# --- values -----------------------------------------------------------------------------------------------------------


class _Writing:
    """Strokes on the slots of a division, part by part."""

    def __init__(self, strokes: Sequence[Stroke], length: int, division: Division, slots: Sequence[int]) -> None:
        self._strokes, self._length, self._division = strokes, length, division
        self._struck: dict[int, int] = {}
        total = sum(part.slots for part in division.parts)
        for index, slot in enumerate(slots):
            self._struck.setdefault(min(slot, total - 1), index)
        self._held_to = {
            slot: nearest_slot(division, length, until)
            for slot, index in self._struck.items()
            if (until := strokes[index].until) is not None
        }
        self._notes: list[TimedValue] = []
        self._rests: list[TimedValue] = []

    def group(self) -> BeatGroup:
        tuplets: list[Tuplet] = []
        first = 0
        for part in self._division.parts:
            known = len(self._notes), len(self._rests)
            self._part(part, first)
            if part.number:
                values = [*self._notes[known[0] :], *self._rests[known[1] :]]
                tuplets.append(self._tuplet(part, values))
            first += part.slots
        return BeatGroup(0, self._length, tuple(self._notes), tuple(self._rests), tuple(tuplets))

    def _part(self, part: Part, first: int) -> None:
        last, slot = first + part.slots, first
        sounding = self._before(first)
        while slot < last:
            if slot in self._struck:
                sounding = slot
            following = min([s for s in self._struck if s > slot], default=last)
            stop = min(following, last)
            if sounding is None:
                self._rest(part, first, slot, stop)
            else:
                slot = self._note(part, first, sounding, slot, stop)
                self._rest(part, first, slot, stop)
                sounding = None
            slot = stop

    def _before(self, first: int) -> int | None:
        """The slot of a roll that goes on where a part begins."""
        held = [slot for slot, until in self._held_to.items() if slot < first < until]
        return held[-1] if held and first not in self._struck else None

    def _note(self, part: Part, first: int, source: int, slot: int, stop: int) -> int:
        """A stroke from `slot` on, tied where one value does not do; returns where it ends."""
        index = self._struck[source]
        stroke = self._strokes[index]
        held_to = self._held_to.get(source)
        end = stop if held_to is None else max(min(stop, held_to), slot + 1)
        is_tied = source < slot or stroke.is_held
        while True:
            value, taken = _longest(part, slot - first, end - slot)
            tick = stroke.tick if slot == source else self._tick(part, slot - first)
            self._notes.append(TimedValue(tick, value, is_tied, int(stroke.is_measured), index))
            slot, is_tied = slot + taken, True
            if held_to is None or slot >= end:
                return slot

    def _rest(self, part: Part, first: int, slot: int, stop: int) -> None:
        """Rests, each on a multiple of its own length."""
        while slot < stop:
            size, local = 1, slot - first
            while local % (2 * size) == 0 and slot + 2 * size <= stop and part.base % (2 * size) == 0:
                size *= 2
            self._rests.append(TimedValue(self._tick(part, local), Value(part.base // size)))
            slot += size

    def _tick(self, part: Part, slot: int) -> int:
        return round(part.slot_at(slot) * self._length)

    def _tuplet(self, part: Part, values: Sequence[TimedValue]) -> Tuplet:
        """With its number; where every second step has a value and few are doubled, the slower steps are counted."""
        number, of = part.number, part.of
        starts = {value.tick for value in values}
        while number % 2 == 0 and of % 2 == 0 and number > 2:
            steps = {
                round((part.start + (part.end - part.start) * 2 * k / number) * self._length)
                for k in range(number // 2)
            }
            fills = all(any(abs(step - start) <= EXACT_TICKS for start in starts) for step in steps)
            if not fills or len(values) >= number:
                break
            number, of = number // 2, of // 2
        return Tuplet(number, of, round(part.start * self._length), round(part.end * self._length))


def _longest(part: Part, slot: int, gap: int) -> tuple[Value, int]:
    """The longest single value from a slot of the part on that is at most `gap` slots long, and how many it takes."""
    room = min(gap, _clear_room(part, slot))
    for size in sorted((2**k * more for k in range(8) for more in (1, 3)), reverse=True):
        plain, dots = (size * 2 // 3, 1) if size % 3 == 0 else (size, 0)
        if size <= room and part.base % plain == 0:
            return Value(part.base // plain, dots), size
    return Value(part.base), 1


def _clear_room(part: Part, slot: int) -> int:
    """How far a value may reach from a slot without hiding where the next stronger steps are."""
    if not slot or part.slots % 2:
        return part.slots
    step = slot & -slot
    if part.slots & (part.slots - 1):
        return 3 * step
    return -slot % (4 * step) or 4 * step


def _silence(length: int) -> Iterator[TimedValue]:
    """Rests for a silent beat: one where a plain or a dotted rest is as long, else from the longest to the shortest."""
    at = 0
    for base in (1, 2, 4, 8, 16, 32, 64):
        plain = 4 * PPQ // base
        if length == plain * 3 // 2 and not at and length == COMPOUND:
            yield TimedValue(0, Value(base, 1))
            return
        while at + plain <= length:
            yield TimedValue(at, Value(base))
            at += plain
