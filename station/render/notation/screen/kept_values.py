"""Remembers what was made last while what it was made of stays the same: most of a score does, from frame to frame."""

from collections.abc import Callable
from typing import TypeVar

import numpy as np

T = TypeVar("T")


class KeptValues:
    """One value a name."""

    def __init__(self) -> None:
        self._kept: dict[str, tuple[tuple[object, ...], object]] = {}

    def once(self, name: str, key: tuple[object, ...], make: Callable[[], T]) -> T:
        """What `make` made of the same `key` last time, else what it makes now."""
        known = self._kept.get(name)
        if known is None or not same(known[0], key):
            known = self._kept[name] = key, make()
        return known[1]  # type: ignore[return-value] # each name has one kind of value


def same(one: tuple[object, ...], other: tuple[object, ...]) -> bool:
    """Whether all are the very same, or alike; an array of NaN is like itself alone."""
    return len(one) == len(other) and all(_alike(a, b) for a, b in zip(one, other, strict=True))


def _alike(a: object, b: object) -> bool:
    if a is b:
        return True
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return isinstance(a, np.ndarray) and isinstance(b, np.ndarray) and np.array_equal(a, b)
    return bool(a == b)
