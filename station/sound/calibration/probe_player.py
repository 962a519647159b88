"""Plays one prepared sound and keeps when each of its blocks is heard: what an output asks for while it is measured."""

import numpy as np
from numpy.typing import NDArray

from station.sound.calibration.timeline import SETTLED_S, Timeline
from station.sound.drum_kit import Frames

LEAD_S = SETTLED_S + 0.2
"""Silence before the sound, until the stream's clock is smooth."""


class ProbePlayer:
    """A renderer (`station.sound.output.card_output.Renderer`) of `sound` (n,) mono, after a silent lead."""

    def __init__(self, sound: NDArray[np.float32], rate_hz: int) -> None:
        self._rate_hz = rate_hz
        self.lead = round(LEAD_S * rate_hz)
        """The frame of the stream on which the sound's first frame falls."""
        self._sound = sound
        self._frame = 0
        self._blocks: list[tuple[int, int]] = []

    def __call__(self, frames: int, dac_ns: int) -> Frames:
        """The next block, both sides alike."""
        self._blocks.append((self._frame, dac_ns))
        begin = self._frame - self.lead
        self._frame += frames
        block = np.zeros((frames, 2), np.float32)
        part = self._sound[max(begin, 0) : max(begin + frames, 0)]
        at = max(-begin, 0)
        block[at : at + len(part)] = part[:, None]
        return block

    @property
    def is_over(self) -> bool:
        """Whether the whole sound was asked for."""
        return self._frame >= self.lead + len(self._sound)

    @property
    def timeline(self) -> Timeline | None:
        """When each frame of the stream is heard by the output's report; None before the first block."""
        blocks = np.array(self._blocks, np.int64).reshape(-1, 2)
        return Timeline(blocks[:, 0], blocks[:, 1], self._rate_hz) if len(blocks) else None

    def heard_ns(self, frames: NDArray[np.int64]) -> NDArray[np.int64]:
        """When `frames` (k,) of the sound are heard by the output's report."""
        timeline = self.timeline
        assert timeline is not None, "the sound was played"
        heard: NDArray[np.int64] = np.round(timeline.at_ns((frames + self.lead).astype(np.float64))).astype(np.int64)
        return heard
