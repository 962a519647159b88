"""A stick played in the air, from kinematics alone: what a sensor near its grip measures, and when each beat was meant.

The stick swings in a vertical plane about a grip that moves with it (HUMANS, Pearl 2023: the hand has a third of the
tip's speed). A stroke speeds the tip up along a raised cosine and brakes it along another, shorter one. Position is
summed from it at 20 kHz and differentiated twice; the beat is where the tip's acceleration is greatest while it is
being braked (after L. Dahl, NIME 2014), found on that fine grid. No reckoning of the station's own is used.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.core.imu import ImuSample, Quaternion, Vector
from station.sync.strokes.stick_orientation import StickMotion

Array = NDArray[np.float64]
FINE_HZ = 20_000.0
GRIP_TO_TIP_M, SENSOR_BEHIND_GRIP_M = 0.27, 0.06
HAND_SHARE = 0.34
LINGERS_S = 0.03
"""So long the stick stays where it was stopped."""
GRAVITY = 9.80665


@dataclass(frozen=True)
class Stroke:
    """The tip is fastest at `at_s`; degrees where the stick comes to rest; `brake_s` from the fastest point to rest."""

    at_s: float
    speed_m_s: float = 4.0
    heading_deg: float = 0.0
    low_deg: float = -10.0
    brake_s: float = 0.05
    push_s: float = 0.12


@dataclass(frozen=True)
class Played:
    """`at_ns` (n,), acceleration and rate (n, 3) in the stick's axes, turn (n, 4) earth from stick; true beats."""

    at_ns: NDArray[np.int64]
    acceleration: Array
    rate: Array
    turn: Array
    beat_s: Array
    strokes: tuple[Stroke, ...]

    def motions(self) -> list[StickMotion]:
        """What a perfect orientation filter would tell."""
        columns = zip(self.at_ns, self.turn, self.rate, self.acceleration, strict=True)
        return [StickMotion(int(t), _four(q), _three(r), _three(a), False, False, False) for t, q, r, a in columns]

    def samples(self) -> list[ImuSample]:
        """What the sensor sends."""
        columns = zip(self.at_ns, self.acceleration, self.rate, strict=True)
        return [ImuSample(int(t), _three(a), _three(r)) for t, a, r in columns]


def play(strokes: tuple[Stroke, ...], rate_hz: float, seconds: float, seed: int = 1, offset_s: float = 0.0) -> Played:
    """The strokes as a sensor at `rate_hz` measures them, with a usual MEMS sensor's noise (0.03 m/s², 0.1 °/s)."""
    fine_s = np.arange(0.0, seconds, 1.0 / FINE_HZ)
    elevation, heading = _elevation(strokes, fine_s), _heading(strokes, fine_s)
    along = np.stack([np.cos(elevation) * np.cos(heading), np.cos(elevation) * np.sin(heading), np.sin(elevation)], 1)
    tip_drop = GRIP_TO_TIP_M * elevation * HAND_SHARE
    grip = tip_drop[:, None] * np.array([0.0, 0.0, 1.0])
    moved = _twice_differentiated(grip - SENSOR_BEHIND_GRIP_M * along, fine_s)
    tip = _twice_differentiated(grip + GRIP_TO_TIP_M * along, fine_s)
    beats = np.array([_beat(fine_s, tip, each) for each in strokes])
    at_s = np.arange(0.02 + offset_s, seconds - 0.02, 1.0 / rate_hz)
    pick = np.rint(at_s * FINE_HZ).astype(np.int64)
    axes = _axes(elevation[pick], heading[pick])
    force = np.einsum("nij,ni->nj", axes, moved[pick] + np.array([0.0, 0.0, GRAVITY]))
    falling, turning = np.gradient(elevation, fine_s)[pick], np.gradient(heading, fine_s)[pick]
    sine, cosine = np.sin(elevation[pick]), np.cos(elevation[pick])
    rate = np.stack([turning * sine, -falling, turning * cosine], 1)
    noise = np.random.default_rng(seed)
    force += noise.normal(0.0, 0.03, force.shape)
    rate += noise.normal(0.0, np.radians(0.1), rate.shape)
    return Played(
        (fine_s[pick] * 1e9).astype(np.int64), force, rate, _turn(elevation[pick], heading[pick]), beats, strokes
    )


