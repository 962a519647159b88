"""All keyframes under one style, and what they say at an instant or at many.

`at` and `many` ask each part for itself, so that Python can make short work of a float; `frame` then has the formulas.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, word
from station.motion.body.head_keys import head_curve
from station.motion.body.idle_motion import BREATH_M, BREATH_RATE, Blinks
from station.motion.body.lean_to_reach import reaching
from station.motion.kinematics.arm import Contact
from station.motion.kinematics.frame import FeetNow, HandNow, Rig
from station.motion.kinematics.grip import Hold
from station.motion.kinematics.leg import HEEL_RAD
from station.motion.kinematics.maths import MANY, ONE, Number, Point
from station.motion.kinematics.splines import SplineChannels
from station.motion.kit.instruments import Instrument
from station.motion.motion_plan import MotionPlan, holds
from station.motion.strokes.brush_sweeps import SWEEP_M, SWISH_M, Sweeps
from station.motion.strokes.flourish import NOTHING, Flourishes, Now, flourished
from station.motion.strokes.hand import HandPart
from station.motion.strokes.stroke import Sliders, Strokes
from station.motion.strokes.travel import HandPath
from station.motion.strokes.variation import spots, varied
from station.motion.style.style import Style
from station.music.score import Score

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class HandKeys:
    """One hand's way, strokes and flourishes, where it shows these, and what a brush sweeps."""

    way: HandPath
    strokes: Strokes
    flourishes: Flourishes | None
    show: Contact
    sweeps: Sweeps | None

    def at(self, time_s: float) -> tuple[HandNow, Now | None]:
        """The contact and the stroke, and what the stick does of its own, None where there are no flourishes."""
        now = self.way.at(time_s), self.strokes.at(time_s)
        if self.sweeps is not None:
            return _swept(now, self.sweeps.at(time_s)), None
        flourish = NOTHING if self.flourishes is None else self.flourishes.at(time_s)
        return (now, None) if flourish is NOTHING else self._raised(now, flourish)

    def many(self, time_s: Array) -> tuple[HandNow, Now | None]:
        """The same at each time."""
        now = self.way.many(time_s), self.strokes.many(time_s)
        if self.sweeps is not None:
            return _swept(now, self.sweeps.many(time_s)), None
        return (now, None) if self.flourishes is None else self._raised(now, self.flourishes.many(time_s))

    def _raised(self, now: HandNow, flourish: Now) -> tuple[HandNow, Now]:
        contact, offsets = now
        to = flourish.raised
        return (tuple([c + to * (s - c) for c, s in zip(contact, self.show, strict=True)]), offsets), flourish


def _swept(now: HandNow, sweep: Point) -> HandNow:
    (x, y, z, *lie), offsets = now
    return (x + sweep[0], y + sweep[1], z + sweep[2], *lie), offsets


