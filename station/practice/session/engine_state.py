"""What the engine has said so far, as every kind of session needs it: kits, output, zero, last strokes, notices.

Transport time is what the student heard and played: a stamp less its pad's latency, less the zero and the output's
latency (`session.device_latency`). The transport may start several times; its last zero holds.
"""

from collections import deque
from dataclasses import dataclass, field

from station.core.events import Choke, DeviceFound, DeviceLost, Hit, SensorLost, SensorMounted
from station.core.pieces import Limb
from station.engine.messages import CaptureSaved, EngineEvent, Notice, Ready, Sounding, Started, Unheard
from station.practice.session.device_latency import Latency

RECENT_HITS = 32
"""How many hits a window may look back on to show what was struck just now; our choice."""

_UNKNOWN_HAND = (
    "no hand is known to hold this stick, so its strokes tell none; the mounting gesture on the window's page Sticks"
    " teaches it (docs/sensors.md)"
)


@dataclass(eq=False)
class EngineState:
    """Hand `handle` every event of the engine.

    `devices` are the kits that are connected, the newest last; `sensors` those on the sticks, each with the hand that
    holds its stick; `output` is what the click is heard on, or was last;
    `capture_fault` why the capture lacks what came after, if it does; `rate_hz` the sound card's, None where there is
    none; `notices` what a user should read once, in order; `recent` the last hits, the newest last; `zero_ns` when cue
    time 0 was heard, None while the transport has not started; `strokes` counts the strokes and the grabbed cymbals
    since the capture began. `unheard` are the spans of session time in which no stroke could be heard, and
    `deaf_since_ns` is when one began that still lasts: no kit is left, and nothing else has been played since.
    """

    latency: Latency = field(default_factory=Latency)
    devices: list[str] = field(default_factory=list)
    sensors: dict[str, Limb] = field(default_factory=dict)
    output: str | None = None
    capture_fault: str | None = None
    rate_hz: int | None = None
    notices: list[str] = field(default_factory=list)
    recent: deque[Hit] = field(default_factory=lambda: deque(maxlen=RECENT_HITS))
    zero_ns: int | None = None
    strokes: int = 0
    unheard: list[tuple[int, int]] = field(default_factory=list)
    deaf_since_ns: int | None = None

    def handle(self, event: EngineEvent) -> None:
        """Take in one event."""
        match event:
            case Hit():
                self._hears_again(event.at_ns)
                self.recent.append(event)
                self.strokes += 1
            case Choke():
                self.strokes += 1
            case Started(zero_ns, output):
                self.zero_ns, self.output = zero_ns, output
            case Unheard(from_ns, until_ns):
                self.unheard.append((from_ns, until_ns))
            case DeviceLost() | DeviceFound():
                self._kit_changed(event)
            case SensorMounted(_, device, mounting):
                self._sensor_is_here(device, mounting.limb)
            case SensorLost(_, device):
                self.sensors.pop(device, None)
                self.notices.append(f"{device} is gone: its stick's strokes are not told until it is back")
            case CaptureSaved(_, fault) if fault is not None:
                self.capture_fault = fault
                self.notices.append(f"nothing more is recorded: {fault}")
            case CaptureSaved(path) if path is not None:
                self.strokes = 0
            case Ready(output, rate_hz) | Sounding(output, rate_hz):
                self.rate_hz = rate_hz
                self.output = output or self.output  # whoever plays on in silence keeps the beat that they heard
            case Notice(text):
                self.notices.append(text)
            case _:
                pass

    def _kit_changed(self, event: DeviceLost | DeviceFound) -> None:
        at_ns, device = event.at_ns, event.device
        self.devices = [other for other in self.devices if other != device]
        if isinstance(event, DeviceFound):
            self._hears_again(at_ns)
            self.devices.append(device)
            self.notices.append(f"{device} is here")
            return
        if not self.devices and self.deaf_since_ns is None:
            self.deaf_since_ns = at_ns
        self.notices.append(f"{device} is gone; plug it in again, the session goes on")

    def _hears_again(self, at_ns: int) -> None:
        """Something can be heard from `at_ns` on."""
        if self.deaf_since_ns is not None:
            self.unheard.append((self.deaf_since_ns, max(at_ns, self.deaf_since_ns)))
            self.deaf_since_ns = None

    def stop_listening(self, now_ns: int) -> None:
        """Nothing more is awaited at `now_ns`: a span without hearing ends there, and another begins."""
        if self.deaf_since_ns is not None:
            self._hears_again(now_ns)
            self.deaf_since_ns = now_ns

    def _sensor_is_here(self, device: str, limb: Limb) -> None:
        """A sensor is mounted anew whenever a capture begins; what its player lacks is told once."""
        if limb is Limb.UNKNOWN and self.sensors.get(device) is not limb:
            self.notices.append(f"{device}: {_UNKNOWN_HAND}")
        self.sensors[device] = limb

    def go_on_from(self, before: "EngineState") -> None:
        """Know what a session knew that ran before on the same engine."""
        self.sensors = dict(before.sensors)
        self.devices, self.capture_fault, self.rate_hz = before.devices, before.capture_fault, before.rate_hz
        self.strokes, self.deaf_since_ns = before.strokes, before.deaf_since_ns

    def transport_ns(self, at_ns: int) -> int | None:
        """The transport's time that was heard at session time `at_ns`; None before it has started."""
        return None if self.zero_ns is None else at_ns - self.zero_ns - self.latency.of_output(self.output)

    def played_ns(self, stroke: Hit | Choke) -> int | None:
        """The transport's time at which `stroke` was played; None before it has started."""
        return self.transport_ns(stroke.at_ns - self.latency.of_stroke(stroke.device, stroke.piece))
