"""All the sensors of one player: what decoders make of their bytes in, what is told of the sticks out.

The engine feeds it live, and whoever replays a capture feeds it the same events: the same strokes come out. Each stick
has its own detector; what several sticks tell together goes through here too.
"""

from station.core.events import (
    Hit,
    SensorEvent,
    SensorLost,
    SensorMounted,
    SensorSamples,
    SensorStatus,
    StickEvent,
    StickPose,
)
from station.core.imu import Mounting
from station.core.units import NS_PER_S
from station.sync.strokes.stick_orientation import StickMotion
from station.sync.strokes.stroke_detector import StrokeDetector

POSE_EVERY_NS = NS_PER_S // 60
"""How often a stick's pose is told: once for each picture of a usual screen."""


class Sticks:
    """Hand `handle` every event of every sensor, in the order in which they come."""

    def __init__(self) -> None:
        self._sticks: dict[str, _Stick] = {}

    def handle(self, event: SensorEvent) -> list[StickEvent | Hit]:
        """What `event` tells of the sticks; a sensor that nobody announced is mounted as sensors mostly are."""
        match event:
            case SensorMounted():
                self._sticks[event.device] = _Stick(event.device, event.mounting)
                return [event]
            case SensorLost():
                self._sticks.pop(event.device, None)
                return [event]
            case SensorStatus():
                return [event]
            case SensorSamples():
                return self._moved(event)

    def _moved(self, event: SensorSamples) -> list[StickEvent | Hit]:
        stick = self._sticks.get(event.device)
        if stick is None:
            stick = self._sticks[event.device] = _Stick(event.device, Mounting())
        return stick.moved(event)


class _Stick:
    def __init__(self, device: str, mounting: Mounting) -> None:
        self._detector = StrokeDetector(device, mounting)
        self._next_pose_ns: int | None = None

    def moved(self, event: SensorSamples) -> list[StickEvent | Hit]:
        told: list[StickEvent | Hit] = []
        for sample in event.samples:
            for motion in self._detector.orientation.feed(sample):
                stroke = self._detector.move(motion)
                if stroke is not None:
                    told.append(stroke)
                if self._next_pose_ns is None or motion.at_ns >= self._next_pose_ns:
                    self._next_pose_ns = motion.at_ns + POSE_EVERY_NS
                    told.append(self._pose(motion))
        return told

    def _pose(self, motion: StickMotion) -> StickPose:
        detector = self._detector
        return StickPose(motion.at_ns, detector.device, detector.mounting.limb, motion.turn, motion.resting)
