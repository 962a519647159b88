"""Into how many cells a beat may be cut, where they lie under a swing, and how likely each is before a note is heard.

Costs are negative natural logarithms of odds, so that they add to half the squared errors of a Gaussian. They say how
common a division is in drum music; those of the strokes follow the depth of the cell in it. Our choice, set so that
the notes of method books come out: sixteenths are everyday, triplets common, sextuplets and thirty-seconds occasional,
fives and sevens rare. What a piece itself repeats outweighs them (`rhythm_words`).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.swing import STRAIGHT, Swing
from station.music.tempo import MeterChange

BINARY_COSTS: Mapping[int, float] = MappingProxyType({1: 0.0, 2: 0.3, 4: 0.8, 3: 1.6, 6: 3.5, 8: 4.0, 5: 11.0, 7: 12.0})
"""Cost of cutting a beat of two halves into so many cells; nothing finer than these is guessed (decision 0060)."""
TERNARY_COSTS: Mapping[int, float] = MappingProxyType(
    {1: 0.0, 3: 0.3, 6: 0.9, 12: 4.0, 2: 5.0, 4: 6.0, 9: 8.0, 5: 11.0, 7: 12.0}
)
"""The same of a beat of three thirds, as in 6/8."""
BINARY_FINE_COSTS: Mapping[int, float] = MappingProxyType({6: 0.7, 8: 1.0, 5: 0.3, 7: 0.5})
"""What each beat costs that is cut so fine, however many others are: a drummer's habits of timing recur as rhythms do,
and must not add up to thirty-seconds. Our choice, by the Groove MIDI Dataset's grooves that several drummers play."""
TERNARY_FINE_COSTS: Mapping[int, float] = MappingProxyType({12: 1.0, 5: 1.0, 7: 2.0, 9: 2.0})
"""The same of a beat of three thirds."""
_STROKE_COSTS: Mapping[int, float] = MappingProxyType(
    {1: 0.0, 2: 0.5, 3: 0.9, 4: 1.0, 5: 1.6, 6: 1.6, 7: 1.8, 8: 2.0, 9: 2.0, 12: 2.4}
)
"""Cost of a cell that is struck, by the denominator of its place in the beat."""


@dataclass(frozen=True, eq=False)
class Division:
    """`cells` equal cells; `places` (cells + 1,) where they are played, from 0 to 1, the next beat's start included.

    `costs` (cells + 1,) is what striking each costs, `cost` the division's own, and `fine` what each beat costs that
    has it.
    """

    cells: int
    places: NDArray[np.float64]
    costs: NDArray[np.float64]
    cost: float
    fine: float


@cache
def divisions_of(is_ternary: bool, length_ticks: int, swing: Swing) -> tuple[Division, ...]:
    """All that a span of `length_ticks` may be cut into."""
    table = TERNARY_COSTS if is_ternary else BINARY_COSTS
    fine = TERNARY_FINE_COSTS if is_ternary else BINARY_FINE_COSTS
    return tuple(_division(cells, cost, fine.get(cells, 0.0), length_ticks, swing) for cells, cost in table.items())


def _division(cells: int, cost: float, fine: float, length_ticks: int, swing: Swing) -> Division:
    denominators = [Fraction(k, cells).denominator for k in range(cells + 1)]
    costs = np.array([_STROKE_COSTS[d] for d in denominators])
    return Division(cells, cell_places(cells, length_ticks, swing), costs, cost, fine)


@cache
def cell_places(cells: int, length_ticks: int, swing: Swing) -> NDArray[np.float64]:
    """Where the cells of a span are played, from 0 to 1, its end included; only halves of halves swing."""
    straight = np.arange(cells + 1) / cells
    if swing.ratio == STRAIGHT or cells & (cells - 1) or length_ticks % (2 * swing.unit_ticks):
        return straight
    meter = MeterChange(0, length_ticks // (PPQ // 32), 128)
    return np.array([swing.swung(round(k * length_ticks / cells), meter) / length_ticks for k in range(cells + 1)])
