"""All keyframes under one style, and what they say at an instant or at many.

`at` and `many` sample anything that moves: the same lines then run on floats and on arrays.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion import body, frame
from station.motion.flourish import Flourishes
from station.motion.frame import BodyNow, HandNow, Rig
from station.motion.hand import HandPart
from station.motion.instruments import Instrument
from station.motion.leg import HEEL_RAD, Footing
from station.motion.life import BREATH_M, BREATH_RATE, Blinks
from station.motion.maths import Maths, Number
from station.motion.plan import Plan, bar_places, holds
from station.motion.reach import leans
from station.motion.splines import Curves
from station.motion.stroke import Sliders, Strokes
from station.motion.style import Style
from station.motion.travel import Way
from station.music.score import Score

Array = NDArray[np.float64]


class Channels(Protocol):
    """Anything that moves: it can be asked for one instant or for many."""

    def at(self, time_s: float, /) -> Number:
        """One instant."""

    def many(self, time_s: Array, /) -> Number:
        """Many."""


Sample = Callable[[Channels, Number], Number]


def at(channels: Channels, time_s: Number) -> Number:
    """The channels at one instant."""
    return channels.at(time_s)


def many(channels: Channels, time_s: Number) -> Number:
    """The channels at many."""
    return channels.many(time_s)


@dataclass(frozen=True, eq=False)
class HandKeys:
    """One hand's way, strokes and flourishes."""

    way: Way
    strokes: Strokes
    flourishes: Flourishes | None

    @classmethod
    def of(cls, score: Score, hand: HandPart, style: Style) -> "HandKeys":
        """The keys of `hand` under `style`."""
        bars = _bars(score, hand, style)
        likely = style.value("flourish", bars) / 100
        flourishes = None
        if likely.any():
            flourishes = Flourishes.of(hand.events.time_s, likely, style.seed + int(hand.limb))
        if flourishes is not None and not flourishes.start_s:
            flourishes = None
        return cls(hand.way, Strokes.of(hand.strokes, sliders(score, hand, style, bars)), flourishes)

    def now(self, time_s: Number, sample: Sample) -> tuple[HandNow, Number | None]:
        """The contact and the stroke, and how high a tossed stick is over the hand, None where nothing is tossed."""
        contact, offsets = sample(self.way, time_s), sample(self.strokes, time_s)
        if self.flourishes is None:
            return (contact, offsets), None
        lift, turn, toss = sample(self.flourishes, time_s)
        raised = contact._replace(z=contact.z + lift), offsets._replace(stick=offsets.stick + turn)
        return raised, toss


