"""How much a hit near a note speaks for an alignment: the log of a likelihood ratio, right place against any place.

At the right place a hit lies near a note of its class (normal, `SD_S`) or is one of the stray share; anywhere else
it lies near one as often as the class comes, `rate` times a second. A snare on a snare says much, a hi-hat 16th on a
hi-hat 16th little, and a hit far from its notes speaks against. Sums over a stretch of hits compare alignments.
Drummers put crashes where they like, so that a rare class is taken for `MIN_RATE` at least: no single stroke decides.
"""

from math import exp, log, pi, sqrt

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

SD_S = 0.03
"""Scatter that is believed before it is known: the Groove MIDI Dataset's 26 ms (HUMANS), a little wider."""

MIN_RATE = 0.5
"""Notes a second of a class, at least (our choice: a hit then weighs 3 nats at most, a backbeat's weight)."""

STRAY = 0.1
"""Share of hits that answer no note (extras, wrong pieces), as believed before it is known."""


def class_rates(note_s: Floats, classes: Indices) -> Floats:
    """Notes a second of each class number, shape (classes,); classes without notes count as one note in all."""
    counts = np.maximum(np.bincount(classes), 1)
    return np.asarray(np.maximum(counts / max(float(np.ptp(note_s)), 1.0), MIN_RATE))


def evidence(distance_s: Floats, rates: Floats) -> Floats:
    """Log-likelihood ratio of each hit (m,) at `distance_s` from its nearest note, of a class of `rates` (m,)."""
    density = np.exp(-0.5 * np.square(distance_s / SD_S)) / (SD_S * np.sqrt(2 * np.pi))
    return np.asarray(np.log(STRAY + (1 - STRAY) * density / rates))


def nats(distance_s: float, rate: float) -> float:
    """`evidence` of one hit, for who cannot wait for arrays."""
    z = distance_s / SD_S
    return log(STRAY + (1 - STRAY) * exp(-0.5 * z * z) / (_ROOT * rate)) if abs(z) < _FAR_SDS else _STRAYED


_ROOT = SD_S * sqrt(2 * pi)
_FAR_SDS = 8.0
_STRAYED = log(STRAY)


def best_evidence(rates: Floats) -> Floats:
    """What each hit (m,) would say if it lay exactly on a note."""
    return evidence(np.zeros(len(rates)), rates)
