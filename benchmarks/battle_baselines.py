"""What the battle's model is compared with: the place in the bar alone, and n-grams of whole chords.

Both are trained on the same takes as the network, over steps of a grid of sixteenths, and score bits a step.
"""

from collections import defaultdict
from collections.abc import Hashable, Sequence

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.bar_memory import chord_of
from station.practice.battle.improvising.beat_steps import INSTRUMENTS, steps_of
from tools.battle_training.takes import GrooveTake

STEPS_A_BAR = 16
_CHORDS = 1 << INSTRUMENTS


def position_bits(train: Sequence[GrooveTake], test: GrooveTake) -> NDArray[np.float64]:
    """Bits of each step (s,) where each instrument is as likely as at this place of all bars, by itself."""
    struck, count = np.full((STEPS_A_BAR, INSTRUMENTS), 0.5), np.ones((STEPS_A_BAR, 1))
    for take in train:
        bars = steps_of(take.beats).played.reshape(-1, STEPS_A_BAR, INSTRUMENTS)
        struck += bars.sum(axis=0)
        count += len(bars)
    chance = struck / count
    played = steps_of(test.beats).played.reshape(-1, STEPS_A_BAR, INSTRUMENTS)
    bits: NDArray[np.float64] = -np.log2(np.where(played > 0, chance, 1 - chance)).sum(axis=2).reshape(-1)
    return bits


class ChordNgrams:
    """Chords after the last n - 1 and the place in the bar, interpolated by Witten & Bell (1991).

    Each context counts a chord once a file, so that a looped file does not outvote the others.
    """

    def __init__(self, train: Sequence[GrooveTake], order: int) -> None:
        self.order = order
        self._after: dict[Hashable, dict[int, int]] = defaultdict(lambda: defaultdict(int))
        for take in train:
            chords = _chords(take)
            seen = {(key, chord) for step, chord in enumerate(chords) for key in self._keys(chords, step)}
            for key, chord in seen:
                self._after[key][chord] += 1

    def _keys(self, chords: Sequence[int], step: int) -> list[Hashable]:
        """The contexts of a step, the shortest first."""
        place = step % STEPS_A_BAR
        return [(), *((place, *chords[max(step - n, 0) : step]) for n in range(self.order))]

    def bits(self, test: GrooveTake) -> NDArray[np.float64]:
        """Bits of each step (s,)."""
        chords = _chords(test)
        return np.array([-np.log2(self._chance(chords, step)) for step in range(len(chords))])

    def _chance(self, chords: Sequence[int], step: int) -> float:
        chance = 1.0 / _CHORDS
        for key in self._keys(chords, step):
            after = self._after.get(key)
            if after:
                total, kinds = sum(after.values()), len(after)
                chance = (after.get(chords[step], 0) + kinds * chance) / (total + kinds)
        return chance


def _chords(take: GrooveTake) -> list[int]:
    return [chord_of(struck) for struck in steps_of(take.beats).played > 0]
