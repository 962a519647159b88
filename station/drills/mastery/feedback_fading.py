"""Feedback that fades: the hint of early and late is shown on fewer and fewer passes as clean ones add up.

Guidance helps while it is there and is missed afterwards (TEACHING: regulated feedback), so it goes from all passes to
a half, a quarter and none. Wrong pads and misses are shown all along, except on probes.
"""

import math
from dataclasses import dataclass
from enum import StrEnum

from station.drills.mastery.rules import Rules


class Feedback(StrEnum):
    """What is said while a pass is played."""

    TIMING = "timing"
    """Wrong pads, misses, and strokes that are early or late."""
    PADS = "pads"
    """Wrong pads and misses alone."""
    NONE = "none"
    """Nothing: a probe."""


@dataclass(frozen=True, slots=True)
class Fading:
    """`level` into `Rules.fades`, `clean` passes played and `passes` shown at it."""

    level: int = 0
    clean: int = 0
    passes: int = 0

    def feedback(self, rules: Rules) -> Feedback:
        """What is said on the next pass that is no probe: passes with the hint are spread evenly."""
        share = rules.fades[min(self.level, len(rules.fades) - 1)]
        is_shown = math.floor((self.passes + 1) * share) > math.floor(self.passes * share)
        return Feedback.TIMING if is_shown else Feedback.PADS

    def after(self, is_clean: bool, rules: Rules) -> "Fading":
        """After a pass that was no probe."""
        clean = self.clean + is_clean
        if clean >= rules.clean_to_fade and self.level < len(rules.fades) - 1:
            return Fading(self.level + 1)
        return Fading(self.level, clean, self.passes + 1)
