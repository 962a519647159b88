"""The pass mark of each level: what makes a pass clean where a lesson's own goals do not say.

The middle row is TEACHING's; the others lie about it (our choice, docs/mastery.md has the table for students):

* spread: novices keep 6–10 % of the interval, amateurs 4–5, professionals 2–3 (HUMANS, Timing), which with music to
  read and two feet is some three times as much (professionals in Groove MIDI 26–28 ms in all, 17 the steadiest tenth);
* studio's floor is what the hands alone bring about: at 250 ms sqrt(σ_C² + 2σ_M²) = 11.7 ms with σ_C 8 and σ_M 6.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.scoring.matching.hit_windows import Level


@dataclass(frozen=True, slots=True)
class PassMark:
    """Share of the notes right, 0–1, and spread ≤ min(ceiling, max(floor, share of the interval))."""

    min_right: float
    sd_floor_ms: float
    sd_interval_share: float
    sd_ceiling_ms: float


PASS_MARKS: Mapping[Level, PassMark] = MappingProxyType(
    {
        Level.BEGINNER: PassMark(0.85, 30.0, 0.20, 50.0),
        Level.ELEMENTARY: PassMark(0.88, 25.0, 0.175, 42.0),
        Level.INTERMEDIATE: PassMark(0.90, 20.0, 0.15, 35.0),
        Level.ADVANCED: PassMark(0.95, 16.0, 0.12, 28.0),
        Level.STUDIO: PassMark(0.98, 12.0, 0.09, 20.0),
    }
)
