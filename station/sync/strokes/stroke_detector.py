"""Strokes of one stick from its motion: preparation, fall, contact, rebound, and armed anew by angle.

A contact turns the stick's fall round within 3–6 ms (Wagner 2006); a hand, which at the very most moves up and down at
10 Hz (Fujii 2009), can take no more than 2π·10 Hz of a movement's speed away each second: 31 % in 5 ms. So a stroke is
a fall that loses most of its speed at once. Lifts, waves, twirls and twitches lose it slowly, whatever their size.
After a contact the detector is deaf until the tip has been raised again by an angle: the contact's own ringing does not
raise it, the smallest bounce of a buzz does. No time is masked beyond the contact itself.

`fall` is the downward part of the rate at which the stick's direction turns (rad/s, + down): a twist about the stick's
own axis does not enter, nor how the sensor is rolled. Tip velocity = rate × lever arm about the fulcrum + the hand's,
downwards, as far as it is known: the sensor's acceleration less gravity, integrated since the stick last stood still or
turned round at the top. Sideways the hand travels from drum to drum, and nothing tells how fast.
"""

import math
from collections import deque
from itertools import pairwise
from typing import NamedTuple

from station.core.events import StickStroke
from station.core.imu import STANDARD_GRAVITY_M_S2, ImuSample, Mounting, Vector
from station.core.units import NS_PER_S
from station.sync.strokes.contact import contact_of
from station.sync.strokes.stick_axes import Rows, rows_of, turned
from station.sync.strokes.stick_orientation import CALM_G, LONGEST_GAP_S, StickMotion, StickOrientation

SUDDEN_S = 0.005
COARSE_S = 0.010
"""A contact takes the speed away within `SUDDEN_S`, smeared by a coarse sensor's samples within two of them, up to
this: longer would be a hand's time."""
SUDDEN_SHARE = 0.65
"""The share of a fall's speed that a contact takes in that time: one that does not rebound takes all of it within 6 ms;
a hand at 10 Hz takes 31 % in 5 ms and 63 % in 10 ms."""
SLOWEST_FALL_RAD_S = 1.0
"""A slower fall is no stroke: 0.3 m/s at the tip, as after a free fall from 4 mm."""
LEAST_RAD = 0.01
"""A shorter fall is no stroke, a shorter rise arms nothing: 3 mm at the tip, as a free bounce of 50 ms rises (g t²/8),
the shortest of a double stroke (HUMANS.md)."""
RAISED_S = 0.003
"""Armed again when raised by what the stick fell within the shortest contact (3 ms): one that rebounds at 0.3 needs
10 ms for that."""
SUNK_RAD = 0.04
"""Or when it has sunk by 1 cm at the tip since the contact: a head does not give way so far (8 mm at 5 m/s, HUMANS.md),
so the stick was in the air; the hand went down as the tip bounced."""
AFTER_S = 0.012
"""So long after a contact was noticed its pulse and rebound are gathered: twice the longest contact."""
KEPT_S = 0.045
"""How much of the past is kept: contact, gathering and what came just before; at 100 Hz four samples."""
STILL_RAD_S, STILL_M_S = 0.2, 0.05
"""A stick that turns more slowly, at about 1 g, stands still: 5 cm/s at the tip; our choice."""
TURNING_M_S = 0.5
"""How fast the hand may be while the stick turns round at the top: in the recorded stroke (HUMANS.md) it sinks 5 cm in
the slow fall of 92 ms."""
HAND_M_S = 1.5
"""How much the hand itself may add to a tip's speed, give or take: in the recorded stroke up to 3.2 m/s, at the contact
0.5; our choice, between."""
TRAVEL_S = 0.1
"""For so long the hand's pushes sideways are remembered: half a travel of 0.25 s from drum to drum (HUMANS.md). What
speed they make is what the hand may have downwards too, at the top of a stroke on the way."""
CONTACT_M_S = 10.0
"""How wrong the sensor's velocity may be after a contact, which no accelerometer follows: the fastest tip's own."""
FULCRUM_SHARE = 1 / 3
"""A stick turns about a third of its length from the butt (HUMANS.md)."""
DRIFT_M_S2 = 0.35
"""How fast the integrated velocity goes wrong: a tilt that is 2° off, as VQF's is in motion (Laidig & Seel 2023)."""


class _Instant(NamedTuple):
    at_s: float
    fall: float
    speed: float
    height: float
    sine: float
    roll: float
    is_clipped: bool


