"""A recording tracked and sonified: its phase, and what its triggers sound where the tracker has locked."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.units import NS_PER_S
from station.music.formats.smf.track_writer import ControlMove
from station.sync.phase.periodic_model import PeriodicModel
from station.sync.phase.phase_tracker import PhaseTrack, TrackerSettings
from station.sync.phase.whole_recording import track_recording
from station.sync.signals.signal import Signal
from station.sync.sonification.channel_levels import ChannelLevel, level_cues
from station.sync.sonification.triggers import Trigger, triggered


@dataclass(frozen=True, slots=True, eq=False)
class Sonified:
    """The `track` of a recording, and the `hits` at the recording's own times."""

    signal: Signal
    track: PhaseTrack
    hits: tuple[Hit, ...]

    def moves(self, level: ChannelLevel) -> list[ControlMove]:
        """What a channel does to a controller while the tracker has locked; raises `BadInput` for a missing channel."""
        samples = self.signal.only([level.channel]).values[:, 0]
        return level_cues(level, _at_ns(self.signal), samples, self.track.locked)


def sonified(
    model: PeriodicModel, signal: Signal, triggers: Sequence[Trigger], settings: TrackerSettings | None = None
) -> Sonified:
    """Track a whole recording as `track_recording` does and let its phase trigger sounds; raises `BadInput`."""
    track = track_recording(model, signal, settings)
    at_ns = _at_ns(signal)
    return Sonified(signal, track, tuple(triggered(triggers, at_ns, track.phase_rad, track.locked)))


def _at_ns(signal: Signal) -> NDArray[np.int64]:
    return np.rint(signal.time_s * NS_PER_S).astype(np.int64)
