"""Cycles cut out of a take, each sample with its phase: what a model is fitted to.

A cycle reaches from one reference to the next. Boyd and Godbout 2012, § 3.1, take the first two zero crossings, with
positive slope, of the right femur's x-rotation; phase ramps from 0 to 2π between them.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from station.core.errors import BadInput
from station.sync.phase.periodic_model import TURN, Exemplar
from station.sync.signals.signal import FloatArray, Signal

_ARMED_SD = 0.25
"""A crossing counts after the channel was this many SDs below its mean, so that noise makes no second (our choice)."""
FEWEST_SAMPLES = 4
"""Of a cycle: fewer cannot tell a fundamental from its harmonic (our choice)."""


def rising_crossings_s(time_s: FloatArray, values: FloatArray) -> FloatArray:
    """When a channel (n,) passes its mean upwards, between samples by the straight line."""
    if not len(values):
        return np.empty(0)
    level = values - values.mean()
    depth = -_ARMED_SD * level.std()
    found, is_armed = [], False
    for at in range(1, len(level)):
        is_armed = is_armed or level[at - 1] < depth
        if is_armed and level[at - 1] < 0 <= level[at]:
            part = level[at - 1] / (level[at - 1] - level[at])
            found.append(time_s[at - 1] + part * (time_s[at] - time_s[at - 1]))
            is_armed = False
    return np.array(found)


def cycle(signal: Signal, start_s: float, end_s: float) -> Exemplar:
    """The samples from `start_s` up to `end_s`, phase from 0 to 2π.

    Raises `BadInput` where they are too few, are not the whole cycle, or all alike. The last sample lasts as long as
    the others.
    """
    inside = (signal.time_s >= start_s) & (signal.time_s < end_s)
    place = f"{start_s:g} to {end_s:g} s"
    if inside.sum() < FEWEST_SAMPLES:
        fault = f"expected at least {FEWEST_SAMPLES} samples in a cycle, found {inside.sum()}"
        raise BadInput(signal.name, place, fault)
    step_s = 1 / signal.rate_hz
    first_s, last_s = float(signal.time_s[0]), float(signal.time_s[-1]) + step_s
    if start_s < first_s - step_s or end_s > last_s + step_s:
        raise BadInput(signal.name, place, f"expected a cycle within {first_s:g} to {last_s:g} s")
    if not np.ptp(signal.values[inside], axis=0).any():
        raise BadInput(signal.name, place, "expected a motion, found every channel still")
    phase_rad = (signal.time_s[inside] - start_s) * (TURN / (end_s - start_s))
    return Exemplar(signal.values[inside], phase_rad, end_s - start_s)


def cycles(signal: Signal, reference: str, most: int | None = 1, names: Sequence[str] | None = None) -> list[Exemplar]:
    """The first cycles (`most`, or all) between rising crossings of the channel `reference`, of `names` or all.

    Raises `BadInput` where there is no such channel, or no whole cycle.
    """
    crossings_s = rising_crossings_s(signal.time_s, signal.only([reference]).values[:, 0])
    if len(crossings_s) < 2:
        fault = f"{reference}: expected two zero crossings with positive slope, found {len(crossings_s)}"
        raise BadInput(signal.name, "", fault)
    pairs = list(pairwise(crossings_s.tolist()))[:most]
    kept = signal if names is None else signal.only(names)
    return [cycle(kept, start_s, end_s) for start_s, end_s in pairs]
