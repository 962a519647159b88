"""The two clocks: the computer's monotonic one, and one that is moved by hand for tests and headless runs."""

import sys
import time
from collections.abc import Callable
from typing import Protocol

monotonic_ns: Callable[[], int] = time.perf_counter_ns if sys.platform == "win32" else time.monotonic_ns
"""Session time: the finest clock of this computer that every process shares and nobody sets.

On Windows `time.monotonic_ns` moves in steps of 15.6 ms before Python 3.13; `time.perf_counter_ns`, which is finer than
a microsecond there, is system-wide since 3.10 (Python's documentation of `time`).
"""


class Clock(Protocol):
    """Tells session time in integer nanoseconds; never goes back."""

    def now_ns(self) -> int:
        """The present session time."""
        ...


class MonotonicClock:
    """The operating system's monotonic clock, the same in every process of one computer."""

    def now_ns(self) -> int:
        """`monotonic_ns()`."""
        return monotonic_ns()


class ManualClock:
    """A clock that stands still until it is moved."""

    def __init__(self, start_ns: int = 0) -> None:
        self._now_ns = start_ns

    def now_ns(self) -> int:
        """Where the clock was last put."""
        return self._now_ns

    def advance_to(self, now_ns: int) -> None:
        """Move forward to `now_ns`; moving back is our own mistake."""
        assert now_ns >= self._now_ns, "a clock never goes back"
        self._now_ns = now_ns
