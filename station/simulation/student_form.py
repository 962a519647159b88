"""How a student is while it plays one score, stroke by stroke: what a specification says, or what a learner has learnt.

Arrays have one value a row of the score, shape (n,). Asynchronies are played − written, **negative is early**.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import ms_from_ns
from station.music.passages import slots
from station.music.score import Score
from station.simulation.student_spec import StudentSpec

Floats = NDArray[np.float64]

SMALLEST_SD_MS = 5.0
"""Motor noise alone keeps a named player from less (HUMANS: σ_M 4–8 ms)."""
LARGEST_SD_MS = 60.0
"""Long intervals are counted out, so that a named player's SD stops growing; our choice."""


@dataclass(frozen=True, eq=False)
class Form:
    """Of each row the asynchrony's `bias_ms` and `sd_ms`, the chances of `miss` and `wrong_piece`, and `velocity_sd`.

    Only hands strike a wrong piece. `extra` is the chance of an unwritten stroke per written one; `wires` says which
    piece the kit reports for one that was struck, where its cables are swapped.
    """

    bias_ms: Floats
    sd_ms: Floats
    miss: Floats
    wrong_piece: Floats
    velocity_sd: Floats
    extra: float = 0.0
    wires: Mapping[Piece, Piece] = field(default_factory=dict)


def form_of(spec: StudentSpec, score: Score) -> Form:
    """A student who is the same throughout."""
    velocity = score.notes["velocity"].astype(np.float64)
    share = spec.velocity_cv_pct / 100.0
    every = np.ones(len(score))
    return Form(
        bias_ms=spec.bias_ms * every,
        sd_ms=sd_in(score, spec) * every,
        miss=spec.miss_pct / 100.0 * every,
        wrong_piece=spec.wrong_piece_pct / 100.0 * every,
        velocity_sd=share * velocity if spec.velocity_sd is None else spec.velocity_sd * every,
        extra=spec.extra_pct / 100.0,
    )


def sd_in(score: Score, spec: StudentSpec) -> float:
    """The SD of the asynchronies in ms: as said, or the said share of the median wait between the slots of `score`."""
    if spec.sd_ms is not None:
        return spec.sd_ms
    return min(max(spec.sd_interval_pct / 100.0 * usual_wait_ms(score), SMALLEST_SD_MS), LARGEST_SD_MS)


def usual_wait_ms(score: Score) -> float:
    """The median wait between the slots of `score`; 0 where it has fewer than two."""
    slot_ns = score.tempo_map.ns_at(slots(score)[0])
    return ms_from_ns(int(np.median(np.diff(slot_ns)))) if len(slot_ns) > 1 else 0.0
