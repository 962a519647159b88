"""What a recording of a lesson that is being written needs of the station."""

from collections.abc import Callable
from dataclasses import dataclass

from station.engine.messages import Command
from station.practice.session.cues.click_pattern import ClickPattern
from station.practice.session.device_latency import Latency


@dataclass(frozen=True, slots=True, eq=False)
class RecordingLine:
    """What a recording needs: where its commands go, what clicks, how late devices are."""

    send: Callable[[Command], None]
    click: ClickPattern
    latency: Latency
