"""A fake sound card: asks an engine for blocks as a driver would, on a clock moved by hand, and keeps what it got."""

import numpy as np
from numpy.typing import NDArray

from station.core.clock import ManualClock
from station.core.units import NS_PER_MS, NS_PER_S
from station.engine.engine import Engine
from station.engine.messages import EngineEvent


class AudioSink:
    """A card of `rate_hz` whose crystal runs `drift` too fast against the clock (1e-4: 100 parts in a million).

    A block is asked for when the clock reaches its start, and heard `latency_ns` later.
    """

    def __init__(
        self,
        engine: Engine,
        clock: ManualClock,
        rate_hz: int = 48_000,
        block_frames: int = 64,
        latency_ns: int = 2 * NS_PER_MS,
        drift: float = 0.0,
    ) -> None:
        self._engine = engine
        self._clock = clock
        self._frame_ns = NS_PER_S / (rate_hz * (1.0 + drift))
        self._block_frames = block_frames
        self._start_ns = clock.now_ns()
        self._latency_ns = latency_ns
        self._blocks: list[NDArray[np.float32]] = []
        self._frames = 0

    def run(self, for_ns: int) -> list[EngineEvent]:
        """Let `for_ns` go by; returns the engine's events."""
        until_ns = self._clock.now_ns() + for_ns
        events: list[EngineEvent] = []
        while (begin_ns := self._begin_ns(self._frames)) < until_ns:
            self._clock.advance_to(max(begin_ns, self._clock.now_ns()))
            self._blocks.append(self._engine.render(self._block_frames, begin_ns + self._latency_ns))
            self._frames += self._block_frames
            events += self._engine.advance(self._clock.now_ns())
        self._clock.advance_to(until_ns)
        return events + self._engine.advance(until_ns)

    @property
    def sound(self) -> NDArray[np.float32]:
        """Everything that was played: float32 (frames, 2)."""
        return np.concatenate(self._blocks) if self._blocks else np.empty((0, 2), np.float32)

    def heard_ns(self, frame: int) -> float:
        """When frame `frame` of `sound` was heard."""
        return self._start_ns + frame * self._frame_ns + self._latency_ns

    def onsets_ns(self, threshold: float = 0.01) -> list[float]:
        """When sound set in after silence."""
        loud = np.abs(self.sound).max(axis=1) > threshold
        starts = np.flatnonzero(loud & ~np.concatenate([[False], loud[:-1]]))
        return [self.heard_ns(int(frame)) for frame in starts]

    def _begin_ns(self, frame: int) -> int:
        return self._start_ns + round(frame * self._frame_ns)
