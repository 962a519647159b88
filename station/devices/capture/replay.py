"""A capture played again: the same bytes through the same decoders give the same events to the nanosecond."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache

from station.core.errors import BadInput
from station.core.events import DeviceEvent, SensorEvent, SensorLost, SensorMounted, SensorSamples, SensorStatus
from station.devices.capture.capture import Capture, CaptureRecord, DeviceWord, RecordKind, device_of, stroke_of
from station.devices.decoders import DecoderBank
from station.devices.mapping.device_file import parse_kit
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.presets import GENERAL_MIDI_PRESET, KNOWN_KITS
from station.devices.mapping.stick_file import SENSOR_PRESET, parse_stick

MOST_DEVICES = 64
"""Of one capture (our choice: nobody plugs in so many kits and sticks)."""


@dataclass(frozen=True, slots=True)
class CaptureBegan:
    """A capture begins here, or goes on in another engine's hand."""


@dataclass(frozen=True, slots=True)
class TransportZero:
    """The transport's zero is heard at session time `at_ns`."""

    at_ns: int


@dataclass(frozen=True, slots=True)
class OutputChanged:
    """The sound goes to the card called `output` from now on, None: to none."""

    output: str | None


@dataclass(frozen=True, slots=True)
class LoggedText:
    """Whoever recorded had `text` kept at session time `at_ns`."""

    at_ns: int
    text: str


Entry = DeviceEvent | SensorEvent | CaptureBegan | TransportZero | OutputChanged | LoggedText


def replay(capture: Capture) -> Iterator[DeviceEvent]:
    """Every event of a kit with the time it had; raises `BadInput` where a record says what it cannot."""
    return (entry for entry in replay_all(capture) if not isinstance(entry, _BESIDE_KITS))


_BESIDE_KITS = (
    SensorMounted,
    SensorLost,
    SensorSamples,
    SensorStatus,
    CaptureBegan,
    TransportZero,
    OutputChanged,
    LoggedText,
)


def replay_all(capture: Capture) -> Iterator[Entry]:
    """Everything that a capture holds, in the order in which it was told on the day; raises as `replay` does."""
    decoders = DecoderBank()
    names: dict[int, str] = {}
    for record in capture.records:
        match record.kind:
            case RecordKind.DEVICE:
                yield from decoders.flush()
                device = device_of(record)
                names[record.device] = device.name
                if len(names) > MOST_DEVICES:
                    raise BadInput("capture", f"device {record.device}", f"more than {MOST_DEVICES} devices")
                _announce(decoders, device)
            case RecordKind.ZERO:
                yield TransportZero(record.at_ns)
            case RecordKind.ANNOTATION:
                yield from decoders.settle(record.at_ns)  # the engine did before it took the text
                yield LoggedText(record.at_ns, record.payload.decode("utf-8", "replace"))
            case RecordKind.START | RecordKind.OUTPUT | RecordKind.END:
                yield from decoders.flush()
                if record.kind == RecordKind.START:
                    yield CaptureBegan()
                elif record.kind == RecordKind.OUTPUT:
                    yield OutputChanged(record.payload.decode("utf-8", "replace") or None)
            case _:
                yield from _of_device(decoders, names.get(record.device, f"device {record.device}"), record)
    yield from decoders.flush()


def _announce(decoders: DecoderBank, device: DeviceWord) -> None:
    """From now on `device` is understood as the capture says."""
    if device.preset == SENSOR_PRESET:
        decoders.add_sensor(device.name, parse_stick(device.kit or "", device.name))
    else:
        decoders.add(device.name, _kit_of(device))


def _of_device(decoders: DecoderBank, name: str, record: CaptureRecord) -> Iterable[DeviceEvent | SensorEvent]:
    """What a record of the device `name` brings; nothing where its kind is not known."""
    match record.kind:
        case RecordKind.BYTES:
            heard = decoders.feed(name, record.payload, record.at_ns)
            return (*heard.sensed, *heard.certain)
        case RecordKind.SETTLED:
            return decoders.settle_until(name, record.at_ns)
        case RecordKind.STROKE:
            return [stroke_of(record, name)]
        case RecordKind.LOST:
            return decoders.lost(name, record.at_ns)
        case RecordKind.FOUND:
            return decoders.found(name, record.at_ns)
        case _:
            return ()


@lru_cache(maxsize=MOST_DEVICES)
def _kit_of(device: DeviceWord) -> DeviceMap:
    """The map of a kit; the same one comes again with every start of an engine, and every plug."""
    if device.kit is not None:
        return parse_kit(device.kit, device.preset)
    return KNOWN_KITS.get(device.preset, GENERAL_MIDI_PRESET)


def transport_zeros_ns(capture: Capture) -> list[int]:
    """The session times at which the transport's zero was heard, one for every start, in order."""
    return [record.at_ns for record in capture.records if record.kind == RecordKind.ZERO]
