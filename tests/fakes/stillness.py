"""Tells when the machine stood still: a test on a shared machine asks nothing of the moments that nobody had.

A thread looks at the clock every few milliseconds; where it was held up for long, so were all others.
"""

import threading
import time
from types import TracebackType
from typing import Self

from station.core.units import NS_PER_MS

LOOK_S = 0.01
HELD_NS = 150 * NS_PER_MS
"""By so much nobody is held up on a machine that merely has much to do."""


def run_for(seconds: float) -> None:
    """Let the machine run so long: what it stands still meanwhile does not count."""
    for _ in range(round(seconds / LOOK_S)):
        time.sleep(LOOK_S)


class Stillness:
    """Use it as a context manager around what is measured."""

    def __init__(self) -> None:
        self._stood: list[tuple[int, int]] = []
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._look, daemon=True)

    def stood(self, from_ns: int, until_ns: int) -> bool:
        """Whether it stood still at some moment between the two."""
        return any(begun_ns < until_ns and from_ns < ended_ns for begun_ns, ended_ns in self._stood)

    def _look(self) -> None:
        before_ns = time.monotonic_ns()
        while not self._over.wait(LOOK_S):
            now_ns = time.monotonic_ns()
            if now_ns - before_ns > HELD_NS:
                self._stood.append((before_ns, now_ns))
            before_ns = now_ns

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, fault: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        self._thread.join()
