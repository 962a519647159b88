"""Many samples at once: the recursion of `PhaseTracker` run in lanes side by side, with the same result.

A sample's phase depends on the one before, so the signal is cut into segments, one a lane. All lanes but the first
begin a little early, where their sample fits best: trackers of one signal draw together within a fraction of a period,
so that a lane has mostly joined its neighbour's way when its own segment begins. Where it has not (somebody stands
still, other motion), it is run again from where its neighbour ended, until all of them agree.
"""

from collections.abc import Iterator
from math import ceil, sqrt
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from station.sync.phase.cadence import DOUBTFUL, CadenceRule
from station.sync.phase.objective import Objective
from station.sync.phase.periodic_model import TURN
from station.sync.phase.templates import Seen, Templates
from station.sync.signals.signal import FloatArray

STEADY, FOLLOWING = (256, 128), (512, 512)
"""Samples of a lane, and how many earlier it begins, at most as many. Two ways draw together by about 0.8 a sample
where λ is 100 and the cadence the paper's, by 0.98 where it follows (our choice: the lanes as long as is fastest)."""
WORTH = 20
"""Lanes pay from so many samples for each that a lane takes: a step of all lanes costs about 20 of one (measured)."""
_AT_ONCE = 32
"""Lanes whose ways are given at once: so few that what is made of them stays in the processor's cache (our choice)."""
JOINED = 1e-11
"""Steps between centres: two ways that are as near as this are one."""
_FLAT = -1e-300
"""Stands for a parabola without curvature, whose slope is 0 too, so that it is not divided by 0."""
_STATES = 3
"""Fields of a `Way` that the next step needs."""
Whole = npt.NDArray[np.int64]


class Way(NamedTuple):
    """Where a tracker was, sample by sample.

    `pace` and `doubt` are those after the sample, `speed` the steps it went, `energy` that of the signal and `expected`
    that of the model.
    """

    place: FloatArray
    pace: FloatArray
    doubt: FloatArray
    quality: FloatArray
    likeness: FloatArray
    speed: FloatArray
    energy: FloatArray
    expected: FloatArray


