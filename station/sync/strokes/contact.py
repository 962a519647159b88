"""When a contact began and how long it lasted, from the pulse that a sensor felt.

While stick and head touch, the force is near half a sine (Wagner 2006, Analysis of drumbeats: 3–6 ms). A pulse's centre
of gravity does not move when a sensor's filter or its sampling smears it, so the onset is the centre less half the
contact's duration, whose measure is the pulse's spread. The sensor's band limit and the difference of two samples each
smear it about as a mean over one sample does: by a twelfth of the interval squared.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

SHORTEST_S, LONGEST_S = 0.003, 0.006
"""A contact's duration (Wagner 2006, in HUMANS.md)."""
SPREAD_SHARE = math.sqrt(0.25 - 2.0 / math.pi**2)
"""The standard deviation of half a sine, as a share of its duration: ∫(t − ½)² π/2 sin πt dt = ¼ − 2/π²."""
FOOT = 0.1
"""What is under this share of the pulse's peak no longer belongs to it; our choice, ten times a gyro's noise."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact: its onset in seconds on the pulse's own time axis, its duration, the pulse's first and last index."""

    onset_s: float
    duration_s: float
    first: int
    last: int


def contact_of(times_s: Sequence[float], pulse: Sequence[float], interval_s: float, peak: int) -> Contact:
    """The contact whose pulse, sampled each about `interval_s`, is highest at index `peak`.

    `pulse` ≥ 0 in any unit. Values around the peak belong to it until the first that is under `FOOT` of it.
    """
    least = FOOT * pulse[peak]
    first = last = peak
    while first > 0 and pulse[first - 1] >= least:
        first -= 1
    while last < len(pulse) - 1 and pulse[last + 1] >= least:
        last += 1
    inside = range(first, last + 1)
    mass = sum(pulse[k] for k in inside)
    centre = sum(pulse[k] * times_s[k] for k in inside) / mass
    variance = sum(pulse[k] * (times_s[k] - centre) ** 2 for k in inside) / mass
    variance = max(0.0, variance - interval_s**2 / 6)
    duration = min(max(math.sqrt(variance) / SPREAD_SHARE, SHORTEST_S), LONGEST_S)
    if interval_s > SHORTEST_S:  # too coarse to tell: the middle of what is possible
        duration = (SHORTEST_S + LONGEST_S) / 2
    return Contact(centre - duration / 2, duration, first, last)
