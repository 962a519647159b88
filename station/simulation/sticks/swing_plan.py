"""How a hand gets from one touch to the next: up, and down again as a whip.

Two coordinates are planned: the tip's height above what it strikes, and the part of it that the hand itself rises.
Given a stroke's height H and speed v, the last descent takes `DESCENT`·H/v; the one stroke that was measured (Pearl
2023: .51 m and 9.4 m/s in 120 ms after a slow fall of 5 cm) gives 2.2. The hand leads: it has most of its speed before
the stick turns in it, and is slow again when the stick strikes (a whip from proximal to distal).
"""

from collections.abc import Sequence

from station.simulation.sticks.swing_body import FULCRUM_M, LENGTH_M
from station.simulation.sticks.swing_contact import Contact
from station.simulation.sticks.swing_path import Knot, knot_between
from station.simulation.sticks.swing_spec import StrokeKind

DESCENT = 2.2
SLOW_FALL = 0.07
"""Share of the height that is lost slowly before the whip (4 of 56 cm, Pearl 2023)."""
CATCH_S, CATCH = 0.030, 1.7
"""After a touch the stick is held again 29 ms later, (speed × time)/1.7 up (Pearl 2023: 4.8 m/s, 8.4 cm)."""
AIR_CATCH_S = 0.12
"""In the air nothing throws the stick back: the arm returns by itself, gently (our choice)."""
HOVER_M = 0.05
"""Where a stick waits above the head; our choice, a fist's height less than the rebound that is caught."""
WAIT_S = 0.10
"""How long a caught stick at least stays low before the next lift, where there is time (our choice)."""
LIFT_M_S = 2.3
"""The tip's greatest speed when it is raised (Pearl 2023)."""
QUICK_LIFT_S, CALM_LIFT_S = 0.06, 0.15
"""The shortest time that a lift takes, and the least where there is no hurry (our choice)."""
TOP_S = 0.12
"""How long the slow fall at the top takes (−212 … −120 ms in Pearl 2023), where there is time."""
LEAST_DOWN = 0.35
"""The least share of a short gap that the descent takes: muscles need time to turn the stick round (our choice)."""
LOW_HAND, MORE_HAND = 0.18, 0.655
"""The hand's rise for a tip at h is h·(0.18 + 0.655 h): 28, 45 and 55 % at 15, 40 and 56 cm. In the descent of Pearl
2023 it was 30, 46 and 58 %, with a reach of 23 cm instead of 27; a hand's share of soft strokes is small, as experts
move the distal joints more (Altenmüller 2020)."""
TURNED_M = (1 - LOW_HAND) / (2 * MORE_HAND)
"""From here on (63 cm) the stick turns no further and the hand does the rest."""
AIR_HAND = 0.4
"""In the air the forearm stops with the stick, which turns about a point 18 cm behind the fulcrum, half way to the
elbow: the hand has 18/(18 + 27) of the tip's motion (our choice)."""
REACH_M = LENGTH_M - FULCRUM_M


def hand_rise(height_m: float) -> float:
    """How far the hand rises for a tip that rises `height_m`, in m: little at first, all of it beyond `TURNED_M`."""
    turned = min(max(height_m, 0.0), TURNED_M)
    return turned * (LOW_HAND + MORE_HAND * turned) + max(height_m - TURNED_M, 0.0)


def tip_knots(touches: Sequence[Contact], lead_s: float) -> list[Knot]:
    """The tip's height over time for one hand's `touches`, from a hover `lead_s` before the first; none: a hover."""
    if not touches:
        return [Knot(0.0, HOVER_M)]
    first = touches[0]
    knots = [Knot(first.onset_s - lead_s, HOVER_M), *_late_rise(first.onset_s - lead_s, HOVER_M, first)]
    for touch, following in zip(touches, [*touches[1:], None], strict=True):
        knots.append(Knot(touch.onset_s, 0.0, -touch.speed_m_s))
        left = Knot(touch.end_s, -touch.sunk_m, touch.speed_after_m_s)
        knots.append(left)
        knots += _after(left, touch) if following is None else _between(left, touch, following)
    return knots


