"""Whether the last hits speak against the place where a student is believed to be: two running sums, hit by hit.

Each sums up log-likelihood ratios as long as they speak against the place (Page's CUSUM, Biometrika 41, 1954). `astray`
asks whether he is anywhere else (`evidence`): then hits fall between their notes. `lost` asks whether he is elsewhere
but in time with the place, in another bar: then hats still meet hats, but kicks and snares come where none is written
and stay away where one is. A class that stands on nearly every onset tells nothing of the latter.
"""

from bisect import bisect_left

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.evidence import STRAY

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

DOUBT = 6.0
"""Nats that raise a doubt (our choice: two strays in a row do not, a wrong bar does)."""

SLACK_S = 0.05
"""How far from its place the note of a hit may lie (our choice: 1.7 SD of `evidence`)."""

_MOST_LEFT_OUT = 2
"""Notes of a class left out before a hit that count: who leaves out more leaves a part out (our choice)."""


class Doubt:
    """What the hits since hit `since` say against the place: `nats`, never negative."""

    def __init__(self, note_s: Floats, classes: Indices) -> None:
        slots = len(np.unique(np.rint(note_s / SLACK_S)))
        shares = np.clip(np.bincount(classes) / slots, STRAY, 1 - STRAY)
        self._met: list[float] = np.log((1 - STRAY) / shares).tolist()
        self._stray: list[float] = np.log(STRAY / (1 - shares)).tolist()
        self._own = {c: np.sort(note_s[classes == c]).tolist() for c in np.unique(classes).tolist()}
        self.calm(0)

    def calm(self, index: int) -> None:
        """Nothing speaks against the place before hit `index`."""
        self._astray = self._lost = 0.0
        self._astray_since = self._lost_since = index
        self._last_met: dict[int, int] = {}

    def raised(self, index: int) -> None:
        """Doubt everything from hit `index` on, as after a stop."""
        self.calm(index)
        self._astray = DOUBT + _STOP_DOUBT

    @property
    def nats(self) -> float:
        """The larger of the two sums."""
        return max(self._astray, self._lost)

    @property
    def since(self) -> int:
        """The first hit of the larger sum."""
        return self._astray_since if self._astray > self._lost else self._lost_since

    def take(self, index: int, match_class: int, place_s: float, said: float) -> None:
        """Hear hit `index`, believed at `place_s`; its distance to the nearest note `said` so many nats for that."""
        self._astray -= said
        if self._astray <= 0.0:
            self._astray, self._astray_since = 0.0, index + 1
        nearest = bisect_left(self._own[match_class], place_s - SLACK_S)
        before = self._last_met.get(match_class)
        left_out = 0 if before is None else min(max(nearest - before - 1, 0), _MOST_LEFT_OUT)
        strays = left_out if said > 0.0 else left_out + 1
        self._lost -= strays * self._stray[match_class]
        if said > 0.0:
            self._lost -= self._met[match_class]
            self._last_met[match_class] = nearest
        if self._lost <= 0.0:
            self._lost, self._lost_since = 0.0, index + 1


MOST_MOVED = 48
"""Hits that a change of place may move, at most (our choice: two bars of a dense groove)."""

LEAST_HITS = 6
"""A look with fewer hits finds everything everywhere (our choice)."""

_WAITS = (4, 6, 8, 12, 16, 24, 32, 64, 128)
"""Hits from one look that found nothing to the next: whoever does not play the score costs little (our choice)."""


class Looks:
    """When a doubt is looked into: with `LEAST_HITS`, then ever more rarely until the hits fit; `count` since then."""

    def __init__(self) -> None:
        self.calm(0)

    def calm(self, index: int) -> None:
        """The hits before `index` fit."""
        self.count, self._next = 0, index + LEAST_HITS - 1

    def is_due(self, index: int) -> bool:
        """Whether hit `index` is one to look at."""
        return index >= self._next

    def look(self, index: int) -> None:
        """It is looked at hit `index`."""
        self._next = index + _WAITS[min(self.count, len(_WAITS) - 1)]
        self.count += 1


_STOP_DOUBT = 3.0
"""Nats of doubt more than enough that follow a stop: a few hits must speak for the place (our choice)."""
