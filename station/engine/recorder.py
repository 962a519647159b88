"""What the engine writes into a capture: numbers the devices, says how each stands when the capture begins."""

from station.core.events import DeviceFound, DeviceLost, Hit
from station.devices.capture import Kind, Record, device_record, stroke_record
from station.devices.capture_file import CaptureSink
from station.devices.decoders import DecoderBank
from station.devices.kit_text import kit_text
from station.devices.presets import PRESETS


class Recorder:
    """Puts what the engine receives into `sink`."""

    def __init__(self, sink: CaptureSink, decoders: DecoderBank) -> None:
        self._sink = sink
        self._decoders = decoders
        self._numbers: dict[str, int] = {}

    @property
    def fault(self) -> str | None:
        """What hinders writing at present, None if nothing does."""
        return self._sink.fault

    def add_device(self, device: str, at_ns: int) -> None:
        """Record who `device` is and how it stands; later bytes refer to it."""
        preset = self._decoders.preset_of(device)
        own = None if PRESETS.get(preset.name) == preset else kit_text(preset)
        number = self._numbers.setdefault(device, len(self._numbers) + 1)
        self._sink.append(device_record(number, at_ns, device, preset.name, own))
        self._sink.append(Record(Kind.BYTES, number, at_ns, self._decoders.bequeath(device)))

    def bytes_came(self, device: str, data: bytes, at_ns: int) -> None:
        """Record bytes, to be called before they are decoded."""
        self._sink.append(Record(Kind.BYTES, self._number(device, at_ns), at_ns, data))

    def settled(self, device: str, until_ns: int) -> None:
        """Record that hits of `device` up to `until_ns` were told before bytes from earlier came."""
        self._sink.append(Record(Kind.SETTLED, self._number(device, until_ns), until_ns))

    def device_changed(self, event: DeviceLost | DeviceFound) -> None:
        """Record that a device went or came."""
        kind = Kind.LOST if isinstance(event, DeviceLost) else Kind.FOUND
        self._sink.append(Record(kind, self._number(event.device, event.at_ns), event.at_ns))

    def stroke(self, hit: Hit) -> None:
        """Record a hit that had no bytes."""
        self._sink.append(stroke_record(self._number(hit.device, hit.at_ns), hit))

    def zero(self, zero_ns: int) -> None:
        """Record where the transport's zero lies."""
        self._sink.append(Record(Kind.ZERO, 0, zero_ns))

    def close(self, at_ns: int) -> None:
        """End the capture."""
        self._sink.close(at_ns)

    def _number(self, device: str, at_ns: int) -> int:
        if device not in self._numbers:
            self.add_device(device, at_ns)
        return self._numbers[device]
