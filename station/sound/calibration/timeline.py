"""When each frame of a stream was heard or recorded, from the times of its blocks; and a recording with its times.

Times are monotonic nanoseconds; frames are counted from the stream's first. Within a block and between two the time is
interpolated, so a stream that drifts against the monotonic clock, or has lost a block, is followed.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_quantile_95
from station.core.units import NS_PER_S

Floats = NDArray[np.float64]

SETTLED_S = 1.0
"""The clock of a stream needs so long before its times are smooth (see `station.sound.output.dac_clock`)."""
_PARTS = 5
"""Into so many parts a stream is cut to see how far its rate can be trusted (our choice)."""


@dataclass(frozen=True, eq=False)
class Timeline:
    """`block_frame` (b,) the first frame of each block, `block_ns` (b,) its time; `rate_hz` the nominal rate."""

    block_frame: NDArray[np.int64]
    block_ns: NDArray[np.int64]
    rate_hz: int

    def at_ns(self, frames: Floats) -> Floats:
        """The time of `frames` (n,), whole or not, in ns; outside the blocks by the nominal rate."""
        at: Floats = self.block_ns[0] + self._since_first_ns(frames)
        return at

    def frame_at(self, at_ns: Floats) -> Floats:
        """The frames at the times `at_ns` (n,): the inverse of `at_ns`."""
        since_ns = np.asarray(at_ns, np.float64) - self.block_ns[0]
        frames = self.block_frame.astype(np.float64)
        last_ns = float(self.block_ns[-1] - self.block_ns[0])
        inside = np.interp(since_ns, (self.block_ns - self.block_ns[0]).astype(np.float64), frames)
        outside = np.minimum(since_ns, 0.0) + np.maximum(since_ns - last_ns, 0.0)
        found: Floats = inside + outside * self.rate_hz / NS_PER_S
        return found

    def _since_first_ns(self, frames: Floats) -> Floats:
        frames = np.asarray(frames, np.float64)
        first, last = float(self.block_frame[0]), float(self.block_frame[-1])
        since_ns = (self.block_ns - self.block_ns[0]).astype(np.float64)
        outside = np.minimum(frames - first, 0.0) + np.maximum(frames - last, 0.0)
        return np.asarray(np.interp(frames, self.block_frame.astype(np.float64), since_ns)) + outside * (
            NS_PER_S / self.rate_hz
        )

    def drift_ppm(self) -> tuple[float, float] | None:
        """How much faster than its nominal rate the stream runs, in parts of a million, and half its 95 % interval.

        None of a stream that is too short to tell: shorter than twice `SETTLED_S`, or of fewer than ten blocks.
        """
        settled = self.block_frame - self.block_frame[0] >= SETTLED_S * self.rate_hz
        frames, at_ns = self.block_frame[settled], self.block_ns[settled]
        if len(frames) < 2 * _PARTS or frames[-1] - frames[0] < SETTLED_S * self.rate_hz:
            return None
        slopes = [_ns_a_frame(f, t) for f, t in zip(*_parts(frames, at_ns), strict=True)]
        ppm = 1e6 * (NS_PER_S / self.rate_hz / np.array(slopes) - 1.0)
        whole = 1e6 * (NS_PER_S / self.rate_hz / _ns_a_frame(frames, at_ns) - 1.0)
        half = t_quantile_95(_PARTS - 1.0) * float(np.std(ppm, ddof=1)) / _PARTS**0.5
        return whole, half


def _parts(frames: NDArray[np.int64], at_ns: NDArray[np.int64]) -> tuple[list[Floats], list[Floats]]:
    return np.array_split(frames, _PARTS), np.array_split(at_ns, _PARTS)


def _ns_a_frame(frames: NDArray[np.int64] | Floats, at_ns: NDArray[np.int64] | Floats) -> float:
    """The slope of the line through the blocks."""
    x, y = frames - frames.mean(), at_ns - at_ns[0]
    return float(x @ (y - y.mean()) / (x @ x))


@dataclass(frozen=True, eq=False)
class TimedRecording:
    """What an input heard: float32 (n, channels) at `rate_hz`, each frame's time, and how many blocks were lost."""

    sound: NDArray[np.float32]
    timeline: Timeline
    lost_blocks: int = 0

    @property
    def rate_hz(self) -> int:
        """Its nominal rate."""
        return self.timeline.rate_hz

    @property
    def clipped(self) -> bool:
        """Whether the input was driven beyond full scale."""
        return bool(np.count_nonzero(np.abs(self.sound) >= CLIPPED) >= CLIPPED_FRAMES)


CLIPPED = 0.999
CLIPPED_FRAMES = 8
"""So many frames at full scale are no chance (our choice)."""