@dataclass(frozen=True, eq=False)
class Keys:
    """All keyframes under one style.

    `hands` of the right and the left, `kicks` the boards of the kick and of its slave, `hat` the hi-hat's opening,
    `heels` how the soles of the kick's and the hi-hat's foot tip; the rest is the body's.
    """

    style: Style
    parts: tuple[HandPart, HandPart]
    hands: tuple[HandKeys, HandKeys]
    body: SplineChannels
    head: SplineChannels
    gaze: SplineChannels
    blinks: Blinks
    kicks: tuple[SplineChannels, SplineChannels]
    hat: SplineChannels
    heels: SplineChannels
    rig: Rig
    instruments: tuple[Instrument, ...]

    @classmethod
    def of(
        cls, plan: MotionPlan, parts: tuple[HandPart, HandPart], style: Style, before: "Keys | None" = None
    ) -> "Keys":
        """The keys of `plan`, whose hands are `parts`, under `style`; those `before` of the same plan that hold too."""
        old = before if before is not None and before.parts is parts else None
        same = {stage for stage in READS if old is not None and _alike(old.style, style, READS[stage])}
        (right, left), ground = parts, plan.ground
        hands = old.hands if old is not None else (None, None)
        return cls(
            style=style,
            parts=parts,
            hands=(_hand(plan, right, style, hands[0], same), _hand(plan, left, style, hands[1], same)),
            body=old.body
            if old is not None and "body" in same
            else reaching(ground, style, parts, plan.figure, plan.pelvis),
            head=old.head if old is not None and "head" in same else head_curve(ground, style),
            gaze=old.gaze if old is not None and "gaze" in same else plan.gaze(style),
            blinks=old.blinks if old is not None and "blinks" in same else plan.blinks(style.seed),
            kicks=old.kicks if old is not None and "kicks" in same else plan.kicks(style),
            hat=plan.hat,
            heels=old.heels if old is not None and "heels" in same else plan.heels(style),
            rig=rig_of(plan, style),
            instruments=plan.instruments,
        )

    @cached_property
    def holds(self) -> tuple[Hold, Hold]:
        """What the right and the left hand hold, and how."""
        return self.parts[0].hold, self.parts[1].hold

    def at(self, time_s: float) -> list[float]:
        """The whole drummer at one instant as a row of `frame`, the instruments left out."""
        twist, lean, side, shrug, hunch, wing, stand, gaze, breath, *face = self.body.at(time_s)
        bearing, pitch = self.gaze.at(time_s)
        shrug += breath * BREATH_M * math.sin(BREATH_RATE * time_s)
        nod, tilt, chin = self.head.at(time_s)
        (right, right_spin), (left, left_spin) = self.hands[0].at(time_s), self.hands[1].at(time_s)
        path = self.rig.path
        phase = 0.0 if path is None else path.phase.first(time_s)
        kick, slave = self.kicks[0].first(time_s), self.kicks[1].first(time_s)
        kick_heel, hat_heel = self.heels.at(time_s)
        feet = FeetNow(kick, self.hat.first(time_s), slave, kick_heel, hat_heel, phase)
        look = gaze * bearing, gaze * pitch
        eyes = self.blinks.at(time_s)
        now = (twist, lean, side, shrug, hunch, wing, stand, *look, nod, tilt, chin, eyes, *face)
        return flourished(ONE, self.rig.row(ONE, now, right, left, feet), right_spin, left_spin)

    def many(self, time_s: Array) -> list[Number]:
        """The same at each time (n,): numbers and arrays (n,)."""
        twist, lean, side, shrug, hunch, wing, stand, gaze, breath, *face = self.body.many(time_s)
        bearing, pitch = self.gaze.many(time_s)
        shrug = shrug + breath * BREATH_M * np.sin(BREATH_RATE * time_s)
        nod, tilt, chin = self.head.many(time_s)
        (right, right_spin), (left, left_spin) = self.hands[0].many(time_s), self.hands[1].many(time_s)
        path = self.rig.path
        phase = 0.0 if path is None else path.phase.many(time_s)[0]
        kick, slave = self.kicks[0].many(time_s)[0], self.kicks[1].many(time_s)[0]
        kick_heel, hat_heel = self.heels.many(time_s)
        feet = FeetNow(kick, self.hat.many(time_s)[0], slave, kick_heel, hat_heel, phase)
        look = gaze * bearing, gaze * pitch
        eyes = self.blinks.many(time_s)
        now = (twist, lean, side, shrug, hunch, wing, stand, *look, nod, tilt, chin, eyes, *face)
        return flourished(MANY, self.rig.row(MANY, now, right, left, feet), right_spin, left_spin)


READS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "strokes": (
            *("amplitude_gain", "amplitude_wrist", "amplitude_elbow", "amplitude_shoulder", "amplitude_fingers"),
            *("frequency_gain", "frequency_wrist", "frequency_elbow", "frequency_shoulder", "whip", "pieces"),
            *("variation", "seed"),
            *(word(piece) for piece in Piece),
        ),
        "way": ("variation", "seed"),
        "flourishes": ("flourish", "seed"),
        "body": (
            *("amplitude_twist", "amplitude_back", "frequency_back", "amplitude_side", "half_time_bpm"),
            *("twist_deg_s", "shrug", "wing_deg", "posture_deg", "stand", "amplitude_gaze", "breathing"),
            *("hunch_deg", "shimmy", "phrase", "fill_lean", "rise", "mood", "expression"),
            *("headbang", "lay_back_ms", "variation", "seed"),
        ),
        "head": (
            *("amplitude_neck", "frequency_neck", "bobs_per_beat", "amplitude_head_side", "backbeat", "chin"),
            *("headbang", "lay_back_ms", "variation", "seed"),
        ),
        "gaze": ("look_around", "attention", "seed"),
        "blinks": ("seed",),
        "kicks": ("beater",),
        "heels": ("amplitude_heel",),
    }
)
"""Which controls each stage of keyframes reads: under all others it stays as it is. What is not here is made anew."""


