"""What the station opens on."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from station.practice.session.device_latency import Latency
from station.practice.session.plan import Plan

if TYPE_CHECKING:
    from station.practice.session.backing_track import BackingRequest


@dataclass(frozen=True, slots=True)
class Launch:
    """What the station opens on: `plan` is shown and not yet played; with `adapt` its tempo will follow the student.

    `latency` is what was measured of the devices, the settings' word where nothing was. Sessions whose tempo stays play
    along to `backing`.
    """

    plan: Plan
    adapt: bool = False
    latency: Latency | None = None
    backing: "BackingRequest | None" = None
