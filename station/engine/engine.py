"""The real-time part as a plain object: bytes and commands in, events and blocks of sound out.

It owns no thread, clock, port or card. Whoever runs it (the engine process, a headless session, a test) feeds it the
bytes of the devices with their times, hands it commands, advances it to the present and, where there is a sound card,
asks it for blocks. One thread may call `render` while another calls anything else; all else takes turns
(`station.engine.engine_step`).

Times are session time (monotonic ns). With a mixer the transport starts with the block that the card asks for next;
without one it runs on the times that `advance` is told.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError, StationError
from station.core.events import DeviceEvent, DeviceFound, DeviceLost, Hit, PhaseEstimate, SensorEvent, SensorSamples
from station.core.imu import Mounting
from station.core.units import NS_PER_S
from station.devices.capture.capture_writer import CaptureFile
from station.devices.decoders import DecoderBank
from station.devices.mapping.device_map import DeviceMap
from station.engine.capture_recorder import CaptureOpening, OpenCapture, RunningCapture
from station.engine.cue_queue import CueRun
from station.engine.messages import (
    AddCues,
    Annotate,
    CaptureSaved,
    Command,
    EngineEvent,
    KeyHit,
    Notice,
    Play,
    Quit,
    RawBytes,
    RecordCapture,
    ReloadDevice,
    Resume,
    SetAirDrums,
    SetBacking,
    SetLevel,
    SetMaster,
    SetMidiOut,
    SetPiece,
    SetSounds,
    Setting,
    Sounding,
    Started,
    Status,
    Stop,
    TrackPhase,
    Transport,
    WatchRawBytes,
    WatchSensors,
)
from station.engine.midi_player import MidiOut, OpenMidiOut, no_midi_out
from station.engine.sound_player import SoundPlayer
from station.sound.buses import ClickVoice
from station.sound.drum_kit import DrumKit, Frames
from station.sound.mixer import Mixer
from station.sound.track import load
from station.sync.sonification.live_triggers import LiveTriggers
from station.sync.sticks import Sticks

STATUS_EVERY_NS = NS_PER_S
KEYBOARD = "keyboard"
"""The device that a stroke on the computer's keys names."""

FindKit = Callable[[str], DeviceMap | None]
"""The user's own kit for a device; raises `BadInput` where its file is at fault."""


def no_own_kit(_: str) -> DeviceMap | None:
    """For an engine that knows kits by their presets alone."""
    return None


FindStick = Callable[[str], Mounting]
"""How the user's sensor of that name is mounted; raises `BadInput` where its file is at fault."""


def no_own_stick(_: str) -> Mounting:
    """For an engine whose sensors are mounted as sensors mostly are."""
    return Mounting()


@dataclass(frozen=True, slots=True)
class OutputState:
    """How the stream on the sound card called `name` is doing; the other fields stand as in `Status`."""

    name: str | None = None
    underflows: int = 0
    latency_ms: float | None = None
    load: float = 0.0


