"""Latency measured on real devices: plays, records and listens, and hands what came to `station.sound.calibration`.

Nothing is stored here. The kit is opened before the sound and closed after it, and where it goes meanwhile the streams
are closed first, for whatever changes JACK's graph waits for every sound callback in this process
(`station.devices.midi.midi_clients`). Every function raises `DeviceError` where a device fails or nothing was heard.
"""

import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.events import DeviceEvent, Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.devices.decoders import DecoderBank
from station.devices.device_ports import DeviceRequest, no_device, watch_devices
from station.devices.mapping.device_file import own_kit
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.presets import preset_for
from station.devices.port_watch import PortWatch
from station.engine.engine_main import SWITCH_INTERVAL_S
from station.sound.buses import ClickVoice
from station.sound.calibration.chirp import train
from station.sound.calibration.latency_estimate import LatencyEstimate
from station.sound.calibration.loopback import MOST_S, LoopbackRound, loopback
from station.sound.calibration.probe_player import ProbePlayer
from station.sound.calibration.stream_report import StreamReport, report_of
from station.sound.calibration.strikes import PAD_STROKES, Strikes, strikes
from station.sound.calibration.taps import Taps, taps
from station.sound.click_sounds import click_sounds
from station.sound.output.card_input import CardInput, open_input
from station.sound.output.card_output import CardOutput
from station.sound.output.sound_output import open_output

POLL_S = 0.0005
ROUNDS = 3
"""So often the devices are opened anew for a loopback, for each opening may set them otherwise."""
REPORT_S = 10.0
"""How long a stream is listened to for its drift: ± 20 parts in a million on a quiet machine."""
KIT_WITHIN_S = 3.0
"""A kit that is plugged in is found within one (`station.devices.port_watch`)."""
FIRST_STROKE_WITHIN_S = 30.0
PAUSE_ENDS_S = 5.0
"""So long a pause between strokes ends the measurement (our choice)."""
LONGEST_S = 120.0
"""Memory's bound on a recording: 46 MB of stereo (our choice)."""
CLICKS = 36
CLICK_S = 0.6
"""100 beats a minute: easy to follow, and 450 ms of delay are told from an early tap (our choice)."""
ACCENT_EVERY = 4
AFTER_S = 0.3

Notify = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class SoundRequest:
    """Part of the name of the output and of the input to use, empty for the default; block and rate as in settings."""

    output: str = ""
    input: str = ""
    block_frames: int = 0
    rate_hz: int = 48_000


@dataclass(frozen=True, slots=True)
class Devices:
    """The names of the devices that took part; None of what was not needed."""

    kit: str | None = None
    output: str | None = None
    input: str | None = None


# --- the output alone ------------------------------------------------------------------------------------------------


def stream_report(request: SoundRequest, notify: Notify, seconds: float = REPORT_S) -> tuple[Devices, StreamReport]:
    """What the output's stream says of itself, and how its clock runs."""
    with ExitStack() as streams:
        output = _output(request, streams)
        notify(f"listening to the clock of {output.name} for {seconds:g} seconds")
        player = ProbePlayer(np.zeros(round(seconds * output.rate_hz), np.float32), output.rate_hz)
        with _prompt():
            output.start(player)
            _until(lambda: player.is_over, seconds + 10.0, output)
        found = report_of(output.latency_ms, player.timeline, output.underflows)
    return Devices(output=output.name), found


def loopback_rounds(request: SoundRequest, notify: Notify, rounds: int = ROUNDS) -> tuple[Devices, LatencyEstimate]:
    """Output latency by chirps that are played and recorded, with the devices opened anew for each round."""
    heard = []
    devices = Devices()
    for number in range(rounds):
        with ExitStack() as streams:
            output = _output(request, streams)
            sound_in = _input(request, output.rate_hz, streams)
            notify(f"chirps, {number + 1} of {rounds}")
            devices = Devices(output=output.name, input=sound_in.name)
            heard.append(_one_round(output, sound_in))
    return devices, loopback(heard)


def _one_round(output: CardOutput, sound_in: CardInput) -> LoopbackRound:
    sound, starts = train(output.rate_hz)
    player = ProbePlayer(sound, output.rate_hz)
    with _prompt():
        sound_in.start()
        output.start(player)
        _until(lambda: player.is_over, 10.0, output)
        _until(lambda: False, MOST_S + AFTER_S, output, gives_up=False)
    return LoopbackRound(player.heard_ns(starts), sound_in.recording())


# --- with the kit ----------------------------------------------------------------------------------------------------


def struck(
    request: SoundRequest, kit: DeviceRequest, notify: Notify, distance_m: float = 0.0
) -> tuple[Devices, Strikes]:
    """Input latency by pads that are struck before a microphone; ends by itself after a pause."""
    with _listening(kit, notify) as listener:
        sound_in = _input(request, request.rate_hz, listener.streams)
        with _prompt():
            sound_in.start()
            notify("strike each pad ten times, about once a second and not too evenly; a pause of five seconds ends it")
            hits = listener.listen(partial(_has_paused, monotonic_ns()), None)
        recording = sound_in.recording()
    stamps = np.array([hit.at_ns for hit in hits], np.int64)
    devices = Devices(kit=listener.device, input=sound_in.name)
    return devices, strikes(stamps, [hit.piece for hit in hits], recording, distance_m)


def _has_paused(begun_ns: int, hits: list[Hit]) -> bool:
    now_ns = monotonic_ns()
    since_s = (now_ns - (hits[-1].at_ns if hits else begun_ns)) / NS_PER_S
    if (now_ns - begun_ns) / NS_PER_S > LONGEST_S:
        return True
    return since_s > (PAUSE_ENDS_S if len(hits) >= PAD_STROKES else FIRST_STROKE_WITHIN_S)


