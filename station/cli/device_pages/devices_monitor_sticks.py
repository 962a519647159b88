"""`station devices monitor --sticks PORT`: what each motion sensor is, and how it does, four times a second.

A line has the time in s, the sensor, its protocol, samples a second, how many were lost, the acceleration in g and how
fast it turns; what it tells of itself where it does. Where nothing readable comes it says what to try.
"""

from collections.abc import Sequence
from dataclasses import asdict
from math import hypot

from station.cli.console import write
from station.cli.input.device_listening import HearOptions, listening_to_sticks, polls
from station.core.clock import monotonic_ns
from station.core.errors import StationError
from station.core.events import SensorSamples, SensorStatus
from station.core.imu import STANDARD_GRAVITY_M_S2, ImuSample
from station.core.units import NS_PER_MS, s_from_ns
from station.devices.decoders import DecoderBank
from station.devices.imu.imu_protocols import PROTOCOLS
from station.devices.imu.imu_reading import RAD_PER_DEGREE
from station.devices.mapping.stick_file import ASSUMED, own_stick
from station.devices.port_watch import PortPoll

LINE_EVERY_NS = 250 * NS_PER_MS
_LISTENED_S = 2.5
"""Long enough for a sensor to be found and to give account of itself, once a second (our choice)."""


def monitor_sticks(options: HearOptions) -> int:
    """Show how the sensors do until Ctrl-C."""
    page = SticksPage(monotonic_ns())
    with listening_to_sticks(options) as sticks:
        for findings in polls((), options.seconds, sticks):
            for line in page.handle(findings, monotonic_ns()):
                write(line, flush=True)
    return 0


def sensors_now(said: Sequence[str]) -> list[dict[str, object]]:
    """What the sensors at these ports are, after a moment of listening: the fields of each one's `SensorStatus`.

    Raises `DeviceError` where none is there.
    """
    page, options = SticksPage(monotonic_ns()), HearOptions(sticks=tuple(said), seconds=_LISTENED_S)
    with listening_to_sticks(options) as sticks:
        for findings in polls((), options.seconds, sticks):
            page.handle(findings, monotonic_ns())
    return [asdict(status) for status in page.statuses.values()]


class SticksPage:
    """The lines of the page: findings in, lines out."""

    def __init__(self, start_ns: int) -> None:
        self._start_ns = start_ns
        self._bank = DecoderBank()
        self.statuses: dict[str, SensorStatus] = {}
        """How each sensor does that is here, by its name."""
        self._newest: dict[str, ImuSample] = {}
        self._due_ns: dict[str, int] = {}

    def handle(self, findings: PortPoll, now_ns: int) -> list[str]:
        """What one look at a sensor brought."""
        lines, device = list[str](), findings.device
        if findings.found:
            lines += self._found(device, now_ns)
        for packet in findings.packets:
            for event in self._bank.feed(device, packet.data, packet.at_ns).sensed:
                if isinstance(event, SensorSamples):
                    self._newest[device] = event.samples[-1]
                elif isinstance(event, SensorStatus):
                    self.statuses[device] = event
        if findings.lost:
            self._bank.lost(device, now_ns)
            self.statuses.pop(device, None)
            lines.append(f"{device} is gone; plug it in again")
        elif device in self.statuses and now_ns >= self._due_ns[device]:
            self._due_ns[device] = now_ns + LINE_EVERY_NS
            lines.append(f"{s_from_ns(now_ns - self._start_ns):10.3f}  {device}  {self._words(device)}")
        return lines

    def _found(self, device: str, now_ns: int) -> list[str]:
        mounting, fault = ASSUMED, ""
        try:
            mounting = own_stick(device)
        except StationError as wrong:
            fault = str(wrong)
        self._bank.add_sensor(device, mounting)
        self._bank.found(device, now_ns)
        self._due_ns[device] = now_ns
        return [fault or f"{device} is here; listening what it speaks"]

    def _words(self, device: str) -> str:
        status = self.statuses[device]
        if not status.protocol:
            return (
                f"nothing readable comes ({status.bad_bytes} bytes): another baud? @9600, @115200 and @921600 are usual"
            )
        rate = "" if status.rate_hz is None else f"{status.rate_hz:7.2f} Hz"
        words = [PROTOCOLS[status.protocol].title, rate, f"{status.lost} lost", _measured(self._newest.get(device))]
        words += [f"{status.bad_bytes} bytes damaged"] if status.bad_bytes else []
        words += [] if status.battery is None else [f"battery {status.battery:.0%}"]
        words += [] if status.temperature_c is None else [f"{status.temperature_c:.1f} °C"]
        return "  ".join([word for word in [*words, status.note] if word])


def _measured(sample: ImuSample | None) -> str:
    if sample is None:
        return ""
    g = hypot(*sample.acceleration_m_s2) / STANDARD_GRAVITY_M_S2
    if sample.rate_rad_s is None:
        return f"{g:6.2f} g  no gyroscope"
    return f"{g:6.2f} g  {hypot(*sample.rate_rad_s) / RAD_PER_DEGREE:6.1f} °/s"
