"""What no slider changes of a performance: limbs, both hands' parts, the body's ground, pedals, instruments."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.avoidance.clearance import cleared
from station.motion.avoidance.cost import Stage
from station.motion.avoidance.optimise import looks, optimised
from station.motion.body.beats import Beats, bob_cofactors, restarts
from station.motion.body.body_keys import Ground, mean_bearing
from station.motion.body.gaze import GazeTargets, gaze_curve
from station.motion.body.idle_motion import Blinks
from station.motion.body.reach import reaching
from station.motion.kinematics.body_solids import BodyPoints
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.maths import MANY, Point, blocks
from station.motion.kinematics.pedal_motion import hat_board, kick_board
from station.motion.kinematics.posture import pelvis_of
from station.motion.kinematics.splines import SplineChannels
from station.motion.kinematics.trunk import TrunkAngles, trunk
from station.motion.kit.instruments import Instrument, instruments
from station.motion.kit.kit import Kit
from station.motion.sticking.limbs import Assignment, assign_limbs
from station.motion.strokes.grip import GRIPS, HELD, Hold
from station.motion.strokes.hand import HandPart
from station.motion.strokes.hand_events import HandEvents, hand_events
from station.motion.strokes.lap import thigh
from station.motion.strokes.targets import strike_points
from station.motion.style.style import Style
from station.music.score import Score

Array = NDArray[np.float64]

HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)


@dataclass(frozen=True, eq=False)
class MotionPlan:
    """Everything fixed; `strike_m` (n, 3) is the point that each stroke of the score touches."""

    score: Score
    kit: Kit
    figure: Figure
    assignment: Assignment
    strike_m: Array
    events: tuple[HandEvents, HandEvents]
    ground: Ground
    pelvis: Point
    hat: SplineChannels
    instruments: tuple[Instrument, ...]

    @classmethod
    def of(cls, score: Score, kit: Kit, figure: Figure, assignment: Assignment | None = None) -> "MotionPlan":
        """The plan of `score`; `assignment` is `assign_limbs`' own where none is given."""
        who = assignment or assign_limbs(score, kit)
        points = strike_points(score, kit, who.limbs)
        return cls(
            score=score,
            kit=kit,
            figure=figure,
            assignment=who,
            strike_m=points,
            events=hand_events(score, who.limbs),
            ground=_ground(score, kit, who.limbs, points),
            pelvis=pelvis_of(kit, figure),
            hat=hat_board(score, score.onset_s),
            instruments=tuple(instruments(score, kit, score.onset_s, points)),
        )

    def kick(self, style: Style) -> SplineChannels:
        """The kick's board over time."""
        score = self.score
        kicks = np.flatnonzero(score.notes["piece"] == Piece.KICK)
        kicks = kicks[np.argsort(score.onset_ns[kicks], kind="stable")]
        velocity = score.notes["velocity"][kicks].astype(np.float64)
        return kick_board(score.onset_s[kicks], velocity, style.beater == "buried")

    def hands(self, style: Style) -> tuple[HandPart, HandPart]:
        """Both hands' parts with what `style` makes them hold."""
        right, left = (
            HandPart.of(self.score, self.kit, self.figure, hold, limb, events, style.heel)
            for limb, hold, events in zip(HANDS, holds(style), self.events, strict=True)
        )
        right, left = cleared((right, left), self.figure)
        if not (len(right.events.row) or len(left.events.row)):
            return right, left
        (right, left), _ = optimised((right, left), self._stage((right, left), style.heel))
        return right, left

    def _stage(self, hands: tuple[HandPart, HandPart], heel: str) -> Stage:
        """The body in its natural posture, in which the `hands` must find their ways."""
        grid = looks(*(hand.events.time_s for hand in hands))
        curves = reaching(self.ground, Style(), hands, self.figure, self.pelvis)
        points = np.empty((6, 3, len(grid)))
        for block in blocks(len(grid)):
            twist, lean, side, shrug, *_ = curves.many(grid[block])
            frame = trunk(MANY, self.figure, self.pelvis, TrunkAngles(twist, lean, side, 0.0, 0.0, 0.0, shrug))
            ends = (self.pelvis, frame.neck, frame.head, frame.crown, frame.right_shoulder, frame.left_shoulder)
            for k, point in enumerate(ends):
                points[k, :, block] = np.stack(np.broadcast_arrays(*point, twist)[:3])
        pelvis, neck, head, crown, right, left = (p.T for p in points)
        thighs = thigh(self.kit, self.figure, True, heel), thigh(self.kit, self.figure, False, heel)
        body = BodyPoints(pelvis, neck, head, crown, (right, left), thighs)
        return Stage(self.figure, self.kit, grid, (points[4], points[5]), body, (hands[0].bump, hands[1].bump))

    def gaze(self, style: Style) -> SplineChannels:
        """Where the drummer looks."""
        sights, ticks = self._sights
        bars = bar_places(self.score, ticks) if style.automation else np.ones(1)
        return gaze_curve(sights, style.value("look_around", bars) / 100, style.seed)

    @cached_property
    def note_bars(self) -> Array:
        """Each note's place in bars from 1, (n,)."""
        return bar_places(self.score, self.score.notes["tick"])

    @cached_property
    def _sights(self) -> tuple[GazeTargets, NDArray[np.int64]]:
        """The hands' strikes as the eyes find them, and their ticks."""
        score = self.score
        order = np.argsort(score.onset_ns, kind="stable")
        order = order[np.isin(self.assignment.limbs[order], HANDS)]
        x, y, z = self.pelvis
        eyes = np.array([x, y + 0.05, z + self.figure.trunk_m + self.figure.neck_m + 0.5 * self.figure.head_m])
        away = self.strike_m[order] - eyes
        bearing = np.arctan2(-away[:, 0], np.maximum(away[:, 1], 0.05))
        pitch = np.arctan2(-away[:, 2], np.hypot(away[:, 0], away[:, 1]))
        place = np.array([self.kit.stand_in_table[p] for p in score.notes["piece"][order].tolist()], np.int64)
        ticks = score.notes["tick"][order]
        bars = score.tempo_map.bars_at(ticks)
        starts = [score.tempo_map.bar_start(b) for b in range(int(bars.max(initial=0)) + 2)]
        bar_s = np.diff(score.tempo_map.seconds_at(np.array(starts, np.int64)))[bars]
        return GazeTargets(score.onset_s[order], place, np.stack([bearing, pitch], 1), bar_s), ticks

    def blinks(self, seed: int) -> Blinks:
        """When the drummer blinks, from before the score's start to after its end."""
        return Blinks.of(float(self.ground.time_s[0]) - 2.0, float(self.ground.time_s[-1]) + 60.0, seed)


