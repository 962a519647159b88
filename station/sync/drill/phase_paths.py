"""Where in a repeated motion somebody is, by the best of many ways through time instead of the best of one instant.

The paper's tracker (`sync.phase`) takes the phase that matches a sample best, near where it was: one way. In a drill
that goes astray, for the strokes of a hand look alike, sixteen of them in a turn. So all phases are kept in mind, each
at each of many tempi: a grid of `phase × tempo`, in which every cell moves on at its own tempo (the bar pointer of
Whiteley, Cemgil and Godsill, ISMIR 2006), and sums up the paper's E₁, the normalised correlation of model and sample,
along the best way that leads there (Viterbi). A change of tempo costs, and so does a phase that moves on faster or
slower than its tempo; no way falls behind the best by more than a jump would cost, so that whoever stops, or begins
anew, is found again.

Each row of the grid is kept in axes that move with its tempo: to move on costs nothing, only the samples are read at
another place.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SLOWEST, FASTEST, TEMPO_STEP = 0.45, 2.2, 1.05
"""The tempi kept in mind, as parts of the model's: half to double with room to spare, each 5 % faster than the one
before, about what a tempo must change for most listeners to notice it (our choice)."""
WEIGHT_PER_S = 45.0
"""What E₁ counts for, each second: samples 10 ms apart are nearly the same, so that one counts 0.45 (our choice)."""
JUMP = 20.0
"""No way falls farther behind: about what a second and a half of a middling match is worth (our choice)."""
CHANGE = 0.3
"""What one step of tempo, or one of phase beside the tempo, costs: a hundredth of a second's match (our choice)."""
CHANGES_PER_S = 25.0
"""How often tempo and phase may so change: 5 % of tempo 25 times a second is faster than anybody plays (our choice)."""
REST = 3.0
"""A channel that is always this, in model and sample, beside channels of SD 1: so rest matches rest, where the
normalised correlation of nothing with nothing would say anything, and strong motion counts more than weak. People
strike alike and prepare unlike: with 1 the simulated sticks are lost at half the tempo, with 2 to 4 they are found."""
APART = 8
"""Phases so many centres away are others: half a stroke of the busiest hand (`drill_model.CENTRES_A_STROKE`)."""


class PathStep(NamedTuple):
    """The best way's end: its phase in turns [0, 1), its `speed` over the model's.

    `match` is how well the sample matches there: E₁, −1 … 1, 0 where nothing was measured; `lead` by how much the way
    is ahead of the best to another phase, a stroke or more away.
    """

    turn: float
    speed: float
    match: float
    lead: float


@dataclass(frozen=True, slots=True, eq=False)
class MatchTable:
    """What the model does: `values` (k, n, c) at n phases, one row of them for each of the `tempi` (k,); scaled."""

    values: Array
    tempi: tuple[float, ...]
    cycle_s: float


