"""A play-along file made ready: read, brought to the card's rate, slowed or sped up without a change of pitch, kept.

That takes seconds and holds the interpreter lock (the stretcher is C++), so it never happens in the engine:
`prepare_in_background` does it in a process of its own and leaves the result on disk as plain int16 frames, which
the engine reads whole before it plays. The same request finds its file again. Signalsmith Stretch (python-stretch) does
the stretching: it is the only one of its quality whose licence and wheels fit.

Level: music is mastered up to full scale, a drum kit is not; a track is set to `TRACK_DB`, and the kit lies above it.
"""

import hashlib
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from station.core.disk.files import write_whole
from station.core.disk_cache import cache_folder, forget_oldest
from station.core.errors import BadInput, DeviceError
from station.sound.drum_kit import Frames
from station.sound.samples.audio_file import opened, read_audio
from station.sound.track import Pcm, PreparedTrack

MIN_SPEED, MAX_SPEED = 0.5, 1.5
MAX_TRACK_S = 600.0
"""Our choice: ten minutes of a song, at half speed 230 MB in memory."""
MIN_LOOP_S = 0.25
TRACK_DB = -20.0
"""RMS of a track as a whole (our choice: a groove on the synthesised kit lies some 4 dB above)."""
CACHED_FILES = 8
NO_STRETCHER = (
    "a track can only play at its own speed: the package python-stretch is missing; where there is no wheel of it "
    "for this processor, `pip install python-stretch` builds it with a C++ compiler"
)
_ENDING = ".track"
_LOUDEST = 0.98


@dataclass(frozen=True, slots=True)
class TrackRequest:
    """What to play along to: a sound file, how fast (0.5 … 1.5), from where, and which part again and again.

    Times are seconds of the file at its own speed.
    """

    path: Path
    rate_hz: int
    speed: float = 1.0
    start_s: float = 0.0
    loop_s: tuple[float, float] | None = None


def tracks_folder() -> Path:
    """Where prepared tracks lie on this system; may be deleted at any time."""
    return cache_folder("tracks")


def prepare_in_background(request: TrackRequest, folder: Path | None = None) -> "Future[PreparedTrack]":
    """`prepare` in a process of its own; the future ends with its result, or raises what it raises."""
    pool = ProcessPoolExecutor(1, mp_context=get_context("spawn"))
    future = pool.submit(prepare, request, folder)
    pool.shutdown(wait=False)
    return future


def prepare(request: TrackRequest, folder: Path | None = None) -> PreparedTrack:
    """Make the track ready; raises `BadInput` for the request's or the file's fault, `DeviceError` for the disk's."""
    length_s = checked_length_s(request)
    home = folder or tracks_folder()
    file = home / f"{_digest(request)}{_ENDING}"
    if not file.exists():
        write_whole(file, pcm_of(stretched(_read(request), request.rate_hz, request.speed)).tobytes())
        forget_oldest(home, _ENDING, CACHED_FILES)
    scale = request.rate_hz / request.speed
    frames = file.stat().st_size // 4
    loop = None
    if request.loop_s is not None:
        first, end = (min(frames, round(second * scale)) for second in request.loop_s)
        loop = first, (frames if request.loop_s[1] >= length_s else end)
    return PreparedTrack(file, request.rate_hz, min(frames - 1, round(request.start_s * scale)), loop)


def stretched(frames: Frames, rate_hz: int, speed: float) -> Frames:
    """`frames` (n, 2) played `speed` times as fast at the same pitch: (about n/speed, 2); raises `DeviceError`."""
    if speed == 1.0:
        return frames
    try:
        import python_stretch  # noqa: PLC0415 - only here; not every processor has a wheel of it
    except ImportError as fault:
        raise DeviceError(NO_STRETCHER) from fault
    stretcher = python_stretch.Signalsmith.Stretch()
    stretcher.preset(2, rate_hz)
    stretcher.setTimeFactor(speed)
    return np.ascontiguousarray(np.asarray(stretcher.process(np.ascontiguousarray(frames.T)), np.float32).T)


def pcm_of(frames: Frames) -> Pcm:
    """`frames` at `TRACK_DB`, less where that would exceed full scale, as int16."""
    rms = float(np.sqrt(np.mean(np.square(frames, dtype=np.float64))))
    peak = float(np.abs(frames).max())
    gain = min(10.0 ** (TRACK_DB / 20.0) / rms, _LOUDEST / peak) if rms > 0.0 else 1.0
    pcm: Pcm = np.rint(frames * np.float32(32767.0 * gain)).astype(np.int16)
    return pcm


def checked_length_s(request: TrackRequest) -> float:
    """How long the file is, at most `MAX_TRACK_S`; raises `BadInput` for no sound file, or a part that it lacks."""
    name = str(request.path)
    if not MIN_SPEED <= request.speed <= MAX_SPEED:
        raise BadInput(name, "speed", f"expected {MIN_SPEED:g} to {MAX_SPEED:g}, found {request.speed:g}")
    length_s = min(MAX_TRACK_S, file_length_s(request.path))
    if not 0.0 <= request.start_s < length_s:
        raise BadInput(name, "start", f"expected 0 to {length_s:.1f} s, found {request.start_s:g}")
    if request.loop_s is not None:
        first, end = request.loop_s
        if not (0.0 <= first <= end - MIN_LOOP_S and max(end - 0.01, 0.0) <= length_s and request.start_s < end):
            within = f"a loop lies within {length_s:.1f} s, lasts {MIN_LOOP_S:g} s, and ends after the start"
            raise BadInput(name, f"loop {first:g}-{end:g}", within)
    return length_s


def file_length_s(path: Path) -> float:
    """How long a sound file is by its head; raises `BadInput` for what is none."""
    with opened(path, str(path)) as file:
        length_s: float = file.frames / file.samplerate
    return length_s


def _read(request: TrackRequest) -> Frames:
    return read_audio(request.path, str(request.path), request.rate_hz, MAX_TRACK_S)


def _digest(request: TrackRequest) -> str:
    """Names what the frames depend on: the file as it is now, the rate and the speed; raises `DeviceError`."""
    try:
        stat, path = request.path.stat(), request.path.resolve()
    except OSError as fault:  # it was there a moment ago
        raise DeviceError(f"{request.path}: cannot be read: {fault.strerror or fault}") from fault
    facts = (str(path), stat.st_size, stat.st_mtime_ns, request.rate_hz, request.speed, TRACK_DB)
    return hashlib.sha256(repr(facts).encode()).hexdigest()[:24]
