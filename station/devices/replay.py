"""A capture played again: the same bytes through the same decoders give the same events to the nanosecond."""

from collections import deque
from collections.abc import Iterator

from station.core.clock import Clock
from station.core.events import DeviceEvent
from station.devices.capture import Capture, DeviceWord, Kind, device_of, stroke_of
from station.devices.decoders import DecoderBank
from station.devices.kit import KitPreset
from station.devices.kit_file import parse_kit
from station.devices.presets import GENERAL_MIDI_PRESET, PRESETS
from station.devices.transport import Packet


def replay(capture: Capture) -> Iterator[DeviceEvent]:
    """Every event of a capture with the time it had; raises `BadInput` where a record says what it cannot."""
    decoders = DecoderBank()
    names: dict[int, str] = {}
    for record in capture.records:
        name = names.get(record.device, f"device {record.device}")
        match record.kind:
            case Kind.DEVICE:
                yield from decoders.flush()
                device = device_of(record)
                names[record.device] = device.name
                decoders.add(device.name, _kit_of(device))
            case Kind.BYTES:
                yield from decoders.feed(name, record.payload, record.at_ns).told
            case Kind.SETTLED:
                yield from decoders.settle_until(name, record.at_ns)
            case Kind.STROKE:
                yield stroke_of(record, name)
            case Kind.LOST:
                yield from decoders.lost(name, record.at_ns)
            case Kind.FOUND:
                yield from decoders.found(name, record.at_ns)
            case Kind.END:
                yield from decoders.flush()
            case _:
                pass
    yield from decoders.flush()


def _kit_of(device: DeviceWord) -> KitPreset:
    if device.kit is not None:
        return parse_kit(device.kit, device.preset)
    return PRESETS.get(device.preset, GENERAL_MIDI_PRESET)


def transport_zeros_ns(capture: Capture) -> list[int]:
    """The session times at which the transport's zero was heard, one for every start, in order."""
    return [record.at_ns for record in capture.records if record.kind == Kind.ZERO]


class CapturePlayer:
    """A capture as a transport: gives each packet of one device when its time has come again.

    `start_ns` is the session time at which the capture's first record falls; every stamp moves by as much.
    """

    def __init__(self, capture: Capture, device: str, clock: Clock, start_ns: int) -> None:
        self._name = device
        self._clock = clock
        first_ns = capture.records[0].at_ns if capture.records else 0
        self._due = deque(Packet(data, at_ns + start_ns - first_ns) for data, at_ns in _packets_of(capture, device))

    @property
    def name(self) -> str:
        """The device whose bytes these are."""
        return self._name

    def read(self) -> list[Packet]:
        """The packets whose time has come since the last call."""
        now_ns = self._clock.now_ns()
        packets = []
        while self._due and self._due[0].at_ns <= now_ns:
            packets.append(self._due.popleft())
        return packets

    def close(self) -> None:
        """Give nothing more."""
        self._due.clear()


def _packets_of(capture: Capture, device: str) -> Iterator[Packet]:
    numbers: set[int] = set()
    for record in capture.records:
        if record.kind == Kind.DEVICE:
            (numbers.add if device_of(record).name == device else numbers.discard)(record.device)
        elif record.kind == Kind.BYTES and record.device in numbers:
            yield Packet(record.payload, record.at_ns)
