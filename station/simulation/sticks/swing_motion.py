"""The path of one stick through space, finely: where its fulcrum is and how it is turned, and what acts on it.

Axes of the room: x to the drummer's right, y forward, z up. The stick's attitude is heading (about z), then elevation
(tip up), then roll about itself: R = Rz(heading) · Ry(−elevation) · Rx(roll), which takes the stick's axes (x to the
tip, z up while it lies, y left) to the room's.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.imu import STANDARD_GRAVITY_M_S2
from station.core.pieces import Limb, Piece
from station.simulation.sticks.swing_body import FULCRUM_M, LENGTH_M, STICK_5A, fulcrum_kick_m, ringing
from station.simulation.sticks.swing_contact import Contact
from station.simulation.sticks.swing_gestures import added_motion
from station.simulation.sticks.swing_path import along, smooth_steps
from station.simulation.sticks.swing_places import CLICK_PLACE, heading_rad, place
from station.simulation.sticks.swing_plan import REACH_M, hand_knots, tip_knots
from station.simulation.sticks.swing_spec import StickGesture, StrokeKind

Floats = NDArray[np.float64]

FINE_HZ = 8000
"""Steps of the path a second; our choice: ten for the shortest contact, far beyond any sensor's band."""

LEAST_TRAVEL_S, MOST_TRAVEL_S = 0.05, 0.5
"""A reach of 40 cm takes about 0.25 s (`shared/HUMANS.md`), less where there is no time."""
TREMOR_HZ, TREMOR_RAD, TREMOR_M = (8.0, 12.0), 0.002, 0.0002
"""Physiological tremor of a hand: 8–12 Hz, a fraction of a millimetre (Elble & Koller 1990)."""
SWAY_HZ, SWAY_RAD, SWAY_M = (0.1, 0.7), 0.05, 0.008
"""How the arms wander while a player plays; our choice: a few degrees, a centimetre."""
STEEP, STEEPEST = math.sin(math.radians(50)), math.sin(math.radians(78))
"""From which elevation on a stick rises less than the hand, and where it never gets (0–71° in Pearl 2023)."""
KICK_S = 0.02
"""How long the hand takes to take up what an impact throws at the fulcrum (our choice)."""


@dataclass(frozen=True, slots=True)
class Grip:
    """How a hand turns a stick that rises by an angle: rolled, and to its left, as shares of that angle."""

    roll_rad: float = 0.0
    roll_share: float = 0.0
    turn_share: float = 0.0


GRIPS = {
    "german": Grip(0.0, 0.05, 0.02),
    "american": Grip(0.5, 0.25, 0.06),
    "french": Grip(1.4, 0.10, 0.12),
    "traditional": Grip(2.6, 0.60, -0.20),
}
"""Palms flat, at 45°, facing each other, and the left hand under the stick; shares are our choice."""


