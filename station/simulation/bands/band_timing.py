"""How the beats of a band without a click fall: a slow drift, choruses that push, an end that slows, a little jitter.

Songs recorded without a click stray by 2–6 % from their mean tempo (our reading of published tempo curves), from bar to
bar by less than 1 %; drummers' beats scatter by 3–8 ms about their own smooth tempo.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class BandDrift:
    """How a band keeps its tempo.

    `walk` is the SD of the slow drift as a share of the tempo, `walk_beats` how long it remembers; `push` how much
    faster choruses are; `ritard` by how much the last `ritard_beats` slow down; `jitter_s` the SD of single beats.
    """

    walk: float = 0.02
    walk_beats: float = 60.0
    push: float = 0.02
    ritard: float = 0.0
    ritard_beats: int = 8
    jitter_s: float = 0.003


def drifting_beats(count: int, period_s: float, drift: BandDrift, rng: np.random.Generator, chorus: Floats) -> Floats:
    """Times in s of `count` beats of about `period_s`, the first at 0; `chorus` (count,), 0 … 1, is where they push."""
    tempo = 1.0 + _walk(count, drift, rng) + drift.push * chorus
    slowing = np.clip((np.arange(count) - (count - 1 - drift.ritard_beats)) / drift.ritard_beats, 0.0, 1.0)
    periods = period_s / tempo * (1.0 + drift.ritard * slowing)
    smooth = np.concatenate([[0.0], np.cumsum(periods[:-1])])
    return smooth + rng.normal(0.0, drift.jitter_s, count) * (np.arange(count) > 0)


def _walk(count: int, drift: BandDrift, rng: np.random.Generator) -> Floats:
    """A random walk that is drawn back to 0 (Ornstein–Uhlenbeck), smoothed over four beats: (count,)."""
    keep = np.exp(-1.0 / drift.walk_beats)
    steps = rng.normal(0.0, drift.walk * np.sqrt(1.0 - keep**2), count + 8)
    walk = np.empty(count + 8)
    value = rng.normal(0.0, drift.walk)
    for i, step in enumerate(steps):
        value = keep * value + step
        walk[i] = value
    return np.convolve(walk, np.full(5, 0.2), "valid")[:count]