class Engine:
    """Devices and commands in, sound and events out."""

    def __init__(
        self,
        mixer: Mixer | None = None,
        open_capture: OpenCapture = CaptureFile,
        open_midi_out: OpenMidiOut = no_midi_out,
        own_kit: FindKit = no_own_kit,
        own_stick: FindStick = no_own_stick,
    ) -> None:
        self.output = OutputState()
        """What the next `Status` says of the sound card; set by whoever owns it."""
        self.quitting = False
        """Whether `Quit` was handled."""
        self._player = SoundPlayer(mixer)
        self._own_kit, self._own_stick = own_kit, own_stick
        self._midi = MidiOut(open_midi_out, self.notify)
        self._decoders = DecoderBank()
        self._devices: list[str] = []
        self._watches_bytes = self._watches_sensors = False
        self._sticks, self._triggers = Sticks(), LiveTriggers(())
        self._recording = RunningCapture(open_capture, self._decoders)
        self._zero_ns: int | None = None
        self._events: list[EngineEvent] = []
        self._now_ns = 0
        self._next_status_ns: int | None = None

    # --- devices -----------------------------------------------------------------------------------------------------

    def use_preset(self, device: str, preset: DeviceMap) -> None:
        """Understand `device` by `preset` instead of the one that its name suggests."""
        self._events += self._decoders.flush()
        self._decoders.add(device, preset)
        self._recording.add_device(device, self._now_ns)

    def feed(self, device: str, data: bytes, at_ns: int) -> None:
        """Take bytes of `device` that came at `at_ns`; the strokes in them sound with the next block."""
        self._recording.bytes_came(device, data, at_ns, self._decoders.overtaken_ns(device, at_ns))
        if self._watches_bytes:
            self._events.append(RawBytes(at_ns, device, data))
        heard = self._decoders.feed(device, data, at_ns)
        for event in heard.sounding:
            self._player.sound(event)
        self._events += heard.certain
        for event in heard.certain:
            if isinstance(event, Hit):
                self._sticks.struck(event)
        for sensed in heard.sensed:
            self._sense(sensed)

    def _sense(self, event: SensorEvent) -> None:
        """Take what a sensor told; a stroke in the air sounds, and is kept with the hand that played it."""
        if self._watches_sensors and isinstance(event, SensorSamples):
            self._events.append(event)
        for told in self._sticks.handle(event):
            if isinstance(told, Hit):
                self._player.sound(told)
                self._recording.stroke(told)
            elif isinstance(told, PhaseEstimate):
                for struck in self._triggers.handle(told, self._now_ns):
                    self._player.sound(struck)
            self._events.append(told)

    def device_found(self, device: str, at_ns: int) -> None:
        """`device` is connected, or connected again; the user's own kit for it, if there is one, holds from now on."""
        self._load_own_kit(device)
        self._connected(device, at_ns)

    def sensor_found(self, device: str, at_ns: int) -> None:
        """`device` is connected, or connected again, and is a motion sensor on a stick."""
        self._load_own_stick(device)
        self._connected(device, at_ns)

    def _connected(self, device: str, at_ns: int) -> None:
        if device not in self._devices:
            self._devices.append(device)
        self._recording.device_changed(DeviceFound(at_ns, device))
        self._tell(self._decoders.found(device, at_ns))

    def _tell(self, events: Iterable[DeviceEvent | SensorEvent]) -> None:
        for event in events:
            if isinstance(event, SensorEvent):
                self._sense(event)
            else:
                self._events.append(event)

    def _load_own_stick(self, device: str) -> None:
        mounting = Mounting()
        try:
            mounting = self._own_stick(device)
        except StationError as fault:
            self.notify(f"{fault}; {device} is taken to be mounted as sensors mostly are")
        if mounting != self._decoders.mounting_of(device):
            self._decoders.add_sensor(device, mounting)
            self._recording.add_device(device, self._now_ns)

    def _load_own_kit(self, device: str) -> None:
        try:
            kit = self._own_kit(device)
        except StationError as fault:
            self.notify(f"{fault}; {device} is taken for {self._decoders.preset_of(device).title}")
            return
        if kit is not None and kit != self._decoders.preset_of(device):
            self.use_preset(device, kit)
            self.notify(f"{device} is understood as you taught it: {kit.title}")

    def device_lost(self, device: str, at_ns: int) -> None:
        """`device` is gone."""
        if device in self._devices:
            self._devices.remove(device)
        self._recording.device_changed(DeviceLost(at_ns, device))
        self._tell(self._decoders.lost(device, at_ns))

    # --- commands ----------------------------------------------------------------------------------------------------

    def handle(self, command: Command) -> None:
        """Obey the app; "now" is what `advance` was told last."""
        match command:
            case Play() | Resume() | AddCues() | Stop():
                self._move_transport(command)
            case (
                SetLevel()
                | SetPiece()
                | SetMaster()
                | SetSounds()
                | SetBacking()
                | SetMidiOut()
                | SetAirDrums()
                | TrackPhase()
            ):
                self._set(command)
            case KeyHit():
                self._strike_key(command)
            case RecordCapture():
                self._record(command.path)
            case Annotate(text):
                self._recording.annotate(text, self._now_ns)
            case WatchRawBytes(on):
                self._watches_bytes = on
            case WatchSensors(on):
                self._watches_sensors = on
            case ReloadDevice(device) if self._decoders.mounting_of(device) is not None:
                self._load_own_stick(device)
            case ReloadDevice(device):
                self._load_own_kit(device)
            case Quit():
                self.quitting = True

    def _move_transport(self, command: Transport) -> None:
        match command:
            case Play():
                self._player.play(CueRun(command.cues), self._now_ns + command.start_in_ns)
                self._midi.play(CueRun(command.cues))
            case Resume():
                self._zero_ns = command.zero_ns
                self._player.resume(CueRun(command.cues), command.zero_ns)
                self._midi.resume(CueRun(command.cues), command.zero_ns, self._now_ns)
            case AddCues(cues):
                self._player.add(CueRun(cues))
                self._midi.add(CueRun(cues))
            case Stop():
                self._zero_ns = None
                self._player.stop()
                self._midi.stop()

    def _set(self, command: Setting) -> None:
        match command:
            case SetLevel():
                self._player.set_level(command.bus, command.level, command.pan)
            case SetPiece():
                self._player.set_piece(command.piece, command.level, command.pan)
            case SetMaster(level):
                self._player.set_master(level)
            case SetSounds():  # whoever has time to read them hands them to `use_sounds`
                pass
            case SetBacking():
                self._set_backing(command)
            case SetMidiOut():
                self._midi.choose(command.port)
            case SetAirDrums():
                self._sticks.play_air(command.kit, command.ahead_ns)
            case TrackPhase():
                self._sticks.track_drill(command.model)
                self._triggers = LiveTriggers(command.triggers)
                if command.note:
                    self._recording.annotate(command.note, self._now_ns)

    def _set_backing(self, command: SetBacking) -> None:
        track = command.loaded
        if command.track is not None and track is None:
            try:
                track = load(command.track)
            except DeviceError as fault:
                self.notify(str(fault))
        rate_hz = self._player.rate_hz
        if track is not None and rate_hz not in (None, track.rate_hz):
            self.notify(f"the track was prepared for {track.rate_hz} Hz and the card plays {rate_hz}: choose it again")
        self._player.set_track(track, command.at_ns)

    def _strike_key(self, key: KeyHit) -> None:
        hit = Hit(
            at_ns=key.at_ns,
            piece=key.piece,
            zone=key.zone,
            velocity=key.velocity,
            articulation=key.articulation,
            openness=key.openness,
            device=KEYBOARD,
        )
        self._player.sound(hit)
        self._recording.stroke(hit)
        self._events.append(hit)

    def _record(self, path: Path | None) -> None:
        self._events += self._decoders.flush()  # what was played before a capture begins or ends is reported before it
        lacking = self._recording.end(self._now_ns)
        if path is None:
            self._events.append(CaptureSaved(None, lacking))
            return
        if lacking is not None:
            self.notify(lacking)
        zero_ns = self._zero_ns if self._player.has_cues else None  # what has played out belongs to what was before
        try:
            self._recording.begin(path, self._now_ns, CaptureOpening(self._devices, self.output.name, zero_ns))
        except StationError as fault:
            self._events.append(CaptureSaved(path, str(fault)))
            return
        self._events.append(CaptureSaved(path))

    # --- time --------------------------------------------------------------------------------------------------------

    def notify(self, text: str) -> None:
        """Give the user something to read with the next `advance`."""
        self._events.append(Notice(text))

    def report(self, event: EngineEvent) -> None:
        """Report `event` with the next `advance`."""
        if isinstance(event, Sounding):  # what was played before sounded elsewhere, and is reported before
            self._events += self._decoders.flush()
            self._recording.output(event.output, self._now_ns)
        self._events.append(event)

    @property
    def is_playing(self) -> bool:
        """Whether the transport runs and something is still to sound."""
        return self._player.has_cues

    def advance(self, now_ns: int) -> list[EngineEvent]:
        """Move to `now_ns`; returns what happened since the last call, in the order in which it was found out."""
        self._now_ns = now_ns
        self._events += self._decoders.settle(now_ns)
        if self._player.is_silent:
            self._player.pass_by(now_ns)
        for zero_ns in self._player.pop_zeros_ns():
            self._zero_ns = zero_ns
            self._midi.started(zero_ns)
            self._events.append(Started(zero_ns, self.output.name))
            self._recording.zero(zero_ns)
        self._midi.advance(now_ns)
        if self._next_status_ns is None:
            self._next_status_ns = now_ns + STATUS_EVERY_NS
        elif now_ns >= self._next_status_ns:
            self._next_status_ns = now_ns + STATUS_EVERY_NS
            if (fault := self._recording.new_fault()) is not None:
                self.notify(fault)
            self._events.append(self._status())
        events, self._events = self._events, []
        return events

    def _status(self) -> Status:
        return Status(
            at_ns=self._now_ns,
            underflows=self.output.underflows,
            late_cues=self._player.late_cues,
            output_latency_ms=self.output.latency_ms,
            load=self.output.load,
        )

    def close(self) -> None:
        """Leave the MIDI output, and end the capture, so that its last hits are on the disk."""
        self._midi.choose(None)
        self._events += self._decoders.flush()
        lacking = self._recording.end(self._now_ns)
        if lacking is not None:
            self.notify(lacking)

    # --- sound -------------------------------------------------------------------------------------------------------

    def attach(self, mixer: Mixer | None) -> None:
        """Sound through `mixer` from now on, None for a card that has gone; only while nobody calls `render`."""
        self._player.attach(mixer)

    def use_sounds(self, kit: DrumKit, clicks: Mapping[ClickVoice, Frames]) -> None:
        """Sound what is struck and clicked from the next block on by these, of the card's rate."""
        self._player.use_sounds(kit, clicks)

    def render(self, frames: int, dac_ns: int) -> NDArray[np.float32]:
        """The next block of sound: float32 (frames, 2), whose first frame is heard at session time `dac_ns`."""
        return self._player.render(frames, dac_ns)
