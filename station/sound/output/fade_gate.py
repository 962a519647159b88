"""Lets the sound of a stream in and out without a click: wherever it is stopped or started, it fades.

Time base: frames at the stream's rate. The gate is shut before the first block, opens over `FADE_S` when the stream is
started, and shuts over as long before it is paused or closed. One thread tells it, another passes blocks through it.
"""

from threading import Event

import numpy as np

from station.core.join_timeout import TURN_S
from station.sound.drum_kit import Frames

FADE_S = 0.005
"""Our choice: longer than a period of the lowest tone that a small speaker gives, shorter than a flam."""


class Gate:
    """A fader that is open, shut, or on its way."""

    def __init__(self, rate_hz: int) -> None:
        self._step = 1.0 / (FADE_S * rate_hz)
        self._gain = 0.0
        self._target = 0.0
        self._is_shut = Event()
        self._is_shut.set()

    def open(self) -> None:
        """Let sound through from the next block on, in a fade."""
        self._is_shut.clear()
        self._target = 1.0

    def shut(self) -> None:
        """Let no more sound through after a fade that begins with the next block."""
        self._target = 0.0

    def wait_until_shut(self, within_s: float) -> bool:
        """Wait for the fade's end, at most `within_s` of a machine that runs; whether it has ended."""
        turns = max(1, round(within_s / TURN_S))
        return any(self._is_shut.wait(within_s / turns) for _ in range(turns))

    def through(self, block: Frames) -> Frames:
        """What of `block` (n, 2) is let through; written in place where it fades."""
        target = self._target
        if self._gain == target:
            if target == 0.0:
                block[:] = 0.0
                self._is_shut.set()
            return block
        direction = 1.0 if target > self._gain else -1.0
        ramp = self._gain + direction * self._step * np.arange(1, len(block) + 1)
        gains = np.clip(ramp, 0.0, 1.0).astype(np.float32)
        self._gain = float(gains[-1]) if len(gains) else self._gain
        block *= gains[:, None]
        if self._gain == 0.0 and target == 0.0:
            self._is_shut.set()
        return block