def _alike(one: Style, other: Style, controls: tuple[str, ...]) -> bool:
    return all(  # a piece's word is no field but may be automated
        getattr(one, c, None) == getattr(other, c, None) and one.automation.get(c) == other.automation.get(c)
        for c in controls
    )


def _hand(plan: MotionPlan, part: HandPart, style: Style, old: HandKeys | None, same: set[str]) -> HandKeys:
    """The keys of one hand; of the `old` those whose stages stay the `same`."""
    bars = _bars(plan, part, style)
    strokes = (
        old.strokes if old and "strokes" in same else Strokes.of(part.strokes, sliders(plan.score, part, style, bars))
    )
    flourishes = old.flourishes if old and "flourishes" in same else _flourishes(part, style, bars)
    way = old.way if old and "way" in same else _way(plan, part, style, bars)
    return HandKeys(way, strokes, flourishes, part.show, _sweeps(plan, part, strokes))


def _way(plan: MotionPlan, part: HandPart, style: Style, bars: Array) -> HandPath:
    """The hand's way, every strike as near to its aim as chance has it."""
    amount = style.factor("variation", bars)
    if not amount.any() or not len(part.events.row):
        return part.way
    contacts = part.contacts.copy()
    contacts[:, :3] += spots(plan.kit, part.events, amount, (style.seed, int(part.limb)))
    return replace(part, contacts=contacts).way


def _sweeps(plan: MotionPlan, part: HandPart, strokes: Strokes) -> Sweeps | None:
    """What the hand sweeps if it holds a brush, which it then neither spins nor tosses."""
    if part.hold.held.name != "brush":
        return None
    right = part.limb == Limb.RIGHT_HAND
    along_m = SWISH_M if right != plan.kit.left_handed else SWEEP_M
    nx, ny, nz = plan.kit.pieces[Piece.SNARE].normal.tolist()
    beats = plan.ground.beats.time_s
    return Sweeps.of(part.events, strokes, beats, along_m if right else -along_m, (nx, ny, nz))


def _flourishes(part: HandPart, style: Style, bars: Array) -> Flourishes | None:
    at_home = part.events.key[:, 0] == Piece.SNARE  # elsewhere a raised hand has its wrist bent too far
    likely = style.value("flourish", bars) / 100 * at_home
    flourishes = Flourishes.of(part.events.time_s, likely, style.seed + int(part.limb)) if likely.any() else None
    return flourishes if flourishes is not None and flourishes.start_s else None


def _bars(plan: MotionPlan, hand: HandPart, style: Style) -> Array:
    """The place in bars of each event of `hand`; one for all where nothing changes over the bars or it is idle."""
    if not style.automation or not len(hand.events.row):
        return np.ones(1)
    return plan.note_bars[hand.events.row]


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
    found = Sliders(gain, _pace(np.array(paces)), style.factor("whip", bars)[None])
    amount = style.factor("variation", bars)
    return varied(found, hand.strokes.rebounds, amount, (style.seed, int(hand.limb))) if amount.any() else found


SLOWEST = 0.3
"""A stroke never takes longer than its natural time over this (our choice)."""


def _pace(frequency: Array) -> Array:
    """How much faster strokes are than natural, from `SLOWEST` at no frequency on, so that every setting counts."""
    return np.where(frequency < 1, SLOWEST + (1 - SLOWEST) * frequency, frequency)


def rig_of(plan: MotionPlan, style: Style) -> Rig:
    """The parts that do not move, for `style`."""
    hold_right, hold_left = holds(style)
    return Rig(
        figure=plan.figure,
        pelvis=plan.pelvis,
        arms=(hold_right.lengths(plan.figure), hold_left.lengths(plan.figure, right=False)),
        rolls=(hold_right.grip.roll, hold_left.grip.roll),
        footings=plan.footings,
        raised=plan.raised_rad,
        path=plan.path,
        heel=HEEL_RAD[style.heel],
        right_kicks=not plan.kit.left_handed,
        neck_rad=plan.figure.limits.neck_rotation,
        hip_m=plan.figure.hip_breadth_m / 2,
    )
