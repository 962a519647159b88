"""Where the sound goes: a sound card through PortAudio (JACK, ALSA, CoreAudio, WASAPI), or nowhere."""

from collections.abc import Sequence
from typing import Any, Protocol

from station.core.errors import DeviceError
from station.sound.card_output import CardOutput, OutputDevice, Renderer
from station.sound.portaudio import PORTAUDIO

SILENT_RATE_HZ = 48_000
BLOCK_FRAMES = range(16, 8_192 + 1)
"""The sizes of a block that may be asked for: less is beyond any driver here, more is 170 ms late (our choice)."""


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
    with PORTAUDIO.running() as sd:
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


def open_output(part: str = "", block_frames: int = 0, rate_hz: int = SILENT_RATE_HZ) -> CardOutput:
    """Open the output whose name contains `part` (empty: the default), not yet playing.

    `block_frames` 0 leaves the block's size to the driver. A device that refuses `rate_hz` is opened at the rate it
    prefers: read `rate_hz` of the result before making sounds for it. Raises `DeviceError` that says what to do.
    """
    if block_frames and block_frames not in BLOCK_FRAMES:
        sizes = f"{BLOCK_FRAMES[0]} to {BLOCK_FRAMES[-1]}"
        raise DeviceError(
            f"no sound in blocks of {block_frames} frames: ask for {sizes}, or for 0, the driver's choice"
        )
    sd = PORTAUDIO.acquire()
    try:
        return CardOutput(sd, choose_output(list_outputs(), part), block_frames, rate_hz)
    except BaseException:
        PORTAUDIO.release()
        raise
