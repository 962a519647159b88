"""The memory of what one player has just played: chords of a step, by what led to them and where.

Contexts of several orders are kept, from the place in the bar alone to the last two beats, as variable-order Markov
models keep them (PPM: Cleary & Witten 1984; Begleiter, El-Yaniv & Yona 2004 on music). Each context that has been
heard says how likely an instrument is, as a log-odds; learned weights blend these with the network's (logistic mixing:
Mahoney 2005), by order and by how often the context was heard. Learning a step is seven entries in a table.
"""

from collections.abc import Hashable, Iterable, Sequence
from typing import cast

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.beat_steps import GRID, INSTRUMENTS, Steps

MOST_KEPT = 24
"""Beyond so many chords after a context all are counted half: older habits fade (our choice)."""
ADDED = 0.4
"""What is added to both counts of a context, near to the Krichevsky-Trofimov estimator's 1/2."""
TIMES = (1, 2, 4, 8)
"""A context heard so often, or more, has a weight of its own."""
ORDERS = 7
"""How many contexts a step has; see `contexts`."""
EVIDENCE = ORDERS * len(TIMES)

Heard = dict[int, int]
"""Chord -> how often it came."""
After = list[tuple[int, Heard]]
"""What came after each context that was heard before, by its order."""

_TOTALS = range(MOST_KEPT + 2)
_COLUMN = [sum(total >= times for times in TIMES) - 1 for total in _TOTALS]
_LOG_ODDS = [[float(np.log((k + ADDED) / (max(n - k, 0) + ADDED))) for k in _TOTALS] for n in _TOTALS]


def contexts(beat: int, place: int, beats_a_bar: int, past: int) -> tuple[int, ...]:
    """The `ORDERS` contexts of a step at a `place` of a beat, on the grid, after the `past` (`with_chord`)."""
    here = beat % beats_a_bar * GRID + place
    last, three = past & _LAST or 1, past & _THREE  # before the first chord it is as after silence
    return (
        here << _ORDER_BITS,
        beat % (2 * beats_a_bar) * GRID + place << _ORDER_BITS | 1,
        (last << _PLACE_BITS | here) << _ORDER_BITS | 2,
        (three << _PLACE_BITS | here) << _ORDER_BITS | 3,
        (past << _PLACE_BITS | here) << _ORDER_BITS | 4,
        (three << _PLACE_BITS | place) << _ORDER_BITS | 5,
        (past << _PLACE_BITS | place) << _ORDER_BITS | 6,
    )


_CHORD_BITS, _PLACE_BITS, _ORDER_BITS = 10, 12, 3
"""Room for a chord and one more number that says there is one; for 4096 places of a bar; for seven orders."""
_LAST, _THREE, _EIGHT = ((1 << chords * _CHORD_BITS) - 1 for chords in (1, 3, 8))


def with_chord(past: int, chord: int) -> int:
    """The last eight chords as one number, in which a chord more is written; 0 where there was none."""
    return (past << _CHORD_BITS | chord + 1) & _EIGHT


def chord_of(struck: Iterable[float]) -> int:
    """What is struck at a step (9,) as a number, a bit for each instrument."""
    return sum(1 << k for k, is_struck in enumerate(struck) if is_struck)


class BarMemory:
    """What has been heard after each context; grows by `learn`, a step at a time."""

    def __init__(self) -> None:
        self._after: dict[Hashable, Heard] = {}

    def after(self, keys: Sequence[Hashable]) -> After:
        """What came after each of the contexts that have been heard."""
        get = self._after.get
        return [(order, heard) for order, key in enumerate(keys) if (heard := get(key)) is not None]

    def learn(self, keys: Sequence[Hashable], chord: int) -> None:
        """Remember that `chord` came in these contexts."""
        known = self._after
        for key in keys:
            heard = known.get(key)
            if heard is None:
                known[key] = {chord: 1}
                continue
            heard[chord] = heard.get(chord, 0) + 1
            if sum(heard.values()) > MOST_KEPT:
                known[key] = {c: n // 2 for c, n in heard.items() if n > 1 or c == chord}
                known[key][chord] = max(known[key][chord], 1)


def said_of(after: After, instrument: int) -> list[tuple[int, float]]:
    """What the contexts say of an instrument: pairs of a column of evidence and a log-odds."""
    return [
        (order * len(TIMES) + _COLUMN[total], _LOG_ODDS[total][struck])
        for order, total, struck in _counted(after, instrument)
    ]


def weighed(weights: NDArray[np.float64]) -> list[list[list[float]]]:
    """What a context says, times its weight of `EVIDENCE`: by order, how often it was heard, and how often struck."""
    by_total = weights.reshape(ORDERS, len(TIMES))[:, _COLUMN]
    return cast(list[list[list[float]]], (by_total[:, :, None] * np.array(_LOG_ODDS)).tolist())


def odds_of(after: After, instrument: int, weights: Sequence[Sequence[Sequence[float]]]) -> float:
    """What the contexts add to the log-odds of an instrument, as they are `weighed`."""
    return sum([weights[order][total][struck] for order, total, struck in _counted(after, instrument)])


def _counted(after: After, instrument: int) -> list[tuple[int, int, int]]:
    """By context: its order, how many chords were heard, and how many with the instrument."""
    bit = 1 << instrument
    found = []
    for order, heard in after:
        total = struck = 0
        for chord, times in heard.items():
            total += times
            if chord & bit:
                struck += times
        found.append((order, total, struck))
    return found


def heard_in(after: After) -> int:
    """Which instruments anything was heard of, a bit for each."""
    found = 0
    for _, heard in after:
        for chord in heard:
            found |= chord
    return found


def given(after: After, instrument: int, is_struck: bool) -> After:
    """What is left of it when it is known whether an instrument is struck."""
    bit, wanted = 1 << instrument, is_struck << instrument
    return [
        (order, left)
        for order, heard in after
        if (left := {chord: times for chord, times in heard.items() if chord & bit == wanted})
    ]


def evidence_of(steps: Steps) -> NDArray[np.float32]:
    """What a memory that hears the steps one after the other says before each, shape (s, 9, EVIDENCE)."""
    memory, past = BarMemory(), 0
    found = np.zeros((len(steps.at), INSTRUMENTS, EVIDENCE), np.float32)
    beats, places = steps.beat.tolist(), (steps.at % GRID).tolist()
    for step, struck in enumerate(steps.played > 0):
        keys = contexts(beats[step], places[step], steps.beats_a_bar, past)
        after = memory.after(keys)
        for k in range(INSTRUMENTS):
            for column, odds in said_of(after, k):
                found[step, k, column] = odds
            if struck[k] or heard_in(after) >> k & 1:
                after = given(after, k, bool(struck[k]))
        chord = chord_of(struck)
        memory.learn(keys, chord)
        past = with_chord(past, chord)
    return found