def holds(style: Style) -> tuple[Hold, Hold]:
    """What the right and the left hand hold, and how."""
    return Hold(GRIPS[style.grip_right], HELD[style.held]), Hold(GRIPS[style.grip_left], HELD[style.held])


def _ground(score: Score, kit: Kit, limbs: NDArray[np.int8], points: Array) -> Ground:
    order = np.argsort(score.onset_ns, kind="stable")
    onset, notes = score.onset_s[order], score.notes[order]
    hands = np.isin(limbs[order], HANDS)
    x, y, _ = kit.seat_m
    at = points[order][hands]
    bearing = np.arctan2(x - at[:, 0], np.maximum(at[:, 1] - y, 0.05))
    beats = Beats.of(score)
    times = beats.with_middles
    ticks = score.tempo_map.ticks_at(np.maximum(times, 0.0))
    velocity = notes["velocity"].astype(np.float64)
    bob = np.empty(len(times))
    bob[::2] = bob_cofactors(times[::2], onset, velocity, notes["piece"])
    bob[1::2] = bob_cofactors(times[1::2], onset, velocity, notes["piece"])
    return Ground(
        beats=beats,
        time_s=times,
        bars=bar_places(score, ticks),
        bearing=mean_bearing(times, onset[hands], bearing),
        bob=bob,
        restart=restarts(beats.time_s, onset),
    )


def bar_places(score: Score, ticks: NDArray[np.int64]) -> Array:
    """Each tick as a place in bars from 1, fractions within the bar."""
    bars = score.tempo_map.bars_at(ticks)
    starts = np.array([score.tempo_map.bar_start(b) for b in range(int(bars.max(initial=0)) + 2)], np.float64)
    return np.asarray(1 + bars + (ticks - starts[bars]) / (starts[bars + 1] - starts[bars]))
