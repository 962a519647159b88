"""What a tracker compares a signal with: the model at its centres, one instant or several at once.

Where samples of several ages are compared, those of the model lie as far back in phase as the cadence tells: so there
is a table for each of some cadences.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from math import log2

import numpy as np
import numpy.typing as npt

from station.sync.phase.periodic_model import PeriodicModel, centres
from station.sync.signals.signal import FloatArray

_TABLES_AN_OCTAVE = 4
"""Cadences lie at most 9 % from a table's: over half a period that is 0.045 turns (our choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class Templates:
    """Tables for one cadence, or for several: the first for `slowest_rad`, then `_TABLES_AN_OCTAVE` to each doubling.

    `directions` (tables, n_m, lags·c): f(μ_j) / |f(μ_j)|, 0 where that is 0; `energy` (tables, n_m): |f(μ_j)|².
    """

    directions: FloatArray
    energy: FloatArray
    slowest_rad: float

    def table(self, cadence_rad: float) -> int:
        """The table for a cadence."""
        last = len(self.directions) - 1
        return 0 if last == 0 else min(max(round(log2(cadence_rad / self.slowest_rad) * _TABLES_AN_OCTAVE), 0), last)

    def tables(self, cadence_rad: FloatArray) -> npt.NDArray[np.int64]:
        """The tables for several cadences (n,)."""
        at = np.rint(np.log2(cadence_rad / self.slowest_rad) * _TABLES_AN_OCTAVE)
        found: npt.NDArray[np.int64] = np.clip(at, 0, len(self.directions) - 1).astype(np.int64)
        return found


def templates(model: PeriodicModel, lags: Sequence[int], slowest_rad: float, fastest_rad: float) -> Templates:
    """The tables of a model; of several ages of samples a table for each of the cadences, else one."""
    count = round(log2(fastest_rad / slowest_rad) * _TABLES_AN_OCTAVE) + 1 if len(lags) > 1 else 1
    cadences = [slowest_rad * 2 ** (at / _TABLES_AN_OCTAVE) for at in range(count)]
    stacked = np.array([_stacked(model, cadence, lags) for cadence in cadences])
    energy = (stacked**2).sum(axis=2)
    length = np.sqrt(energy)[:, :, None]
    return Templates(np.divide(stacked, length, out=np.zeros_like(stacked), where=length > 0), energy, slowest_rad)


def _stacked(model: PeriodicModel, cadence_rad: float, lags: Sequence[int]) -> FloatArray:
    """The model at its centres and, beside it, as long ago as each of the lags: (n_m, lags·c)."""
    phase = centres(model.centre_count)
    return np.concatenate([model.at(phase - lag * cadence_rad) for lag in lags], axis=1)


class Past:
    """The newest sample of a signal with older ones beside it; before the first sample the signal stood still."""

    def __init__(self, lags: Sequence[int]) -> None:
        self._places = [-1 - lag for lag in lags]
        self._samples: deque[FloatArray] = deque(maxlen=max(lags) + 1)

    def with_older(self, sample: FloatArray) -> FloatArray:
        """The samples of all lags, one after the other."""
        if not self._samples:
            self._samples.extend([sample] * (self._samples.maxlen or 1))
        self._samples.append(sample)
        return np.concatenate([self._samples[place] for place in self._places])


class Seen:
    """What a tracker sees of a whole signal `values` (n, c): what `Past` gives for each sample."""

    def __init__(self, model: PeriodicModel, values: FloatArray, lags: Sequence[int]) -> None:
        self._model, self._values, self._lags = model, values, lags

    def __len__(self) -> int:
        return len(self._values)

    def at(self, samples: npt.NDArray[np.int64]) -> FloatArray:
        """The model's zero-mean form of these samples (k,) and older ones, a new array (k, lags·c)."""
        if len(self._lags) == 1:
            return self._model.zero_mean(self._values.take(samples, axis=0))
        ages = [self._values.take(np.maximum(samples - lag, 0), axis=0) for lag in self._lags]
        return np.concatenate([self._model.zero_mean(each) for each in ages], axis=1)
