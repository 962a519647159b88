"""The drummer: a score, a kit, a figure and a style in, the pose at any time out.

What a style cannot change is made once (`plan`). What it can, the keyframes of strokes and body, is made anew by
`with_style`. A pose evaluates the splines at its time and runs forward kinematics; the arm is solved from where the
shoulder is at that instant, so that the body may move as it likes and every tip is still on its drum at the strike.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion import body
from station.motion.figure import Figure, figure_of
from station.motion.frame import BodyNow, Rig
from station.motion.hand import HandPart
from station.motion.instruments import Instrument
from station.motion.kit import Kit, load_kit
from station.motion.leg import HEEL_RAD, Footing
from station.motion.life import BREATH_RATE, Blinks, breath
from station.motion.limbs import Assignment
from station.motion.maths import MANY, ONE, Number
from station.motion.plan import Plan, bar_places, holds
from station.motion.pose import Pose
from station.motion.reach import leans
from station.motion.splines import Curves
from station.motion.stroke import Sliders, Strokes
from station.motion.style import NATURAL, Style, bent
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


@dataclass(frozen=True, eq=False)
class Drummer:
    """Plays `score` on `kit` with the body of `figure` in the manner of `style`; ask `pose` for any time.

    Raises `BadInput` for a piece that a limb cannot reach: it names the piece, the note and the missing distance.
    """

    score: Score
    kit: Kit = field(default_factory=load_kit)
    figure: Figure = field(default_factory=figure_of)
    style: Style = field(default_factory=Style)
    plan: Plan | None = None
    parts: tuple[HandPart, HandPart] | None = None

    def __post_init__(self) -> None:
        plan = self.plan or Plan.of(self.score, self.kit, self.figure)
        object.__setattr__(self, "plan", plan)
        object.__setattr__(self, "parts", self.parts or plan.hands(self.style))

    def with_style(self, style: Style) -> "Drummer":
        """The same drummer in another style; what it does not change is shared."""
        same_hold = holds(style) == holds(self.style)
        return Drummer(self.score, self.kit, self.figure, style, self._plan, self.parts if same_hold else None)

    @property
    def assignment(self) -> Assignment:
        """Who plays what, and why."""
        return self._plan.assignment

    @property
    def _plan(self) -> Plan:
        assert self.plan is not None
        return self.plan

    @property
    def _hands(self) -> tuple[HandPart, HandPart]:
        assert self.parts is not None
        return self.parts

    # --- keyframes: what the style decides ----------------------------------------------------------------------------

    @cached_property
    def _keys(self) -> "_Keys":
        return _Keys.of(self._plan, self._hands, self.style)

    # --- poses --------------------------------------------------------------------------------------------------------

    def pose(self, time_s: float) -> Pose:
        """Everything at `time_s` seconds from the score's tick 0, before and after the score too."""
        keys = self._keys
        now = keys.body_now(time_s, math.sin(time_s * BREATH_RATE), at)
        (right_way, right), (left_way, left) = keys.hands
        hands = (right_way.at(time_s), right.at(time_s)), (left_way.at(time_s), left.at(time_s))
        row = keys.rig.row(ONE, now, *hands, keys.boards(time_s, at))
        for instrument in keys.instruments:
            row += instrument.at(time_s)
        return Pose(time_s, np.array(row))

    def rows(self, time_s: Array) -> Array:
        """The poses at each time (n,) as rows (n, fields) in the layout of `frame`; the instruments are left out."""
        keys = self._keys
        now = keys.body_now(time_s, np.sin(time_s * BREATH_RATE), many)
        (right_way, right), (left_way, left) = keys.hands
        hands = (right_way.many(time_s), right.many(time_s)), (left_way.many(time_s), left.many(time_s))
        row = keys.rig.row(MANY, now, *hands, keys.boards(time_s, many))
        return np.stack([np.broadcast_to(value, time_s.shape) for value in row], axis=1)


def at(channels: Channels, time_s: Number) -> Number:
    """The channels at one instant."""
    return channels.at(time_s)


def many(channels: Channels, time_s: Number) -> Number:
    """The channels at many."""
    return channels.many(time_s)


@dataclass(frozen=True, eq=False)
class _Keys:
    """All keyframes under one style."""

    hands: tuple[tuple[Way, Strokes], tuple[Way, Strokes]]
    body: Curves
    bob: Curves
    gaze: Curves
    blinks: Blinks
    feet: tuple[Curves, Curves]
    breathing: float
    rig: Rig
    instruments: tuple[Instrument, ...]

    @classmethod
    def of(cls, plan: Plan, hands: tuple[HandPart, HandPart], style: Style) -> "_Keys":
        ground = plan.ground
        values = body.keys(ground, style)
        first = body.curves(ground, style, values)
        needed = leans(first, hands, plan.figure, plan.pelvis)
        if needed.any():
            values[1] += needed
            first = body.curves(ground, style, values)
        right, left = ((hand.way, Strokes.of(hand.strokes, sliders(plan.score, hand, style))) for hand in hands)
        left_kick = plan.kit.left_handed
        return cls(
            hands=(right, left),
            body=first,
            bob=body.bob_curve(ground, style),
            gaze=plan.gaze(float(style.value("look_around", 1.0)) / 100, style.seed),
            blinks=plan.blinks(style.seed),
            feet=(plan.hat, plan.kick) if left_kick else (plan.kick, plan.hat),
            breathing=float(style.factor("breathing", 1.0)),
            rig=rig_of(plan, style),
            instruments=plan.instruments,
        )

    def body_now(self, time_s: Number, sine: Number, sample: Sample) -> BodyNow:
        twist, lean, side, shrug, wing, stand = sample(self.body, time_s)
        bearing, pitch = sample(self.gaze, time_s)
        lift = shrug + breath(sine, self.breathing)
        bob = sample(self.bob, time_s)[0]
        return BodyNow(twist, lean, side, lift, wing, stand, bearing, pitch, bob, sample(self.blinks, time_s))

    def boards(self, time_s: Number, sample: Sample) -> tuple[Number, Number]:
        right, left = self.feet
        return sample(right, time_s)[0], sample(left, time_s)[0]


def sliders(score: Score, hand: HandPart, style: Style) -> Sliders:
    """What `style` does to the strokes of `hand`, each in its bar."""
    bars = (
        bar_places(score, score.notes["tick"][hand.events.row])
        if style.automation and len(hand.events.row)
        else np.ones(1)
    )
    gains = [style.joint_factor("amplitude", j, bars) for j in ("shoulder", "elbow", "wrist")]
    fingers = gains[2] * style.factor("amplitude_fingers", bars)
    paces = [style.joint_factor("frequency", j, bars) for j in ("shoulder", "elbow", "wrist", "wrist")]
    gain = np.array([*gains, fingers])
    if style.pieces and len(hand.events.row):
        own = np.full(len(Piece), 1.0)
        for piece, amplitude in style.pieces.items():
            own[piece] = bent(amplitude / NATURAL)
        gain = gain * own[score.notes["piece"][hand.events.row]]
    return Sliders(gain, np.maximum(np.array(paces), SLOWEST), style.factor("whip", bars)[None])


SLOWEST = 0.3
"""A stroke never takes longer than its natural time over this (our choice)."""


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
        gaze=0.9 * float(style.factor("amplitude_gaze", 1.0)),
        neck_rad=plan.figure.limits.neck_rotation,
        hip_m=plan.figure.hip_breadth_m / 2,
    )
