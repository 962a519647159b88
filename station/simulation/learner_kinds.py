"""The kinds of simulated learners: what differs between people, and the hostile ones that a teacher also meets.

Numbers are hypotheses for trying teaching policies against each other (they validate the controller, not people); none
is measured on drummers. Speeds are shares of the lesson's target tempo; skill counts in octaves of speed.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from station.core.pieces import Piece


@dataclass(frozen=True, slots=True)
class LearnerKind:
    """One kind of learner.

    `start_speed` where it plays comfortably at first, bars scattered by `bar_scatter_octaves`, `weak_share` of them
    `weak_octaves` harder; `ceiling_speed` the comfortable speed that no practice exceeds. `sd_interval_pct` of the
    interval is its spread when comfortable, `velocity_cv_pct` that of velocities. `bias_ms` its habitual lean,
    `lean_ms` how far limbs scatter about it. `lapse` and `confusion` are the chances of a miss and a wrong pad a stroke
    at first, `quickest` how much of what is left to learn a good pass can teach at best. So many bad passes in a row as
    `quits_after` make it leave (None: it never does). `latency_ms` is the equipment's fault, as are `wires`: neither is
    learnt away.
    """

    start_speed: float = 0.62
    ceiling_speed: float = 1.35
    bar_scatter_octaves: float = 0.06
    weak_share: float = 0.25
    weak_octaves: float = 0.20
    sd_interval_pct: float = 4.5
    velocity_cv_pct: float = 13.5
    bias_ms: float = -12.0
    lean_ms: float = 8.0
    lapse: float = 0.02
    confusion: float = 0.01
    extra: float = 0.01
    quickest: float = 1.0
    quits_after: int | None = None
    latency_ms: float = 0.0
    wires: Mapping[Piece, Piece] = field(default_factory=dict)


_USUAL = LearnerKind()

LEARNERS: Mapping[str, LearnerKind] = MappingProxyType(
    {
        "usual": _USUAL,
        "beginner": replace(
            _USUAL,
            start_speed=0.50,
            sd_interval_pct=8.0,
            velocity_cv_pct=25.0,
            bias_ms=-25.0,
            lapse=0.05,
            confusion=0.03,
            extra=0.03,
        ),
        "gifted": replace(_USUAL, start_speed=0.85, sd_interval_pct=2.5, velocity_cv_pct=8.0, quickest=2.0),
        "slow": replace(_USUAL, start_speed=0.55, quickest=0.5),
        "late_equipment": replace(_USUAL, latency_ms=100.0),
        "swapped_toms": replace(_USUAL, wires={Piece.TOM_1: Piece.TOM_2, Piece.TOM_2: Piece.TOM_1}),
        "plateau": replace(_USUAL, ceiling_speed=0.85),
        "quitter": replace(_USUAL, start_speed=0.55, quits_after=3),
    }
)
"""Spreads and velocities by HUMANS (amateur, novice, professional); the last four are TEACHING's hostile ones."""
