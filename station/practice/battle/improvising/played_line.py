"""What was heard and what is being played as one line of steps that grows, with a memory of it."""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.bar_memory import BarMemory, chord_of, contexts, with_chord
from station.practice.battle.improvising.beat_steps import GRID, INSTRUMENTS, LONGEST_LAG, RECENT, Steps, steps_of
from station.practice.battle.improvising.played_beats import Beats
from station.practice.battle.improvising.played_divisions import DIVISIONS, MOST_CELLS

_Number = TypeVar("_Number", bound=np.generic)


@dataclass(eq=False)
class PlayedLine:
    """What was heard and what is played, growing: `steps` has room for it all, of which `step` and `beat` are there.

    Of the steps' places only those are written that were heard. `memory` has heard it all, `past` is its last chords
    (`with_chord`), `divisions` (beats_a_bar, d) how often each place of the bar had each division.
    """

    steps: Steps
    memory: BarMemory
    divisions: NDArray[np.float64]
    past: int = 0
    step: int = 0
    beat: int = 0

    @classmethod
    def after(cls, heard: Sequence[Beats], beats: int, beats_a_bar: int) -> "PlayedLine":
        """What was heard, remembered, and room for so many beats."""
        known = steps_of(heard[0]) if heard else steps_of(Beats.silent(0, beats_a_bar))
        line = cls(_with_room(known, beats), BarMemory(), np.zeros((beats_a_bar, len(DIVISIONS))))
        chords = (known.played @ _CHORDS).astype(np.int64).tolist()
        for beat, at, chord in zip(known.beat.tolist(), known.at.tolist(), chords, strict=True):
            line._remember(contexts(beat, at % GRID, beats_a_bar, line.past), chord)
        for division in known.division.tolist():
            line._next_beat(division)
        return line

    def strike(self, place: int, keys: Sequence[Hashable], struck: Sequence[bool]) -> None:
        """Play the next step (9,), at that place of the beat, in its contexts."""
        row = np.array(struck, np.float32)
        self.steps.struck[RECENT + self.step] = row
        self.steps.grid[(LONGEST_LAG + self.beat) * GRID + place] = row
        self._remember(keys, chord_of(struck))

    def end_beat(self) -> None:
        """Count what the beat had, and go on to the next."""
        steps, division = self.steps, int(self.steps.division[self.beat])
        in_beat = steps.struck[RECENT + self.step - division : RECENT + self.step]
        steps.counts[self.beat + 1] = steps.counts[self.beat] + in_beat.sum(axis=0)
        self._next_beat(division)

    def _remember(self, keys: Sequence[Hashable], chord: int) -> None:
        self.memory.learn(keys, chord)
        self.past = with_chord(self.past, chord)
        self.step += 1

    def _next_beat(self, division: int) -> None:
        self.divisions[self.beat % self.steps.beats_a_bar, DIVISIONS.index(division)] += 1
        self.beat += 1


_CHORDS = (1 << np.arange(INSTRUMENTS)).astype(np.float32)
"""The bit of each instrument in a chord."""


def _with_room(known: Steps, beats: int) -> Steps:
    """The steps with room behind them for what is struck in so many beats of the finest division."""
    return replace(
        known,
        division=_longer(known.division, beats),
        struck=_longer(known.struck, beats * MOST_CELLS),
        grid=_longer(known.grid, beats * GRID),
        counts=_longer(known.counts, beats),
    )


def _longer(values: NDArray[_Number], by: int) -> NDArray[_Number]:
    return np.concatenate([values, np.zeros((by, *values.shape[1:]), values.dtype)])
