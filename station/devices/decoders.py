"""All the kits and sensors that are heard, each with its own decoder, by its name: for live bytes and captures.

What is a stroke is judged by what the pads sent; what comes out has the velocities as they count (`velocity_curve`).
What sensors measure comes out beside it, and waits for nothing.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import NamedTuple

from station.core.events import DeviceEvent, DeviceFound, DeviceLost, Hit, SensorEvent, SensorLost
from station.core.imu import Mounting
from station.devices.hid.hid_decoder import HidDecoder
from station.devices.imu.imu_sensor import ImuSensor
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.presets import preset_for
from station.devices.mapping.trigger_filter import FalseTrigger, TriggerFilter
from station.devices.mapping.velocity_curve import AS_SENT, counted
from station.devices.midi.midi_decoder import MidiDecoder


class DecodedEvents(NamedTuple):
    """What bytes brought: the events that may sound at once, those that are certain now, and what sensors `sensed`."""

    sounding: list[DeviceEvent]
    certain: list[DeviceEvent]
    sensed: Sequence[SensorEvent] = ()


class _Kit:
    """One kit: what it sends, and which of it counts."""

    def __init__(self, preset: DeviceMap, device: str, with_curves: bool) -> None:
        self.decoder = HidDecoder(preset, device) if preset.reports else MidiDecoder(preset, device)
        self.filter = TriggerFilter(preset)
        self.is_filtered = preset.has_rules
        pads = preset.pads if with_curves else {}
        self._tables = {piece: pad.curve.table for piece, pad in pads.items() if pad.curve != AS_SENT}

    def as_counts(self, events: Iterable[DeviceEvent]) -> list[DeviceEvent]:
        """The events with the velocities that they count as."""
        return [self._counted(event) for event in events] if self._tables else list(events)

    def _counted(self, event: DeviceEvent) -> DeviceEvent:
        table = self._tables.get(event.piece) if isinstance(event, Hit) else None
        if table is None:
            return event
        assert isinstance(event, Hit)
        velocity, fraction = counted(table, event.velocity, event.velocity_fraction)
        return replace(event, velocity=velocity, velocity_fraction=fraction)

    def reset(self) -> list[DeviceEvent]:
        """Start afresh; returns what still waited."""
        self.decoder.reset()
        waiting = self.filter.flush()
        self.filter.reset()
        return self.as_counts(waiting)


class DecoderBank:
    """Decoders by device; a device that nobody announced gets the preset that `suggest` has for its name.

    Without `with_curves` velocities stay as they were sent.
    """

    def __init__(self, suggest: Callable[[str], DeviceMap] = preset_for, with_curves: bool = True) -> None:
        self._suggest = suggest
        self._with_curves = with_curves
        self._kits: dict[str, _Kit] = {}
        self._sensors: dict[str, ImuSensor] = {}

    def add_sensor(self, device: str, mounting: Mounting) -> None:
        """Understand `device` as a motion sensor mounted so; with its next bytes it says so, and starts afresh."""
        self._sensors[device] = ImuSensor(device, mounting)

    def mounting_of(self, device: str) -> Mounting | None:
        """How `device` is mounted, if it is a motion sensor."""
        sensor = self._sensors.get(device)
        return None if sensor is None else sensor.mounting

    def add(self, device: str, preset: DeviceMap) -> None:
        """Understand `device` as a kit, by `preset`, from now on; what its decoder knew is forgotten."""
        self._sensors.pop(device, None)
        self._kits[device] = _Kit(preset, device, self._with_curves)

    def preset_of(self, device: str) -> DeviceMap:
        """The preset by which `device` is understood."""
        return self._kit(device).decoder.preset

    def feed(self, device: str, data: bytes, at_ns: int) -> DecodedEvents:
        """What `data` from `device`, come at `at_ns`, brings."""
        sensor = self._sensors.get(device)
        if sensor is not None:
            return DecodedEvents([], [], sensor.feed(data, at_ns))
        kit = self._kit(device)
        events = kit.decoder.feed(data, at_ns)
        if not kit.is_filtered:
            events = kit.as_counts(events)
            return DecodedEvents(events, events)
        sounding = [event for event in events if kit.filter.feed(event)]
        return DecodedEvents(kit.as_counts(sounding), kit.as_counts(kit.filter.certain()))

    def settle(self, now_ns: int) -> list[DeviceEvent]:
        """What is certain by the clock, which must not run ahead of the bytes."""
        return [event for kit in self._kits.values() for event in kit.as_counts(kit.filter.settle(now_ns))]

    def settle_until(self, device: str, until_ns: int) -> list[DeviceEvent]:
        """What a clock had made certain of `device` at `until_ns`; see `overtaken_ns`."""
        if device in self._sensors:
            return []
        kit = self._kit(device)
        return kit.as_counts(kit.filter.settle_until(until_ns))

    def overtaken_ns(self, device: str, at_ns: int) -> int | None:
        """Up to when events of `device` were let go, if bytes from before that come only now; see `TriggerFilter`."""
        return None if device in self._sensors else self._kit(device).filter.overtaken_ns(at_ns)

    def waits(self, device: str) -> bool:
        """Whether something of `device` is not certain yet."""
        return device not in self._sensors and self._kit(device).filter.waits

    def flush(self) -> list[DeviceEvent]:
        """All that still waits, as it stands."""
        return [event for kit in self._kits.values() for event in kit.as_counts(kit.filter.flush())]

    def pop_false_triggers(self) -> list[FalseTrigger]:
        """What was held back since the last call."""
        found = [held_back for kit in self._kits.values() for held_back in kit.filter.false_triggers]
        for kit in self._kits.values():
            kit.filter.false_triggers.clear()
        return found

    def restart_state(self, device: str) -> bytes:
        """Bytes that tell a later decoder of `device` how the kit stands now; see `MidiDecoder.restart_state`.

        A sensor has no such bytes: it starts afresh here as it will there.
        """
        if device in self._sensors:
            self._sensors[device].reset()
            return b""
        kit = self._kit(device)
        kit.filter.reset()
        return kit.decoder.restart_state()

    def lost(self, device: str, at_ns: int) -> list[DeviceEvent | SensorEvent]:
        """`device` is gone: half a message and the pedal's position mean nothing any more."""
        sensor = self._sensors.get(device)
        if sensor is None:
            return [*self._kit(device).reset(), DeviceLost(at_ns, device)]
        sensor.reset()
        return [SensorLost(at_ns, device)]

    def found(self, device: str, at_ns: int) -> list[DeviceEvent | SensorEvent]:
        """`device` is there, or there again."""
        sensor = self._sensors.get(device)
        if sensor is None:
            return [*self._kit(device).reset(), DeviceFound(at_ns, device)]
        sensor.reset()
        return [sensor.found(at_ns)]

    def _kit(self, device: str) -> _Kit:
        kit = self._kits.get(device)
        if kit is None:
            kit = self._kits[device] = _Kit(self._suggest(device), device, self._with_curves)
        return kit
