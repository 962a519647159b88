"""Waiting for a thread or a process so that a machine that stands still for a moment costs no time of it.

The clock runs on while a busy or suspended machine runs nobody. So the wait is made of turns, and one that takes
seconds is one turn all the same.
"""

from typing import Protocol

TURN_S = 0.05
"""Our choice: short against every wait."""


class Ending(Protocol):
    """A thread or a process."""

    def join(self, timeout: float | None = None) -> None:
        """Wait for its end, at most so many seconds."""
        ...

    def is_alive(self) -> bool:
        """Whether it has not ended."""
        ...


def ends_within(ending: Ending, seconds: float) -> bool:
    """Wait for the end of `ending`, `seconds` of a machine that runs; whether it has ended."""
    for _ in range(round(seconds / TURN_S)):
        ending.join(TURN_S)
        if not ending.is_alive():
            return True
    return False
