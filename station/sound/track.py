"""A play-along track while it plays: frames from an array, looped without a seam, kept in step with the transport.

Time base: frames at the card's rate. The card's clock and the monotonic one drift apart by up to 0.2 ms a second; cues
are placed on the latter, so the track follows: it is moved by single frames, each move a crossfade over one piece of
the mixer, which for a frame is an interpolation that nobody hears. A larger jump (the stream lost blocks) fades too.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.sound.drum_kit import Frames

MAX_TRACK_S = 600.0
"""Our choice: ten minutes of a song, at half speed 230 MB in memory."""
SEAM_S = 0.01
"""The end of a loop fades into its beginning within so long (our choice)."""
EDGE_S = 0.005
"""A track that starts or stops in mid-music fades in or out within so long."""
LEAVE_S = 0.6
"""After the last turn of a loop the music goes on, and fades out within so long (our choice: a beat or so is heard of
it, less than a session stands still after its last pass)."""
TRACK_SLACK = 2
"""Frames by which a track may be off its place: the clock's own noise (our choice)."""
TRACK_JUMP_S = 0.03
"""Further away than this a track is moved at once, for the stream has jumped (our choice: a flam's width)."""
_SCALE = np.float32(1.0 / 32768.0)

Pcm = NDArray[np.int16]
"""Stereo sound as stored: int16 (n, 2)."""


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """Sound to play along to: `pcm` at `rate_hz`, from frame `start` on; `loop` (first, past the last), None: once.

    With `turns` the loop is played so often, and left for what follows it, which fades out within `LEAVE_S`.
    """

    pcm: Pcm
    rate_hz: int
    start: int = 0
    loop: tuple[int, int] | None = None
    turns: int | None = None

    def __post_init__(self) -> None:
        assert self.pcm.ndim == 2, "stereo"
        assert 0 <= self.start < len(self.pcm), "a track starts within itself"
        if self.loop is not None:
            first, end = self.loop
            assert 0 <= first < end <= len(self.pcm), "a loop lies within its track"
            assert self.start < end, "a track starts before its loop's end"
        assert self.turns is None or (self.turns > 0 and self.loop is not None), "what turns has a loop"


@dataclass(frozen=True, slots=True)
class PreparedTrack:
    """A file of int16 frames ready to play at `rate_hz`; `start` and `loop` in frames of it, `turns` a `Track`'s."""

    file: Path
    rate_hz: int
    start: int
    loop: tuple[int, int] | None
    turns: int | None = None


def load(prepared: PreparedTrack) -> Track:
    """The track in memory; raises `DeviceError` where its file is gone."""
    try:
        pcm = np.fromfile(prepared.file, np.int16).reshape(-1, 2)
    except (OSError, ValueError) as fault:
        raise DeviceError(f"the play-along track cannot be read: {fault}; choose its file again") from fault
    if prepared.start >= len(pcm) or (prepared.loop is not None and prepared.loop[1] > len(pcm)):
        raise DeviceError(f"the play-along track {prepared.file} is cut short; choose its file again")
    return Track(pcm, prepared.rate_hz, prepared.start, prepared.loop, prepared.turns)


