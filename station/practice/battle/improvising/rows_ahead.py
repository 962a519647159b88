"""What is known before each step of a line that is being played: the rows of `beat_steps`, nothing of them asked twice.

While a beat is played only its last steps and the grid change. How much there was of each instrument stays for the
beat, where the beats stand and what the music is for the whole line.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.beat_steps import (
    AMOUNTS,
    GRID,
    RECENT,
    Music,
    Steps,
    amounts,
    beat_place,
    earlier_offsets,
    music_row,
    past_divisions,
    place_in_beat,
)
from station.practice.battle.improvising.played_divisions import DIVISIONS

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class RowsAhead:
    """The rows of the beats of `steps` from `first` on, while they are played.

    `stays` (b, columns) is where each beat stands, and the music; by division, `places` (d, columns) are its cells'
    and `earlier` (d, 16) which rows of the grid they see, beside the beat's own.
    """

    steps: Steps
    first: int
    stays: Floats
    places: Mapping[int, Floats]
    earlier: Mapping[int, NDArray[np.int64]]

    @classmethod
    def of(cls, steps: Steps, first: int, beats: int, music: Music) -> "RowsAhead":
        """Of so many beats."""
        where = beat_place(np.arange(first, first + beats), steps.beats_a_bar, music)
        cells = {d: np.full(d, GRID // d) for d in DIVISIONS}
        at = {d: np.arange(d) * (GRID // d) for d in DIVISIONS}
        return cls(
            steps,
            first,
            np.concatenate([where, np.tile(music_row(music), (beats, 1))], axis=1),
            {d: place_in_beat(np.full(d, d), at[d]) for d in DIVISIONS},
            {d: at[d][:, None] + earlier_offsets(cells[d], steps.beats_a_bar) for d in DIVISIONS},
        )

    def known_before(self, beat: int) -> Floats:
        """What stays for a whole beat: how much of each instrument there was, where it stands, the music."""
        return np.concatenate([amounts(self.steps, beat), self.stays[beat - self.first]])

    def of_division(self, beat: int, known: Floats) -> Floats:
        """The row (1, columns) before a beat is divided, as of `division_rows`."""
        return np.concatenate([past_divisions(self.steps, np.array([beat]))[0], known])[None]

    def of_steps(self, beat: int, step: int, known: Floats) -> Callable[[int], Floats]:
        """Of a beat whose first step is `step`: the row (1, columns) before each of its cells, as of `step_rows`."""
        steps, division = self.steps, int(self.steps.division[beat])
        seen = np.maximum(self.earlier[division] + beat * GRID, 0)
        places, amount, stays = self.places[division], known[:AMOUNTS], known[AMOUNTS:]

        def row(cell: int) -> Floats:
            recent = steps.struck[step + cell : step + cell + RECENT].ravel()
            return np.concatenate([recent, steps.grid[seen[cell]].ravel(), amount, places[cell], stays])[None]

        return row
