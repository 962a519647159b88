"""One set of formulas for one instant and for many: the functions that they need, on floats and on arrays.

Forward kinematics is written once over `Maths`. On plain floats Python's own `math` is several times faster than numpy,
which is what a live pose needs; on arrays numpy gives whole performances at once.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

Number = Any
"""A float, or an array with a place for each instant: whichever the `Maths` at hand computes with."""

Point = tuple[Number, Number, Number]


@dataclass(frozen=True, slots=True, eq=False)
class Maths:
    """The functions of one kind of number."""

    sin: Callable[[Number], Number]
    cos: Callable[[Number], Number]
    acos: Callable[[Number], Number]
    atan2: Callable[[Number, Number], Number]
    sqrt: Callable[[Number], Number]
    least: Callable[[Number, Number], Number]
    most: Callable[[Number, Number], Number]


def _least(a: float, b: float) -> float:
    return a if a < b else b  # in half the time of min, which takes any number of anything


def _most(a: float, b: float) -> float:
    return a if a > b else b


ONE = Maths(math.sin, math.cos, math.acos, math.atan2, math.sqrt, _least, _most)
MANY = Maths(np.sin, np.cos, np.arccos, np.arctan2, np.sqrt, np.minimum, np.maximum)


def arcsine(sine: float) -> float:
    """The angle of `sine`, the steepest there is where it is out of −1 … 1."""
    return math.asin(max(-1.0, min(1.0, sine)))


_BLOCK = 4096
"""So many instants at once are computed as fast as all of them (our choice)."""


def blocks(count: int, most: int = _BLOCK) -> Iterator[slice]:
    """The parts of at most so many in which `count` instants are computed, so that what it takes meanwhile is small."""
    return (slice(start, min(start + most, count)) for start in range(0, count, most))
