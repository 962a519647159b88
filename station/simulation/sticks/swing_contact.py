"""What happens at each touch: when it begins, how long it lasts, how fast the tip comes and goes.

A buzz is spelled out into its bounces here. In the air nothing is touched: muscles stop the stick, slower, and the
"contact" is that stop, with the greatest acceleration in its middle.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from station.core.pieces import CYMBALS, Limb, Piece, Zone
from station.simulation.sticks.swing_body import LENGTH_M
from station.simulation.sticks.swing_spec import StickStrokeSpec, StrokeKind, height_for

SLOW_CONTACT_S, FAST_CONTACT_S = 0.006, 0.003
"""Contact with a head lasts 3–6 ms, shorter when louder (Wagner 2006, abstract and § 4)."""
CONTACT_SPEEDS_M_S = (1.0, 9.0)
HARD_CONTACT_S = 0.0012
"""Contact with a rim, a cymbal or another stick; our choice: wood on metal is a millisecond or so."""

HEAD_REBOUND, HARD_REBOUND = (0.35, 0.60), (0.20, 0.40)
"""Speed after over before: 0.51 was measured on a head (Pearl 2023); a cymbal yields and takes more (our choice)."""
AIR_REBOUND = (0.05, 0.25)
AIR_SCATTER_RAD = (0.09, 0.12)
"""In the air nothing is there to aim at: strokes meant for one place scatter by 5° to the sides and 7° up and down
(one deviation; our choice, somewhat under what half a minute of playing spreads over in `data/imu/airdrums`)."""
AIR_STOP_S = (0.045, 0.075)
"""How a hand stops a stick in the air; our choice: slower than any head, as fast as forearm muscles reverse."""

BOUNCE_S = (0.026, 0.036)
BOUNCE_KEEPS = 0.78
"""A pressed roll's bounces: their spacing, and the speed that each keeps (our choice; strokes of a buzz run together
above some 30 a second)."""
SHOULDER_M = 0.33
"""Where the shoulder strikes a crash's edge, from the butt; our choice: between the tip's taper and the middle."""
IMPACT_ANGLE_RAD, ANGLE_SD_RAD = (-0.02, 0.14), 0.01
"""The stick's elevation as it touches a flat pad: 0–8° keeps the bead on the head. A hand has its habit on each piece
and strays from it by half a degree (our choice)."""


@dataclass(frozen=True, slots=True)
class Contact:
    """One touch. `spec` its row in the specification, `bounce` 0 for the stroke itself, 1 … for a buzz's bounces.

    `angle_rad` the stick's elevation at its beginning, `aside_rad` how far to the left of its aim it points.
    """

    spec: int
    bounce: int
    limb: Limb
    piece: Piece
    zone: Zone
    kind: StrokeKind
    onset_s: float
    lasts_s: float
    speed_m_s: float
    rebound: float
    height_m: float
    struck_m: float
    angle_rad: float
    aside_rad: float = 0.0

    @property
    def end_s(self) -> float:
        """When it is over."""
        return self.onset_s + self.lasts_s

    @property
    def speed_after_m_s(self) -> float:
        """Of the tip, away from what it struck."""
        return self.rebound * self.speed_m_s

    @property
    def sunk_m(self) -> float:
        """How far below the first touch the tip is when it leaves; a push that is alike forwards and backwards."""
        return 0.5 * (1 - self.rebound) * self.speed_m_s * self.lasts_s


def contacts(strokes: Sequence[StickStrokeSpec], rng: np.random.Generator) -> list[Contact]:
    """Every touch of `strokes`, by time; several hands may be among them."""
    low, high = IMPACT_ANGLE_RAD
    habits = {limb: low + (high - low) * rng.uniform(size=len(Piece)) for limb in Limb}
    touches = []
    for row, stroke in enumerate(strokes):
        angle = float(habits[stroke.limb][stroke.piece] + rng.normal(0, ANGLE_SD_RAD))
        touches += _touches(row, stroke, angle, rng)
    return _apart(sorted(touches, key=lambda c: c.onset_s))


def _touches(row: int, stroke: StickStrokeSpec, angle_rad: float, rng: np.random.Generator) -> list[Contact]:
    first = _first_touch(row, stroke, angle_rad, rng)
    if stroke.kind is not StrokeKind.BUZZ:
        return [first]
    touches, at_s, speed = [first], first.onset_s, first.speed_m_s
    while (at_s := at_s + rng.uniform(*BOUNCE_S)) < stroke.at_s + stroke.lasts_s:
        speed *= BOUNCE_KEEPS
        bounce = len(touches)
        touches.append(replace(first, bounce=bounce, onset_s=at_s, speed_m_s=max(speed, 0.25), height_m=0.01))
    return touches


def _first_touch(row: int, stroke: StickStrokeSpec, angle_rad: float, rng: np.random.Generator) -> Contact:
    hard = stroke.zone in (Zone.RIM, Zone.EDGE, Zone.BELL, Zone.BOW) or stroke.piece in CYMBALS
    hard = hard or stroke.kind is StrokeKind.CLICK
    in_air = stroke.kind is StrokeKind.AIR
    usual = AIR_REBOUND if in_air else HARD_REBOUND if hard else HEAD_REBOUND
    drawn = float(rng.uniform(*usual))
    stop = float(rng.uniform(*AIR_STOP_S))
    soft = float(np.interp(stroke.speed_m_s, CONTACT_SPEEDS_M_S, (SLOW_CONTACT_S, FAST_CONTACT_S)))
    lasts = stop if in_air else HARD_CONTACT_S if hard else soft
    return Contact(
        spec=row,
        bounce=0,
        limb=stroke.limb,
        piece=stroke.piece,
        zone=stroke.zone,
        kind=stroke.kind,
        onset_s=stroke.at_s - lasts / 2 if in_air else stroke.at_s,
        lasts_s=lasts,
        speed_m_s=stroke.speed_m_s,
        rebound=drawn if stroke.rebound is None else stroke.rebound,
        height_m=height_for(stroke.speed_m_s) if stroke.height_m is None else stroke.height_m,
        struck_m=SHOULDER_M if stroke.shoulder else LENGTH_M,
        angle_rad=angle_rad + in_air * rng.normal(0, AIR_SCATTER_RAD[1]),
        aside_rad=in_air * rng.normal(0, AIR_SCATTER_RAD[0]),
    )


def _apart(touches: list[Contact]) -> list[Contact]:
    """Without the touches that a hand cannot make: those that begin while its stick still touches."""
    free_from: dict[Limb, float] = {}
    kept = []
    for touch in touches:
        if touch.onset_s >= free_from.get(touch.limb, -np.inf):
            kept.append(touch)
            free_from[touch.limb] = touch.end_s + LEAST_GAP_S
    return kept


LEAST_GAP_S = 0.012
"""The least time from one touch's end to the next one's beginning; below it a bounce is part of the same touch."""
