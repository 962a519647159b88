"""A capture played again: the same bytes through the same decoders give the same events to the nanosecond."""

from collections.abc import Iterator

from station.core.events import DeviceEvent
from station.devices.capture import Capture, DeviceWord, Kind, device_of, stroke_of
from station.devices.decoders import DecoderBank
from station.devices.kit import KitPreset
from station.devices.kit_file import parse_kit
from station.devices.presets import GENERAL_MIDI_PRESET, PRESETS


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