def _elevation(strokes: tuple[Stroke, ...], fine_s: Array) -> Array:
    """Angle of the stick (n,): the falls and brakes, and slow ways up to where the next fall starts."""
    rate = np.zeros_like(fine_s)
    knots: list[tuple[float, float]] = []
    for each in strokes:
        fastest = each.speed_m_s / (GRIP_TO_TIP_M * (1.0 + HAND_SHARE))
        since = fine_s - each.at_s
        push, brake = (since >= -each.push_s) & (since < 0), (since >= 0) & (since < each.brake_s)
        rate[push] = -fastest * (1 + np.cos(np.pi * since[push] / each.push_s)) / 2
        rate[brake] = -fastest * (1 + np.cos(np.pi * since[brake] / each.brake_s)) / 2
        fall = fastest * (each.push_s + each.brake_s) / 2
        knots += [
            (each.at_s - each.push_s, np.radians(each.low_deg) + fall),
            (each.at_s + each.brake_s + LINGERS_S, np.radians(each.low_deg)),
        ]
    for (begin, low), (end, high) in zip(knots[1::2], knots[2::2], strict=False):
        way = (fine_s >= begin) & (fine_s < end)
        rate[way] = (high - low) / (end - begin) * (1 - np.cos(2 * np.pi * (fine_s[way] - begin) / (end - begin)))
    return np.asarray(knots[0][1] + np.cumsum(rate) / FINE_HZ)


def _heading(strokes: tuple[Stroke, ...], fine_s: Array) -> Array:
    """Heading (n,): it moves between strokes, while the stick rises."""
    heading = np.full_like(fine_s, np.radians(strokes[0].heading_deg))
    for one, after in pairwise(strokes):
        begin, end = one.at_s + one.brake_s + LINGERS_S, after.at_s - after.push_s
        share = np.clip((fine_s - begin) / (end - begin), 0.0, 1.0)
        heading += np.radians(after.heading_deg - one.heading_deg) * (1 - np.cos(np.pi * share)) / 2
    return heading


def _twice_differentiated(position: Array, fine_s: Array) -> Array:
    return np.asarray(np.gradient(np.gradient(position, fine_s, axis=0), fine_s, axis=0))


def _beat(fine_s: Array, moved: Array, stroke: Stroke) -> float:
    within = np.flatnonzero((fine_s >= stroke.at_s) & (fine_s <= stroke.at_s + stroke.brake_s))
    return float(fine_s[within[np.argmax(np.linalg.norm(moved[within], axis=1))]])


def _axes(elevation: Array, heading: Array) -> Array:
    """The stick's axes as columns (n, 3, 3): along, to the left, up."""
    zero = np.zeros_like(heading)
    along = np.stack([np.cos(elevation) * np.cos(heading), np.cos(elevation) * np.sin(heading), np.sin(elevation)], 1)
    left = np.stack([-np.sin(heading), np.cos(heading), zero], 1)
    return np.stack([along, left, np.cross(along, left)], 2)


def _turn(elevation: Array, heading: Array) -> Array:
    """Quaternions (n, 4): first down by minus the elevation about y, then about the vertical."""
    ch, sh, cp, sp = np.cos(heading / 2), np.sin(heading / 2), np.cos(-elevation / 2), np.sin(-elevation / 2)
    return np.stack([ch * cp, -sh * sp, ch * sp, sh * cp], 1)


def _three(row: Array) -> Vector:
    return float(row[0]), float(row[1]), float(row[2])


def _four(row: Array) -> Quaternion:
    return float(row[0]), float(row[1]), float(row[2]), float(row[3])
