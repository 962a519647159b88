"""What the engine writes into a capture: numbers the devices, says how each stands when the capture begins.

A `Recorder` belongs to one capture; the engine's `RunningCapture` is there always, and takes what comes while none is
open for nothing.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from station.core.events import DeviceFound, DeviceLost, Hit
from station.devices.capture.capture import CaptureRecord, RecordKind, device_record, stroke_record
from station.devices.capture.capture_writer import CaptureSink
from station.devices.decoders import DecoderBank
from station.devices.mapping.device_writer import kit_text
from station.devices.mapping.presets import KNOWN_KITS
from station.devices.mapping.stick_file import SENSOR_PRESET, stick_text

OpenCapture = Callable[[Path, int], CaptureSink]
"""Begins a capture at a path and a session time; raises `StationError`."""


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
        number = self._numbers.setdefault(device, len(self._numbers) + 1)
        self._sink.append(device_record(number, at_ns, device, *self._understood(device)))
        self._sink.append(CaptureRecord(RecordKind.BYTES, number, at_ns, self._decoders.restart_state(device)))

    def _understood(self, device: str) -> tuple[str, str | None]:
        """How `device` is understood: the name of its preset, and the text of its own file, if any."""
        mounting = self._decoders.mounting_of(device)
        if mounting is not None:
            return SENSOR_PRESET, stick_text(mounting)
        preset = self._decoders.preset_of(device)
        return preset.name, None if KNOWN_KITS.get(preset.name) == preset else kit_text(preset)

    def put(self, kind: RecordKind, device: str, at_ns: int, payload: bytes = b"") -> None:
        """Record something of `device`."""
        if device not in self._numbers:
            self.add_device(device, at_ns)
        self._sink.append(CaptureRecord(kind, self._numbers[device], at_ns, payload))

    def stroke(self, hit: Hit) -> None:
        """Record a hit that had no bytes."""
        if hit.device not in self._numbers:
            self.add_device(hit.device, hit.at_ns)
        self._sink.append(stroke_record(self._numbers[hit.device], hit))

    def say(self, kind: RecordKind, at_ns: int, text: str = "") -> None:
        """Record something that is of no device."""
        self._sink.append(CaptureRecord(kind, 0, at_ns, text.encode("utf-8", "replace")))

    def close(self, at_ns: int) -> None:
        """End the capture."""
        self._sink.close(at_ns)


@dataclass(frozen=True, slots=True)
class CaptureOpening:
    """How things stand when a capture begins: the kits that are there, what sounds, the zero of a running transport."""

    devices: Iterable[str]
    output: str | None
    zero_ns: int | None


class RunningCapture:
    """The capture that is written at present, if one is."""

    def __init__(self, open_capture: OpenCapture, decoders: DecoderBank) -> None:
        self._open, self._decoders = open_capture, decoders
        self._recorder: Recorder | None = None
        self._reported: str | None = None

    def begin(self, path: Path, at_ns: int, scene: CaptureOpening) -> None:
        """Begin a capture at `path`; the one before has ended. Raises `StationError` where none can be begun."""
        assert self._recorder is None, "one capture at a time"
        self._recorder = Recorder(self._open(path, at_ns), self._decoders)
        for device in scene.devices:
            self._recorder.add_device(device, at_ns)
        self.output(scene.output, at_ns)
        if scene.zero_ns is not None:
            self.zero(scene.zero_ns)

    def end(self, at_ns: int) -> str | None:
        """Close the capture, where one is open; returns what it lacks."""
        if self._recorder is None:
            return None
        self._recorder.close(at_ns)
        fault, self._recorder, self._reported = self._recorder.fault, None, None
        return fault

    def new_fault(self) -> str | None:
        """What hinders writing since the last call, reported once."""
        fault = self._recorder.fault if self._recorder is not None else None
        is_news, self._reported = fault != self._reported, fault
        return fault if is_news else None

    # --- what is recorded --------------------------------------------------------------------------------------------

    def add_device(self, device: str, at_ns: int) -> None:
        """`device` is understood otherwise from now on."""
        if self._recorder is not None:
            self._recorder.add_device(device, at_ns)

    def bytes_came(self, device: str, data: bytes, at_ns: int, overtaken_ns: int | None) -> None:
        """Bytes came, to be recorded before they are decoded; what was let go until `overtaken_ns` went before them."""
        if self._recorder is None:
            return
        if overtaken_ns is not None:
            self._recorder.put(RecordKind.SETTLED, device, overtaken_ns)
        self._recorder.put(RecordKind.BYTES, device, at_ns, data)

    def device_changed(self, event: DeviceLost | DeviceFound) -> None:
        """A device went or came."""
        if self._recorder is not None:
            kind = RecordKind.LOST if isinstance(event, DeviceLost) else RecordKind.FOUND
            self._recorder.put(kind, event.device, event.at_ns)

    def stroke(self, hit: Hit) -> None:
        """A hit came that had no bytes."""
        if self._recorder is not None:
            self._recorder.stroke(hit)

    def zero(self, zero_ns: int) -> None:
        """The transport's zero lies there."""
        if self._recorder is not None:
            self._recorder.say(RecordKind.ZERO, zero_ns)

    def output(self, name: str | None, at_ns: int) -> None:
        """The sound goes to the card called `name`."""
        if self._recorder is not None:
            self._recorder.say(RecordKind.OUTPUT, at_ns, name or "")

    def annotate(self, text: str, at_ns: int) -> None:
        """Keep `text` in the capture."""
        if self._recorder is not None:
            self._recorder.say(RecordKind.ANNOTATION, at_ns, text)
