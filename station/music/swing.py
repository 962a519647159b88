"""Swing: the second half of each pair of cells comes later, by an exact ratio.

With a ratio r (long:short) the offbeat of a pair of length p moves from p/2 to p·r/(r+1), and whatever stands inside
either half moves in proportion, so that sixteenths under swung eighths stay in order. Ticks round to the nearest.
r = 2 is the triplet feel, 3 the dotted eighth, 1 straight. Pairs begin with the bar, and in a meter with groups with
each group.
"""

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache

import numpy as np

from station.core.units import PPQ
from station.music.score import Score
from station.music.tempo import MeterChange

STRAIGHT, TRIPLETS = 1.0, 2.0
MIN_RATIO, MAX_RATIO = 1.0, 3.5
"""The range that drummers play (HUMANS: Friberg & Sundström, 1 at 300 bpm to 3.5 at 120)."""
_LIMIT_DENOMINATOR = 1000


@dataclass(frozen=True, slots=True)
class Swing:
    """A `ratio` long:short of two cells of `unit_ticks` each."""

    ratio: float = STRAIGHT
    unit_ticks: int = PPQ // 2

    def swung(self, tick: int, meter: MeterChange) -> int:
        """Where the straight `tick` of a bar is played; ticks count from the bar's start, the bar's end included.

        Where the pairs do not fill the bar (eighths in 7/8) or one of its groups, its last cell stays straight.
        """
        if self.ratio == STRAIGHT:
            return tick
        start, end = _group_around(tick, meter)
        pair = 2 * self.unit_ticks
        start += (tick - start) // pair * pair
        inside = tick - start
        if not inside or start + pair > end:
            return tick
        long_share = _long_share(self.ratio)
        if inside <= self.unit_ticks:
            return start + round(inside * 2 * long_share)
        return start + round(pair * long_share + (inside - self.unit_ticks) * 2 * (1 - long_share))

    @property
    def stands_in_words(self) -> bool:
        """Whether notation writes it as a mark over straight cells: any swing (but see `triplets_spelled_out`)."""
        return self.ratio != STRAIGHT


def triplets_spelled_out(score: Score) -> Score:
    """The score with its swing written in triplets in the bars that have triplets of their own besides.

    There a mark over straight cells would write strokes apart that sound at once. Only a ratio of 2 is a triplet.
    """
    notes = score.notes
    within = notes["tick"] - np.array([score.tempo_map.bar_start(bar) for bar in range(score.bar_count)])[score.bar]
    is_swung, is_sixth = notes["swing_ticks"] > 0, within % (PPQ // 6) == 0
    bars = [
        bar
        for bar in np.unique(score.bar[is_sixth & ~is_swung & (within % (PPQ // 2) != 0)]).tolist()
        if (is_swung & (score.bar == bar)).any() and is_sixth[is_swung & (score.bar == bar)].all()
    ]
    if not bars:
        return score
    rows, beyond = notes.copy(), score.beyond.copy()
    for some in (rows, beyond):
        some["swing_ticks"][np.isin(score.tempo_map.bars_at(some["tick"]), bars)] = 0
        some.setflags(write=False)
    return replace(score, notes=rows, beyond=beyond)


@lru_cache
def _long_share(ratio: float) -> Fraction:
    """The long cell's share of the pair, exactly."""
    exact = Fraction(ratio).limit_denominator(_LIMIT_DENOMINATOR)
    return exact / (exact + 1)


def _group_around(tick: int, meter: MeterChange) -> tuple[int, int]:
    """Where the pairs around `tick` begin and must end: its group in a meter with groups, else the bar."""
    start = 0
    for beats in meter.groups:
        end = start + beats * meter.beat_ticks
        if tick < end:
            return start, end
        start = end
    return (0, meter.bar_ticks) if not meter.groups else (start, start)
