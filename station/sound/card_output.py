"""A stream on a sound card, and when each of its blocks is heard.

The driver asks for a block whenever it needs one, in its own thread. The block's time is when its first frame leaves
the converter, mapped to the monotonic clock: PortAudio's `outputBufferDacTime` on the stream's own clock, read together
with the monotonic one so that a callback which came late does not count, then smoothed by `DacClock`. Where a driver
reports no time, the present plus the stream's latency stands in.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from threading import Thread
from types import ModuleType
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.units import NS_PER_S, ns_from_s
from station.sound.dac_clock import DacClock
from station.sound.drum_kit import Frames
from station.sound.gate import Gate
from station.sound.portaudio import PORTAUDIO

Renderer = Callable[[int, int], Frames]
"""`render(frames, dac_ns)`: the next float32 (frames, 2), whose first frame is heard at monotonic `dac_ns`."""

MAX_LATENCY_S = 2.0
"""A reported time further ahead than this, or before the present by more than `MAX_PAST_S`, is no report at all."""
MAX_PAST_S = 0.1
LOAD_SMOOTHING = 0.02
"""Share of a new block in the running mean of the load."""
SHUT_WITHIN_S = 0.4
"""A stream that fades no sooner has stopped asking (our choice: twice the longest block)."""
CLOSE_WITHIN_S = 1.0
"""A driver that takes longer to close its stream has lost its server and would wait for minutes (our choice)."""


@dataclass(frozen=True, slots=True)
class SoundDevice:
    """A device that can play or record: its PortAudio number and name, the system behind it, what it prefers."""

    index: int
    name: str
    host: str
    channels: int
    rate_hz: int
    is_default: bool


class CardOutput:
    """A stream on a real device, one user of PortAudio; `start` makes it play."""

    def __init__(self, sd: ModuleType, device: SoundDevice, block_frames: int, rate_hz: int) -> None:
        self.name = device.name
        self.host = device.host
        self.underflows = 0
        self.load = 0.0
        self._fault: DeviceError | None = None
        self._abort: type[Exception] = sd.CallbackAbort
        self._error: type[Exception] = sd.PortAudioError
        self._render: Renderer | None = None
        self._is_asking = False
        self._is_open = True
        channels, self.rate_hz = accepted_settings(sd, device, rate_hz)
        try:
            self._stream = sd.OutputStream(
                device=device.index,
                channels=channels,
                dtype="float32",
                samplerate=self.rate_hz,
                blocksize=block_frames,
                latency="low",
                callback=self._callback,
            )
        except sd.PortAudioError as fault:
            raise DeviceError(f"sound output {device.name!r} cannot be opened: {fault}; choose another") from fault
        self._clock = DacClock(self.rate_hz)
        self._gate = Gate(self.rate_hz)
        self._latency_s = float(self._stream.latency)

    @property
    def latency_ms(self) -> float | None:
        """From the callback to the converter as the stream reports it."""
        return 1000.0 * self._latency_s

    @property
    def fault(self) -> DeviceError | None:
        """Why the stream ended by itself; None while it runs, or was stopped by us."""
        if self._fault is None and self._is_asking and not self._stream.active:
            self._fault = DeviceError(f"sound output {self.name!r} stopped: it was unplugged, or its server ended")
        return self._fault

    def start(self, render: Renderer) -> None:
        """Begin to ask `render` for blocks, in the driver's thread; raises `DeviceError`."""
        self._render = render
        self.resume()

    def pause(self) -> None:
        """Ask for no blocks until `resume`: nothing of the driver's then waits for the interpreter lock."""
        if self.fault is not None:  # to stop a stream whose server is gone would take minutes
            raise self.fault
        self._fade_out()
        self._is_asking = False
        try:
            self._stream.stop()
        except self._error as fault:
            raise DeviceError(f"sound output {self.name!r} does not pause: {fault}") from fault

    def resume(self) -> None:
        """Go on asking after `pause`; raises `DeviceError`."""
        self._clock.resync()
        self._gate.open()
        try:
            self._stream.start()
        except self._error as fault:
            raise DeviceError(f"sound output {self.name!r} does not start: {fault}; choose another") from fault
        self._is_asking = True

    def close(self) -> None:
        """Stop and give the device back; harmless when closed already."""
        if not self._is_open:
            return
        self._fade_out()
        self._is_open = self._is_asking = False
        closing = Thread(target=self._end, name="close sound output", daemon=True)
        closing.start()
        closing.join(CLOSE_WITHIN_S)
        if closing.is_alive():
            PORTAUDIO.abandon()
        PORTAUDIO.release()

    def _fade_out(self) -> None:
        """Let what sounds fade, so that the end of the stream is no click."""
        if self._is_asking and self.fault is None:
            self._gate.shut()
            self._gate.wait_until_shut(SHUT_WITHIN_S)

    def _end(self) -> None:
        if self._fault is None:
            with suppress(self._error):
                self._stream.stop()  # closing alone would throw away what was faded and not yet played
        self._stream.close()

    def _callback(self, out: NDArray[np.float32], frames: int, times: "DriverTimes", status: "DriverStatus") -> None:
        begun_ns = monotonic_ns()
        if status.output_underflow:
            self.underflows += 1
            self._clock.resync()
        reported_ns = reported_dac_ns(begun_ns, self._stream.time, times, self._latency_s)
        try:
            assert self._render is not None, "the stream was started with a renderer"
            fit_channels(self._gate.through(self._render(frames, self._clock.block(frames, reported_ns))), out)
        except Exception as fault:
            out.fill(0.0)
            self._fault = DeviceError(f"the sound stopped: {fault!r}")
            raise self._abort from fault
        used = (monotonic_ns() - begun_ns) * self.rate_hz / (NS_PER_S * frames)
        self.load += LOAD_SMOOTHING * (used - self.load)