class Lanes:
    """Runs a tracker over a whole signal."""

    def __init__(self, objective: Objective, templates: Templates, cadence: CadenceRule) -> None:
        self._objective, self._templates, self._cadence = objective, templates, cadence
        self._segment, self._early = FOLLOWING if cadence.feedback else STEADY
        self.worth = WORTH * (self._segment + self._early)
        self._below = int(np.abs(objective.offsets).max()) + 1
        self._goes_round = 2 * self._below + 1 > objective.count
        above = self._below + ceil(cadence.fastest) + 1
        around = np.arange(-self._below, objective.count + above) % objective.count
        self._width = len(around)
        directions = templates.directions[:, around].reshape(-1, templates.directions.shape[2])
        self._directions = np.ascontiguousarray(directions.T)
        self._row = len(directions)
        self._energy = templates.energy[:, around].ravel()
        self._offsets = objective.offsets[:, None]
        self._root = sqrt(objective.price)

    def ways(self, seen: Seen, place: float, pace: float) -> Iterator[Way]:
        """The way through n ≥ 1 samples, bit by bit, from a place from 0 to n_m and a pace before the first."""
        begins = np.arange(0, len(seen), self._segment)
        found = np.zeros((len(Way._fields), self._segment, len(begins)))
        states = self._warmed(seen, begins, place, pace)
        self._along(seen, begins, found, slice(None), states)
        while len(late := self._not_joined(found, states)):
            states[:, late] = found[:_STATES, -1, late - 1]
            self._along(seen, begins, found, late, states[:, late])
        left = len(seen)
        for first in range(0, len(begins), _AT_ONCE):
            some = found[:, :, first : first + _AT_ONCE].transpose(0, 2, 1).reshape(len(found), -1)[:, :left]
            yield Way._make(some)
            left -= some.shape[1]

    def _warmed(self, seen: Seen, begins: Whole, place: float, pace: float) -> FloatArray:
        """The states with which the lanes begin, as far as the ends of the segments before them tell."""
        states = np.zeros((_STATES, len(begins)))
        states[0], states[1] = place, pace
        if len(begins) == 1:
            return states
        samples, early = begins[1:] - self._early, states[:, 1:]
        early[0] = self._fitting(seen.at(samples) @ self._directions, self._first(early[1])) - pace
        for age in range(self._early):
            early = np.array(self._step(seen.at(samples + age), early)[:_STATES])
        states[:, 1:] = early
        return states

    def _fitting(self, products: FloatArray, first: Whole) -> FloatArray:
        """The centres that fit best, nothing else known."""
        at = first[:, None] + np.arange(self._objective.count)
        best: FloatArray = products.take(at).argmax(axis=1).astype(np.float64)
        return best

    def _along(self, seen: Seen, begins: Whole, found: FloatArray, lanes: Whole | slice, begin: FloatArray) -> None:
        """Run lanes through their segments, and write their ways down; beyond the end the last sample stays."""
        states: FloatArray | tuple[FloatArray, ...] = begin
        for sample in range(self._segment):
            step = self._step(seen.at(np.minimum(begins[lanes] + sample, len(seen) - 1)), states)
            states = step[:_STATES]
            for row, values in zip(found, step, strict=True):
                row[sample, lanes] = values

    def _not_joined(self, found: FloatArray, states: FloatArray) -> Whole:
        """The lanes that did not begin where their neighbours ended."""
        apart = np.abs(states[:, 1:] - found[:_STATES, -1, :-1])
        apart[0] = np.abs(self._objective.short(apart[0]))
        return np.flatnonzero(apart.max(axis=0, initial=0.0) > JOINED) + 1

    def _step(self, seen: FloatArray, states: FloatArray | tuple[FloatArray, ...]) -> tuple[FloatArray, ...]:
        """One sample (lanes, lags·c) in every lane, as `PhaseTracker.step`: the fields of a `Way`."""
        places, paces, doubts = states
        energy = np.einsum("ij,ij->i", seen, seen)
        seen *= (1 / np.sqrt(np.where(energy > 0, energy, np.inf)))[:, None]
        products = seen @ self._directions
        first = self._first(paces)
        found = self._best(products, first, places + paces)
        place, quality, likeness, surprise, expected = found
        speed, after = paces + surprise, paces
        if self._cadence.feedback:
            after = self._cadence.after_all(paces, likeness, surprise)
        if self._cadence.most_doubt < np.inf:
            doubts = self._doubts(doubts, products, first, likeness)
            lost = np.flatnonzero(doubts > self._cadence.most_doubt)
            if len(lost):
                anew = self._best(products, first[lost], self._fitting(products, first[lost]))
                for row, values in zip(found, anew, strict=True):
                    row[lost] = values
                after = after.copy()
                doubts[lost], speed[lost], after[lost] = 0.0, 0.0, self._cadence.usual
        return place, after, doubts, quality, likeness, speed, energy, expected

    def _doubts(self, doubts: FloatArray, products: FloatArray, first: Whole, likeness: FloatArray) -> FloatArray:
        """The doubts after a sample, whose likeness at the places is given."""
        better = np.zeros_like(doubts)
        doubtful = np.flatnonzero(likeness < DOUBTFUL)
        at = first[doubtful, None] + np.arange(self._objective.count)
        better[doubtful] = products.take(at).max(axis=1) - likeness[doubtful]
        after: FloatArray = doubts + self._cadence.doubt_weight * (better - doubts)
        return after

    def _best(self, products: FloatArray, first: Whole, expected: FloatArray) -> tuple[FloatArray, ...]:
        """As `Objective.best`: places, E, E1 at the centres, steps from the expected places, |f|² at the centres."""
        near = np.rint(expected)
        rest = expected - near
        middle = first + near.astype(np.int64)
        alike = products.take(self._offsets + middle)
        values = alike - self._cost(self._offsets, rest)
        chosen = values.argmax(axis=0)
        at = chosen * len(first) + np.arange(len(first))
        here, likeness = values.take(at), alike.take(at)
        offset = self._objective.offsets.take(chosen)
        middle += offset
        above = products.take(middle + 1) - self._cost(offset + 1, rest)
        below = products.take(middle - 1) - self._cost(offset - 1, rest)
        a, b = 0.5 * (above + below) - here, 0.5 * (above - below)
        beyond = -0.5 * b / np.minimum(a, _FLAT)
        centre = near + offset
        surprise = self._apart(offset - rest + beyond)
        centre -= self._objective.count * np.floor(centre / self._objective.count)
        return centre + beyond, here + 0.5 * b * beyond, likeness, surprise, self._energy.take(middle % self._row)

    def _cost(self, offsets: npt.NDArray[np.int64], rest: FloatArray) -> FloatArray:
        """λE2 so many centres from the one that is `rest` before the expected place."""
        steps = self._root * self._apart(offsets - rest)
        return steps * steps

    def _first(self, paces: FloatArray) -> Whole:
        """Where the product with centre 0 is, for each lane, in the table for its pace."""
        first: Whole = np.arange(len(paces)) * self._row + self._below
        if len(self._templates.directions) > 1:
            first += self._templates.tables(paces * (TURN / self._objective.count)) * self._width
        return first

    def _apart(self, steps: FloatArray) -> FloatArray:
        return self._objective.short(steps) if self._goes_round else steps
