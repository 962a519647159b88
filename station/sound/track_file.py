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
from station.sound.songs.softer_drums import softer_drums
from station.sound.track import MAX_TRACK_S, Pcm, PreparedTrack

MIN_SPEED, MAX_SPEED = 0.5, 1.5
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

    Times are seconds of the file at its own speed. The files `beside` it sound with it. With a `piece_s` (from, until)
    only that much is made ready, at the level that it has in the whole, and silence where the files have nothing. What
    is struck at `softer`, seconds of the file and `Piece` values, is turned down. `turns` are a `Track`'s.
    """

    path: Path
    rate_hz: int
    speed: float = 1.0
    start_s: float = 0.0
    loop_s: tuple[float, float] | None = None
    beside: tuple[Path, ...] = ()
    piece_s: tuple[float, float] | None = None
    softer: tuple[tuple[float, int], ...] = ()
    turns: int | None = None

    @property
    def files(self) -> tuple[Path, ...]:
        """All that sounds."""
        return self.path, *self.beside


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
        write_whole(file, _pcm(request).tobytes())
        forget_oldest(home, _ENDING, CACHED_FILES)
    scale = request.rate_hz / request.speed
    frames = file.stat().st_size // 4
    begin_s, end_s = request.piece_s or (0.0, length_s)
    loop = None
    if request.loop_s is not None:
        first, end = (min(frames, round((second - begin_s) * scale)) for second in request.loop_s)
        loop = first, (frames if request.loop_s[1] >= end_s else end)
    start = min(frames - 1, round((request.start_s - begin_s) * scale))
    return PreparedTrack(file, request.rate_hz, start, loop, request.turns)


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


def pcm_of(frames: Frames, gain: float | None = None) -> Pcm:
    """`frames` times `gain` (`level_gain` where None) as int16; what exceeds full scale is cut off."""
    scale = np.float32(32767.0 * (level_gain(frames) if gain is None else gain))
    pcm: Pcm = np.clip(np.rint(frames * scale), -32768, 32767).astype(np.int16)
    return pcm


def level_gain(frames: Frames) -> float:
    """What brings `frames` to `TRACK_DB`, less where that would exceed full scale; 1 where there is silence."""
    rms = float(np.sqrt(np.mean(np.square(frames, dtype=np.float64))))
    peak = float(np.abs(frames).max())
    return min(10.0 ** (TRACK_DB / 20.0) / rms, _LOUDEST / peak) if rms > 0.0 else 1.0


def checked_length_s(request: TrackRequest) -> float:
    """How long the files are, at most `MAX_TRACK_S`; raises `BadInput` for no sound file, or a part that they lack."""
    name = str(request.path)
    if not MIN_SPEED <= request.speed <= MAX_SPEED:
        raise BadInput(name, "speed", f"expected {MIN_SPEED:g} to {MAX_SPEED:g}, found {request.speed:g}")
    whole_s = max(map(file_length_s, request.files))
    if request.piece_s is not None:
        return _checked_piece_s(request, request.piece_s, whole_s)
    length_s = min(MAX_TRACK_S, whole_s)
    if not 0.0 <= request.start_s < length_s:
        raise BadInput(name, "start", f"expected 0 to {length_s:.1f} s, found {request.start_s:g}")
    if request.loop_s is not None:
        first, end = request.loop_s
        if not (0.0 <= first <= end - MIN_LOOP_S and max(end - 0.01, 0.0) <= length_s and request.start_s < end):
            within = f"a loop lies within {length_s:.1f} s, lasts {MIN_LOOP_S:g} s, and ends after the start"
            raise BadInput(name, f"loop {first:g}-{end:g}", within)
    return length_s


def _checked_piece_s(request: TrackRequest, piece_s: tuple[float, float], whole_s: float) -> float:
    """Where the piece ends; raises `BadInput` for a piece of what is too long, or one that has nothing of the files."""
    begin_s, end_s = piece_s
    first, end = request.loop_s or (request.start_s, end_s)
    assert begin_s <= request.start_s < end_s, "a piece holds where it starts"
    assert begin_s <= first < end <= end_s, "a piece holds its loop"
    name = str(request.path)
    if whole_s > MAX_TRACK_S and end_s > MAX_TRACK_S:
        raise BadInput(name, "", f"lasts {whole_s:.0f} s; at most the first {MAX_TRACK_S:.0f} s are played along to")
    if not (end > 0.0 and first < whole_s):
        raise BadInput(name, "", f"lasts {whole_s:.1f} s, and has nothing from {first:.1f} to {end:.1f} s")
    if end_s - begin_s > 2 * MAX_TRACK_S:
        raise BadInput(name, "", f"{end_s - begin_s:.0f} s at once; expected at most {2 * MAX_TRACK_S:.0f} s")
    return end_s


def file_length_s(path: Path) -> float:
    """How long a sound file is by its head; raises `BadInput` for what is none."""
    with opened(path, str(path)) as file:
        length_s: float = file.frames / file.samplerate
    return length_s


def _pcm(request: TrackRequest) -> Pcm:
    """All that is asked for as it is kept."""
    whole = _read(request)
    piece = whole if request.piece_s is None else _piece(whole, request.rate_hz, request.piece_s)
    soft = _with_softer_drums(request, piece)
    return pcm_of(stretched(soft, request.rate_hz, request.speed), None if piece is whole else level_gain(whole))


def _read(request: TrackRequest) -> Frames:
    """The sum of all files, as long as the longest."""
    whole = np.zeros((0, 2), np.float32)
    for path in request.files:
        frames = read_audio(path, str(path), request.rate_hz, MAX_TRACK_S)
        whole, other = (whole, frames) if len(whole) >= len(frames) else (frames, whole)
        whole[: len(other)] += other
    return whole


def _piece(whole: Frames, rate_hz: int, piece_s: tuple[float, float]) -> Frames:
    """The frames of `piece_s`, silent before the first of `whole` and after the last."""
    begin, end = (round(second * rate_hz) for second in piece_s)
    piece = np.zeros((end - begin, 2), np.float32)
    inside = whole[max(begin, 0) : max(end, 0)]
    at = max(-begin, 0)
    piece[at : at + len(inside)] = inside
    return piece


def _with_softer_drums(request: TrackRequest, piece: Frames) -> Frames:
    if not request.softer:
        return piece
    at_s, pieces = np.array(request.softer, np.float64).T
    begin_s = request.piece_s[0] if request.piece_s is not None else 0.0
    return softer_drums(piece, request.rate_hz, at_s - begin_s, pieces.astype(np.uint8))


def _digest(request: TrackRequest) -> str:
    """Names what the frames depend on: the files as they are now, rate and request; raises `DeviceError`."""
    try:
        stats = [(str(path.resolve()), (stat := path.stat()).st_size, stat.st_mtime_ns) for path in request.files]
    except OSError as fault:  # they were there a moment ago
        raise DeviceError(f"{request.path}: cannot be read: {fault.strerror or fault}") from fault
    facts = (stats, request.rate_hz, request.speed, request.piece_s, request.softer, TRACK_DB)
    return hashlib.sha256(repr(facts).encode()).hexdigest()[:24]
