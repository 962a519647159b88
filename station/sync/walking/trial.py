"""A recorded trial: its signal, its skeleton and where each foot came down; and the model of a gait fitted to one."""

from dataclasses import dataclass, replace
from pathlib import Path

from station.sync.phase.exemplars import cycles
from station.sync.phase.periodic_model import CENTRES, PeriodicModel, fitted
from station.sync.signals.signal import CHANNEL_SETS, Signal
from station.sync.signals.signal_files import read_signal
from station.sync.walking.footfall import Steps, footfalls
from station.sync.walking.mocap_skeleton import Points, Skeleton
from station.sync.walking.skeleton_of import skeleton_with_heels

GAIT_CHANNELS = CHANNEL_SETS["walk"]


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """A trial's whole `signal`, and the `skeleton` with heels that it moves."""

    signal: Signal
    skeleton: Skeleton

    @classmethod
    def read(cls, path: Path) -> "Trial":
        """The trial of an `.amc` or `.bvh` file; raises `BadInput`, also where the skeleton has no legs."""
        return cls(read_signal(path), skeleton_with_heels(path))

    def between(self, start_s: float, end_s: float) -> "Trial":
        """The samples from `start_s` up to `end_s`, at the times they had."""
        first, last = (int(k) for k in self.signal.time_s.searchsorted([start_s - 1e-9, end_s - 1e-9]))
        return replace(self, signal=self.signal.between(first, last))

    @property
    def places(self) -> Points:
        """Where the joints are, (n, joints, 3) in metres."""
        return self.skeleton.positions(self.signal.names, self.signal.values)

    @property
    def steps(self) -> tuple[Steps, Steps]:
        """The steps of the right foot and of the left, at the signal's own times."""
        start_s = float(self.signal.time_s[0])
        right, left = (
            Steps(foot.contact_s + start_s, foot.low_s + start_s) for foot in footfalls(self.skeleton, self.signal)
        )
        return right, left


def gait_model(signal: Signal, centre_count: int = CENTRES) -> PeriodicModel:
    """The paper's model of a gait: hips and knees over the first cycle between the right thigh's zero crossings.

    Raises `BadInput` where the signal lacks a channel or a whole cycle.
    """
    channels = signal.only(GAIT_CHANNELS)
    return fitted(GAIT_CHANNELS, cycles(channels, GAIT_CHANNELS[0]), centre_count)