class StrokeDetector:
    """Finds the strokes of one stick; `feed` it every sample of the sensor in order."""

    def __init__(self, device: str, mounting: Mounting) -> None:
        self.device, self.mounting = device, mounting
        self.orientation = StickOrientation(mounting)
        self._lever = (mounting.tip_m + mounting.butt_m) * (1 - FULCRUM_SHARE)
        self._begin_ns: int | None = None
        self._start()

    def _start(self) -> None:
        self._kept: deque[_Instant] = deque()
        self._velocity = self._force = 0.0  # of the sensor, upwards
        self._push = 0.0  # the mean of its acceleration sideways
        self._doubt = CONTACT_M_S
        self._below = self._sink = 0.0  # how far the tip has sunk since its top, and how fast it does
        self._is_armed = True
        self._fastest = 0.0  # of this fall
        self._top = self._low = self._high = 0.0
        self._raise = 0.0
        self._due_s: float | None = None  # when a contact that was noticed is told, and from when on it may have been
        self._since_s = 0.0

    def feed(self, sample: ImuSample) -> list[StickStroke]:
        """The strokes that are certain with `sample`: about 15 ms after their contact."""
        return [stroke for motion in self.orientation.feed(sample) if (stroke := self.move(motion)) is not None]

    def move(self, motion: StickMotion) -> StickStroke | None:
        """The stroke that is certain with the stick's next `motion`."""
        if self._begin_ns is None:
            self._begin_ns = motion.at_ns
        if self._kept and motion.at_ns - self._begin_ns > (self._kept[-1].at_s + LONGEST_GAP_S) * NS_PER_S:
            self._start()
        now = self._instant(motion)
        if now is None:
            return None
        self._arm(now)
        if self._due_s is None:
            if self._is_armed and self._is_contact(now):
                self._doubt = CONTACT_M_S
                self._is_armed, self._due_s = False, now.at_s + self._after_s()
                self._since_s = self._earlier(now).at_s
                self._low = self._high = now.sine
                self._raise = max(LEAST_RAD, self._fastest * RAISED_S)
            return None
        if now.at_s < self._due_s:
            return None
        self._due_s = None
        return self._stroke(motion.is_derived)

    # --- the stick's motion -------------------------------------------------------------------------------------------

    def _instant(self, motion: StickMotion) -> _Instant | None:
        assert self._begin_ns is not None
        at_s = (motion.at_ns - self._begin_ns) / NS_PER_S
        kept = self._kept
        rows = rows_of(motion.turn)
        _, y, z = motion.rate_rad_s
        _, left, up = rows[2]
        fall = up * y - left * z
        before = kept[-1] if kept else None
        dt_s = 0.0 if before is None else at_s - before.at_s
        speed = self._tip(rows, motion, fall, dt_s)
        now = _Instant(at_s, fall, speed, self._below, rows[2][0], math.atan2(left, up), motion.is_clipped)
        kept.append(now)
        while self._due_s is None and kept[0].at_s < at_s - max(KEPT_S, 4 * dt_s):
            kept.popleft()
        return now if before is not None else None

    def _tip(self, rows: Rows, motion: StickMotion, fall: float, dt_s: float) -> float:
        """The tip's speed; keeps the sensor's velocity and how far the tip is below its highest point."""
        force = turned(rows, motion.acceleration_m_s2)
        before = self._kept[-1].fall if self._kept else 0.0
        half = 0.5 * dt_s
        vz = self._velocity + half * (self._force + force[2] - 2.0 * STANDARD_GRAVITY_M_S2)
        self._doubt += DRIFT_M_S2 * dt_s
        self._push += (math.hypot(force[0], force[1]) - self._push) * min(dt_s / TRAVEL_S, 1.0)
        is_still = self._is_still(fall, force)
        if is_still or before <= 0.0 < fall:
            known = STILL_M_S if is_still else math.hypot(TURNING_M_S, self._push * TRAVEL_S)
            share = known**2 / (known**2 + self._doubt**2)
            if share < 0.5:
                self._below = 0.0
            vz *= share
            self._doubt *= math.sqrt(share)
        self._velocity, self._force = vz, force[2]
        _, p, q = motion.rate_rad_s
        wx, wy, _ = turned(rows, (0.0, q * self._lever, -p * self._lever))
        down = self._down(fall, fall * self.mounting.tip_m - vz)
        sink = max(0.0, down)
        self._below = self._below + 0.5 * (self._sink + sink) * dt_s if sink > 0.0 else 0.0
        self._sink = sink
        return math.sqrt(wx**2 + wy**2 + down**2)

    def _down(self, fall: float, integrated: float) -> float:
        """The tip's speed downwards: of turning about the fulcrum, and `integrated`, weighed by their variances."""
        turned_m_s = fall * self._lever
        share = HAND_M_S**2 / (HAND_M_S**2 + self._doubt**2)
        return turned_m_s + (integrated - turned_m_s) * share

    def _is_still(self, fall: float, force: Vector) -> bool:
        if abs(fall) >= STILL_RAD_S:
            return False
        x, y, z = force
        size = math.sqrt(x * x + y * y + z * z)
        return abs(size - STANDARD_GRAVITY_M_S2) < CALM_G * STANDARD_GRAVITY_M_S2

    # --- the machine --------------------------------------------------------------------------------------------------

    def _arm(self, now: _Instant) -> None:
        if not self._is_armed:
            self._low, self._high = min(self._low, now.sine), max(self._high, now.sine)
            is_free = now.sine - self._low >= self._raise or self._high - now.sine >= SUNK_RAD
            self._is_armed = is_free and self._due_s is None
            self._fastest, self._top = 0.0, now.sine
        if self._is_armed:
            if now.fall <= 0.0 and self._kept[-2].fall <= 0.0:
                self._fastest, self._top = 0.0, now.sine
            self._top = max(self._top, now.sine)
            self._fastest = max(self._fastest, now.fall)

    def _is_contact(self, now: _Instant) -> bool:
        if self._fastest < SLOWEST_FALL_RAD_S or self._top - min(i.sine for i in self._kept) < LEAST_RAD:
            return False
        return self._earlier(now).fall - now.fall >= SUDDEN_SHARE * self._fastest

    def _earlier(self, now: _Instant) -> _Instant:
        """What was `SUDDEN_S` ago; with a coarse sensor two samples ago, within `COARSE_S`, or one."""
        kept = self._kept
        interval_s = now.at_s - kept[-2].at_s
        back_s = 1.01 * max(SUDDEN_S, min(2 * interval_s, COARSE_S))
        earlier = kept[-2]
        for instant in reversed(kept):
            if instant.at_s < now.at_s - back_s:
                break
            if instant is not now:
                earlier = instant
        return earlier

    def _after_s(self) -> float:
        interval_s = self._kept[-1].at_s - self._kept[-2].at_s
        return max(AFTER_S, 1.01 * interval_s)

    def _stroke(self, is_derived: bool) -> StickStroke | None:
        """The contact that was noticed; None where the tip came to it too slowly."""
        kept = list(self._kept)
        pairs = list(pairwise(kept))
        interval_s = min(b.at_s - a.at_s for a, b in pairs)
        times = [(a.at_s + b.at_s) / 2 for a, b in pairs]
        pulse = [max(0.0, (a.fall - b.fall) / (b.at_s - a.at_s)) for a, b in pairs]
        peak = max((k for k, at_s in enumerate(times) if at_s >= self._since_s), key=lambda k: pulse[k])
        contact = contact_of(times, pulse, interval_s, peak)
        onset_s = contact.onset_s - (interval_s / 2 if is_derived else 0.0)
        foot = max(contact.first, 1)
        clean = kept[foot] if kept[foot].fall > kept[foot - 1].fall else kept[foot - 1]  # the foot's own may be smeared
        earlier = max((i for i in kept if i.at_s <= clean.at_s - SUDDEN_S), default=kept[0])
        left_s = max(0.0, onset_s - clean.at_s)
        speed, fall = _at_onset(clean.speed, earlier.speed, clean, earlier, left_s), clean.fall
        if speed < SLOWEST_FALL_RAD_S * self._lever:
            return None
        is_clipped = any(instant.is_clipped for instant in kept)
        up = -min(i.fall for i in kept[contact.last + 1 : contact.last + 3])  # the foot's own may be smeared
        assert self._begin_ns is not None
        return StickStroke(
            self._begin_ns + round(onset_s * NS_PER_S),
            self.device,
            self.mounting.limb,
            speed,
            clean.height + speed * left_s,
            None if is_clipped else min(max(up * self._lever / speed, 0.0), 1.0),
            math.asin(min(max(clean.sine - fall * left_s, -1.0), 1.0)),
            is_clipped,
            roll_rad=clean.roll,
        )


def _at_onset(value: float, before: float, clean: _Instant, earlier: _Instant, left_s: float) -> float:
    """What goes on as it did from `earlier` to `clean`, at the contact's onset `left_s` later."""
    span_s = clean.at_s - earlier.at_s
    return max(0.0, value + (value - before) * left_s / span_s) if span_s > 0.0 else value