def accepted_settings(
    sd: ModuleType, device: SoundDevice, rate_hz: int, direction: Literal["input", "output"] = "output"
) -> tuple[int, int]:
    """Channels and rate to open `device` with: those wished for, else the nearest that it takes.

    Two channels are enough; a device that insists on all of its own gets them. The device's own rate stands in for one
    that it refuses. Where it takes nothing the wish is returned, and opening it tells why.
    """
    stereo = min(2, device.channels)
    check = sd.check_output_settings if direction == "output" else sd.check_input_settings
    choices = [(channels, rate) for channels in (stereo, device.channels) for rate in (rate_hz, device.rate_hz)]
    for channels, rate in choices:
        try:
            check(device=device.index, channels=channels, dtype="float32", samplerate=rate)
        except sd.PortAudioError:
            continue
        return channels, rate
    return stereo, device.rate_hz


class DriverTimes(Protocol):
    """What PortAudio tells a callback, in seconds of the stream's clock; drivers that cannot tell report zero."""

    currentTime: float  # noqa: N815 - PortAudio's name
    outputBufferDacTime: float  # noqa: N815 - PortAudio's name


class DriverStatus(Protocol):
    """What PortAudio says went wrong before a callback."""

    output_underflow: bool


def reported_dac_ns(now_ns: int, stream_s: float, times: DriverTimes, latency_s: float) -> int:
    """When the block is heard by the driver's report, in monotonic ns.

    `now_ns` and `stream_s` are the monotonic and the stream's clock at one moment. Falls back on the callback's own
    `currentTime` where the stream's clock cannot be read, and on `latency_s` where the report makes no sense.
    """
    for clock_s in (stream_s, times.currentTime):
        ahead_s = times.outputBufferDacTime - clock_s
        if clock_s and times.outputBufferDacTime and -MAX_PAST_S < ahead_s < MAX_LATENCY_S:
            return now_ns + ns_from_s(ahead_s)
    return now_ns + ns_from_s(latency_s)


def fit_channels(stereo: Frames, out: NDArray[np.float32]) -> None:
    """Write `stereo` (n, 2) to `out` (n, channels): one gets the mean of both, of many the first two get them."""
    if out.shape[1] == 1:
        np.mean(stereo, axis=1, keepdims=True, out=out)
    else:
        out[:, :2] = stereo
        out[:, 2:] = 0.0
