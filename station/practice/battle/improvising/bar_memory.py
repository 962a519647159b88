"""The memory of what one player has just played: chords of a step, by what led to them and where.

Contexts of several orders are kept, from the place in the bar alone to the last two beats, as variable-order Markov
models keep them (PPM: Cleary & Witten 1984; Begleiter, El-Yaniv & Yona 2004 on music). Each context that has been
heard says how likely an instrument is, as a log-odds; learned weights blend these with the network's (logistic mixing:
Mahoney 2005), by order and by how often the context was heard. Learning a step is seven entries in a table.
"""

from collections.abc import Hashable, Iterable, Sequence

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


def contexts(steps: Steps, step: int, chords: Sequence[int]) -> tuple[Hashable, ...]:
    """The `ORDERS` contexts of a step after the `chords` of all steps before it."""
    beat, bar = int(steps.beat[step]), steps.beats_a_bar
    place = int(steps.at[step]) % GRID
    here = beat % bar * GRID + place
    three, eight = tuple(chords[-3:]), tuple(chords[-8:])
    return (
        (0, here),
        (1, beat % (2 * bar) * GRID + place),
        (2, here, chords[-1] if chords else 0),
        (3, here, three),
        (4, here, eight),
        (5, place, three),
        (6, place, eight),
    )


def chord_of(struck: Iterable[float]) -> int:
    """What is struck at a step (9,) as a number, a bit for each instrument."""
    return sum(1 << k for k, is_struck in enumerate(struck) if is_struck)


class BarMemory:
    """What has been heard after each context; grows by `learn`, a step at a time."""

    def __init__(self) -> None:
        self._after: dict[Hashable, Heard] = {}

    def after(self, keys: Sequence[Hashable]) -> After:
        """What came after each of the contexts that have been heard."""
        known = self._after
        return [(order, known[key]) for order, key in enumerate(keys) if key in known]

    def learn(self, keys: Sequence[Hashable], chord: int) -> None:
        """Remember that `chord` came in these contexts."""
        for key in keys:
            heard = self._after.setdefault(key, {})
            heard[chord] = heard.get(chord, 0) + 1
            if sum(heard.values()) > MOST_KEPT:
                self._after[key] = {c: n // 2 for c, n in heard.items() if n > 1 or c == chord}
                self._after[key][chord] = max(self._after[key][chord], 1)


def said_of(after: After, instrument: int) -> list[tuple[int, float]]:
    """What the contexts say of an instrument: pairs of a column of evidence and a log-odds."""
    bit = 1 << instrument
    found = []
    for order, heard in after:
        total = struck = 0
        for chord, times in heard.items():
            total += times
            if chord & bit:
                struck += times
        found.append((order * len(TIMES) + _COLUMN[total], _LOG_ODDS[total][struck]))
    return found


def given(after: After, instrument: int, is_struck: bool) -> After:
    """What is left of it when it is known whether an instrument is struck."""
    bit, wanted = 1 << instrument, is_struck << instrument
    left = []
    for order, heard in after:
        if any(chord & bit != wanted for chord in heard):
            heard = {chord: times for chord, times in heard.items() if chord & bit == wanted}  # noqa: PLW2901
        if heard:
            left.append((order, heard))
    return left


def evidence_of(steps: Steps) -> NDArray[np.float32]:
    """What a memory that hears the steps one after the other says before each, shape (s, 9, EVIDENCE)."""
    memory = BarMemory()
    chords: list[int] = []
    found = np.zeros((len(steps.at), INSTRUMENTS, EVIDENCE), np.float32)
    for step, struck in enumerate(steps.played > 0):
        keys = contexts(steps, step, chords)
        after = memory.after(keys)
        for k in range(INSTRUMENTS):
            for column, odds in said_of(after, k):
                found[step, k, column] = odds
            after = given(after, k, bool(struck[k]))
        chords.append(chord_of(struck))
        memory.learn(keys, chords[-1])
    return found
