"""Pictures and sound in, an MP4 out: H.264 and AAC by FFmpeg's libraries (PyAV), encoded by a thread of its own.

Picture k is shown from k / fps on; sound begins with picture 0. The file is written beside its place and takes its
name when it is complete: what is given up or fails in between leaves nothing. Who adds pictures and sound keeps them
abreast, for the file interleaves them.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from queue import Queue
from threading import Thread

import av
import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import growing
from station.core.errors import DeviceError
from station.render.gpu.nv12 import Planes

_ENCODER = "libx264"
_AHEAD = 4
"""So many pictures or pieces of sound may wait for the encoder; our choice: 5 MB at 1280×720."""
_SOUND_BITS_A_SECOND = 192_000
"""AAC of two channels is taken for transparent from about here on (our choice)."""
_KEY_EVERY_S = 1.0
"""A picture to start from so often: one can step back and forth through a stroke (our choice; x264: 250 pictures)."""
_BT709, _NARROW = 1, 1
"""ITU-T H.273, tables 2 to 4: primaries, transfer, matrix; and FFmpeg's number of the narrow range."""


@dataclass(frozen=True, slots=True)
class Effort:
    """How the encoder works: x264's preset, and what it holds constant, lower being finer.

    `held` is "crf", its rate factor, or "qp", the quantiser: with that one it need not look at a picture beforehand,
    which takes it a tenth less time for a file a twentieth larger.
    """

    preset: str
    held: str
    value: int


EFFORTS = (Effort("ultrafast", "qp", 20), Effort("veryfast", "crf", 19), Effort("medium", "crf", 17))
"""For each level of the pictures' quality; our choice: drawing stays what takes the time."""


@dataclass(frozen=True, slots=True)
class VideoFormat:
    """What a video is: `size` (width, height) in even pixels, pictures a second, the sound's rate (None: silent)."""

    size: tuple[int, int]
    fps: Fraction
    rate_hz: int | None = None
    effort: Effort = EFFORTS[0]


def encoder_name() -> str:
    """What encodes on this computer; raises `DeviceError` where nothing does."""
    if _ENCODER not in av.codecs_available:
        raise DeviceError("the installed FFmpeg cannot encode H.264: install the wheel of av (pip install av)")
    return f"H.264 by x264, FFmpeg {av.ffmpeg_version_info}"


@contextmanager
def video_file(path: Path, video: VideoFormat) -> Iterator["VideoSink"]:
    """Where the pictures and the sound of the file at `path` go; it is there when the block has ended, or never.

    Raises `DeviceError` where the disk or FFmpeg refuses; then, and if the block raises, an old file stays as it was.
    """
    with growing(path) as part:
        sink = VideoSink(part, video)
        try:
            yield sink
        except BaseException:
            sink.close(is_whole=False)
            raise
        sink.close(is_whole=True)


class VideoSink:
    """Takes pictures and sound in order and hands them to the encoder's thread; waits where that is behind."""

    def __init__(self, path: Path, video: VideoFormat) -> None:
        self._encoder = _Encoder(path, video)
        self._work: Queue[Callable[[], None] | None] = Queue(_AHEAD)
        self._fault: BaseException | None = None
        self._thread = Thread(target=self._run, name="video", daemon=True)
        self._thread.start()

    def add_picture(self, planes: Planes) -> None:
        """The next picture, shape (height · 3/2, width) as `station.render.gpu.nv12` makes it; raises `OSError`."""
        self._add(partial(self._encoder.picture, planes))

    def add_sound(self, frames: NDArray[np.float32]) -> None:
        """The next of the sound, shape (n, 2), full scale ±1; raises `OSError`."""
        self._add(partial(self._encoder.sound, frames))

    def close(self, is_whole: bool) -> None:
        """End the file, which is worth keeping only if it `is_whole`; raises what went wrong since."""
        if not is_whole:
            self._fault = self._fault or _GivenUp()
        self._work.put(None)
        self._thread.join()
        if is_whole and self._fault is not None:
            raise self._fault

    def _add(self, work: Callable[[], None]) -> None:
        if self._fault is not None:
            raise self._fault
        self._work.put(work)

    def _run(self) -> None:
        """Encode until there is nothing more; after a fault what comes is dropped, so that nobody waits."""
        while (work := self._work.get()) is not None:
            self._try(work)
        self._try(self._encoder.finish)
        try:
            self._encoder.close()
        except Exception as fault:
            self._fault = self._fault or fault

    def _try(self, work: Callable[[], None]) -> None:
        if self._fault is None:
            try:
                work()
            except Exception as fault:
                self._fault = fault


class _GivenUp(Exception):
    """Why the encoder drops what is left."""


class _Encoder:
    """Two streams and the file that they go to; after its making used by one thread alone."""

    def __init__(self, path: Path, video: VideoFormat) -> None:
        self._container = av.open(str(path), "w", format="mp4", options={"movflags": "+faststart"})
        self._time_base = 1 / video.fps
        self._pictures = self._container.add_stream(_ENCODER, rate=video.fps, options=_options(video))
        self._pictures.width, self._pictures.height = video.size
        self._pictures.pix_fmt = "nv12"
        self._pictures.codec_context.time_base = self._time_base
        self._pictures.codec_context.thread_type = "FRAME"
        self._pictures.codec_context.color_range = _NARROW
        for name in ("color_primaries", "color_trc", "colorspace"):
            setattr(self._pictures.codec_context, name, _BT709)
        self._shown = 0
        self._rate_hz = video.rate_hz
        self._heard = 0
        if video.rate_hz is not None:
            self._sounds = self._container.add_stream("aac", rate=video.rate_hz, layout="stereo")
            self._sounds.bit_rate = _SOUND_BITS_A_SECOND

    def picture(self, planes: Planes) -> None:
        """Encode one."""
        frame = av.VideoFrame.from_ndarray(planes, format="nv12")
        frame.pts, frame.time_base = self._shown, self._time_base
        self._shown += 1
        self._container.mux(self._pictures.encode(frame))

    def sound(self, frames: NDArray[np.float32]) -> None:
        """Encode some."""
        assert self._rate_hz is not None, "the video was said to be silent"
        frame = av.AudioFrame.from_ndarray(np.ascontiguousarray(frames.T), format="fltp", layout="stereo")
        frame.rate = self._rate_hz
        frame.pts, frame.time_base = self._heard, Fraction(1, self._rate_hz)
        self._heard += len(frames)
        self._container.mux(self._sounds.encode(frame))

    def finish(self) -> None:
        """Encode what the encoders hold back."""
        for stream in self._container.streams:
            self._container.mux(stream.encode(None))

    def close(self) -> None:
        """Write the table of contents, and let the file go."""
        self._container.close()


def _options(video: VideoFormat) -> dict[str, str]:
    return {
        "preset": video.effort.preset,
        video.effort.held: str(video.effort.value),
        "g": str(max(1, round(_KEY_EVERY_S * video.fps))),
    }