class TrackVoice:
    """A track that plays: `read` its next frames, `move` it when it has drifted."""

    def __init__(self, track: Track) -> None:
        self._track = track
        self._at = 0  # frames since the start, moves included
        self._move = 0
        self._seam = min(round(SEAM_S * track.rate_hz), track.loop[1] - track.loop[0]) if track.loop else 0
        self._plain_until = track.loop[1] - self._seam if track.loop else len(track.pcm)
        """Up to here frames are simply those of the array."""
        self._leave = max(1, round(LEAVE_S * track.rate_hz))
        self._edge = max(1, round(EDGE_S * track.rate_hz))
        self._fade_in_left = self._edge if track.start else 0
        self._fade_out_left: int | None = None

    @property
    def rate_hz(self) -> int:
        """Of its track."""
        return self._track.rate_hz

    @property
    def position(self) -> int:
        """Frames of the track that have gone by since it started."""
        return self._at

    @property
    def has_ended(self) -> bool:
        """Whether nothing more will sound."""
        if self._fade_out_left is not None:
            return self._fade_out_left <= 0
        if self._track.loop is not None and self._track.turns is not None:
            first, end = self._track.loop
            return self._track.start + self._at >= first + self._track.turns * (end - first) + self._leave
        return self._track.loop is None and self._track.start + self._at >= len(self._track.pcm)

    def move(self, frames: int) -> None:
        """Jump ahead (or back, where negative) by `frames`, in a crossfade over what is read next."""
        self._move = max(frames, -self._at)

    def stop(self) -> None:
        """Fade out within `EDGE_S`."""
        if self._fade_out_left is None:
            self._fade_out_left = self._edge

    def read(self, count: int) -> Frames:
        """The next `count` frames, float32 (count, 2); silence after the end."""
        frames = self._frames(self._at, count)
        if self._move:
            ramp = (np.arange(1, count + 1, dtype=np.float32) / count)[:, None]
            frames += ramp * (self._frames(self._at + self._move, count) - frames)
            self._at += self._move
            self._move = 0
        self._at += count
        self._fade_edges(frames)
        return frames

    def _fade_edges(self, frames: Frames) -> None:
        count = len(frames)
        if self._fade_in_left:
            gone = self._edge - self._fade_in_left
            frames *= _ramp(gone, count, self._edge)[:, None]
            self._fade_in_left = max(0, self._fade_in_left - count)
        if self._fade_out_left is not None:
            gone = self._edge - self._fade_out_left
            frames *= 1.0 - _ramp(gone, count, self._edge)[:, None]
            self._fade_out_left -= count

    def _frames(self, at: int, count: int) -> Frames:
        """`count` frames from `at` frames after the start."""
        begin = self._track.start + at
        if begin + count <= self._plain_until:
            return np.multiply(self._track.pcm[begin : begin + count], _SCALE, dtype=np.float32)
        places = np.arange(begin, begin + count)
        if self._track.loop is None:
            return self._sound(places)
        return self._turning(places, *self._track.loop)

    def _turning(self, places: NDArray[np.int64], first: int, end: int) -> Frames:
        """The frames at `places` counted on through all turns of the loop."""
        turn, turns = np.maximum(places - first, 0) // (end - first), self._track.turns
        is_last = np.zeros(len(places), np.bool_) if turns is None else turn >= turns - 1
        if turns is not None:
            turn = np.minimum(turn, turns - 1)
        places = places - turn * (end - first)
        frames = self._sound(places)
        left = end - places
        near = (left <= self._seam) & ~is_last
        if near.any():  # the loop's last frames fade into what leads up to its first
            ahead = (1.0 - left[near] / np.float32(self._seam)).astype(np.float32)[:, None]
            frames[near] += ahead * (self._sound(first - left[near]) - frames[near])
        if is_last.any():
            frames *= np.clip(1.0 + left / self._leave, 0.0, 1.0).astype(np.float32)[:, None]
        return frames

    def _sound(self, places: NDArray[np.int64]) -> Frames:
        """The frames at `places`; silence before the first and after the last."""
        pcm = self._track.pcm
        inside = (places >= 0) & (places < len(pcm))
        frames: Frames = np.multiply(pcm[np.where(inside, places, 0)], _SCALE, dtype=np.float32)
        if not inside.all():
            frames[~inside] = 0.0
        return frames


class TrackPlayer:
    """The track that plays, and those before it while they fade out."""

    def __init__(self) -> None:
        self._voices: list[TrackVoice] = []

    @property
    def plays(self) -> bool:
        """Whether something sounds."""
        return bool(self._voices)

    def play(self, track: Track) -> None:
        """Play `track` in place of one that plays."""
        self.stop()
        self._voices.append(TrackVoice(track))

    def stop(self) -> None:
        """Fade out."""
        for voice in self._voices:
            voice.stop()

    def forget(self) -> None:
        """Be silent at once."""
        self._voices.clear()

    def keep_at(self, position: int) -> None:
        """Bring what plays to `position`, the frames since its start that is read next.

        A frame at a time where it has drifted a little, at once where it is `TRACK_JUMP_S` away.
        """
        if not self._voices:
            return
        voice = self._voices[-1]
        off = position - voice.position
        if abs(off) > round(TRACK_JUMP_S * voice.rate_hz):
            voice.move(off)
        elif abs(off) > TRACK_SLACK:
            voice.move(1 if off > 0 else -1)

    def add_to(self, bus: NDArray[np.float32], count: int) -> None:
        """Add the next `count` frames to `bus`, interleaved (2 · count,)."""
        for voice in self._voices:
            bus += voice.read(count).reshape(-1)
        self._voices = [voice for voice in self._voices if not voice.has_ended]


def _ramp(gone: int, count: int, length: int) -> NDArray[np.float32]:
    """`count` steps of a rise from 0 to 1 over `length` frames, `gone` of which are over."""
    steps: NDArray[np.float32] = np.minimum(1.0, (gone + np.arange(1, count + 1)) / length).astype(np.float32)
    return steps
