"""One ringing sound: where it stands, how loud it is, and how it fades when it must go before its end."""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.sound.buses import Bus
from station.sound.drum_kit import Frames, Sound


class Voice:
    """A sound that plays on a bus from its first frame to its last, or until it has faded.

    `gain` is its amplitude factor now and `slope` the gain's change a frame; `piece` (None for a click) and `openness`
    say what may choke or damp it, `sound` what of its mute group stops it; `row` is its place in the mixer; `sides` are
    the factors of left and right in turn, as long as the longest row, None in the middle.
    """

    __slots__ = (
        "_at",
        "_data",
        "_stop",
        "bus",
        "fading",
        "gain",
        "openness",
        "piece",
        "row",
        "sides",
        "slope",
        "sound",
    )

    def __init__(self, frames: Frames, bus: Bus, gain: float, piece: Piece | None, openness: float = 0.0) -> None:
        self._data = frames.reshape(-1)
        self._at = 0
        self._stop = len(self._data)
        self.bus = bus
        self.gain = gain
        self.slope = 0.0
        self.fading = False
        self.piece = piece
        self.openness = openness
        self.row = -1
        self.sound: Sound | None = None
        self.sides: NDArray[np.float32] | None = None

    @property
    def position(self) -> int:
        """Frames played so far."""
        return self._at // 2

    def fade_within(self, frames: int) -> None:
        """Fall to silence in a straight line over `frames` frames; one that fades faster already goes on so."""
        frames = max(1, frames)
        if self._at + 2 * frames >= self._stop and self.fading:
            return
        self.slope = -self.gain / frames
        self._stop = min(self._stop, self._at + 2 * frames)
        self.fading = True

    def copy_to(self, row: NDArray[np.float32]) -> bool:
        """Fill `row` with the next numbers (left, right, left …), without gain, and move on; whether it still rings.

        Zeros follow the end.
        """
        size = len(row)
        at = self._at
        self._at = next_at = at + size
        if self.fading:
            self.gain += self.slope * (size // 2)
        rings = next_at < self._stop
        if rings:
            row[:] = self._data[at:next_at]
        else:
            left = self._stop - at
            row[:left] = self._data[at : self._stop]
            row[left:] = 0.0
        if self.sides is not None:
            row *= self.sides[:size]
        return rings