def hand_knots(tip: Sequence[Knot], touches: Sequence[Contact]) -> list[Knot]:
    """The hand's part of the tip's height: it rises with it, comes down before it, and turns round after the touch."""
    onsets = {touch.onset_s: touch for touch in touches}
    ends = {touch.end_s: touch for touch in touches}
    coming = touches[-1] if touches else None
    knots: list[Knot] = []
    for before, knot in zip([tip[0], *tip[:-1]][::-1], tip[::-1], strict=True):
        struck, left = onsets.get(knot.at_s), ends.get(knot.at_s)
        coming = struck or coming
        owner = struck or left or coming
        if owner is not None and owner.kind is StrokeKind.AIR:
            knots.append(Knot(knot.at_s, *(AIR_HAND * value for value in knot[1:])))
        elif left is None:
            knots.append(_led(knot))
        if struck is not None and struck.kind is not StrokeKind.AIR:
            knots += [_led(knot_between(before, knot, share)) for share in (0.85, 0.7, 0.5, 0.25)]
    return knots[::-1]


def _led(knot: Knot) -> Knot:
    """Where the hand is, how fast and how pushed, when the tip is at `knot`: `hand_rise` and its derivatives."""
    low, turned = max(knot.place, 0.0), knot.place < TURNED_M
    slope, bend = (LOW_HAND + 2 * MORE_HAND * low, 2 * MORE_HAND) if turned else (1.0, 0.0)
    return Knot(knot.at_s, hand_rise(low), slope * knot.speed, slope * knot.push + bend * knot.speed**2)


def _between(left: Knot, touch: Contact, following: Contact) -> list[Knot]:
    """From `left`, the end of `touch`, to just before `following`."""
    gap = following.onset_s - left.at_s
    caught = _caught(left, touch.kind is StrokeKind.AIR)
    down = DESCENT * following.height_m * (1 - SLOW_FALL) / following.speed_m_s
    up = max(QUICK_LIFT_S, 2.0 * max(following.height_m - caught.place, 0.0) / LIFT_M_S)
    if gap < caught.at_s - left.at_s + up + down:
        return [_bounce(left, gap, following)]
    if touch.kind.is_caught and gap > caught.at_s - left.at_s + WAIT_S + up + down:
        return [caught, *_late_rise(caught.at_s, caught.place, following)]
    return [caught, *_top(caught.at_s + up, following)]


def _bounce(left: Knot, gap: float, following: Contact) -> Knot:
    """The top of a stroke that has no time to be caught: up with the rebound, round, and down."""
    rise, fall = max(left.speed, 0.05) / CATCH, following.speed_m_s / DESCENT
    share = min(max(rise / (rise + fall), LEAST_DOWN), 1 - LEAST_DOWN)
    down = gap * share
    height = min(fall * down, following.height_m)
    if height < fall * down:
        down = max(height / fall, LEAST_DOWN * gap)
    return Knot(following.onset_s - down, height, 0.0, -(following.speed_m_s / down + left.speed / (gap - down)) / 2)


def _late_rise(from_s: float, place: float, following: Contact) -> list[Knot]:
    """Wait, then rise in time for `following`."""
    down = DESCENT * following.height_m * (1 - SLOW_FALL) / following.speed_m_s
    latest = following.onset_s - down - TOP_S / 2
    quick = max(QUICK_LIFT_S, 2.0 * max(following.height_m - place, 0.0) / LIFT_M_S)
    up = max(quick, min(CALM_LIFT_S, latest - from_s))
    start = latest - up
    waited = [Knot(start, place)] if start > from_s + 0.01 else []
    return waited + _top(max(start, from_s) + up, following)


def _top(top_s: float, following: Contact) -> list[Knot]:
    """The top of a stroke: reached at `top_s`, then a slow fall until the whip begins."""
    height = following.height_m
    down = DESCENT * height * (1 - SLOW_FALL) / following.speed_m_s
    whip_s = following.onset_s - down
    if whip_s - top_s < 0.03:
        return [Knot(top_s, height)]
    fall_speed = -2.0 * SLOW_FALL * height / min(whip_s - top_s, TOP_S)
    waited = [Knot(whip_s - TOP_S, height)] if whip_s - top_s > TOP_S + 0.01 else []
    return [Knot(top_s, height), *waited, Knot(whip_s, height * (1 - SLOW_FALL), fall_speed)]


def _caught(left: Knot, in_air: bool) -> Knot:
    """The stick held again after a touch."""
    lasts = AIR_CATCH_S if in_air else CATCH_S
    return Knot(left.at_s + lasts, left.place + left.speed * lasts / CATCH + 0.005)


def _after(left: Knot, touch: Contact) -> list[Knot]:
    """The end: caught, and brought to the hover."""
    caught = _caught(left, touch.kind is StrokeKind.AIR)
    return [caught, Knot(caught.at_s + 0.4, HOVER_M)]
