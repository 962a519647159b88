"""A stream on a sound card, and when each of its blocks is heard.

The driver asks for a block whenever it needs one, in its own thread. The block's time is when its first frame leaves
the converter, mapped to the monotonic clock: PortAudio's `outputBufferDacTime` on the stream's own clock, read together
with the monotonic one so that a callback which came late does not count, then smoothed by `DacClock`. Where a driver
reports no time, the present plus the stream's latency stands in.
"""

from collections.abc import Callable
from contextlib import suppress
from types import ModuleType
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.units import NS_PER_S, ns_from_s
from station.sound.drum_kit import Frames
from station.sound.output.card_stream import MAX_LATENCY_S, MAX_PAST_S, CardStream, SoundDevice
from station.sound.output.fade_gate import Gate

Renderer = Callable[[int, int], Frames]
"""`render(frames, dac_ns)`: the next float32 (frames, 2), whose first frame is heard at monotonic `dac_ns`."""

LOAD_SMOOTHING = 0.02
"""Share of a new block in the running mean of the load."""
JACK = "JACK"
"""In the name of a host whose streams cannot be closed without their server: PortAudio would wait for it for ten
minutes, or end the process by what it asserts (`pa_jack.c`, `CleanUpStream`)."""
SHUT_WITHIN_S = 0.4
"""A stream that fades no sooner has stopped asking (our choice: twice the longest block)."""


class CardOutput(CardStream):
    """A stream on a real device, one user of PortAudio; `start` makes it play."""

    def __init__(self, sd: ModuleType, device: SoundDevice, block_frames: int, rate_hz: int) -> None:
        super().__init__(sd, device, block_frames, rate_hz, "output")
        self.host = device.host
        self.underflows = 0
        self.load = 0.0
        self._fault = ""
        self._has_server = True
        self._abort: type[Exception] = sd.CallbackAbort
        self._render: Renderer | None = None
        self._is_asking = False
        self._gate = Gate(self.rate_hz)

    @property
    def fault(self) -> DeviceError | None:
        """Why the stream ended by itself; None while it runs, or was stopped by us."""
        if not self._fault and self._is_asking and not self._stream.active:
            self._fault = f"{self._title} stopped: it was unplugged, or its server ended"
            self._has_server = JACK not in self.host
        return DeviceError(self._fault) if self._fault else None  # one that is raised would hold us by its traceback

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
            raise DeviceError(f"{self._title} does not pause: {fault}") from fault

    def resume(self) -> None:
        """Go on asking after `pause`; raises `DeviceError`."""
        self._clock.resync()
        self._gate.open()
        self._begin()
        self._is_asking = True

    def close(self) -> None:
        """Stop and give the device back; harmless when closed already."""
        if not self._is_open:
            return
        self._fade_out()
        self._is_asking = False
        self._give_back(self._has_server)

    def _fade_out(self) -> None:
        """Let what sounds fade, so that the end of the stream is no click."""
        if self._is_asking and self.fault is None:
            self._gate.shut()
            self._gate.wait_until_shut(SHUT_WITHIN_S)

    def _end(self) -> None:
        if not self._fault:
            with suppress(self._error):
                self._stream.stop()  # closing alone would throw away what was faded and not yet played
        super()._end()

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
            self._fault = f"the sound stopped: {fault!r}"
            raise self._abort from fault
        used = (monotonic_ns() - begun_ns) * self.rate_hz / (NS_PER_S * frames)
        self.load += LOAD_SMOOTHING * (used - self.load)


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
