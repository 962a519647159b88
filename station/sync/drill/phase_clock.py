"""A clock that runs as the student moves: phases in, a time of the loop's score out, for pictures.

A phase says where in the loop's shortest repeat the student is. The clock counts the repeats, so that it goes on
through loop after loop. It never goes back and never leaps: between two phases it runs on at their cadence, what it
lags behind it makes up at `FASTEST` times the written tempo at most, and where it is ahead it waits. When the student
is lost it stands, and goes on from there when they are found. In which repeat they are nobody sees in their hands: the
clock begins where the session's own is, in the repeat that is nearest, and where the kit's hits settle it, it skips
whole repeats, in which the hands are alike.
"""

from collections import deque

import numpy as np

from station.core.events import Hit, PhaseEstimate
from station.core.units import NS_PER_S
from station.sync.drill.drill_model import DrillModel
from station.sync.drill.loop_repeats import settled

FASTEST = 3.0
"""Times the written tempo: a student at double tempo is followed, and half as much again is left to catch up (our
choice)."""
FORETOLD_S = 0.3
"""A phase is run on with for so long at most: longer than any sensor's packets take to come (our choice)."""
HITS = 24
"""So many of the last strokes say in which repeat the student is: two bars of eighths and more (our choice)."""
_TURN = 2 * np.pi


class PhaseClock:
    """The time of one loop's score; `advance` it with every picture, and give it what is heard."""

    def __init__(self, model: DrillModel) -> None:
        self._model = model
        self._estimate: PhaseEstimate | None = None
        self._cycles = 0
        self._hits: deque[tuple[Hit, float]] = deque(maxlen=HITS)
        self._found = False
        self._shown_s: float | None = None
        self._shown_ns = 0

    @property
    def position_s(self) -> float | None:
        """Where in the score the student is shown, seconds from its beginning; None before they were found."""
        return self._shown_s

    def handle(self, estimate: PhaseEstimate) -> None:
        """Take in a phase; they come in order."""
        before, self._estimate = self._estimate, estimate
        if not estimate.locked:
            self._found = False
        elif self._found and before is not None:
            self._cycles += round(_turns(before, estimate.at_ns) - _turns(estimate, estimate.at_ns))

    def hit(self, hit: Hit) -> None:
        """Take in a stroke on the kit, which may settle in which repeat the student is."""
        if self._found and self._model.repeats > 1:
            self._hits.append((hit, self._target_s(hit.at_ns) % self._model.cycle_s))

    def advance(self, now_ns: int, clock_s: float) -> None:
        """Move on to session time `now_ns`, at which the session's own place in the score is `clock_s`."""
        estimate = self._estimate
        if estimate is not None and estimate.locked and not self._found:
            if self._shown_s is None:
                self._shown_s, self._shown_ns = clock_s, now_ns
            self._find(now_ns, self._shown_s)
        if self._shown_s is not None and self._found:
            self._settle()
            passed_s = max(now_ns - self._shown_ns, 0) / NS_PER_S
            ahead_s = self._target_s(now_ns) - self._shown_s
            self._shown_s += min(max(ahead_s, 0.0), FASTEST * passed_s)
        self._shown_ns = now_ns

    def _find(self, now_ns: int, near_s: float) -> None:
        """Count the repeats so that the student is as near as may be to `near_s`."""
        self._cycles, self._found = 0, True
        self._cycles = round((near_s - self._target_s(now_ns)) / self._model.cycle_s)

    def _settle(self) -> None:
        """Skip the repeats that the hits say are over."""
        model = self._model
        if not self._hits:
            return
        hits, places = zip(*self._hits, strict=True)
        found = settled(hits, places, model.onset_s, model.piece, model.loop_s, model.repeats)
        assert self._shown_s is not None
        if found is not None:
            skipped = (found - self._cycles) % model.repeats
            self._cycles += skipped
            self._shown_s += skipped * model.cycle_s
            self._hits.clear()

    def _target_s(self, at_ns: int) -> float:
        """Where the student is at a session time, by the newest phase."""
        assert self._estimate is not None
        until_ns = min(at_ns, self._estimate.at_ns + int(FORETOLD_S * NS_PER_S))
        return (self._cycles + _turns(self._estimate, until_ns)) * self._model.cycle_s


def _turns(estimate: PhaseEstimate, at_ns: int) -> float:
    """The phase [0, 1) of an estimate, run on at its cadence to `at_ns`, in turns."""
    since_s = (at_ns - estimate.at_ns) / NS_PER_S
    return estimate.phase_rad / _TURN % 1.0 + since_s * estimate.cadence_rad_s / _TURN
