"""One hand's part: which strikes it makes, where its stick touches, how high it rises before each."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, Zone
from station.motion import stroke
from station.motion.arm import ArmLengths, Contact, Offsets, solve
from station.motion.dynamics import stroke_height_m
from station.motion.figure import Figure
from station.motion.kit import Kit
from station.motion.maths import MANY, Point
from station.motion.piece import Target
from station.motion.splines import Curves
from station.motion.travel import Way, lifts
from station.music.score import Score

Array = NDArray[np.float64]

YAW_RAD = np.radians(10.0)
"""How far hand and stick are turned in from the line between shoulder and struck point (American grip, our choice)."""
PALM_RAD = np.radians(14.0)
"""The stick's angle μ in the palm at the contact (28.8° in the measured stroke, whose wrist was flat; our choice)."""
SHOULDER_OF_STICK_M = 0.10
"""From the tip back to the part that meets a cymbal's edge or a rim (our choice)."""
_SAME_STROKE_S = 0.004
"""Strikes of one hand nearer than this are one movement."""


def arm_lengths(figure: Figure) -> ArmLengths:
    """The measures that `arm` needs."""
    return ArmLengths(figure.upper_arm_m, figure.forearm_m, figure.hand_m, figure.stick_ahead_m, figure.stick_behind_m)


def contact_of(target: Target, limb: Limb, figure: Figure) -> tuple[float, ...]:
    """The contact's seven numbers (`arm.Contact`) for `target`."""
    ahead = figure.stick_ahead_m - (SHOULDER_OF_STICK_M if target.shoulder else 0.0)
    yaw = YAW_RAD if limb == Limb.RIGHT_HAND else -YAW_RAD
    x, y, z = target.point_m.tolist()
    return x, y, z, target.rise_rad, float(yaw), ahead, float(PALM_RAD)


@dataclass(frozen=True, eq=False)
class HandPart:
    """The strikes of one hand, in order: `rows` of the score, times, contacts (n, 7), heights, amplitudes (4, n)."""

    rows: NDArray[np.int64]
    times_s: Array
    contacts: Array
    height_m: Array
    amplitude: Array
    lever_m: Array
    way: Way

    @classmethod
    def of(
        cls, score: Score, kit: Kit, figure: Figure, limb: Limb, rows: NDArray[np.int64], shoulder: Point
    ) -> "HandPart":
        """The part of `limb`, whose strikes are `rows` of `score`; amplitudes are solved from `shoulder`, still."""
        rows = rows[np.argsort(score.onset_ns[rows], kind="stable")]
        times = score.onset_s[rows]
        if len(rows):
            keep = np.concatenate(([True], np.diff(times) > _SAME_STROKE_S))
            rows, times = rows[keep], times[keep]
        notes = score.notes[rows]
        kinds, which = np.unique(np.stack([notes["piece"], notes["zone"]], 1), axis=0, return_inverse=True)
        if len(rows):
            table = [contact_of(kit.target(Piece(p), Zone(z), limb), limb, figure) for p, z in kinds.tolist()]
            contacts = np.array(table)[which]
            played = np.array([kit.stand_in(Piece(p)) for p, _ in kinds.tolist()])[which]
            height = stroke_height_m(notes["velocity"])
        else:  # an idle hand waits over the snare
            contacts = np.array([contact_of(kit.target(Piece.SNARE, Zone.HEAD, limb), limb, figure)])
            played, times, height = np.array([int(Piece.SNARE)]), np.array([-60.0]), np.array([0.05])
        arm = solve(MANY, arm_lengths(figure), shoulder, Contact(*contacts.T), Offsets(0.0, 0.0, 0.0, 0.0), 0.0)
        gamma, beta, alpha, mu = arm.angles
        angles = np.stack(np.broadcast_arrays(gamma, gamma + beta, gamma + beta + alpha, gamma + beta + alpha + mu))
        lever = np.full(len(times), figure.hand_m + figure.stick_ahead_m)
        return cls(
            rows,
            times,
            contacts,
            height,
            stroke.amplitudes(height, angles, arm_lengths(figure)),
            lever,
            Way.of(times, contacts, lifts(kit, contacts, played)),
        )

    def offsets(self, sliders: stroke.Sliders) -> list[Curves]:
        """The strokes' keyframes under `sliders`."""
        return stroke.curves(self.times_s, self.height_m, self.amplitude, self.lever_m, sliders)
