"""How simulated learners play and learn: the numbers of the model in `learner`, in one table.

All of them are our choice; each line names the effect that it stands for. They are hypotheses about people, so a
policy that lives by one of them alone is worth nothing: `perturbed` draws them anew within a share.
"""

from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

import numpy as np

from station.simulation.learner_kinds import LearnerKind


@dataclass(frozen=True, slots=True)
class LearnerParams:
    """The model's numbers; speeds count in octaves, times in seconds, the rest are shares."""

    # --- how it plays ---
    steepness: float = 8.0
    """An overload of 1/8 octave (9 % too fast) multiplies the odds of a lapse by e."""
    spread_per_octave: float = 3.0
    """At twice the comfortable speed the spread, in shares of the interval, is about four times as large."""
    comfort_odds: float = 2.0
    """At the comfortable speed a lapse has odds of e^−2 of what it has when far too fast, …"""
    worst_lapse: float = 0.40
    worst_confusion: float = 0.15
    """… where these shares of the strokes go wrong."""

    # --- what it learns and forgets ---
    fast_gain: float = 0.010
    fast_kept: float = 0.985
    slow_gain: float = 0.012
    slow_kept: float = 0.9995
    """A pass at the best speed adds the gains' shares of what is left to learn; so much stays from pass to pass."""
    challenge_octaves: float = 0.35
    """Passes so much faster or slower than comfortable teach 1/e of it."""
    fast_life_s: float = 20 * 60.0
    slow_life_s: float = 14 * 86_400.0
    """The memories fade by e in this time of rest."""
    spacing_growth: float = 1.7
    """After a gap of a day the slow memory's life grows so many times (TEACHING: gains only after 24 h gaps)."""
    habit_gain: float = 0.05
    habit_worn_off: float = 0.03
    worst_habit: float = 0.30
    """An all wrong pass adds so much chance of a lapse, an all right one takes so much off; the last is the worst."""
    limb_gain: float = 0.03
    """A right pass takes this share off each limb's own lapses and confusions, and with feedback off its lean."""

    # --- feedback and fatigue ---
    feedback_help_octaves: float = 0.12
    """Feedback lets a student play so much faster; once used to it, missing it costs as much."""
    feedback_to_fast: float = 0.5
    feedback_from_slow: float = 0.4
    """With feedback on every stroke the fast memory learns so much more, the slow one so much less."""
    habituation: float = 0.04
    """A pass makes a student used to its share of feedback by this much."""
    tiring_s: float = 40 * 60.0
    recovery_s: float = 10 * 60.0
    fatigue_octaves: float = 0.30
    """Playing tires by e in the first, rest restores in the second, and who is exhausted is so much slower."""


HUMAN = LearnerParams()

Numbers = TypeVar("Numbers", LearnerParams, LearnerKind)
_KEPT_SHARES = ("fast_kept", "slow_kept")
"""What stays a pass is near 1: what is lost is what varies."""
_EXACT = ("latency_ms",)
"""The equipment's fault is what it is."""


def perturbed(numbers: Numbers, rng: np.random.Generator, share: float) -> Numbers:
    """The same with every fractional number drawn evenly from ± `share` about it; counts and cables stay."""
    changes: dict[str, Any] = {}
    for field in fields(numbers):
        value = getattr(numbers, field.name)
        if not isinstance(value, float) or field.name in _EXACT:
            continue
        factor = float(rng.uniform(1.0 - share, 1.0 + share))
        changes[field.name] = 1.0 - (1.0 - value) * factor if field.name in _KEPT_SHARES else value * factor
    return replace(numbers, **changes)
