"""What a stream on a sound card is, whichever way it goes: how it is opened and begun, and how it is given back."""

from dataclasses import dataclass
from threading import Thread
from types import ModuleType
from typing import Any, Literal

from station.core.errors import DeviceError
from station.core.join_timeout import ends_within
from station.sound.output.dac_clock import DacClock
from station.sound.output.portaudio import PORTAUDIO

Direction = Literal["input", "output"]

MAX_LATENCY_S = 2.0
"""A driver's report of a block further from the present than this, or `MAX_PAST_S` on its wrong side, is none."""
MAX_PAST_S = 0.1
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


class CardStream:
    """A stream on a real device, one user of PortAudio, with a clock for its blocks; base of both directions.

    A subclass has `_callback`, which the driver calls for every block in its own thread. Raises `DeviceError`.
    """

    def __init__(
        self, sd: ModuleType, device: SoundDevice, block_frames: int, rate_hz: int, direction: Direction
    ) -> None:
        self.name = device.name
        self._title = f"sound {direction} {device.name!r}"
        self._error: type[Exception] = sd.PortAudioError
        self._is_open = True
        channels, self.rate_hz = accepted_settings(sd, device, rate_hz, direction)
        try:
            self._stream = (sd.OutputStream if direction == "output" else sd.InputStream)(
                device=device.index,
                channels=channels,
                dtype="float32",
                samplerate=self.rate_hz,
                blocksize=block_frames,
                latency="low",
                callback=self._callback,
            )
        except sd.PortAudioError as fault:
            raise DeviceError(f"{self._title} cannot be opened: {fault}; choose another") from fault
        self._clock = DacClock(self.rate_hz)
        self._latency_s = float(self._stream.latency)

    @property
    def latency_ms(self) -> float:
        """Between the callback and the converter as the stream reports it."""
        return 1000.0 * self._latency_s

    def _callback(self, block: Any, frames: int, times: Any, status: Any) -> None:  # noqa: ANN401 - each its own
        """Give or take a block."""
        raise NotImplementedError

    def _begin(self) -> None:
        try:
            self._stream.start()
        except self._error as fault:
            raise DeviceError(f"{self._title} does not start: {fault}; choose another") from fault

    def _end(self) -> None:
        """Close the stream; it and the callback that it made for the driver no longer hold each other, nor us."""
        self._stream.close()
        vars(self._stream).clear()

    def _give_back(self, with_its_server: bool = True) -> None:
        """Close the stream and leave PortAudio; a driver that hangs, or has no server any more, is left as it is."""
        self._is_open = False
        if not with_its_server:
            PORTAUDIO.abandon()
            PORTAUDIO.release()
            return
        closing = Thread(target=self._end, name=f"close {self._title}", daemon=True)
        closing.start()
        if not ends_within(closing, CLOSE_WITHIN_S):
            PORTAUDIO.abandon()
        PORTAUDIO.release()


def accepted_settings(sd: ModuleType, device: SoundDevice, rate_hz: int, direction: Direction) -> tuple[int, int]:
    """Channels and rate to open `device` with: those asked for, else the nearest that it takes.

    Two channels are enough; a device that insists on all of its own gets them. The device's own rate stands in for one
    that it refuses. Where it takes nothing the request is returned, and opening it tells why.
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
