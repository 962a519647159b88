"""A recording tracked and sonified: its phase, where it can be trusted, and what its triggers sound."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.units import NS_PER_S
from station.sync.phase.periodic_model import PeriodicModel
from station.sync.phase.phase_tracker import PhaseTrack, TrackerSettings
from station.sync.signals.signal import Signal
from station.sync.sonification.triggers import Trigger, triggered
from station.sync.walking.trial import track_recording

LEAST_QUALITY = 0.5
"""A phase is trusted from this E_max on (our choice: after convergence a plain walk is never below .8, the paper's "low"
values while a phase converges or a body turns are below it)."""


@dataclass(frozen=True, slots=True, eq=False)
class Sonified:
    """The `track` of a recording, where it is `sure` (n,), and the `hits` at the recording's own times."""

    signal: Signal
    track: PhaseTrack
    sure: NDArray[np.bool_]
    hits: tuple[Hit, ...]


def is_sure(track: PhaseTrack) -> NDArray[np.bool_]:
    """Where a phase may sound, (n,)."""
    return track.quality >= LEAST_QUALITY


def sonified(
    model: PeriodicModel, signal: Signal, triggers: Sequence[Trigger], settings: TrackerSettings = TrackerSettings()
) -> Sonified:
    """Track a whole recording and let its phase trigger sounds; raises `BadInput` where it lacks a channel."""
    track = track_recording(model, signal, settings)
    sure = is_sure(track)
    at_ns = np.rint(signal.time_s * NS_PER_S).astype(np.int64)
    return Sonified(signal, track, sure, tuple(triggered(triggers, at_ns, track.phase_rad, sure)))
