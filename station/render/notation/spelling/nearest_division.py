"""What was meant by strokes that lie on no grid: the division that says most simply where they are.

A stroke that is played strays from its place by some milliseconds; a finer division comes nearer to it and says less.
The two are weighed as a code's length is (the least of −log probability): normal strays, and every slot as likely as
another.
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache

from station.core.units import PPQ
from station.music.beat_groups import COMPOUND
from station.render.notation.spelling.beat_divisions import Division, divisions, nearest_slot, slot_ticks

STRAY = 0.04
"""Standard deviation of a played stroke in parts of a quarter: 20 ms at 120 bpm (HUMANS: amateurs 10 to 20 ms)."""
_TOGETHER = PPQ // 12
"""Strokes closer than a twelfth of a quarter are one place: flams, and hands and feet that are not quite together."""
_LOST = 6.0
"""What it costs to write two places as one, as much as a stray of three and a half standard deviations."""
_LONELY = 4.5
"""And for each thirty-second off the sixteenths with no other beside it, as much as three: they come in runs."""
_SIXTEENTH = 16
_PLAIN_SLOTS, _TUPLET_SLOTS = 8, 6
"""Nothing finer than thirty-seconds and sextuplets is guessed (our choice: none of it could be read)."""
_USUAL_NUMBERS = (0, 2, 3, 6)


@lru_cache(maxsize=1 << 10)
def guesses(length: int) -> tuple[Division, ...]:
    """The divisions that a beat `length` ticks long may have been meant in, the simplest first."""
    finest = _PLAIN_SLOTS * 3 // 2 if length == COMPOUND else _PLAIN_SLOTS
    found = tuple(
        d
        for d in divisions(length)
        if all(
            p.number in _USUAL_NUMBERS and p.slots * len(d.parts) <= (_TUPLET_SLOTS if p.number else finest)
            for p in d.parts
        )
    )
    return found or divisions(length)[:1]


def nearest_division(
    onsets: Sequence[int], length: int, stray: float = STRAY, habits: Mapping[Division, float] | None = None
) -> Division:
    """The division of a beat `length` ticks long that its `onsets` (ticks from its start, rising) were meant in.

    `stray` is the standard deviation in quarters; `habits` what each division costs besides, as −log probability.
    """
    costs = code_lengths(onsets, length, stray)
    return min(costs, key=lambda division: costs[division] + (habits or {}).get(division, 0.0))


def code_lengths(onsets: Sequence[int], length: int, stray: float = STRAY) -> dict[Division, float]:
    """−log probability of the onsets for each of `guesses`."""
    leaders = [tick for k, tick in enumerate(onsets) if not k or tick - onsets[k - 1] > _TOGETHER]
    return {d: _code_length(d, onsets, leaders, length, stray * PPQ) for d in guesses(length)}


def _code_length(division: Division, onsets: Sequence[int], leaders: Sequence[int], length: int, sigma: float) -> float:
    places = slot_ticks(division, length)
    slot_of = {tick: nearest_slot(division, length, tick) for tick in onsets}
    strays = sum((tick - places[slot]) ** 2 for tick, slot in slot_of.items()) / sigma**2 / 2
    slots = {slot_of[tick] for tick in leaders}
    lonely = sum(slot - 1 not in slots and slot + 1 not in slots for slot in slots & _between_sixteenths(division))
    return strays + len(leaders) * math.log(len(places)) + _LOST * (len(leaders) - len(slots)) + _LONELY * lonely


@lru_cache(maxsize=1 << 14)
def _between_sixteenths(division: Division) -> frozenset[int]:
    """The slots that only thirty-seconds reach."""
    found, first = set[int](), 0
    for part in division.parts:
        if part.base > _SIXTEENTH and not part.number:
            found |= set(range(first + 1, first + part.slots, 2))
        first += part.slots
    return frozenset(found)
