"""Where notation writes the strokes of a score, and how long each lasts there: straight, on divisions of the beat.

Swing is written straight (`swing_ticks`). What was played and lies on no division is written on the nearest sensible
one, hands and feet together, which may be the next beat's or the next bar's start.
"""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.beat_groups import beat_groups
from station.music.score import Score
from station.render.notation.spelling.beat_divisions import Division, divisions, nearest_slot, slot_ticks
from station.render.notation.spelling.nearest_division import code_lengths, guesses

_ROUNDED = PPQ // 192
"""Half a tick of a 96 PPQ file: so far its onsets stray from the simple divisions that they were meant on."""
_EXACT = 2
"""And from those that such files cannot hold: by rounding to our own ticks alone."""
_PLAYED_SHARE = 0.2
"""A score with more inexact beats was played, and the others are exact by chance (our choice)."""
_STRAY_S, _LEAST, _MOST = 0.02, 0.02, 0.08
"""A played stroke's standard deviation (HUMANS: amateurs 10 to 20 ms), and its bounds in quarters."""


@dataclass(frozen=True, slots=True)
class _Beat:
    """From `start` to `end`: the ticks in between that are struck, and where they are written if they are exact."""

    start: int
    end: int
    ticks: tuple[int, ...]
    places: tuple[int, ...] | None

    @property
    def length(self) -> int:
        return self.end - self.start

    @property
    def offsets(self) -> tuple[int, ...]:
        return tuple(tick - self.start for tick in self.ticks)


def beats_of(score: Score) -> Iterator[tuple[int, int]]:
    """Start and end of all beat groups of a score, in ticks."""
    tempo = score.tempo_map
    for bar in range(score.bar_count):
        start, end = tempo.bar_start(bar), tempo.bar_start(bar + 1)
        yield from ((start + a, start + b) for a, b in beat_groups(tempo.meter_at(start), end - start))


def written_ticks(score: Score, is_foot: NDArray[np.bool_]) -> NDArray[np.int64]:
    """The tick at which notation writes each stroke, shape (n,); grace strokes stand with their main stroke."""
    straight: NDArray[np.int64] = score.notes["tick"] - score.notes["swing_ticks"]
    beats = list(_beats(score, straight, is_foot))
    inexact = sum(beat.places is None for beat in beats)
    is_played = inexact > _PLAYED_SHARE * len(beats)
    moved = {t: place for b in beats if b.places and not is_played for t, place in zip(b.ticks, b.places, strict=True)}
    moved |= _moved(score, [beat for beat in beats if is_played or beat.places is None])
    return np.array([moved.get(tick, tick) for tick in straight.tolist()], np.int64)


def _beats(score: Score, straight: NDArray[np.int64], is_foot: NDArray[np.bool_]) -> Iterator[_Beat]:
    """The beats that are struck."""
    ticks = np.unique(straight)
    voices = [np.unique(straight[is_foot == foot]) for foot in (False, True)]
    for start, end in beats_of(score):
        if inside := _within(ticks, start, end):
            places: dict[int, int] | None = {}
            for voice in voices:
                exact = _exact_places(tuple(tick - start for tick in _within(voice, start, end)), end - start)
                places = None if places is None or exact is None else places | exact
            found = None if places is None else tuple(start + places[tick - start] for tick in inside)
            yield _Beat(start, end, inside, found)


def _within(ticks: NDArray[np.int64], start: int, end: int) -> tuple[int, ...]:
    first, last = np.searchsorted(ticks, [start, end])
    return tuple(ticks[first:last].tolist())


@lru_cache(maxsize=1 << 14)
def _exact_places(offsets: tuple[int, ...], length: int) -> dict[int, int] | None:
    """Where a voice's strokes stand that are on a division, roughly on a simple one or well on any; None without."""
    for tried, most in ((guesses(length), _ROUNDED), (divisions(length), _EXACT)):
        for division in tried:
            if _fits(division, offsets, length, most):
                places = slot_ticks(division, length)
                return {tick: places[nearest_slot(division, length, tick)] for tick in offsets}
    return None


def _fits(division: Division, offsets: Sequence[int], length: int, most: int) -> bool:
    places, slots = slot_ticks(division, length), set[int]()
    for tick in offsets:
        slot = nearest_slot(division, length, tick)
        if abs(places[slot] - tick) > most or slot in slots or slot == len(places) - 1:
            return False
        slots.add(slot)
    return True


def _moved(score: Score, beats: list[_Beat]) -> dict[int, int]:
    """Where the ticks of played beats are written; a division that the score has often is the likelier one."""
    costs = [code_lengths(beat.offsets, beat.length, _stray(score, beat)) for beat in beats]
    chosen = Counter(min(cost, key=cost.__getitem__) for cost in costs)
    habit = {d: -math.log((n + 1) / (len(beats) + 1)) for d, n in chosen.items()}
    rare = math.log(len(beats) + 1)
    moved: dict[int, int] = {}
    for beat, cost in zip(beats, costs, strict=True):
        division = min(cost, key=lambda d: cost[d] + habit.get(d, rare))
        places = slot_ticks(division, beat.length)
        last = len(places) - (2 if beat.end >= score.end_tick else 1)  # nothing is written after the end
        for tick in beat.ticks:
            moved[tick] = beat.start + places[min(nearest_slot(division, beat.length, tick - beat.start), last)]
    return moved


def _stray(score: Score, beat: _Beat) -> float:
    """The standard deviation of its strokes in quarters."""
    quarters = _STRAY_S * score.tempo_map.bpm_at(beat.start) / 60
    return min(max(quarters, _LEAST), _MOST)
