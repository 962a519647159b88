"""What the struck instruments do: cymbals swing and settle, drums shake, heads ripple and flash.

A cymbal rocks on its stand as a pendulum whose rate falls with its size (HUMANS: 14″ .68–.92 Hz … 20″ .48–.66, decay
1–2 s); each stroke adds a push by its force and lightens with the cymbal's weight. A drum's shell shakes quickly and
little. The motion is exact at any instant: between strokes it is a decaying rotation of one complex number, and what
every stroke leaves behind is summed once.
"""

import cmath
import math
from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.motion.kit.kit import Kit
from station.motion.kit.piece import KitPiece
from station.music.score import Score

Array = NDArray[np.float64]

INCH_M = 0.0254
_CYMBAL_HZ = 0.80
_CYMBAL_REFERENCE_M, _CYMBAL_SLOWS = 7 * INCH_M, 0.95
"""A 14″ cymbal rocks 0.8 times a second, and the rate falls with this power of the size: the middles of HUMANS' ranges
from 14″ to 20″ (calculated)."""
_CYMBAL_DECAY_S = 1.3
_CYMBAL_PUSH_RAD = math.radians(11.0)
"""How far the hardest stroke tips a 14″ cymbal (our choice); a larger one less, by its weight."""
_DRUM_HZ, _DRUM_DECAY_S, _DRUM_PUSH_RAD = 9.0, 0.12, math.radians(0.8)
"""A rack tom shakes on its arm (our choice; the thesis, § 3.3.1, calls it very subtle)."""
_FLASH_DECAY_S = 0.12
_HEAD_PRESS_M, _HEAD_DECAY_S = 0.008, 0.035
"""A head gives way by 8 mm under a 5 m/s stroke (HUMANS: calculated)."""

_STILL = (0.0, 0.0, 0.0, 0.0)
_DECAYS = 9.2
"""After so many decays a ten-thousandth is left: the piece is still."""


@dataclass(frozen=True, eq=False)
class Instrument:
    """One piece's response: its strokes' times, the complex swing after each, and for how long it then moves.

    `axis`: the shares of the two directions in the swing.
    """

    times_s: list[float]
    swing: list[complex]
    force: list[float]
    axis: tuple[float, float]
    rate: complex
    drum: bool
    rings_s: float

    def at(self, time_s: float) -> tuple[float, float, float, float]:
        """Tip about the piece's right and away axes, flash 0 … 1, and how deep the head is pressed."""
        i = bisect_right(self.times_s, time_s) - 1
        if i < 0:
            return _STILL
        ago = time_s - self.times_s[i]
        if ago > self.rings_s:
            return _STILL
        swing = (self.swing[i] * cmath.exp(self.rate * ago)).imag
        flash = self.force[i] * math.exp(-ago / _FLASH_DECAY_S)
        press = _HEAD_PRESS_M * self.force[i] * math.exp(-ago / _HEAD_DECAY_S) if self.drum else 0.0
        return self.axis[0] * swing, self.axis[1] * swing, flash, press


def instruments(score: Score, kit: Kit, onset_s: Array, strike_m: Array) -> list[Instrument]:
    """The response of every piece of `kit`, in its order, to the strokes at `strike_m` (n, 3)."""
    played = np.array([kit.stand_in_table[p] for p in score.notes["piece"].tolist()], np.int64)
    result = []
    for piece in kit.pieces.values():
        rows = np.flatnonzero(played == piece.piece)
        rows = rows[np.argsort(onset_s[rows], kind="stable")]
        result.append(_instrument(piece, onset_s[rows], score.notes["velocity"][rows], strike_m[rows]))
    return result


def _instrument(piece: KitPiece, times_s: Array, velocity: Array, strike_m: Array) -> Instrument:
    force = (np.asarray(velocity, np.float64) / 127).tolist()
    cymbal = piece.kind in ("cymbal", "hihat")
    size = piece.radius_m / _CYMBAL_REFERENCE_M
    if cymbal:
        push, decay = _CYMBAL_PUSH_RAD / size**2, _CYMBAL_DECAY_S
        turns = 2 * math.pi * _CYMBAL_HZ / size**_CYMBAL_SLOWS
    else:
        push, decay, turns = _DRUM_PUSH_RAD, _DRUM_DECAY_S, 2 * math.pi * _DRUM_HZ
    if piece.kind == "hihat":
        push *= 0.15  # the clutch and the foot hold it
    rate = complex(-1 / decay, turns)
    swing, state, last = [], 0j, 0.0
    for at, f in zip(times_s.tolist(), force, strict=True):
        state = state * cmath.exp(rate * (at - last)) + push * f
        last = at
        swing.append(state)
    right, away, _ = piece.axes
    arm = (strike_m - piece.centre).mean(0) if len(strike_m) else -away
    # a push down on the near side (−away) tips the near edge down: positive about the piece's right axis
    tips = np.array([-(arm @ away), arm @ right])
    norm = float(np.hypot(*tips)) or 1.0
    reach = min(1.0, norm / piece.radius_m) / norm if cymbal else 1.0 / norm
    axis = (float(tips[0] * reach), float(tips[1] * reach))
    return Instrument(times_s.tolist(), swing, force, axis, rate, not cymbal, _DECAYS * decay)
