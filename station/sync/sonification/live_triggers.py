"""Triggers that sound live: phases are told some hundredths of a second late, and are run on with to the present."""

from collections.abc import Sequence

from station.core.events import Hit, PhaseEstimate
from station.core.units import NS_PER_S
from station.sync.sonification.triggers import Trigger, TriggerRun

FORETOLD_S = 0.3
"""A phase is run on with for so long at most, as `drill.phase_clock` does."""


class LiveTriggers:
    """What the phases of one motion trigger as they come."""

    def __init__(self, triggers: Sequence[Trigger]) -> None:
        self._run = TriggerRun(triggers)

    def handle(self, estimate: PhaseEstimate, now_ns: int) -> list[Hit]:
        """What has been passed at session time `now_ns`, in order; times never lie after it."""
        late_s = min(max((now_ns - estimate.at_ns) / NS_PER_S, 0.0), FORETOLD_S)
        phase_rad = estimate.phase_rad + late_s * estimate.cadence_rad_s
        return self._run.step(max(now_ns, estimate.at_ns), phase_rad, estimate.locked)
