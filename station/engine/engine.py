"""The real-time part as a plain object: bytes and commands in, events and blocks of sound out.

It owns no thread, clock, port or card. Whoever runs it (the engine process, a headless session, a test) feeds it the
bytes of the devices with their times, hands it commands, advances it to the present and, where there is a sound card,
asks it for blocks. One thread may call `render` while another calls anything else; all else takes turns
(`station.engine.runner`).

Times are session time (monotonic ns). With a mixer the transport starts with the block that the card asks for next;
without one it runs on the times that `advance` is told.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError, StationError
from station.core.events import Choke, DeviceEvent, DeviceFound, DeviceLost, Hit, PedalMoved
from station.core.kitmap import Strike
from station.core.units import NS_PER_S
from station.devices.capture_file import CaptureFile, CaptureSink
from station.devices.decoders import DecoderBank
from station.devices.kit import KitPreset
from station.engine.messages import (
    Command,
    Eavesdrop,
    EngineEvent,
    KeyHit,
    Notice,
    Overheard,
    Play,
    Quit,
    Record,
    Recorded,
    Resume,
    SetBacking,
    SetLevel,
    SetMidiOut,
    SetPiece,
    Setting,
    Started,
    Status,
    Stop,
    TakeKit,
)
from station.engine.midi_player import MidiPlayer, MidiSink
from station.engine.playback import CueRun
from station.engine.player import Player
from station.engine.recorder import Recorder
from station.sound.mixer import Mixer
from station.sound.track import load

STATUS_EVERY_NS = NS_PER_S
KEYBOARD = "keyboard"
"""The device that a stroke on the computer's keys names."""

OpenCapture = Callable[[Path, int], CaptureSink]
OpenMidiOut = Callable[[str], MidiSink]
FindKit = Callable[[str], KitPreset | None]
"""The user's own kit for a device; raises `BadInput` where its file is at fault."""


def no_midi_out(port: str) -> MidiSink:
    """For an engine without ports."""
    raise DeviceError(f"{port}: there is no MIDI output here")