def tapped(
    request: SoundRequest, kit: DeviceRequest, notify: Notify, clicks: int = CLICKS
) -> tuple[Devices, Piece, Taps]:
    """Equipment and habit together by strokes along with a click; with the piece that was struck most often."""
    with _listening(kit, notify) as listener:
        output = _output(request, listener.streams)
        sound, starts = _clicks(output.rate_hz, clicks)
        player = ProbePlayer(sound, output.rate_hz)
        with _prompt():
            notify(f"strike one pad with each of {clicks} clicks; play as you always play")
            output.start(player)
            hits = listener.listen(lambda _: player.is_over, output)
        clicks_ns = player.heard_ns(starts)
    struck_most = Counter(hit.piece for hit in hits).most_common(1)
    piece = struck_most[0][0] if struck_most else Piece.SNARE
    stamps = np.array([hit.at_ns for hit in hits if hit.piece == piece], np.int64)
    return Devices(kit=listener.device, output=output.name), piece, taps(stamps, clicks_ns)


def _clicks(rate_hz: int, count: int) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """The clicks to tap along with, and the frame of each."""
    sounds = click_sounds(rate_hz)
    starts = np.round(np.arange(count) * CLICK_S * rate_hz).astype(np.int64)
    track = np.zeros(starts[-1] + round(CLICK_S * rate_hz), np.float32)
    for number, start in enumerate(starts):
        click = sounds[ClickVoice.BEAT if number % ACCENT_EVERY else ClickVoice.ACCENT].mean(axis=1)
        track[start : start + len(click)] += click
    return track, starts


class _KitListener:
    """The kit that is listened to, and the streams that are closed before anything of the kit's is."""

    def __init__(self, watch: PortWatch, streams: ExitStack) -> None:
        self.streams = streams
        self.device = ""
        self._watch = watch
        self._decoders = DecoderBank(_understood)

    def find(self) -> None:
        """Wait for the kit."""
        give_up_ns = monotonic_ns() + round(KIT_WITHIN_S * NS_PER_S)
        while not self.device:
            findings = self._watch.poll(monotonic_ns())
            if findings.found:
                self.device = findings.device
            elif findings.fault or monotonic_ns() > give_up_ns:
                raise DeviceError(findings.fault or no_device((DeviceRequest(self._watch.wanted),)))
            time.sleep(POLL_S)

    def listen(self, is_over: Callable[[list[Hit]], bool], output: CardOutput | None) -> list[Hit]:
        """The strokes until `is_over` of those that came so far."""
        hits: list[Hit] = []
        while not is_over(hits):
            findings = self._watch.poll(monotonic_ns())
            if findings.lost:
                raise DeviceError(f"{self.device} went away while it was measured")
            if output is not None and output.fault is not None:
                raise output.fault
            for packet in findings.packets:
                hits += _hits(self._decoders.feed(self.device, packet.data, packet.at_ns).certain)
            hits += _hits(self._decoders.settle(monotonic_ns()))
            time.sleep(POLL_S)
        return hits + _hits(self._decoders.flush())


def _hits(events: list[DeviceEvent]) -> list[Hit]:
    return [event for event in events if isinstance(event, Hit)]


def _understood(device: str) -> DeviceMap:
    return own_kit(device) or preset_for(device)


class _Streams:
    """The sound that is measured, as the kit's driver sees it: streams that are closed before a port is opened."""

    def __init__(self, streams: ExitStack) -> None:
        self._streams = streams

    @contextmanager
    def paused(self) -> Iterator[None]:
        """Close them; whoever measures opens the next ones."""
        self._streams.close()
        yield

    def server_lives(self) -> bool | None:
        """A stream whose server ends says so itself, and ends the measurement."""
        return True


@contextmanager
def _listening(kit: DeviceRequest, notify: Notify) -> Iterator[_KitListener]:
    """The kit that is asked for, opened; streams that are put onto its stack are closed before it."""
    with ExitStack() as streams:
        watches = watch_devices((kit,), sound=_Streams(streams))
        if not watches.kits:
            raise DeviceError(no_device((kit,)))
        watch = watches.kits[0]
        try:
            listener = _KitListener(watch, streams)
            notify(f"looking for {f'a kit called {kit.part!r}' if kit.part else 'a kit'}")
            listener.find()
            notify(f"{listener.device} is here")
            yield listener
        finally:
            streams.close()
            watches.close()


# --- streams ---------------------------------------------------------------------------------------------------------


def _output(request: SoundRequest, streams: ExitStack) -> CardOutput:
    output = open_output(request.output, request.block_frames, request.rate_hz)
    streams.callback(output.close)
    return output


def _input(request: SoundRequest, rate_hz: int, streams: ExitStack) -> CardInput:
    sound_in = open_input(request.input, request.block_frames, rate_hz)
    streams.callback(sound_in.close)
    return sound_in


def _until(is_over: Callable[[], bool], within_s: float, output: CardOutput, gives_up: bool = True) -> None:
    """Wait; raises `DeviceError` where the output stops, or with `gives_up` where the time runs out."""
    end_ns = monotonic_ns() + round(within_s * NS_PER_S)
    while not is_over():
        if output.fault is not None:
            raise output.fault
        if monotonic_ns() > end_ns:
            if gives_up:
                raise DeviceError(f"sound output {output.name!r} asks for no sound")
            return
        time.sleep(10 * POLL_S)


@contextmanager
def _prompt() -> Iterator[None]:
    """Sound callbacks get the interpreter lock as soon as in the engine."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_INTERVAL_S)
    try:
        yield
    finally:
        sys.setswitchinterval(before)
