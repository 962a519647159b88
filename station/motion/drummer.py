"""The drummer: a score, a kit, a figure and a style in, the pose at any time out.

What a style cannot change is made once: limbs, contacts, ways between them, pedals, instruments. What it can, the
keyframes of strokes and body, is made anew by `with_style`. A pose evaluates the splines at its time and runs forward
kinematics; the arm is solved from where the shoulder is at that instant, so that the body may move as it likes.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, Zone
from station.motion import body, pedals
from station.motion.arm import Arm, Offsets, solve
from station.motion.figure import Figure, figure_of
from station.motion.hand import HandPart, arm_lengths
from station.motion.instruments import Instrument, instruments
from station.motion.kit import Kit, load_kit
from station.motion.leg import Footing, leg
from station.motion.limbs import Assignment, assign_limbs
from station.motion.maths import ONE, Point
from station.motion.pose import Pose
from station.motion.splines import Curves
from station.motion.style import Style
from station.motion.trunk import TrunkAngles, trunk
from station.music.score import Score

Array = NDArray[np.float64]

HIP_ABOVE_SEAT = 0.05
"""Height of the hip joints over the seat, as a share of the stature (our choice)."""


@dataclass(frozen=True, eq=False)
class Drummer:
    """Plays `score` on `kit` with the body of `figure` in the manner of `style`; ask `pose` for any time.

    Raises `BadInput` for a piece that a limb cannot reach: it names the piece, the note and the missing distance.
    """

    score: Score
    kit: Kit = field(default_factory=load_kit)
    figure: Figure = field(default_factory=figure_of)
    style: Style = field(default_factory=Style)
    plan: "_Plan | None" = None

    def __post_init__(self) -> None:
        if self.plan is None:
            object.__setattr__(self, "plan", _Plan(self.score, self.kit, self.figure))

    def with_style(self, style: Style) -> "Drummer":
        """The same drummer in another style; what no style changes is shared."""
        return Drummer(self.score, self.kit, self.figure, style, self.plan)

    @property
    def assignment(self) -> Assignment:
        """Who plays what, and why."""
        return self._fixed.assignment

    @property
    def _fixed(self) -> "_Plan":
        assert self.plan is not None
        return self.plan

    # --- what the style decides --------------------------------------------------------------------------------------

    @cached_property
    def _strokes(self) -> tuple[list[Curves], list[Curves]]:
        right, left = self._fixed.hands
        return right.offsets(self.style.sliders), left.offsets(self.style.sliders)

    @cached_property
    def _body(self) -> Curves:
        plan, style = self._fixed, self.style
        return body.body_curves(plan.beats_s, plan.bearing, style.body_factors, np.radians(style.posture_deg))

    # --- one instant --------------------------------------------------------------------------------------------------

    def pose(self, time_s: float) -> Pose:
        """Everything at `time_s` seconds from the score's tick 0, before and after the score too."""
        fixed, figure = self._fixed, self.figure
        twist, lean, side, nod, turn, tilt = self._body.at(time_s)
        frame = trunk(ONE, figure, fixed.pelvis, TrunkAngles(twist, lean, side, nod, turn, tilt, 0.0))
        wing = np.radians(self.style.wing_deg)
        right = self._arm(0, time_s, frame.right_shoulder, wing)
        left = self._arm(1, time_s, frame.left_shoulder, -wing)
        kick, hat = fixed.kick.at(time_s)[0], fixed.hat.at(time_s)[0]
        boards = kick * fixed.raised[0], hat * fixed.raised[1]
        legs = [leg(ONE, f, hip, b, 0.0) for f, hip, b in zip(fixed.footings, fixed.hips, boards, strict=True)]
        played = [i.at(time_s) for i in fixed.instruments]
        points: list[Point] = [
            *(fixed.pelvis, frame.spine, frame.neck, frame.head, frame.crown),
            *(frame.right_shoulder, right.elbow, right.wrist, right.hand),
            *(frame.left_shoulder, left.elbow, left.wrist, left.hand),
            *(fixed.hips[0], legs[0].knee, legs[0].ankle, legs[0].toe),
            *(fixed.hips[1], legs[1].knee, legs[1].ankle, legs[1].toe),
            *(right.butt, left.butt, right.tip, left.tip, right.back, left.back, frame.facing, frame.head_up),
        ]
        angles = [twist, lean, side, nod, turn, tilt]
        for arm in (right, left):
            angles += [arm.heading_rad, *arm.angles]
        for one in legs:
            angles += one.angles
        table: Array = np.array(points)
        response = np.array(played)
        return Pose(
            time_s=time_s,
            joints_m=table[:21],
            angles_rad=np.array(angles),
            butt_m=table[21:23],
            tip_m=table[23:25],
            palm=table[25:27],
            facing=table[27],
            head_up=table[28],
            footboard_rad=boards,
            beater_rad=kick * pedals.BEATER_SWING_RAD,
            hat_gap_m=hat * pedals.OPEN_GAP_M,
            swing_rad=response[:, :2],
            flash=response[:, 2],
            ripple_m=response[:, 3],
            eyes=1.0,
        )

    def _arm(self, side: int, time_s: float, shoulder: Point, wing_rad: float) -> Arm:
        fixed = self._fixed
        offsets = Offsets(*(c.at(time_s)[0] for c in self._strokes[side]))
        return solve(ONE, fixed.lengths, shoulder, fixed.hands[side].way.at(time_s), offsets, wing_rad)