@dataclass(frozen=True, eq=False)
class Keys:
    """All keyframes under one style.

    `hands` of the right and the left, `feet` the boards under them; the rest is the body's.
    """

    hands: tuple[HandKeys, HandKeys]
    body: Curves
    head: Curves
    gaze: Curves
    blinks: Blinks
    feet: tuple[Curves, Curves]
    rig: Rig
    instruments: tuple[Instrument, ...]

    @classmethod
    def of(cls, plan: Plan, hands: tuple[HandPart, HandPart], style: Style) -> "Keys":
        """The keys of `plan`, whose hands are `hands`, under `style`."""
        ground = plan.ground
        values = body.keys(ground, style)
        first = body.curves(ground, style, values)
        needed = leans(first, hands, plan.figure, plan.pelvis)
        if needed.any():
            values[1] += needed
            first = body.curves(ground, style, values)
        right, left = (HandKeys.of(plan.score, hand, style) for hand in hands)
        left_kick, kick = plan.kit.left_handed, plan.kick(style)
        return cls(
            hands=(right, left),
            body=first,
            head=body.head_curve(ground, style),
            gaze=plan.gaze(style),
            blinks=plan.blinks(style.seed),
            feet=(plan.hat, kick) if left_kick else (kick, plan.hat),
            rig=rig_of(plan, style),
            instruments=plan.instruments,
        )

    def row(self, m: Maths, time_s: Number, sample: Sample) -> list[Number]:
        """The whole drummer as a row of `frame`, the instruments left out."""
        twist, lean, side, shrug, wing, stand, gaze, breath = sample(self.body, time_s)
        bearing, pitch = sample(self.gaze, time_s)
        nod, tilt = sample(self.head, time_s)
        shrug = shrug + breath * BREATH_M * m.sin(BREATH_RATE * time_s)
        now = BodyNow(
            *(twist, lean, side, shrug, wing, stand, gaze * bearing, gaze * pitch),
            *(nod, tilt, sample(self.blinks, time_s)),
        )
        feet = sample(self.feet[0], time_s)[0], sample(self.feet[1], time_s)[0]
        (right, right_toss), (left, left_toss) = (hand.now(time_s, sample) for hand in self.hands)
        row = self.rig.row(m, now, right, left, feet)
        if right_toss is not None:
            row[frame.BUTT.start + 2] = row[frame.BUTT.start + 2] + right_toss
            row[frame.TIP.start + 2] = row[frame.TIP.start + 2] + right_toss
        if left_toss is not None:
            row[frame.BUTT.start + 5] = row[frame.BUTT.start + 5] + left_toss
            row[frame.TIP.start + 5] = row[frame.TIP.start + 5] + left_toss
        return row


def _bars(score: Score, hand: HandPart, style: Style) -> Array:
    """The place in bars of each event of `hand`; one for all where nothing changes over the bars or it is idle."""
    if not style.automation or not len(hand.events.row):
        return np.ones(1)
    return bar_places(score, score.notes["tick"][hand.events.row])


def sliders(score: Score, hand: HandPart, style: Style, bars: Array) -> Sliders:
    """What `style` does to the strokes of `hand`, each in its bar."""
    gains = [style.joint_factor("amplitude", j, bars) for j in ("shoulder", "elbow", "wrist")]
    fingers = gains[2] * style.factor("amplitude_fingers", bars)
    paces = [style.joint_factor("frequency", j, bars) for j in ("shoulder", "elbow", "wrist", "wrist")]
    gain = np.array([*gains, fingers])
    if len(hand.events.row):
        struck = score.notes["piece"][hand.events.row]
        for piece in style.own_pieces:
            gain = gain * np.where(struck == piece, style.piece_factor(piece, bars), 1.0)
    return Sliders(gain, _pace(np.array(paces)), style.factor("whip", bars)[None])


SLOWEST = 0.3
"""A stroke never takes longer than its natural time over this (our choice)."""


def _pace(frequency: Array) -> Array:
    """How much faster strokes are than natural, from `SLOWEST` at no frequency on, so that every setting counts."""
    return np.where(frequency < 1, SLOWEST + (1 - SLOWEST) * frequency, frequency)


def rig_of(plan: Plan, style: Style) -> Rig:
    """The parts that do not move, for `style`."""
    kick, hat = plan.kit.pedals[Piece.KICK], plan.kit.pedals[Piece.HIHAT_PEDAL]
    pedals = (hat, kick) if plan.kit.left_handed else (kick, hat)
    right, left = (Footing.of(p, plan.figure, r) for p, r in zip(pedals, (True, False), strict=True))
    hold_right, hold_left = holds(style)
    return Rig(
        figure=plan.figure,
        pelvis=plan.pelvis,
        arms=(hold_right.lengths(plan.figure), hold_left.lengths(plan.figure, right=False)),
        rolls=(hold_right.grip.roll, hold_left.grip.roll),
        footings=(right, left),
        raised=(pedals[0].raised_rad, pedals[1].raised_rad),
        heel=HEEL_RAD[style.heel],
        right_kicks=not plan.kit.left_handed,
        neck_rad=plan.figure.limits.neck_rotation,
        hip_m=plan.figure.hip_breadth_m / 2,
    )
