"""Many samples at once: the recursion of `PhaseTracker` run in lanes side by side, with the same result.

A sample's phase depends on the one before, so the signal is cut into stretches, one a lane. All lanes but the first
begin a little early, where their sample fits best: trackers of one signal draw together within a fraction of a period,
so that a lane has mostly joined its neighbour's way when its own stretch begins. Where it has not (somebody stands
still, other motion), it is run again from where its neighbour ended, until all of them agree.
"""

from math import ceil, sqrt
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from station.sync.phase.cadence import CadenceRule
from station.sync.phase.objective import Objective
from station.sync.phase.periodic_model import TURN
from station.sync.phase.templates import Templates
from station.sync.signals.signal import FloatArray

STEADY, FOLLOWING = (256, 128), (512, 512)
"""Samples of a lane, and how many earlier it begins, at most as many. Two ways draw together by about 0.8 a sample where
λ is 100 and the cadence the paper's, by 0.95 where it follows (our choice; the lanes are as long as is fastest)."""
JOINED = 1e-11
"""Steps between centres: two ways that are as near as this are one."""
_FLAT = -1e-300
"""Stands for a parabola without curvature, whose slope is 0 too, so that it is not divided by 0."""
_ROWS = 6
"""Fields of a `Way` that a step gives."""
Whole = npt.NDArray[np.int64]


class Way(NamedTuple):
    """Where a tracker was, sample by sample.

    `pace` is the one after the sample, `speed` the steps it went, `energy` that of the signal.
    """

    place: FloatArray
    pace: FloatArray
    centre: FloatArray
    quality: FloatArray
    likeness: FloatArray
    speed: FloatArray
    energy: FloatArray


class Lanes:
    """Runs a tracker over a whole signal."""

    def __init__(self, objective: Objective, templates: Templates, cadence: CadenceRule) -> None:
        self._objective, self._templates, self._cadence = objective, templates, cadence
        self._stretch, self._early = FOLLOWING if cadence.feedback else STEADY
        self._below = int(np.abs(objective.offsets).max()) + 1
        self._goes_round = 2 * self._below + 1 > objective.count
        above = self._below + ceil(cadence.fastest) + 1
        around = np.arange(-self._below, objective.count + above) % objective.count
        self._width = len(around)
        directions = templates.directions[:, around].reshape(-1, templates.directions.shape[2])
        self._directions = np.ascontiguousarray(directions.T)
        self._offsets = objective.offsets[:, None]
        self._root = sqrt(objective.price)

    def way(self, seen: FloatArray, place: float, pace: float) -> Way:
        """The way (n,) through samples (n, lags·c), n ≥ 1, from a place from 0 to n_m and a pace before the first."""
        count, width = seen.shape
        lanes = -(-count // self._stretch)
        energy = np.einsum("ij,ij->i", seen, seen)
        padded = np.zeros((lanes * self._stretch, width))
        np.multiply(seen, (1 / np.sqrt(np.where(energy > 0, energy, np.inf)))[:, None], out=padded[:count])
        stretches = padded.reshape(lanes, self._stretch, width)
        found = np.zeros((_ROWS, self._stretch, lanes))
        places, paces = self._warmed(stretches, place, pace)
        self._along(stretches, found, slice(None), places, paces)
        while len(late := self._not_joined(found, places, paces)):
            places[late], paces[late] = found[:2, -1, late - 1]
            self._along(stretches, found, late, places[late], paces[late])
        rows = found.transpose(0, 2, 1).reshape(_ROWS, -1)[:, :count]
        return Way._make([*rows, energy])

    def _warmed(self, stretches: FloatArray, place: float, pace: float) -> tuple[FloatArray, FloatArray]:
        """The places and paces with which the lanes begin, as far as the ends of the stretches before tell them."""
        places, paces = np.full(len(stretches), place), np.full(len(stretches), pace)
        before, first = stretches[:-1], self._stretch - self._early
        at, rates = self._fitting(before[:, first], paces[1:]) - pace, paces[1:]
        for sample in range(first, self._stretch):
            at, rates = self._step(before[:, sample], at, rates)[:2]
        places[1:], paces[1:] = at, rates
        return places, paces

    def _fitting(self, seen: FloatArray, paces: FloatArray) -> FloatArray:
        """The centres that fit these samples best, nothing else known."""
        first = self._first(paces)[:, None] + np.arange(self._objective.count)
        best: FloatArray = (seen @ self._directions).take(first).argmax(axis=1).astype(np.float64)
        return best

    def _along(
        self, stretches: FloatArray, found: FloatArray, lanes: Whole | slice, places: FloatArray, paces: FloatArray
    ) -> None:
        """Run lanes through their stretches, and write their ways down."""
        for sample in range(self._stretch):
            step = self._step(stretches[lanes, sample], places, paces)
            places, paces = step[:2]
            for row, values in zip(found, step, strict=True):
                row[sample, lanes] = values

    def _not_joined(self, found: FloatArray, places: FloatArray, paces: FloatArray) -> Whole:
        """The lanes that did not begin where their neighbours ended."""
        end, end_pace = found[:2, -1, :-1]
        apart = np.maximum(np.abs(self._objective.short(places[1:] - end)), np.abs(paces[1:] - end_pace))
        return np.flatnonzero(apart > JOINED) + 1

    def _step(self, seen: FloatArray, places: FloatArray, paces: FloatArray) -> tuple[FloatArray, ...]:
        """One sample (lanes, lags·c) of length 1 in every lane; the first fields of a `Way`.

        As `Objective.best`, and what `PhaseTracker.step` does with it.
        """
        products = seen @ self._directions
        expected = places + paces
        near = np.rint(expected)
        rest = expected - near
        middle = self._first(paces) + near.astype(np.int64)
        alike = products.take(self._offsets + middle)
        values = alike - self._cost(self._offsets, rest)
        chosen = values.argmax(axis=0)
        at = chosen * len(seen) + np.arange(len(seen))
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
        after = self._cadence.after_all(paces, likeness, surprise) if self._cadence.feedback else paces
        return centre + beyond, after, centre, here + 0.5 * b * beyond, likeness, paces + surprise

    def _cost(self, offsets: npt.NDArray[np.int64], rest: FloatArray) -> FloatArray:
        """λE2 so many centres from the one that is `rest` before the expected place."""
        steps = self._root * self._apart(offsets - rest)
        return steps * steps

    def _first(self, paces: FloatArray) -> Whole:
        """Where the product with centre 0 is, for each lane, in the table for its pace."""
        first: Whole = np.arange(len(paces)) * self._directions.shape[1] + self._below
        if len(self._templates.directions) > 1:
            first += self._templates.tables(paces * (TURN / self._objective.count)) * self._width
        return first

    def _apart(self, steps: FloatArray) -> FloatArray:
        return self._objective.short(steps) if self._goes_round else steps
