"""Where the sound goes: a stream on a sound card through PortAudio (JACK, ALSA, CoreAudio, WASAPI), or nowhere.

The card's driver asks for a block whenever it needs one, in its own thread. The block's time is when its first frame
leaves the converter, mapped to the monotonic clock: PortAudio's `outputBufferDacTime` on the stream's own clock, read
together with the monotonic one so that a callback which came late does not count, then smoothed by `DacClock`. Where a
driver reports no time, the present plus the stream's latency stands in.

sounddevice loads the PortAudio library when it is imported; so it is imported when an output is asked for.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.core.units import NS_PER_S, ns_from_s
from station.sound.dac_clock import DacClock
from station.sound.drum_kit import Frames

Renderer = Callable[[int, int], Frames]
"""`render(frames, dac_ns)`: the next float32 (frames, 2), whose first frame is heard at monotonic `dac_ns`."""

SILENT_RATE_HZ = 48_000
MAX_LATENCY_S = 2.0
"""A reported time further ahead than this, or before the present by more than `MAX_PAST_S`, is no report at all."""
MAX_PAST_S = 0.1
LOAD_SMOOTHING = 0.02
"""Share of a new block in the running mean of the load."""

NO_PORTAUDIO = (
    "no sound: the PortAudio library is missing; on Debian and Ubuntu `apt install libportaudio2`, "
    "elsewhere `pip install --force-reinstall sounddevice`"
)


@dataclass(frozen=True, slots=True)
class OutputDevice:
    """A device that can play: its PortAudio number and name, the system behind it, and what it prefers."""

    index: int
    name: str
    host: str
    channels: int
    rate_hz: int
    is_default: bool


class Output(Protocol):
    """A place for sound: real or silent."""

    name: str
    rate_hz: int

    @property
    def latency_ms(self) -> float | None:
        """From the callback to the converter as the stream reports it; None when silent."""
        ...

    @property
    def underflows(self) -> int:
        """Blocks that came too late since the start."""
        ...

    @property
    def load(self) -> float:
        """Share of the block time that rendering takes, a running mean."""
        ...

    @property
    def fault(self) -> DeviceError | None:
        """Why the stream ended by itself (the device vanished, or rendering failed); None while it runs."""
        ...

    def start(self, render: Renderer) -> None:
        """Begin to ask `render` for blocks; raises `DeviceError`."""
        ...

    def pause(self) -> None:
        """Ask for no blocks until `resume`, with the device kept; raises `DeviceError`."""
        ...

    def resume(self) -> None:
        """Go on asking after `pause`; raises `DeviceError`."""
        ...

    def close(self) -> None:
        """Stop and give the device back; harmless when closed already."""
        ...


class SilentOutput:
    """No sound card: nothing is ever asked for, and the engine keeps time by the monotonic clock."""

    name = "silent"
    rate_hz = SILENT_RATE_HZ
    latency_ms: float | None = None
    underflows = 0
    load = 0.0
    fault: DeviceError | None = None

    def start(self, render: Renderer) -> None:
        """Do nothing: `render` is never called."""

    def pause(self) -> None:
        """Do nothing."""

    def resume(self) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""


def list_outputs() -> list[OutputDevice]:
    """Every device that can play, the system's default first; raises `DeviceError` where PortAudio is missing."""
    sd = _sounddevice()
    try:
        hosts: Sequence[dict[str, Any]] = sd.query_hostapis()
        devices: Sequence[dict[str, Any]] = sd.query_devices()
        default = sd.default.device[1]
    except sd.PortAudioError as fault:
        raise DeviceError(f"the sound devices cannot be listed: {fault}") from fault
    found = [
        OutputDevice(
            index=index,
            name=device["name"],
            host=hosts[device["hostapi"]]["name"],
            channels=device["max_output_channels"],
            rate_hz=round(device["default_samplerate"]),
            is_default=index == default,
        )
        for index, device in enumerate(devices)
        if device["max_output_channels"] > 0
    ]
    return sorted(found, key=lambda device: not device.is_default)


def choose_output(devices: Sequence[OutputDevice], part: str) -> OutputDevice:
    """The device whose "host: name" contains `part`, letter case aside; the first (the default) for an empty `part`.

    A device called exactly so comes before those that merely contain it. Raises `DeviceError` naming what there is.
    """
    if not devices:
        raise DeviceError("no sound: no output device was found; connect one, or start the sound server")
    wanted = part.casefold()
    exact = [device for device in devices if device.name.casefold() == wanted]
    near = [device for device in devices if wanted in f"{device.host}: {device.name}".casefold()]
    if not (exact or near):
        names = ", ".join(repr(device.name) for device in devices)
        raise DeviceError(f"no sound output is called {part!r}; there are {names}")
    return (exact or near)[0]


