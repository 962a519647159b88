"""What each step asks of whoever repeats a phrase: length, density, coordination, dynamics, syncopation.

A step is a row of numbers, not a lesson. Density is told in strokes a second, so that a step asks the same of the limbs
at any tempo: a beat has fewer strokes where beats are short. `difficulty` is the number of `drills/difficulty` that a
phrase of the step is to have, before what the ground itself asks.
"""

from bisect import bisect_right
from dataclasses import dataclass

from station.practice.battle.vocabulary.asked_of_limbs import Coordination, Dynamics
from station.practice.battle.vocabulary.lesson_bars import LENGTHS

MOST_STEP = 24
"""The highest step. Two dozen steps let a staircase of ±1 meet a level within eight rounds (issue: ±2 of it)."""


BARS_FROM = (7, 15)
"""Steps from which two and four bars are asked (`LENGTHS`)."""
COORDINATION_FROM = (3, 8, 14)
"""Steps from which the kick joins, the hands move over the kit, the hi-hat foot joins."""
DYNAMICS_FROM = (5, 11, 17)
"""Steps from which accents, ghosts and ornaments are asked."""
SLOWEST_HZ, FASTEST_HZ = 1.5, 9.0
"""Strokes a second of all limbs together at the first and the last step: a stroke on each beat at 90, and what two
hands and a foot of a trained player do for four bars (HUMANS, Heights: one hand 5–7, one foot 3–6). Our choice."""
EASIEST, HARDEST = 5.0, 48.0
"""The measured difficulty of the first and the last step: about the first lessons', and above the
hardest that ship (docs/difficulty.md)."""


@dataclass(frozen=True, slots=True)
class Demand:
    """One step: `bars` long, `strokes_per_s` of all limbs; `off_beat` 0–1 is how much stands off the beat."""

    bars: int
    strokes_per_s: float
    coordination: Coordination
    dynamics: Dynamics
    off_beat: float
    difficulty: float


def demand_at(step: int) -> Demand:
    """What `step`, 0 to `MOST_STEP`, asks."""
    assert 0 <= step <= MOST_STEP, "a staircase stays on its steps"
    share = step / MOST_STEP
    return Demand(
        bars=LENGTHS[bisect_right(BARS_FROM, step)],
        strokes_per_s=SLOWEST_HZ + (FASTEST_HZ - SLOWEST_HZ) * share,
        coordination=Coordination(bisect_right(COORDINATION_FROM, step)),
        dynamics=Dynamics(bisect_right(DYNAMICS_FROM, step)),
        off_beat=share,
        difficulty=EASIEST + (HARDEST - EASIEST) * share,
    )
