"""How right each limb was in each bar of the lesson, over all passes: where it hurts, to be drilled with one click.

What is right is said by `scoring.matching.right`. Bars are the lesson's, from 1.
"""

from dataclasses import dataclass

import numpy as np

from station.core.pieces import Limb
from station.music.judgement import Label
from station.practice.session.session import SessionResult
from station.scoring.matching.right import right_notes

LIMBS = (Limb.LEFT_HAND, Limb.RIGHT_HAND, Limb.LEFT_FOOT, Limb.RIGHT_FOOT)


@dataclass(frozen=True, slots=True)
class HeatCell:
    """One limb in one bar: its notes, and how many of them were right."""

    right: int
    notes: int

    @property
    def share(self) -> float:
        """Right notes as a share of all, 0–1."""
        return self.right / self.notes


@dataclass(frozen=True, slots=True)
class HeatMap:
    """`cells` by bar (from 1) and limb; what has no notes is not there. `limbs` are those that play."""

    cells: dict[tuple[int, Limb], HeatCell]

    @property
    def bars(self) -> list[int]:
        """The lesson's bars that have notes, in order."""
        return sorted({bar for bar, _ in self.cells})

    @property
    def limbs(self) -> list[Limb]:
        """The limbs that have notes, left before right, hands before feet."""
        return [limb for limb in LIMBS if any(limb == played for _, played in self.cells)]


def heat_map(result: SessionResult) -> HeatMap:
    """The map of a session's result."""
    score = result.score
    if not len(score):
        return HeatMap({})
    bars = np.asarray(result.plan.practised_bars, np.int32)[score.bar] + 1
    known = result.alignment.note_label != Label.UNKNOWN
    right = right_notes(score, result.alignment, result.plan.level.windows)
    cells: dict[tuple[int, Limb], HeatCell] = {}
    for limb in LIMBS:
        mine = known & (score.notes["limb"] == limb)
        for bar in np.unique(bars[mine]).tolist():
            here = mine & (bars == bar)
            cells[bar, limb] = HeatCell(int(right[here].sum()), int(here.sum()))
    return HeatMap(cells)
