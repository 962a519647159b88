"""Many samples at once: the recursion of `PhaseTracker` run in lanes side by side, with the same result.

A sample's phase depends on the one before, so the signal is cut into stretches, one a lane. All lanes but the first
begin a little early, where their sample fits best: trackers of one signal draw together within a fraction of a period,
so that a lane has mostly joined its neighbour's way when its own stretch begins. Where it has not (somebody stands
still, other motion), it is run again from where its neighbour ended, until all of them agree.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from station.sync.phase.cadence import CadenceRule
from station.sync.phase.objective import Objective
from station.sync.phase.periodic_model import TURN
from station.sync.phase.templates import Templates
from station.sync.signals.signal import FloatArray

STRETCH = 256
"""Samples of a lane (our choice: half and double take as long)."""
EARLY = 160
"""Samples by which a lane begins early, at most `STRETCH` (our choice: with λ 100 two ways draw together by about 0.8 a
sample)."""
JOINED = 1e-12
"""Steps between centres: two ways that are as near as this are one."""
_FLAT = -1e-300
"""Stands for a parabola without curvature, whose slope is 0 too, so that it is not divided by 0."""
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
        count = objective.count
        self._margin = int(np.abs(objective.offsets).max()) + 1
        self._goes_round = 2 * self._margin + 1 > count
        around = np.arange(-self._margin, count + self._margin) % count
        self._width = len(around)
        directions = templates.directions[:, around].reshape(-1, templates.directions.shape[2])
        self._directions = np.ascontiguousarray(directions.T)
        self._offsets = objective.offsets[:, None]
        self._steps = self._offsets.astype(np.float64)

    def way(self, seen: FloatArray, place: float, pace: float) -> Way:
        """The way (n,) through samples (n, lags·c), n ≥ 1, from a place and a pace before the first."""
        count, width = seen.shape
        lanes = -(-count // STRETCH)
        padded = np.zeros((lanes * STRETCH, width))
        padded[:count] = seen
        stretches = padded.reshape(lanes, STRETCH, width)
        found = np.zeros((len(Way._fields), STRETCH, lanes))
        places, paces = self._warmed(stretches, place, pace)
        self._along(stretches, found, slice(None), places, paces)
        while len(late := self._not_joined(found, places, paces)):
            places[late], paces[late] = found[:2, -1, late - 1]
            self._along(stretches, found, late, places[late], paces[late])
        return Way(*found.transpose(0, 2, 1).reshape(len(found), -1)[:, :count])

    def _warmed(self, stretches: FloatArray, place: float, pace: float) -> tuple[FloatArray, FloatArray]:
        """The places and paces with which the lanes begin, as far as the ends of the stretches before tell them."""
        places, paces = np.full(len(stretches), place), np.full(len(stretches), pace)
        before, first = stretches[:-1], STRETCH - EARLY
        at, rates = self._fitting(before[:, first], paces[1:]) - pace, paces[1:]
        for sample in range(first, STRETCH):
            at, rates, *_ = self._step(before[:, sample], at, rates)
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
        for sample in range(STRETCH):
            step = self._step(stretches[lanes, sample], places, paces)
            places, paces = step.place, step.pace
            for row, values in zip(found, step, strict=True):
                row[sample, lanes] = values

    def _not_joined(self, found: FloatArray, places: FloatArray, paces: FloatArray) -> Whole:
        """The lanes that did not begin where their neighbours ended."""
        end, end_pace = found[:2, -1, :-1]
        apart = np.maximum(np.abs(self._objective.short(places[1:] - end)), np.abs(paces[1:] - end_pace))
        return np.flatnonzero(apart > JOINED) + 1

    def _step(self, seen: FloatArray, places: FloatArray, paces: FloatArray) -> Way:
        """One sample (lanes, lags·c) in every lane: `Objective.best`, and what `PhaseTracker.step` does with it."""
        count, price = self._objective.count, self._objective.price
        energy = np.einsum("ij,ij->i", seen, seen)
        per_length = 1 / np.sqrt(np.where(energy > 0, energy, np.inf))
        products = seen @ self._directions
        expected = places + paces
        near = np.rint(expected)
        rest = expected - near
        near -= count * np.floor(near / count)
        middle = self._first(paces) + near.astype(np.int64)
        alike = products.take(self._offsets + middle) * per_length
        values = alike - price * self._apart(self._steps - rest) ** 2
        chosen = values.argmax(axis=0)
        at = chosen * len(seen) + np.arange(len(seen))
        here, likeness = values.take(at), alike.take(at)
        offset = self._objective.offsets.take(chosen)
        middle += offset
        ahead = offset - rest
        above = products.take(middle + 1) * per_length - price * self._apart(ahead + 1) ** 2
        below = products.take(middle - 1) * per_length - price * self._apart(ahead - 1) ** 2
        a, b = 0.5 * (above + below) - here, 0.5 * (above - below)
        beyond = -0.5 * b / np.minimum(a, _FLAT)
        centre = near + offset
        centre -= count * np.floor(centre / count)
        surprise = self._apart(ahead + beyond)
        after = self._cadence.after_all(paces, likeness, surprise) if self._cadence.feedback else paces
        quality = here + 0.5 * b * beyond
        return Way(centre + beyond, after, centre, quality, likeness, paces + surprise, energy)

    def _first(self, paces: FloatArray) -> Whole:
        """Where the product with centre 0 is, for each lane, in the table for its pace."""
        first: Whole = np.arange(len(paces)) * self._directions.shape[1] + self._margin
        if len(self._templates.directions) > 1:
            first += self._templates.tables(paces * (TURN / self._objective.count)) * self._width
        return first

    def _apart(self, steps: FloatArray) -> FloatArray:
        return self._objective.short(steps) if self._goes_round else steps