@dataclass(frozen=True, slots=True)
class StickPath:
    """A stick's path at `time_s` (n,): its `fulcrum_m` (n, 3), `heading`, `elevation` and `roll` in rad (n,) each.

    `contact_force_n` (n,) acts on it along its own z axis at `struck_m` (n,) from the butt.
    """

    limb: Limb
    time_s: Floats
    fulcrum_m: Floats
    heading_rad: Floats
    elevation_rad: Floats
    roll_rad: Floats
    contact_force_n: Floats
    struck_m: Floats

    def axes(self) -> Floats:
        """The stick's axes in the room, (n, 3, 3): column 0 its x axis."""
        return rotation(self.heading_rad, self.elevation_rad, self.roll_rad)

    def point_m(self, from_butt_m: float) -> Floats:
        """Where the point of the stick `from_butt_m` from its butt is, (n, 3)."""
        forward = self.axes()[:, :, 0]
        return self.fulcrum_m + (from_butt_m - FULCRUM_M) * forward

    def force_free_of_gravity(self, at_m: float) -> Floats:
        """What an ideal accelerometer at `at_m` from the butt reads, (n, 3) in m/s², in the stick's axes."""
        step = 1.0 / FINE_HZ
        moved = self.point_m(at_m)
        acceleration = np.gradient(np.gradient(moved, step, axis=0), step, axis=0)
        acceleration[:, 2] += STANDARD_GRAVITY_M_S2
        felt: Floats = np.einsum("nij,ni->nj", self.axes(), acceleration)
        felt[:, 2] += self._ring(at_m)
        return felt

    def rate_rad_s(self) -> Floats:
        """What an ideal gyroscope reads anywhere on the stick, (n, 3), in the stick's axes."""
        step = 1.0 / FINE_HZ
        turn, rise, roll = (np.gradient(a, step) for a in (self.heading_rad, self.elevation_rad, self.roll_rad))
        cos, sin = np.cos(self.roll_rad), np.sin(self.roll_rad)
        flat, steep = np.cos(self.elevation_rad), np.sin(self.elevation_rad)
        return np.stack([roll + turn * steep, -rise * cos + turn * flat * sin, rise * sin + turn * flat * cos], axis=1)

    def _ring(self, at_m: float) -> Floats:
        ring = np.zeros(len(self.time_s))
        for struck in np.unique(self.struck_m[self.contact_force_n != 0]):
            force = np.where(self.struck_m == struck, self.contact_force_n, 0.0)
            for start, stop_of, stop in _bursts(force != 0, FINE_HZ // 10):
                blow = np.where(np.arange(start, stop) < stop_of, force[start:stop], 0.0)
                ring[start:stop] += ringing(blow, 1.0 / FINE_HZ, float(struck), at_m)
        return ring


def rotation(heading: Floats, elevation: Floats, roll: Floats) -> Floats:
    """Matrices (n, 3, 3) that take the stick's axes to the room's."""
    ch, sh = np.cos(heading), np.sin(heading)
    ce, se = np.cos(elevation), np.sin(elevation)
    cr, sr = np.cos(roll), np.sin(roll)
    rows = [
        [ch * ce, -sh * cr - ch * se * sr, sh * sr - ch * se * cr],
        [sh * ce, ch * cr - sh * se * sr, -ch * sr - sh * se * cr],
        [se, ce * sr, ce * cr],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def stick_motion(
    touches: Sequence[Contact],
    gestures: Sequence[StickGesture],
    limb: Limb,
    span_s: tuple[float, float],
    grip: Grip,
    rng: np.random.Generator,
) -> StickPath:
    """The path of `limb`'s stick over `span_s` through its `touches`, with its `gestures` beside them."""
    time_s = np.arange(math.floor((span_s[1] - span_s[0]) * FINE_HZ)) / FINE_HZ + span_s[0]
    lead_s = (touches[0].onset_s - span_s[0]) if touches else 0.0
    knots = tip_knots(touches, lead_s)
    tip_m, hand_m = along(knots, time_s), along(hand_knots(knots, touches), time_s)
    target, heading, angle, reach = _targets(touches, limb, time_s)
    sine = _within_reach(np.sin(angle) + (tip_m - hand_m) / reach)
    hand_m = tip_m + reach * (np.sin(angle) - sine)
    rise = np.arcsin(sine)
    fulcrum = target.copy()
    fulcrum[:, 0] -= np.cos(heading) * np.cos(angle) * reach
    fulcrum[:, 1] -= np.sin(heading) * np.cos(angle) * reach
    fulcrum[:, 2] += hand_m - reach * np.sin(angle)
    added = added_motion(gestures, time_s, fulcrum)
    shaken = _restlessness(time_s, 1 - 0.95 * added["calm"], rng)
    fulcrum += np.stack([added["x_m"], added["y_m"], added["z_m"]], axis=1) + shaken[:, :3]
    turned = rise - angle
    force, struck = _forces(touches, time_s)
    fulcrum[:, 2] += _kicks(touches, time_s)
    return StickPath(
        limb,
        time_s,
        fulcrum,
        heading + added["turn_rad"] + grip.turn_share * turned + shaken[:, 3],
        rise + added["rise_rad"] + shaken[:, 5],
        grip.roll_rad + grip.roll_share * turned + added["roll_rad"] + shaken[:, 4],
        force,
        struck,
    )


def _within_reach(sine: Floats) -> Floats:
    """The sine of the stick's elevation (n,), kept below `STEEPEST` with two derivatives; the hand does the rest."""
    room = STEEPEST - STEEP
    excess = np.maximum(np.abs(sine) - STEEP, 0)
    return np.asarray(np.clip(sine, -STEEP, STEEP) + np.sign(sine) * room * np.tanh(excess / room))


def _targets(touches: Sequence[Contact], limb: Limb, time_s: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Where the hand aims (n, 3), its heading, the elevation at impact and the reach from the fulcrum, (n,) each."""
    aims = []
    for touch in touches:
        at = CLICK_PLACE if touch.kind is StrokeKind.CLICK else place(touch.piece)
        aims.append((*at, heading_rad(limb, at) + touch.aside_rad, touch.angle_rad, touch.struck_m - FULCRUM_M))
    if not aims:
        at = place(Piece.SNARE)
        aims = [(*at, heading_rad(limb, at), 0.05, REACH_M)]
    rows = [_moves(touches, [aim[column] for aim in aims], time_s) for column in range(6)]
    return np.stack(rows[:3], axis=1), rows[3], rows[4], rows[5]


def _moves(touches: Sequence[Contact], aims: list[float], time_s: Floats) -> Floats:
    steps = [(float(time_s[0]), float(time_s[0]), aims[0])]
    for before, following, aim in zip(touches, touches[1:], aims[1:], strict=False):
        gap = following.onset_s - before.end_s
        lasts = min(max(gap * 0.7, LEAST_TRAVEL_S), MOST_TRAVEL_S, gap * 0.95)
        steps.append((before.end_s + 0.15 * (gap - lasts), before.end_s + 0.15 * (gap - lasts) + lasts, aim))
    return smooth_steps(steps, time_s)


def _forces(touches: Sequence[Contact], time_s: Floats) -> tuple[Floats, Floats]:
    """The force of the contacts along the stick's z axis in N, and where it acts in m from the butt, (n,) each."""
    force, struck = np.zeros(len(time_s)), np.full(len(time_s), LENGTH_M)
    body = STICK_5A
    about_fulcrum = body.inertia_kg_m2 + body.mass_kg * (body.centre_m - FULCRUM_M) ** 2
    for touch in touches:
        if touch.kind is StrokeKind.AIR:
            continue
        inside = slice(*np.searchsorted(time_s, [touch.onset_s, touch.end_s]).tolist())
        s = (time_s[inside] - touch.onset_s) / touch.lasts_s
        push = 6 * s * (1 - s) * (touch.speed_m_s + touch.speed_after_m_s) / touch.lasts_s
        force[inside] = push * about_fulcrum / (touch.struck_m - FULCRUM_M) ** 2
        struck[inside] = touch.struck_m
    return force, struck


def _kicks(touches: Sequence[Contact], time_s: Floats) -> Floats:
    """How far impacts throw the fulcrum up or down, in m: a jump of speed that the hand takes up within `KICK_S`."""
    moved = np.zeros(len(time_s))
    for touch in touches:
        if touch.kind is StrokeKind.AIR:
            continue
        reach = touch.struck_m - FULCRUM_M
        jump = fulcrum_kick_m(touch.struck_m) * (touch.speed_m_s + touch.speed_after_m_s) / reach
        start = int(np.searchsorted(time_s, touch.onset_s))
        t = time_s[start : start + int(12 * KICK_S * FINE_HZ)] - touch.onset_s
        grown = 1 - np.exp(-((t / touch.lasts_s) ** 2))
        moved[start : start + len(t)] += jump * t * np.exp(-t / KICK_S) * grown
    return moved


def _restlessness(time_s: Floats, gain: Floats, rng: np.random.Generator) -> Floats:
    """Tremor and sway of three places (m) and three angles (rad), (n, 6)."""
    shaken = np.zeros((len(time_s), 6))
    for column in range(6):
        sizes = (TREMOR_M, SWAY_M) if column < 3 else (TREMOR_RAD, SWAY_RAD)
        for band, size in zip((TREMOR_HZ, SWAY_HZ), sizes, strict=True):
            for _ in range(3):
                hertz, phase = rng.uniform(*band), rng.uniform(0, 2 * math.pi)
                shaken[:, column] += size / 3 * np.sin(2 * math.pi * hertz * time_s + phase)
    result: Floats = shaken * gain[:, None]
    result[:, 5] *= 0.2  # the elevation is what a player controls: the tip must meet the head when it is meant to
    result[:, 2] *= 0.2
    return result


def _bursts(active: NDArray[np.bool_], tail: int) -> list[tuple[int, int, int]]:
    """Each run of `active` as (its first index, the index after its last, that with `tail` more)."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], active.astype(np.int8), [0]])))
    return [(int(a), int(b), min(int(b) + tail, len(active))) for a, b in edges.reshape(-1, 2)]
