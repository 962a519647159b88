"""All the sensors of one player: what decoders make of their bytes in, what is told of the sticks out.

The engine feeds it live, and whoever replays a capture feeds it the same events: the same strokes come out. Each stick
has its own detector; what several sticks tell together, the hits in the air, comes from all of them.
"""

from collections import deque
from dataclasses import replace

from station.core.events import (
    Hit,
    SensorEvent,
    SensorLost,
    SensorMounted,
    SensorSamples,
    SensorStatus,
    StickEvent,
    StickPose,
    StickStroke,
)
from station.core.imu import Mounting
from station.core.units import NS_PER_S
from station.sync.air.air_drums import AirDrums
from station.sync.air.air_zones import AIR_DEVICE, AirKit
from station.sync.drill.drill_model import DrillModel
from station.sync.drill.drill_tracker import DrillTracker
from station.sync.strokes.hand_naming import strokes_of_hits
from station.sync.strokes.stick_orientation import StickMotion
from station.sync.strokes.stroke_detector import StrokeDetector

POSE_EVERY_NS = NS_PER_S // 60
"""How often a stick's pose is told: once for each picture of a usual screen."""

RECENT = 12
"""So many hits and strokes of late tell which stick made a hit while it is played: two seconds of sixteenths at 90 bpm;
our choice."""


class Sticks:
    """Hand `handle` every event of every sensor, in the order in which they come."""

    def __init__(self) -> None:
        self._detectors: dict[str, StrokeDetector] = {}
        self._next_pose_ns: dict[str, int] = {}
        self._air: AirDrums | None = None
        self._pads: deque[Hit] = deque(maxlen=RECENT)
        self._strokes: deque[StickStroke] = deque(maxlen=RECENT)
        self._drill: DrillTracker | None = None

    def track_drill(self, model: DrillModel | None) -> None:
        """Tell where in the drill of `model` the sticks are from now on; no longer where it is None."""
        self._drill = None if model is None else DrillTracker(model)
        if self._drill is not None:
            for device, detector in self._detectors.items():
                self._drill.handle(SensorMounted(0, device, detector.mounting))

    def play_air(self, kit: AirKit | None, ahead_ns: int | None = None) -> None:
        """Make hits of strokes in the air from now on, as `AirDrums` does; no longer where `kit` is None."""
        self._air = None if kit is None else AirDrums(kit, ahead_ns)
        for device, detector in self._detectors.items():
            self._mount_in_air(device, detector.mounting)

    def struck(self, hit: Hit) -> None:
        """Take a stroke on a pad: the air kit leaves its piece to it, and learns where that stick points."""
        if self._air is not None and hit.device != AIR_DEVICE:
            self._air.pad(hit)
            self._pads.append(hit)

    def _aim(self, air: AirDrums, stroke: StickStroke) -> None:
        self._strokes.append(stroke)
        for hit, made in zip(tuple(self._pads), strokes_of_hits(self._pads, self._strokes), strict=True):
            if made is not None:
                self._pads.remove(hit)
                air.pad(replace(hit, limb=made.limb))

    def handle(self, event: SensorEvent) -> list[StickEvent | Hit]:
        """What `event` tells of the sticks; a sensor that nobody announced is mounted as sensors mostly are."""
        phases = [] if self._drill is None else [*self._drill.handle(event)]
        if self._air is not None:
            for phase in phases:
                self._air.phase(phase)
        return [*self._felt(event), *phases]

    def _felt(self, event: SensorEvent) -> list[StickEvent | Hit]:
        match event:
            case SensorMounted():
                self._mount(event.device, event.mounting)
                return [event]
            case SensorLost():
                self._detectors.pop(event.device, None)
                if self._air is not None:
                    self._air.lost(event.device)
                return [event]
            case SensorStatus():
                return [event if self._air is None else replace(event, air=self._air.words(event.device))]
            case SensorSamples():
                return self._moved(event)

    def _mount(self, device: str, mounting: Mounting) -> StrokeDetector:
        detector = self._detectors[device] = StrokeDetector(device, mounting)
        self._next_pose_ns.pop(device, None)
        self._mount_in_air(device, mounting)
        return detector

    def _mount_in_air(self, device: str, mounting: Mounting) -> None:
        if self._air is not None:
            self._air.mount(device, mounting)

    def _moved(self, event: SensorSamples) -> list[StickEvent | Hit]:
        detector = self._detectors.get(event.device) or self._mount(event.device, Mounting())
        told: list[StickEvent | Hit] = []
        for sample in event.samples:
            for motion in detector.orientation.feed(sample):
                told += self._told(detector, motion)
        return told

    def _told(self, detector: StrokeDetector, motion: StickMotion) -> list[StickEvent | Hit]:
        device, told = detector.device, list[StickEvent | Hit]()
        stroke = detector.move(motion)
        if stroke is not None:
            told.append(stroke)
            if self._air is not None and self._pads:
                self._aim(self._air, stroke)
        if self._air is not None:
            told += self._air.moved(device, motion)
        if motion.at_ns >= self._next_pose_ns.get(device, motion.at_ns):
            self._next_pose_ns[device] = motion.at_ns + POSE_EVERY_NS
            told.append(StickPose(motion.at_ns, device, detector.mounting.limb, motion.turn, motion.resting))
        return told
