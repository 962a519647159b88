"""A line on a terminal that says how far a long work is, and how long it will still take."""

import sys
from time import monotonic

_WIDTH = 30
_EVERY_S = 0.2
"""So often is it written anew (our choice: calm to look at)."""
_SURE_AFTER_S = 1.0
"""Before that the first, slow steps would foretell too much (our choice)."""


class ProgressLine:
    """Tells how many of `total` pictures are done, on standard error if that is a terminal, else not at all."""

    def __init__(self, total: int) -> None:
        self._total = total
        self._is_seen = sys.stderr.isatty()
        self._began_s = self._next_s = monotonic()

    def tell(self, done: int) -> None:
        """So many are done."""
        now_s = monotonic()
        if self._is_seen and (now_s >= self._next_s or done == self._total):
            self._next_s = now_s + _EVERY_S
            sys.stderr.write(f"\r{progress_line(done, self._total, now_s - self._began_s)}\x1b[K")
            sys.stderr.flush()

    def close(self) -> None:
        """Leave the line as it is, and go on below it."""
        if self._is_seen:
            sys.stderr.write("\n")


def progress_line(done: int, total: int, taken_s: float) -> str:
    """Such as `████████░░░░  45 %  270 of 600 pictures, 92 a second, 4 s left`."""
    filled = _WIDTH * done // total
    line = f"{'█' * filled}{'░' * (_WIDTH - filled)} {100 * done // total:3d} %  {done} of {total} pictures"
    if not done or taken_s < _SURE_AFTER_S:
        return line
    left_s = taken_s * (total - done) / done
    return f"{line}, {done / taken_s:.3g} a second, {_duration(left_s)} left"


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest:02d} s" if minutes else f"{rest} s"
