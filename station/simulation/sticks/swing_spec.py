"""What a pair of sticks is asked to do: strokes, and motions that are no strokes.

Speeds are those of the point that strikes (the tip, or the shoulder) just before it touches, heights that point's above
the place it will strike.
"""

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from station.core.pieces import Limb, Piece, Zone

REAL_STROKE_HEIGHT_M, REAL_STROKE_SPEED_M_S = 0.56, 9.4
"""The one full stroke that was measured (Pearl 2023, doi 10.1101/2023.10.09.561270)."""

HEIGHT_EXPONENT = 0.8
"""Speed grows with height to this power; our choice between a free fall (0.5) and proportion (1, Dahl 2004)."""

INCH_M = 0.0254
_VELOCITIES = (1.0, 20.0, 49.0, 64.0, 80.0, 96.0, 112.0, 127.0)
_HEIGHTS_IN = (0.5, 1.2, 3.0, 4.5, 6.0, 9.0, 12.0, 15.0)
"""Stick heights of marching practice for p, mp, mf, f, ff, fff at the velocities that notation programs give them; a
ghost stroke at 20 rises about an inch (our choice)."""


class StrokeKind(StrEnum):
    """How a stick strikes. Full, down, tap and up differ in where it starts and where it is left."""

    FULL = "full"
    DOWN = "down"
    TAP = "tap"
    UP = "up"
    BUZZ = "buzz"
    AIR = "air"
    CLICK = "click"

    @property
    def is_caught(self) -> bool:
        """Whether the hand catches the stick low afterwards."""
        return self in (StrokeKind.DOWN, StrokeKind.TAP)


@dataclass(frozen=True, slots=True)
class StickStrokeSpec:
    """One stroke: the stick of `limb` touches at `at_s`; in the air the tip's |acceleration| has its peak then.

    `speed_m_s` is what the hand intends; `height_m` None takes that of `height_for`, and a hand with too little time
    rises less. `rebound` None is drawn (0.3 … 0.6 on a head). `shoulder` strikes with the stick's shoulder, as crashes
    are played. A `BUZZ` lasts `lasts_s` and bounces until then. `CLICK` hits the other stick in the air.
    """

    at_s: float
    limb: Limb
    piece: Piece = Piece.SNARE
    zone: Zone = Zone.HEAD
    speed_m_s: float = 3.3
    height_m: float | None = None
    kind: StrokeKind = StrokeKind.FULL
    rebound: float | None = None
    shoulder: bool = False
    lasts_s: float = 0.0


class GestureKind(StrEnum):
    """What a stick does that is no stroke."""

    LIFT = "lift"
    TWITCH = "twitch"
    WAVE = "wave"
    SCRATCH = "scratch"
    TWIRL = "twirl"
    REST = "rest"
    REGRIP = "regrip"


@dataclass(frozen=True, slots=True)
class StickGesture:
    """A motion without a stroke from `at_s` for `lasts_s` seconds; `size` 1 is the usual one, 2 twice as large."""

    at_s: float
    lasts_s: float
    limb: Limb
    kind: GestureKind
    size: float = 1.0


def height_for(speed_m_s: float) -> float:
    """The height in m from which a stroke usually reaches `speed_m_s`."""
    return REAL_STROKE_HEIGHT_M * math.pow(speed_m_s / REAL_STROKE_SPEED_M_S, 1 / HEIGHT_EXPONENT)


def speed_for(height_m: float) -> float:
    """The tip's speed in m/s that a stroke from `height_m` usually reaches."""
    return REAL_STROKE_SPEED_M_S * math.pow(height_m / REAL_STROKE_HEIGHT_M, HEIGHT_EXPONENT)


def speed_for_velocity(velocity: float) -> float:
    """The tip's speed in m/s for a written velocity 1 … 127."""
    return speed_for(float(np.interp(velocity, _VELOCITIES, _HEIGHTS_IN)) * INCH_M)


def velocity_for_speed(speed_m_s: float) -> float:
    """The velocity 1 … 127 that a pad tells for a tip at `speed_m_s`; the inverse of `speed_for_velocity`."""
    return float(np.interp(height_for(speed_m_s) / INCH_M, _HEIGHTS_IN, _VELOCITIES))