class PhasePaths:
    """Follows all ways; `step_s` between samples."""

    def __init__(self, table: MatchTable, step_s: float) -> None:
        self._table = table
        self._count = table.values.shape[1]
        steps = int(np.ceil(np.log(FASTEST / SLOWEST) / np.log(TEMPO_STEP)))
        self._speeds = SLOWEST * TEMPO_STEP ** np.arange(steps + 1)
        self._tempi = np.array(table.tempi)
        nearest = np.argmin(np.abs(np.log(self._speeds[:, None] / self._tempi)), axis=1)
        self._advance = self._speeds * (self._count * step_s / table.cycle_s)
        self._moved = np.zeros(len(self._speeds))
        self._score = np.zeros((len(self._speeds), self._count))
        self._phases = np.arange(self._count)
        self._first = 2 * self._count * nearest  # where a row's kind begins in the doubled matches
        self._rows = np.arange(len(self._speeds))[:, None]
        self._weight = WEIGHT_PER_S * step_s
        self._every = max(1, round(1 / (CHANGES_PER_S * step_s)))
        self._steps, self._lead = 0, 0.0
        self._units: dict[bytes, Array] = {}

    def step(self, values: Array, present: NDArray[np.bool_]) -> PathStep:
        """The end of the best way after one more sample: `values` (c,), of which those `present` (c,) were measured."""
        self._steps += 1
        self._moved = (self._moved + self._advance) % self._count
        moved = np.round(self._moved).astype(np.int64) % self._count
        matches = self._matches(values, present)
        if matches is not None:
            doubled = np.concatenate([matches, matches], axis=1).ravel()
            self._score += self._weight * doubled[(self._first + moved)[:, None] + self._phases]
        if self._steps % self._every == 0:
            self._change(moved)
        return self._best(moved, matches)

    def model_at(self, turn: float, speed: float) -> Array:
        """What the model does at a phase [0, 1), at `speed` times its tempo: (c,)."""
        kind = int(np.argmin(np.abs(np.log(speed / self._tempi))))
        return np.asarray(self._table.values[kind, round(turn * self._count) % self._count])

    def _matches(self, values: Array, present: NDArray[np.bool_]) -> Array | None:
        """E₁ (k, n) of the sample at every phase; None without a channel."""
        if not present.any():
            return None
        key = present.tobytes()
        if key not in self._units:
            self._units[key] = _units(self._table.values[:, :, present])
        sample = np.append(values[present], REST)
        return np.asarray(self._units[key] @ (sample / np.linalg.norm(sample)))

    def _change(self, moved: NDArray[np.int64]) -> None:
        """Every cell may have come from a neighbour in tempo or phase, at a price."""
        here = self._score[self._rows, (self._phases - moved[:, None]) % self._count]
        best = here.copy()
        np.maximum(best[1:], here[:-1] - CHANGE, out=best[1:])
        np.maximum(best[:-1], here[1:] - CHANGE, out=best[:-1])
        np.maximum(best, np.maximum(np.roll(here, 1, axis=1), np.roll(here, -1, axis=1)) - CHANGE, out=best)
        self._score = best[self._rows, (self._phases + moved[:, None]) % self._count]
        self._lead = _lead(best.max(axis=0))

    def _best(self, moved: NDArray[np.int64], matches: Array | None) -> PathStep:
        self._score -= self._score.max()
        np.maximum(self._score, -JUMP, out=self._score)
        row, column = divmod(int(self._score.argmax()), self._count)
        place = (column + int(moved[row])) % self._count
        kind = self._first[row] // (2 * self._count)
        match = 0.0 if matches is None else float(matches[kind, place])
        turn = (column + _peak(self._score[row], column) + float(self._moved[row])) / self._count
        return PathStep(turn % 1.0, float(self._speeds[row]), match, self._lead)


def _units(values: Array) -> Array:
    """`values` (k, n, c) with the channel of rest beside them, each of length 1: (k, n, c + 1)."""
    kinds, count, _ = values.shape
    rested = np.concatenate([values, np.full((kinds, count, 1), REST)], axis=2)
    return np.asarray(rested / np.linalg.norm(rested, axis=2, keepdims=True))


def _lead(score: Array) -> float:
    """By how much the best phase is ahead of the best that is `APART` centres away or more."""
    top = int(score.argmax())
    apart = min(APART, len(score) // 4)
    return float(score[top] - np.roll(score, -top)[apart : len(score) - apart + 1].max())


def _peak(score: Array, at: int) -> float:
    """Where between its neighbours the greatest of a turn lies, by the paper's parabola (eq. 10–12): −0.5 … 0.5."""
    before, here, after = (float(score[(at + k) % len(score)]) for k in (-1, 0, 1))
    a, b = 0.5 * (after + before) - here, 0.5 * (after - before)
    return float(np.clip(-b / (2 * a), -0.5, 0.5)) if a < 0 else 0.0