def no_own_kit(_: str) -> KitPreset | None:
    """For an engine that knows kits by their presets alone."""
    return None


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
    ) -> None:
        self.output = OutputState()
        """What the next `Status` tells of the sound card; set by whoever owns it."""
        self.quitting = False
        """Whether `Quit` was handled."""
        self._player = Player(mixer)
        self._open_capture = open_capture
        self._open_midi_out = open_midi_out
        self._own_kit = own_kit
        self._midi: MidiPlayer | None = None
        self._midi_fault: DeviceError | None = None
        self._decoders = DecoderBank()
        self._devices: list[str] = []
        self._eavesdrops = False
        self._recorder: Recorder | None = None
        self._capture_fault: str | None = None
        self._zero_ns: int | None = None
        self._events: list[EngineEvent] = []
        self._now_ns = 0
        self._next_status_ns: int | None = None

    # --- devices -----------------------------------------------------------------------------------------------------

    def use_preset(self, device: str, preset: KitPreset) -> None:
        """Understand `device` by `preset` instead of the one that its name suggests."""
        self._events += self._decoders.flush()
        self._decoders.add(device, preset)
        if self._recorder is not None:
            self._recorder.add_device(device, self._now_ns)

    def feed(self, device: str, data: bytes, at_ns: int) -> None:
        """Take bytes of `device` that came at `at_ns`; the strokes in them sound with the next block."""
        overtaken_ns = self._decoders.overtaken_ns(device, at_ns)
        if self._recorder is not None:
            if overtaken_ns is not None:
                self._recorder.settled(device, overtaken_ns)
            self._recorder.bytes_came(device, data, at_ns)
        if self._eavesdrops:
            self._events.append(Overheard(at_ns, device, data))
        heard = self._decoders.feed(device, data, at_ns)
        for event in heard.sounding:
            self._sound(event)
        self._events += heard.told

    def device_found(self, device: str, at_ns: int) -> None:
        """`device` is connected, or connected again; the user's own kit for it, if there is one, holds from now on."""
        self._take_own_kit(device)
        if device not in self._devices:
            self._devices.append(device)
        if self._recorder is not None:
            self._recorder.device_changed(DeviceFound(at_ns, device))
        self._events += self._decoders.found(device, at_ns)

    def _take_own_kit(self, device: str) -> None:
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
        if self._recorder is not None:
            self._recorder.device_changed(DeviceLost(at_ns, device))
        self._events += self._decoders.lost(device, at_ns)

    def _sound(self, event: DeviceEvent) -> None:
        match event:
            case Hit():
                strike = Strike(event.piece, event.zone, event.articulation, event.openness)
                self._player.strike(strike, event.velocity)
            case Choke():
                self._player.choke(event.piece)
            case PedalMoved():
                self._player.pedal(event.openness)
            case _:
                pass

    # --- commands ----------------------------------------------------------------------------------------------------

    def handle(self, command: Command) -> None:
        """Obey the app; "now" is what `advance` was told last."""
        match command:
            case Play():
                self._player.play(CueRun(command.cues), self._now_ns + command.start_in_ns)
                if self._midi is not None:
                    self._midi.play(CueRun(command.cues))
            case Resume():
                self._zero_ns = command.zero_ns
                self._player.resume(CueRun(command.cues), command.zero_ns)
                if self._midi is not None:
                    self._midi.resume(CueRun(command.cues), command.zero_ns, self._now_ns)
            case Stop():
                self._zero_ns = None
                self._player.stop()
                if self._midi is not None:
                    self._midi.stop()
            case SetLevel() | SetPiece() | SetBacking() | SetMidiOut():
                self._set(command)
            case KeyHit():
                self._take_key(command)
            case Record():
                self._record(command.path)
            case Eavesdrop(on):
                self._eavesdrops = on
            case TakeKit(device):
                self._take_own_kit(device)
            case Quit():
                self.quitting = True

    def _set(self, command: Setting) -> None:
        match command:
            case SetLevel():
                self._player.set_level(command.bus, command.level, command.pan)
            case SetPiece():
                self._player.set_piece(command.piece, command.level, command.pan)
            case SetBacking():
                self._set_backing(command)
            case SetMidiOut():
                self._set_midi_out(command.port)

    def _set_midi_out(self, port: str | None) -> None:
        if self._midi is not None:
            self._midi.close()
        self._midi = self._midi_fault = None
        if port is None:
            return
        try:
            self._midi = MidiPlayer(self._open_midi_out(port))
        except StationError as fault:
            self.notify(f"the demonstration is not sent: {fault}")

    def _send_midi(self, now_ns: int) -> None:
        """Send what is due; a fault is told once."""
        if self._midi is None:
            return
        self._midi.advance(now_ns)
        if self._midi.fault is not self._midi_fault:
            self._midi_fault = self._midi.fault
            self.notify(f"the demonstration is no longer sent: {self._midi_fault}")

    def _set_backing(self, wish: SetBacking) -> None:
        track = wish.loaded
        if wish.track is not None and track is None:
            try:
                track = load(wish.track)
            except DeviceError as fault:
                self.notify(str(fault))
        rate_hz = self._player.rate_hz
        if track is not None and rate_hz not in (None, track.rate_hz):
            self.notify(f"the track was prepared for {track.rate_hz} Hz and the card plays {rate_hz}: choose it again")
        self._player.set_track(track, wish.at_ns)

    def _take_key(self, key: KeyHit) -> None:
        hit = Hit(
            at_ns=key.at_ns,
            piece=key.piece,
            zone=key.zone,
            velocity=key.velocity,
            articulation=key.articulation,
            openness=key.openness,
            device=KEYBOARD,
        )
        self._sound(hit)
        if self._recorder is not None:
            self._recorder.stroke(hit)
        self._events.append(hit)

    def _record(self, path: Path | None) -> None:
        self._events += self._decoders.flush()  # what was played before a capture begins or ends is told before it
        lacking = self._end_capture()
        if path is None:
            self._events.append(Recorded(None, lacking))
            return
        if lacking is not None:
            self.notify(lacking)
        try:
            sink = self._open_capture(path, self._now_ns)
        except StationError as fault:
            self._events.append(Recorded(path, str(fault)))
            return
        self._events.append(Recorded(path))
        self._recorder = Recorder(sink, self._decoders)
        for device in self._devices:
            self._recorder.add_device(device, self._now_ns)
        if self._zero_ns is not None and self._player.has_cues:  # one that has played out belongs to what was before
            self._recorder.zero(self._zero_ns)

    def _end_capture(self) -> str | None:
        """Close the capture; returns what it lacks."""
        if self._recorder is None:
            return None
        self._recorder.close(self._now_ns)
        fault, self._recorder, self._capture_fault = self._recorder.fault, None, None
        return fault

    # --- time --------------------------------------------------------------------------------------------------------

    def notify(self, text: str) -> None:
        """Tell the user something with the next `advance`."""
        self._events.append(Notice(text))

    def tell(self, event: EngineEvent) -> None:
        """Say `event` with the next `advance`."""
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
        for zero_ns in self._player.take_zeros_ns():
            self._zero_ns = zero_ns
            if self._midi is not None:
                self._midi.started(zero_ns)
            self._events.append(Started(zero_ns, self.output.name))
            if self._recorder is not None:
                self._recorder.zero(zero_ns)
        self._send_midi(now_ns)
        if self._next_status_ns is None:
            self._next_status_ns = now_ns + STATUS_EVERY_NS
        elif now_ns >= self._next_status_ns:
            self._next_status_ns = now_ns + STATUS_EVERY_NS
            self._tell_capture_fault()
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

    def _tell_capture_fault(self) -> None:
        fault = self._recorder.fault if self._recorder is not None else None
        if fault is not None and fault != self._capture_fault:
            self.notify(fault)
        self._capture_fault = fault

    def close(self) -> None:
        """Leave the MIDI output, and end the capture, so that its last hits are on the disk."""
        self._set_midi_out(None)
        self._events += self._decoders.flush()
        lacking = self._end_capture()
        if lacking is not None:
            self.notify(lacking)

    # --- sound -------------------------------------------------------------------------------------------------------

    def attach(self, mixer: Mixer | None) -> None:
        """Sound through `mixer` from now on, None for a card that has gone; only while nobody calls `render`."""
        self._player.attach(mixer)

    def render(self, frames: int, dac_ns: int) -> NDArray[np.float32]:
        """The next block of sound: float32 (frames, 2), whose first frame is heard at session time `dac_ns`."""
        return self._player.render(frames, dac_ns)
