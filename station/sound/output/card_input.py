"""A recording stream on a sound card, and when each of its frames was heard; for measuring latency alone.

As in `card_output`: PortAudio's `inputBufferAdcTime` on the stream's own clock, read together with the monotonic one
and smoothed by the same loop. Where a driver reports no time, the present less the stream's latency stands in. Blocks
are kept as they come, the callback does nothing else.
"""

from dataclasses import dataclass
from types import ModuleType
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.units import ns_from_s
from station.sound.calibration.timeline import TimedRecording, Timeline
from station.sound.output.card_stream import MAX_LATENCY_S, MAX_PAST_S, CardStream, SoundDevice
from station.sound.output.portaudio import PORTAUDIO
from station.sound.output.sound_output import USUAL_RATE_HZ, choose_device, list_devices


class InputTimes(Protocol):
    """What PortAudio tells a recording callback, in seconds of the stream's clock."""

    currentTime: float  # noqa: N815 - PortAudio's name
    inputBufferAdcTime: float  # noqa: N815 - PortAudio's name


class InputStatus(Protocol):
    """What PortAudio says went wrong before a callback."""

    input_overflow: bool


@dataclass(frozen=True, slots=True)
class _Block:
    first_ns: int
    sound: NDArray[np.float32]


class CardInput(CardStream):
    """A stream from a real device, one user of PortAudio; it records from `start` to `close`."""

    def __init__(self, sd: ModuleType, device: SoundDevice, block_frames: int, rate_hz: int) -> None:
        super().__init__(sd, device, block_frames, rate_hz, "input")
        self.lost_blocks = 0
        self._blocks: list[_Block] = []

    def start(self) -> None:
        """Begin to record; raises `DeviceError`."""
        self._begin()

    def recording(self) -> TimedRecording:
        """All that was recorded so far; raises `DeviceError` where nothing came."""
        blocks = list(self._blocks)
        if not blocks:
            raise DeviceError(f"{self._title} brings nothing: is it the right one, may it be used?")
        lengths = np.array([len(block.sound) for block in blocks])
        first = np.concatenate([[0], np.cumsum(lengths)[:-1]]).astype(np.int64)
        times = np.array([block.first_ns for block in blocks], np.int64)
        sound = np.concatenate([block.sound for block in blocks])
        return TimedRecording(sound, Timeline(first, times, self.rate_hz), self.lost_blocks)

    def close(self) -> None:
        """Stop and give the device back; harmless when closed already."""
        if self._is_open:
            self._give_back()

    def _callback(self, heard: NDArray[np.float32], frames: int, times: InputTimes, status: InputStatus) -> None:
        begun_ns = monotonic_ns()
        if status.input_overflow:
            self.lost_blocks += 1
            self._clock.resync()
        reported_ns = reported_adc_ns(begun_ns, self._stream.time, times, self._latency_s)
        self._blocks.append(_Block(self._clock.block(frames, reported_ns), heard.copy()))


def reported_adc_ns(now_ns: int, stream_s: float, times: InputTimes, latency_s: float) -> int:
    """When a block's first frame was heard by the driver's report, in monotonic ns.

    `now_ns` and `stream_s` are the monotonic and the stream's clock at one moment; falls back as the output's does.
    """
    for clock_s in (stream_s, times.currentTime):
        ago_s = clock_s - times.inputBufferAdcTime
        if clock_s and times.inputBufferAdcTime and -MAX_PAST_S < ago_s < MAX_LATENCY_S:
            return now_ns - ns_from_s(ago_s)
    return now_ns - ns_from_s(latency_s)


def open_input(part: str = "", block_frames: int = 0, rate_hz: int = USUAL_RATE_HZ) -> CardInput:
    """Open the input whose name contains `part` (empty: the default), not yet recording; raises `DeviceError`."""
    sd = PORTAUDIO.acquire()
    try:
        return CardInput(sd, choose_device(list_devices("input"), part, "input"), block_frames, rate_hz)
    except BaseException:
        PORTAUDIO.release()
        raise
