"""Where the sound goes: a sound card through PortAudio (JACK, ALSA, CoreAudio, WASAPI)."""

from collections.abc import Sequence
from typing import Any, Literal, Protocol

from station.core.errors import DeviceError
from station.core.settings import LEAST_BLOCK_FRAMES
from station.sound.output.card_output import CardOutput, Renderer
from station.sound.output.card_stream import SoundDevice
from station.sound.output.portaudio import PORTAUDIO

USUAL_RATE_HZ = 48_000
BLOCK_FRAMES = range(LEAST_BLOCK_FRAMES, 8_192 + 1)
"""The sizes of a block that may be asked for: less is beyond any driver here, more is 170 ms late (our choice)."""


class Output(Protocol):
    """A place for sound."""

    name: str
    host: str
    rate_hz: int

    @property
    def latency_ms(self) -> float | None:
        """From the callback to the converter as the stream reports it; None where it does not."""
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


def list_outputs() -> list[SoundDevice]:
    """Every device that can play, the system's default first; raises `DeviceError` where PortAudio is missing."""
    return list_devices("output")


def list_devices(direction: Literal["input", "output"]) -> list[SoundDevice]:
    """Every device that can record, or play, the system's default first; raises `DeviceError`."""
    with PORTAUDIO.running() as sd:
        try:
            hosts: Sequence[dict[str, Any]] = sd.query_hostapis()
            devices: Sequence[dict[str, Any]] = sd.query_devices()
            default = sd.default.device[direction == "output"]
        except sd.PortAudioError as fault:
            raise DeviceError(f"the sound devices cannot be listed: {fault}") from fault
    channels = f"max_{direction}_channels"
    found = [
        SoundDevice(
            index=index,
            name=device["name"],
            host=hosts[device["hostapi"]]["name"],
            channels=device[channels],
            rate_hz=round(device["default_samplerate"]),
            is_default=index == default,
        )
        for index, device in enumerate(devices)
        if device[channels] > 0
    ]
    return sorted(found, key=lambda device: not device.is_default)


def choose_output(devices: Sequence[SoundDevice], part: str) -> SoundDevice:
    """The device whose "host: name" contains `part`, letter case aside; the first (the default) for an empty `part`.

    A device called exactly so comes before those that merely contain it. Raises `DeviceError` naming what there is.
    """
    return choose_device(devices, part, "output")


def choose_device(devices: Sequence[SoundDevice], part: str, direction: Literal["input", "output"]) -> SoundDevice:
    """The same for either direction."""
    if not devices:
        raise DeviceError(f"no sound: no {direction} device was found; connect one, or start the sound server")
    wanted = part.casefold()
    exact = [device for device in devices if device.name.casefold() == wanted]
    near = [device for device in devices if wanted in f"{device.host}: {device.name}".casefold()]
    if not (exact or near):
        names = ", ".join(repr(device.name) for device in devices)
        raise DeviceError(f"no sound {direction} is called {part!r}; there are {names}")
    return (exact or near)[0]


def open_output(part: str = "", block_frames: int = 0, rate_hz: int = USUAL_RATE_HZ) -> CardOutput:
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
