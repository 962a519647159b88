"""A whole recording tracked: made zero-mean by its own means, at the cadence that its model's period tells.

A person's posture differs from the exemplar's by constants, and so does one file format's rest pose from another's. The
paper's § 3 assumes of every signal that its channels are zero-mean; of a recording they can be made so.
"""

from dataclasses import replace
from math import pi

from station.core.errors import BadInput
from station.sync.phase.periodic_model import TURN, PeriodicModel
from station.sync.phase.phase_tracker import ADAPTIVE, PhaseTrack, TrackerSettings, tracked
from station.sync.signals.signal import Signal


def zero_mean(model: PeriodicModel, signal: Signal) -> Signal:
    """The model's channels of a recording, each moved so that its mean is the model's; raises `BadInput`."""
    channels = signal.only(model.channels)
    if not len(signal):
        return channels
    return replace(channels, values=channels.values - channels.values.mean(axis=0) + model.mean)


def own_cadence(model: PeriodicModel, signal: Signal) -> float | None:
    """The phase from sample to sample at the model's own period; None where it knows none.

    Raises `BadInput` for a signal with fewer than two samples in a period.
    """
    if model.period_s is None:
        return None
    cadence_rad = TURN / (model.period_s * signal.rate_hz)
    if not cadence_rad < pi:
        raise BadInput(signal.name, "", f"has fewer than 2 samples in the model's period of {model.period_s:g} s")
    return cadence_rad


def track_recording(model: PeriodicModel, signal: Signal, settings: TrackerSettings | None = None) -> PhaseTrack:
    """The phase of a whole recording; without `settings` the adaptive tracker's at the model's own cadence.

    Raises `BadInput` where it lacks a channel.
    """
    if settings is None:
        cadence_rad = own_cadence(model, signal)
        settings = ADAPTIVE if cadence_rad is None else replace(ADAPTIVE, cadence_rad=cadence_rad)
    return tracked(model, zero_mean(model, signal).values, settings)
