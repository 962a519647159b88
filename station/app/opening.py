"""The window watched by the program that opened it: when its frames were shown, what they cost, what they showed."""

import time
from collections.abc import Callable
from math import inf

from station.core.clock import monotonic_ns
from station.core.units import NS_PER_S
from station.render.snapshot import Snapshot


class Watch:
    """Is called for each frame and says when to close the window: after so many `frames`, or so many `seconds`.

    `report` gets {"open_ns"} when the first frame is there, and at the end when frames were `shown_ns`, the processor's
    seconds until then (`worked_s`), and `lit`: pairs of when a frame first showed a stroke and of its velocity.
    """

    def __init__(self, frames: int | None, seconds: float | None, report: Callable[[dict[str, object]], None]) -> None:
        self._frames = inf if frames is None else frames
        self._length_ns = inf if seconds is None else seconds * NS_PER_S
        self._report = report
        self._shown_ns: list[int] = []
        self._worked_s: list[float] = []
        self._highlighted: list[tuple[int, int]] = []
        self._struck: set[int] = set()

    def shown(self, snapshot: Snapshot | None) -> bool:
        """A frame is on the screen; returns whether the window stays open."""
        now_ns = monotonic_ns()
        self._shown_ns.append(now_ns)
        self._worked_s.append(time.process_time())
        if len(self._shown_ns) == 1:
            self._report({"open_ns": now_ns})
        struck = set() if snapshot is None else {strike.velocity for strike in snapshot.strikes if strike.student}
        self._highlighted.extend((now_ns, velocity) for velocity in struck - self._struck)
        self._struck = struck
        return len(self._shown_ns) < self._frames and now_ns - self._shown_ns[0] < self._length_ns

    def close(self) -> None:
        """Report what was seen."""
        self._report({"shown_ns": self._shown_ns, "worked_s": self._worked_s, "lit": self._highlighted})
