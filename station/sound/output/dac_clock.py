"""When each block of sound is heard, on the monotonic clock: a delay-locked loop over the driver's jittery reports.

Time base: monotonic nanoseconds in and out; frames are the sound card's. A second-order loop (F. Adriaensen, "Using a
DLL to filter time", Linux Audio Conference 2005) predicts the next block's time from the card's measured frame length
and corrects both by a share of the error, so that drift between the two clocks is followed and jitter averaged away.
Its bandwidth starts wide and narrows as it settles. A single late report is clipped; reports that stay away from the
prediction mean that the stream itself jumped (an underflow, a suspended computer), and the loop starts again from them.

Bounds, by simulation in the tests: with reports of 0.5 ms SD, one in a hundred late by up to 20 ms, and a card that is
200 ppm off, blocks of 16 to 256 frames are placed within 0.1 ms once ten seconds have passed, blocks of 1024 (of which
few reports come) within 0.2 ms.
"""

from math import pi, sqrt

from station.core.units import NS_PER_MS, NS_PER_S

FINAL_BANDWIDTH_HZ = 0.05
"""Our choice: averages over some seconds; quartz drifts far slower."""
FIRST_BANDWIDTH_HZ = 1.0
SETTLING = 0.5
"""Bandwidth × time since the start while the loop narrows (our choice: about half a cycle of it has passed)."""
MAX_STEP = 0.5
"""The loop's angle a block, 2π·bandwidth·block length, stays below this: blocks of any length leave it stable."""
CLIP_NS = 1 * NS_PER_MS
"""One report moves the loop no further than this error would."""
JUMP_NS = 3 * NS_PER_MS
JUMP_BLOCKS = 8
"""So many reports in turn, each beyond `JUMP_NS` on one side, are a jump of the stream and no jitter (our choice)."""


class DacClock:
    """Maps a stream's blocks to the monotonic time at which their first frame is heard."""

    def __init__(self, rate_hz: int) -> None:
        self._nominal_ns = NS_PER_S / rate_hz
        self._frame_ns = self._nominal_ns
        self._origin_ns = 0
        self._next_ns: float | None = None  # from the origin, so that a float keeps fractions of a ns
        self._settled_s = 0.0
        self._away = 0

    @property
    def frame_ns(self) -> float:
        """How long a frame lasts on the monotonic clock, drift included."""
        return self._frame_ns

    def resync(self) -> None:
        """Start again from the next report: the stream has jumped. The frame's length is kept."""
        self._next_ns = None
        self._settled_s = 0.0
        self._away = 0

    def block(self, frames: int, reported_ns: int) -> int:
        """The time at which the first of the next `frames` frames is heard, given what the driver reports for it."""
        if self._next_ns is None or self._jumped(reported_ns - self._origin_ns - self._next_ns):
            self.resync()
            self._origin_ns, self._next_ns = reported_ns, 0.0
        at_ns = self._origin_ns + round(self._next_ns)
        error_ns = reported_ns - self._origin_ns - self._next_ns
        self._next_ns += self._step_ns(frames, max(-CLIP_NS, min(CLIP_NS, error_ns)))
        return at_ns

    def _jumped(self, error_ns: float) -> bool:
        side = (error_ns > JUMP_NS) - (error_ns < -JUMP_NS)
        self._away = self._away + side if side * self._away >= 0 and side else side
        return abs(self._away) >= JUMP_BLOCKS

    def _step_ns(self, frames: int, error_ns: float) -> float:
        """From this block to the next, with this block's error taken into account, here and in the frame's length."""
        block_s = frames * self._nominal_ns / NS_PER_S
        step = min(MAX_STEP, 2 * pi * self._bandwidth_hz() * block_s)
        step_ns = frames * self._frame_ns + sqrt(2) * step * error_ns
        self._frame_ns += step * step * error_ns / max(1, frames)
        self._settled_s += block_s
        return step_ns

    def _bandwidth_hz(self) -> float:
        narrowing = SETTLING / max(self._settled_s, 1e-9)
        return max(FINAL_BANDWIDTH_HZ, min(FIRST_BANDWIDTH_HZ, narrowing))
