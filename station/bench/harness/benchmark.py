"""What a benchmark is: a row of a table, and a function that measures it.

An area of the station is a module of this package with a tuple `BENCHMARKS`; `station.bench.harness.run` finds it by
that. Each benchmark runs in a process of its own, or of its group's, so it may import, allocate and fail as it likes.
It measures with real work, in seconds rather than minutes, and times a peer's way of doing the same work beside its own
wherever there is one.
"""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

DEFAULT_LIMIT_S = 60.0
"""What a benchmark may take before it is ended; our choice, a fifth of the whole run's time."""


@dataclass(frozen=True, slots=True)
class Measurement:
    """A result in the benchmark's unit, and the peer's beside it; None where it could not be had, and why in `note`."""

    value: float | None
    peer_value: float | None = None
    note: str = ""


@dataclass(frozen=True, slots=True)
class Benchmark:
    """A row: `target` is the value to reach (None if there is none), `peer` who is measured beside us.

    `measure` may raise; the row then says why. `is_soak` marks the long ones, which run only when they are asked for;
    `limit_s` is the most that it may take, in seconds. Those of a module that have one `group` and stand together are
    measured in one process and one limit, so that they can share what takes long to make.
    """

    name: str
    unit: str
    target: float | None
    better: Literal["lower", "higher"]
    peer: str | None
    measure: Callable[[], Measurement]
    is_soak: bool = False
    limit_s: float = DEFAULT_LIMIT_S
    group: str = ""

    def reaches(self, value: float | None) -> bool | None:
        """Whether `value` reaches the target; None where there is no value or no target."""
        if value is None or self.target is None:
            return None
        return value <= self.target if self.better == "lower" else value >= self.target


def median_s(work: Callable[[], object], times: int) -> float:
    """The median time of `times` calls of `work` in seconds; the first call, which warms caches, is not counted."""
    work()
    taken = []
    for _ in range(times):
        start = time.perf_counter()
        work()
        taken.append(time.perf_counter() - start)
    return statistics.median(taken)
