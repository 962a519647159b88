"""A capture played again: the same bytes through the same decoders give the same events to the nanosecond."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from station.core.events import DeviceEvent
from station.devices.capture import Capture, DeviceWord, Kind, Record, device_of, stroke_of
from station.devices.decoders import DecoderBank
from station.devices.kit import KitPreset
from station.devices.kit_file import parse_kit
from station.devices.presets import GENERAL_MIDI_PRESET, PRESETS


@dataclass(frozen=True, slots=True)
class Begun:
    """A capture begins here, or goes on in another engine's hand."""


@dataclass(frozen=True, slots=True)
class Zero:
    """The transport's zero is heard at session time `at_ns`."""

    at_ns: int


@dataclass(frozen=True, slots=True)
class Heard:
    """The sound goes to the card called `output` from now on, None: to none."""

    output: str | None


@dataclass(frozen=True, slots=True)
class Remark:
    """Whoever recorded had `text` kept at session time `at_ns`."""

    at_ns: int
    text: str


Entry = DeviceEvent | Begun | Zero | Heard | Remark


def replay(capture: Capture) -> Iterator[DeviceEvent]:
    """Every event of a capture with the time it had; raises `BadInput` where a record says what it cannot."""
    return (entry for entry in replay_all(capture) if not isinstance(entry, Begun | Zero | Heard | Remark))


def replay_all(capture: Capture) -> Iterator[Entry]:
    """Everything that a capture holds, in the order in which it was told on the day; raises as `replay` does."""
    decoders = DecoderBank()
    names: dict[int, str] = {}
    for record in capture.records:
        match record.kind:
            case Kind.DEVICE:
                yield from decoders.flush()
                device = device_of(record)
                names[record.device] = device.name
                decoders.add(device.name, _kit_of(device))
            case Kind.ZERO:
                yield Zero(record.at_ns)
            case Kind.REMARK:
                yield from decoders.settle(record.at_ns)  # the engine did before it took the remark
                yield Remark(record.at_ns, record.payload.decode("utf-8", "replace"))
            case Kind.START | Kind.OUTPUT | Kind.END:
                yield from decoders.flush()
                if record.kind == Kind.START:
                    yield Begun()
                elif record.kind == Kind.OUTPUT:
                    yield Heard(record.payload.decode("utf-8", "replace") or None)
            case _:
                yield from _of_device(decoders, names.get(record.device, f"device {record.device}"), record)
    yield from decoders.flush()


def _of_device(decoders: DecoderBank, name: str, record: Record) -> Iterable[DeviceEvent]:
    """What a record of the device `name` brings; nothing where its kind is not known."""
    match record.kind:
        case Kind.BYTES:
            return decoders.feed(name, record.payload, record.at_ns).told
        case Kind.SETTLED:
            return decoders.settle_until(name, record.at_ns)
        case Kind.STROKE:
            return [stroke_of(record, name)]
        case Kind.LOST:
            return decoders.lost(name, record.at_ns)
        case Kind.FOUND:
            return decoders.found(name, record.at_ns)
        case _:
            return ()


def _kit_of(device: DeviceWord) -> KitPreset:
    if device.kit is not None:
        return parse_kit(device.kit, device.preset)
    return PRESETS.get(device.preset, GENERAL_MIDI_PRESET)


def transport_zeros_ns(capture: Capture) -> list[int]:
    """The session times at which the transport's zero was heard, one for every start, in order."""
    return [record.at_ns for record in capture.records if record.kind == Kind.ZERO]