class _Plan:
    """What no style changes: limbs, hands' ways, pedals, instruments, beats."""

    def __init__(self, score: Score, kit: Kit, figure: Figure) -> None:
        self.assignment = assign_limbs(score, kit)
        self.lengths = arm_lengths(figure)
        seat = kit.seat_m
        self.pelvis: Point = (seat[0], seat[1], seat[2] + HIP_ABOVE_SEAT * figure.stature_m)
        half = figure.hip_breadth_m / 2
        x, y, z = self.pelvis
        self.hips: tuple[Point, Point] = ((x + half, y, z), (x - half, y, z))
        onset_s, limbs = score.onset_s, self.assignment.limbs
        self.strikes_m = _strike_points(score, kit, limbs)
        self.beats_s = body.beat_times(score)
        hand_rows = np.flatnonzero((limbs == Limb.RIGHT_HAND) | (limbs == Limb.LEFT_HAND))
        bearing = np.arctan2(-self.strikes_m[hand_rows, 0], np.maximum(self.strikes_m[hand_rows, 1] - y, 0.05))
        halves = np.sort(np.concatenate((self.beats_s, 0.5 * (self.beats_s[1:] + self.beats_s[:-1]))))
        order = np.argsort(onset_s[hand_rows], kind="stable")
        self.bearing = body.facing(halves, onset_s[hand_rows][order], bearing[order])
        still = trunk(ONE, figure, self.pelvis, TrunkAngles(0.0, np.radians(6.0), 0.0, 0.0, 0.0, 0.0, 0.0))
        shoulders = (still.right_shoulder, still.left_shoulder)
        self.hands = tuple(
            HandPart.of(score, kit, figure, limb, np.flatnonzero(limbs == limb), shoulder)
            for limb, shoulder in zip((Limb.RIGHT_HAND, Limb.LEFT_HAND), shoulders, strict=True)
        )
        kicks = np.flatnonzero(score.notes["piece"] == Piece.KICK)
        kicks = kicks[np.argsort(onset_s[kicks], kind="stable")]
        self.kick = pedals.kick_board(onset_s[kicks], score.notes["velocity"][kicks].astype(np.float64))
        self.hat = pedals.hat_board(score, onset_s)
        boards = kit.pedals[Piece.KICK], kit.pedals[Piece.HIHAT_PEDAL]
        if kit.left_handed:
            boards = boards[::-1]
        self.footings = tuple(Footing.of(p, figure, right) for p, right in zip(boards, (True, False), strict=True))
        self.raised = tuple(p.raised_rad for p in boards)
        self.instruments: list[Instrument] = instruments(score, kit, onset_s, self.strikes_m)


def _strike_points(score: Score, kit: Kit, limbs: NDArray[np.int8]) -> Array:
    """The point that each stroke touches, (n, 3)."""
    notes = score.notes
    kinds, which = np.unique(np.stack([notes["piece"], notes["zone"], limbs], 1), axis=0, return_inverse=True)
    points = [kit.target(Piece(p), Zone(z), Limb(limb)).point_m for p, z, limb in kinds.tolist()]
    return np.array(points).reshape(-1, 3)[which]
