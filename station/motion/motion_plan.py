"""What no slider changes of a performance: limbs, both hands' parts, the body's ground, pedals, instruments."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.avoidance.clearance import cleared
from station.motion.avoidance.cost import Stage
from station.motion.avoidance.left_over import left_over
from station.motion.avoidance.optimise import looks, optimised
from station.motion.body import body_keys
from station.motion.body.beats import Beats, bob_cofactors, restarts
from station.motion.body.body_keys import Ground, mean_bearing
from station.motion.body.gaze import GazeTargets, gaze_curve
from station.motion.body.heels import heel_curves
from station.motion.body.idle_motion import Blinks
from station.motion.body.intensity import Intensity
from station.motion.body.lean_to_reach import reaching
from station.motion.feasibility.on_a_kit import InfeasibleDemand
from station.motion.kinematics.body_solids import BodyPoints
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.foot_path import FootPath, Visits
from station.motion.kinematics.footings import footings
from station.motion.kinematics.grip import Hold
from station.motion.kinematics.leg import Footing
from station.motion.kinematics.maths import MANY, Point, blocks
from station.motion.kinematics.pedal_motion import hat_board, kick_board
from station.motion.kinematics.posture import pelvis_of
from station.motion.kinematics.splines import SplineChannels
from station.motion.kinematics.trunk import TrunkAngles, trunk
from station.motion.kit.instruments import Instrument, instruments
from station.motion.kit.kit import Kit
from station.motion.sticking.limbs import Assignment, assign_limbs
from station.motion.strokes.hand import HandPart
from station.motion.strokes.hand_events import HandEvents, hand_events
from station.motion.strokes.lap import Thigh, thighs
from station.motion.strokes.targets import strike_points
from station.motion.style.style import Style
from station.music.score import Score

Array = NDArray[np.float64]

QUIET = Style(phrase=0.0, fill_lean=0.0, variation=0.0)
"""The style whose shoulders are in the middle of what all others make of them."""
LIVELY = Style(amplitude_twist=75.0, amplitude_back=95.0, amplitude_side=45.0, shrug=50.0, phrase=60.0, fill_lean=100.0)
"""The style whose shoulders are farthest from the natural ones: hands are so pointed that both serve their wrists."""
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
    visits: Visits
    path: FootPath | None
    footings: tuple[Footing, Footing]
    instruments: tuple[Instrument, ...]

    @classmethod
    def of(cls, score: Score, kit: Kit, figure: Figure, assignment: Assignment | None = None) -> "MotionPlan":
        """The plan of `score`; `assignment` is `assign_limbs`' own where none is given."""
        who = assignment or assign_limbs(score, kit)
        visits = Visits.of(score, who.limbs, kit.feet[1])
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
            visits=visits,
            path=FootPath.of(visits),
            footings=footings(kit, figure),
            instruments=tuple(instruments(score, kit, score.onset_s, points)),
        )

    @property
    def raised_rad(self) -> tuple[float, float, float]:
        """How far the boards of kick, hi-hat and slave are raised at rest."""
        kick, hat = self.kit.pedals[Piece.KICK], self.kit.pedals[Piece.HIHAT_PEDAL]
        return kick.raised_rad, hat.raised_rad, 0.0 if self.kit.slave is None else self.kit.slave.raised_rad

    @cached_property
    def _kicks(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """The rows of the kick's foot's strokes and of the slave's, in order of time."""
        score, limbs = self.score, self.assignment.limbs
        kicks = np.flatnonzero(score.notes["piece"] == Piece.KICK)
        kicks = kicks[np.argsort(score.onset_ns[kicks], kind="stable")]
        second = limbs[kicks] == self.kit.feet[1]
        return kicks[~second], kicks[second]

    def kicks(self, style: Style) -> tuple[SplineChannels, SplineChannels]:
        """The boards of the kick and of its slave over time."""
        first, second = (
            kick_board(
                self.score.onset_s[rows], self.score.notes["velocity"][rows].astype(float), style.beater == "buried"
            )
            for rows in self._kicks
        )
        return first, second

    def heels(self, style: Style) -> SplineChannels:
        """How the soles of the kick's and the hi-hat's foot tip in time."""
        moving = np.zeros(0) if self.path is None else self.path.busy_s
        busy = self.score.onset_s[self._kicks[0]], np.union1d(self.visits.time_s, moving)
        return heel_curves(self.ground, style, busy)

    def hands(self, style: Style, searches: int | None = None) -> tuple[HandPart, HandPart]:
        """Both hands' parts with what `style` makes them hold; `searches` as in `optimised`."""
        legs = thighs(self.kit, self.figure, self.footings, style.heel)
        right, left = (
            HandPart.of(self.score, self.kit, self.figure, hold, limb, events, own)
            for limb, hold, events, own in zip(HANDS, holds(style), self.events, legs, strict=True)
        )
        right, left = cleared((right, left), self.figure)
        if not (len(right.events.row) or len(left.events.row)):
            return right, left
        stage = self._stage((right, left), legs)
        lively = self._body(stage.grid, body_keys.curves(self.ground, LIVELY, body_keys.keys(self.ground, LIVELY)))
        shoulders = list(zip(stage.roots, lively[4:], strict=True))  # leaning too would bend wrists
        right, left = (hand.eased(self.figure, stage.grid, r) for hand, r in zip((right, left), shoulders, strict=True))
        hands, _ = optimised((right, left), stage, searches)
        return hands

    def left_over(self, style: Style, parts: tuple[HandPart, HandPart]) -> tuple[InfeasibleDemand, ...]:
        """Where both hands of `parts`, made for `style`, are in something all the same, by bar."""
        if not any(len(hand.events.row) for hand in parts):
            return ()
        return left_over(
            self.score, parts, self._stage(parts, thighs(self.kit, self.figure, self.footings, style.heel))
        )

    def _stage(self, hands: tuple[HandPart, HandPart], legs: tuple[Thigh, Thigh]) -> Stage:
        """The body in its natural posture, in which the `hands` must find their ways."""
        grid = looks(*(hand.events.time_s for hand in hands))
        points = self._body(grid, reaching(self.ground, QUIET, hands, self.figure, self.pelvis))
        pelvis, neck, head, crown, right, left = (p.T for p in points)
        body = BodyPoints(pelvis, neck, head, crown, (right, left), legs)
        return Stage(self.figure, self.kit, grid, (points[4], points[5]), body, (hands[0].bump, hands[1].bump))

    def _body(self, time_s: Array, curves: SplineChannels) -> Array:
        """Pelvis, neck's base, head, crown, shoulders at each time (n,) in a body moved by `curves`, (6, 3, n)."""
        points = np.empty((6, 3, len(time_s)))
        for block in blocks(len(time_s)):
            twist, lean, side, shrug, hunch, *_ = curves.many(time_s[block])
            frame = trunk(MANY, self.figure, self.pelvis, TrunkAngles(twist, lean, side, 0.0, 0.0, 0.0, shrug, hunch))
            ends = (self.pelvis, frame.neck, frame.head, frame.crown, frame.right_shoulder, frame.left_shoulder)
            for k, point in enumerate(ends):
                points[k, :, block] = np.stack(np.broadcast_arrays(*point, twist)[:3])
        return points

    def gaze(self, style: Style) -> SplineChannels:
        """Where the drummer looks."""
        sights, ticks = self._sights
        bars = bar_places(self.score, ticks) if style.automation else np.ones(1)
        return gaze_curve(sights, style.value("look_around", bars) / 100, style.seed, style.attention)

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
    return Hold.of(style.grip_right, style.held), Hold.of(style.grip_left, style.held)


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
        intensity=Intensity.of(times, onset, velocity, notes["piece"]),
    )


def bar_places(score: Score, ticks: NDArray[np.int64]) -> Array:
    """Each tick as a place in bars from 1, fractions within the bar."""
    bars = score.tempo_map.bars_at(ticks)
    starts = np.array([score.tempo_map.bar_start(b) for b in range(int(bars.max(initial=0)) + 2)], np.float64)
    return np.asarray(1 + bars + (ticks - starts[bars]) / (starts[bars + 1] - starts[bars]))
