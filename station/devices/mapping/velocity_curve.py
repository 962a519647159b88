"""A pad's velocity curve: how loud a stroke counts for the velocity that the pad sent.

Pads answer differently: on one a ghost stroke sends 8, on another 50. A `VelocityCurve` is straight between `softest`,
which counts as 1, and `loudest`, which counts as 127, and bends in between: t ↦ t^(2^(−2·bend)), t the share of the way
from softest to loudest. A bend above 0 makes soft strokes count for more, below 0 for less. Five ghosts and five
accents are enough to find the curve of a pad: their medians then count as what lessons write.

Captures hold what the pad sent and the kit's file with the curve, so that a replay gives the same velocities.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import log
from statistics import median
from types import MappingProxyType

from station.core.errors import BadInput

HARDEST = 127
SOFTEST_FROM, SOFTEST_TO = 1.0, 100.0
LOUDEST_FROM, LOUDEST_TO = 20.0, 400.0
"""Beyond 127: a pad whose hardest stroke is to count for less than that; our choice of ends."""
MOST_BEND = 1.0
LEAST_SPAN = 10.0
"""So far apart softest and loudest lie at the least; our choice: less is a switch, no pad."""

GHOST_COUNTS, ACCENT_COUNTS = 32, 116
"""What a ghost and an accent are to count as: what lessons write (the middles of HUMANS' 20–45 and 105–127)."""
STROKES = 5
"""So many ghosts, and so many accents, tell a pad's curve."""
_SLIP = 1
"""So many strokes of each may be a slip (our choice: one of five; the median does not mind it)."""
_LEAST_RATIO = 1.1
"""Accents are at least so much louder than ghosts, or nobody could have told them apart (our choice)."""


@dataclass(frozen=True, slots=True)
class VelocityCurve:
    """Velocities as the pad sends them: `softest` counts as 1, `loudest` as 127, `bend` −1 firm … 1 light between."""

    softest: float = 1.0
    loudest: float = float(HARDEST)
    bend: float = 0.0

    @classmethod
    def nearest(cls, softest: float, loudest: float, bend: float) -> "VelocityCurve":
        """The curve that comes nearest to these numbers among those that a kit may have; softest goes first."""
        softest = min(SOFTEST_TO, max(SOFTEST_FROM, softest))
        loudest = min(LOUDEST_TO, max(LOUDEST_FROM, softest + LEAST_SPAN, loudest))
        return cls(softest, loudest, min(MOST_BEND, max(-MOST_BEND, bend)))

    @property
    def table(self) -> tuple[int, ...]:
        """What each velocity 0–127 counts as, 128 numbers: 1–127 for a stroke, 0 for velocity 0."""
        return _table(self)


AS_SENT = VelocityCurve()
SHAPES: Mapping[str, VelocityCurve] = MappingProxyType(
    {
        "as_sent": AS_SENT,
        "light": VelocityCurve(bend=0.25),
        "very_light": VelocityCurve(bend=0.5),
        "firm": VelocityCurve(bend=-0.25),
        "very_firm": VelocityCurve(bend=-0.5),
    }
)
"""Curves with names; our choice: a light touch makes velocity 32 count as 48 or 64, a firm one as 18 or 9."""


@lru_cache(maxsize=256)
def _table(curve: VelocityCurve) -> tuple[int, ...]:
    span, power = curve.loudest - curve.softest, _power(curve.bend)
    shares = (min(1.0, max(0.0, (sent - curve.softest) / span)) for sent in range(1, HARDEST + 1))
    return (0, *(round(1 + (HARDEST - 1) * share**power) for share in shares))


def _power(bend: float) -> float:
    return float(2.0 ** (-2.0 * bend))


def counted(table: Sequence[int], velocity: int, fraction: float) -> tuple[int, float]:
    """What a velocity and its fraction count as by the table of a curve, straight between two of its numbers."""
    above = table[velocity + 1] if velocity < HARDEST else table[velocity]
    whole, rest = divmod(table[velocity] + fraction * (above - table[velocity]), 1.0)
    return int(whole), rest


# --- learnt from strokes ---------------------------------------------------------------------------------------------


def fitted(ghosts: Sequence[int], accents: Sequence[int]) -> VelocityCurve:
    """The curve by which the medians of both count as ghost and accent; raises `BadInput` where they cannot be told."""
    check_apart(ghosts, accents)
    ghost, accent = float(median(ghosts)), float(median(accents))
    low, high = ((counts - 1) / (HARDEST - 1) for counts in (GHOST_COUNTS, ACCENT_COUNTS))
    softest = 1.0
    if (ghost - softest) / (accent - softest) > (low / high) ** (1 / _power(-MOST_BEND)):
        steepest = (low / high) ** (1 / _power(-MOST_BEND))
        softest = min(SOFTEST_TO, (ghost - steepest * accent) / (1 - steepest))
    share = max(ghost - softest, 0.5) / (accent - softest)
    bend = min(MOST_BEND, max(-MOST_BEND, log(log(share) / log(low / high), 2) / 2))
    loudest = softest + (accent - softest) / high ** (1 / _power(bend))
    loudest = min(LOUDEST_TO, max(LOUDEST_FROM, loudest, softest + LEAST_SPAN))
    return VelocityCurve(round(softest, 2), round(loudest, 2), round(bend, 4))


def check_apart(ghosts: Sequence[int], accents: Sequence[int]) -> None:
    """Raises `BadInput` unless the ghosts, a slip aside, are all softer than the accents, a slip aside."""
    if median(accents) < LOUDEST_FROM:
        raise BadInput(
            "the velocity curve", "", f"accents of {min(accents)}–{max(accents)} are too soft to tell: strike harder"
        )
    loud_ghost, soft_accent = sorted(ghosts)[-1 - _SLIP], sorted(accents)[_SLIP]
    if soft_accent < _LEAST_RATIO * loud_ghost:
        heard = f"ghosts {min(ghosts)}–{max(ghosts)}, accents {min(accents)}–{max(accents)}"
        raise BadInput(
            "the velocity curve", "", f"ghosts and accents cannot be told apart ({heard}): play both once more"
        )


def threshold_below(threshold: int, ghosts: Sequence[int]) -> int:
    """A threshold that leaves the ghosts alone: the pad's own, or half of the softest where that is lower."""
    return min(threshold, max(1, min(ghosts) // 2))
