"""The cues that are still to sound: a sorted run with its place in it, so that what is due is taken at no cost.

Cue times are nanoseconds from the transport's zero, the session time at which cue time 0 is heard. A cue that the sound
has already passed is late; up to `LATE_NS` it still sounds (two blocks never meet to the nanosecond), beyond it is
dropped and counted: a click at the wrong time is worse than none.
"""

from operator import attrgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_MS
from station.engine.messages import CUE_DTYPE, Bus

LATE_NS = 5 * NS_PER_MS
"""A quarter of the asynchrony that a drummer just notices (19–24 ms; our choice)."""
_NEVER_NS = np.iinfo(np.int64).max
_GREATEST_VELOCITY = 127


class Cue(NamedTuple):
    """One sound that is due: `at_ns` is session time, the rest stands as in `CUE_DTYPE`."""

    at_ns: int
    bus: int
    piece: int
    zone: int
    articulation: int
    velocity: int
    openness: float


_time_of = attrgetter("at_ns")


class CueRun:
    """Cues in order of time, and how many are done; made where there is time, taken from where there is none."""

    def __init__(self, cues: NDArray[np.void]) -> None:
        check_cues(cues)
        self._cues = cues[np.argsort(cues["at_ns"], kind="stable")]
        self._times_ns = np.ascontiguousarray(self._cues["at_ns"])
        self._done = 0
        self._next_ns = int(self._times_ns[0]) if len(cues) else _NEVER_NS

    @property
    def is_empty(self) -> bool:
        """Whether every cue is done."""
        return self._next_ns == _NEVER_NS

    def pop_due(self, until_ns: int) -> list[Cue]:
        """The cues before `until_ns` (transport time) that were not taken yet; their times stay transport time."""
        if self._next_ns >= until_ns:
            return []
        begin, end = self._done, int(np.searchsorted(self._times_ns, until_ns))
        self._done = end
        self._next_ns = int(self._times_ns[end]) if end < len(self._times_ns) else _NEVER_NS
        return [Cue(*row) for row in self._cues[begin:end].tolist()]


def check_cues(cues: NDArray[np.void]) -> None:
    """Cues come from our own practice room: a value that no sound has is our mistake, found here, not in the sound."""
    assert cues.dtype == CUE_DTYPE, "cues are a table of CUE_DTYPE"
    for name, greatest in (
        ("bus", Bus.STUDENT),  # a track is no cue
        ("piece", max(Piece)),
        ("zone", max(Zone)),
        ("articulation", max(Articulation)),
        ("velocity", _GREATEST_VELOCITY),
    ):
        assert not len(cues) or cues[name].max() <= greatest, f"a cue's {name} is beyond {greatest}"


class CueQueue:
    """The transport: where its zero lies and what is still to sound."""

    def __init__(self) -> None:
        self.zero_ns: int | None = None
        """Session time of cue time 0; None while the transport stands."""
        self.late = 0
        """Cues dropped because their time had passed, since the start."""
        self._runs: tuple[CueRun, ...] = ()

    @property
    def has_cues(self) -> bool:
        """Whether something is still to sound; any thread may ask."""
        return not all(run.is_empty for run in self._runs)  # the thread that sounds replaces the runs, all at once

    def start(self, run: CueRun, zero_ns: int) -> None:
        """Run from now on, with nothing but `run` to sound."""
        self.zero_ns = zero_ns
        self._runs = (run,)

    def add(self, run: CueRun) -> None:
        """Let `run` sound beside what is still to sound; nothing where the transport stands."""
        if self.zero_ns is not None:
            self._runs = (*(other for other in self._runs if not other.is_empty), run)

    def resume(self, run: CueRun, zero_ns: int, now_ns: int) -> None:
        """Run as if started before with `run` at `zero_ns`: what was due before `now_ns` is over, and not late."""
        run.pop_due(now_ns - zero_ns)
        self.start(run, zero_ns)

    def stop(self) -> None:
        """Stand still and forget what was to sound."""
        self.zero_ns, self._runs = None, ()

    def pop_due(self, from_ns: int, until_ns: int) -> list[Cue]:
        """The cues due in [`from_ns`, `until_ns`) of session time, in order, and those but a little before it."""
        if self.zero_ns is None:
            return []
        due = [cue for run in self._runs for cue in run.pop_due(until_ns - self.zero_ns)]
        if len(self._runs) > 1:
            due.sort(key=_time_of)
        moved = [cue._replace(at_ns=cue.at_ns + self.zero_ns) for cue in due]
        in_time = [cue for cue in moved if cue.at_ns >= from_ns - LATE_NS]
        self.late += len(moved) - len(in_time)
        return in_time