def open_output(part: str = "", block_frames: int = 0, rate_hz: int = SILENT_RATE_HZ) -> "CardOutput":
    """Open the output whose name contains `part` (empty: the default), not yet playing.

    `block_frames` 0 leaves the block's size to the driver. A device that refuses `rate_hz` is opened at the rate it
    prefers: read `rate_hz` of the result before making sounds for it. Raises `DeviceError` that says what to do.
    """
    return CardOutput(choose_output(list_outputs(), part), block_frames, rate_hz)


class CardOutput:
    """A stream on a real device; `start` makes it play."""

    def __init__(self, device: OutputDevice, block_frames: int, rate_hz: int) -> None:
        sd = _sounddevice()
        self.name = device.name
        self.underflows = 0
        self.load = 0.0
        self.fault: DeviceError | None = None
        self._abort: type[Exception] = sd.CallbackAbort
        self._error: type[Exception] = sd.PortAudioError
        self._render: Renderer | None = None
        self._stopping = False
        self._channels = min(2, device.channels)
        settings = {"device": device.index, "channels": self._channels, "dtype": "float32"}
        self.rate_hz = rate_hz
        try:
            try:
                sd.check_output_settings(samplerate=rate_hz, **settings)
            except sd.PortAudioError:
                self.rate_hz = device.rate_hz
            self._stream = sd.OutputStream(
                samplerate=self.rate_hz,
                blocksize=block_frames,
                latency="low",
                callback=self._callback,
                finished_callback=self._finished,
                **settings,
            )
        except sd.PortAudioError as fault:
            raise DeviceError(f"sound output {device.name!r} cannot be opened: {fault}; choose another") from fault
        self._clock = DacClock(self.rate_hz)

    @property
    def latency_ms(self) -> float | None:
        """From the callback to the converter as the stream reports it."""
        return 1000.0 * float(self._stream.latency)

    def start(self, render: Renderer) -> None:
        """Begin to ask `render` for blocks, in the driver's thread; raises `DeviceError`."""
        self._render = render
        self.resume()

    def pause(self) -> None:
        """Ask for no blocks until `resume`: nothing of the driver's then waits for the interpreter lock."""
        self._stopping = True
        try:
            self._stream.stop()
        except self._error as fault:
            raise DeviceError(f"sound output {self.name!r} does not pause: {fault}") from fault

    def resume(self) -> None:
        """Go on asking after `pause`."""
        self._stopping = False
        self._clock.resync()
        try:
            self._stream.start()
        except self._error as fault:
            raise DeviceError(f"sound output {self.name!r} does not start: {fault}; choose another") from fault

    def close(self) -> None:
        """Stop and give the device back."""
        self._stopping = True
        self._stream.close(ignore_errors=True)

    def _finished(self) -> None:
        if not self._stopping and self.fault is None:
            self.fault = DeviceError(f"sound output {self.name!r} stopped: it was unplugged, or its server ended")

    def _callback(self, out: NDArray[np.float32], frames: int, times: "DriverTimes", status: "DriverStatus") -> None:
        begun_ns = time.monotonic_ns()
        if status.output_underflow:
            self.underflows += 1
            self._clock.resync()
        reported_ns = reported_dac_ns(begun_ns, self._stream.time, times, self._stream.latency)
        try:
            assert self._render is not None, "the stream was started with a renderer"
            fit_channels(self._render(frames, self._clock.block(frames, reported_ns)), out)
        except Exception as fault:
            out.fill(0.0)
            self.fault = DeviceError(f"the sound stopped: {fault!r}")
            raise self._abort from fault
        used = (time.monotonic_ns() - begun_ns) * self.rate_hz / (NS_PER_S * frames)
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
    """Write `stereo` (n, 2) to `out` (n, 1 or 2): one channel gets the mean of both."""
    if out.shape[1] == 1:
        np.mean(stereo, axis=1, keepdims=True, out=out)
    else:
        out[:] = stereo


def _sounddevice() -> ModuleType:
    try:
        import sounddevice  # noqa: PLC0415 - loads PortAudio, which may be missing
    except OSError as fault:
        raise DeviceError(NO_PORTAUDIO) from fault
    module: ModuleType = sounddevice
    return module
