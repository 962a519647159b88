"""What a check reports: the worst of one fault in one take, how long it lasts and where it is."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Finding:
    """A fault: `amount` in `unit` against `allowed`, worst at `time_s` in `bar` (from 1), in a `share` of instants."""

    kind: str
    what: str
    amount: float
    allowed: float
    unit: str
    time_s: float
    bar: int
    share: float

    @property
    def gravity(self) -> float:
        """How far beyond what is allowed, in units in which faults of different kinds compare roughly."""
        return (self.amount - self.allowed) / _GRAVE[self.unit]

    def __str__(self) -> str:
        where = f"bar {self.bar} ({self.time_s:.3f} s)"
        return f"{self.kind:9} {self.what:44} {self.amount:8.1f} {self.unit:4} (≤ {self.allowed:.4g}) {where}"


_GRAVE = {"mm": 10.0, "°": 10.0, "°/s": 1000.0, "m/s": 10.0, "ms": 10.0, "n": 10.0, "m": 0.1}
"""So much beyond is a fault that a watcher sees at once (our choice)."""


class Findings(list[Finding]):
    """The faults of one take."""

    def __init__(self, bar_at: "BarAt") -> None:
        super().__init__()
        self.bar_at = bar_at

    def note(self, kind: str, what: str, amount: Array, allowed: float, unit: str, time_s: Array) -> None:
        """Keep the worst of `amount` (n,) at `time_s` (n,) if it is more than `allowed`."""
        if not len(amount):
            return
        if not np.isfinite(amount).all():
            bad = int(np.flatnonzero(~np.isfinite(amount))[0])
            self.append(Finding("number", what, np.inf, 0.0, unit, float(time_s[bad]), self.bar_at(time_s[bad]), 1.0))
            return
        worst = int(np.argmax(amount))
        if amount[worst] > allowed:
            share = float(np.mean(amount > allowed))
            at = float(time_s[worst])
            self.append(Finding(kind, what, float(amount[worst]), allowed, unit, at, self.bar_at(at), share))


class BarAt:
    """The bar, from 1, that an instant lies in."""

    def __init__(self, starts_s: Array) -> None:
        self.starts_s = starts_s

    def __call__(self, time_s: float) -> int:
        """The bar, from 1, of `time_s`."""
        return max(1, int(np.searchsorted(self.starts_s, time_s + 1e-6, "right")))
