"""One hand's part: which strikes it makes, where its stick touches, how high it rises before each."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Articulation, Limb, Piece, Zone, word
from station.motion.arm import Contact, Offsets, solve
from station.motion.contacts import PROTRACTION_M, Strike, contact
from station.motion.dynamics import stroke_height_m
from station.motion.figure import Figure
from station.motion.grip import Hold
from station.motion.kit import Kit
from station.motion.maths import ONE, Point
from station.motion.stroke import StrokePlan, amplitudes
from station.motion.travel import Way, lifts
from station.music.score import Score

Array = NDArray[np.float64]

SAME_STROKE_S = 0.004
"""Strikes of one hand nearer than this are one movement."""
GRACE_HEIGHT_M, LAID_HEIGHT_M = 0.045, 0.06
"""Grace strokes fall from no higher than this, a cross-stick's stick is lifted no higher (our choice)."""
_LONG_AGO_S = -60.0
_IDLE_HEIGHT_M = 0.05


@dataclass(frozen=True, eq=False)
class HandPart:
    """The strikes of one hand, in order of time.

    `rows` (n,) of the score, `contacts` (n, fields), `wrist_m` (n, 3) where the wrist is at each, naturally; the plan
    of its strokes and its way between them. A hand without strikes waits over the snare: `rows` is empty, n is 1.
    """

    rows: NDArray[np.int64]
    contacts: Array
    wrist_m: Array
    strokes: StrokePlan
    way: Way

    @classmethod
    def of(cls, score: Score, kit: Kit, figure: Figure, hold: Hold, limb: Limb, rows: NDArray[np.int64]) -> "HandPart":
        """The part of `limb`, whose strikes are `rows` of `score`.

        Raises `BadInput` for a piece out of reach: it names the piece, the note and the missing distance.
        """
        rows = rows[np.argsort(score.onset_ns[rows], kind="stable")]
        times = score.onset_s[rows]
        keep = np.diff(times, prepend=-np.inf) > SAME_STROKE_S
        rows, times = rows[keep], times[keep]
        notes = score.notes[rows]
        if len(rows):
            key = np.stack([notes["piece"], notes["zone"], notes["articulation"]], 1)
            height = _heights(notes) * hold.held.height
        else:
            key = np.array([[Piece.SNARE, Zone.HEAD, Articulation.NORMAL]])
            times, height = np.array([_LONG_AGO_S]), np.array([_IDLE_HEIGHT_M])
        kinds, which = np.unique(key, axis=0, return_inverse=True)
        which = which.reshape(-1)
        ways = [_lie_of(kit, figure, hold, Strike(Piece(p), Zone(z), Articulation(a), limb)) for p, z, a in kinds]
        for k, lie in enumerate(ways):
            if lie.missing_m > PROTRACTION_M:
                _out_of_reach(score, kit, limb, int(rows[np.argmax(which == k)]), lie.missing_m - PROTRACTION_M)
        contacts = np.array([lie.contact for lie in ways])[which]
        lengths = hold.lengths(figure)
        plan = StrokePlan(
            strike_s=times,
            height_m=height,
            amplitude=amplitudes(height, np.array([lie.angles for lie in ways])[which].T, lengths, _parts(hold)),
            ceiling=np.array([lie.ceiling for lie in ways])[which].T,
            lever_m=lengths.hand + lengths.ahead,
        )
        edge = np.array([kit.target(Piece(p), Zone(z), limb).shoulder for p, z, _ in kinds])[which]
        played = np.array([kit.stand_in(Piece(p)) for p, _, _ in kinds])[which]
        way = Way.of(times, contacts, lifts(kit, contacts, played), edge[:-1])
        return cls(rows, contacts, np.array([lie.wrist for lie in ways])[which], plan, way)


def _heights(notes: NDArray[np.void]) -> Array:
    height = stroke_height_m(notes["velocity"])
    height = np.where(notes["lead_ms"] > 0, np.minimum(height, GRACE_HEIGHT_M), height)
    laid = notes["articulation"] == Articulation.CROSS_STICK
    return np.where(laid, np.minimum(height, LAID_HEIGHT_M), height)


def _parts(hold: Hold) -> Array:
    return np.array([[1.0], [1.0], [hold.grip.wrist], [hold.grip.fingers]])


@dataclass(frozen=True, slots=True)
class _Lie:
    """One kind of strike solved at the natural posture."""

    contact: Contact
    missing_m: float
    wrist: Point
    angles: tuple[float, float, float, float]
    ceiling: tuple[float, float, float, float]


def _lie_of(kit: Kit, figure: Figure, hold: Hold, strike: Strike) -> _Lie:
    touch, missing, shoulder = contact(kit, figure, strike, hold)
    arm = solve(ONE, hold.lengths(figure), shoulder, touch, Offsets(0.0, 0.0, 0.0, 0.0))
    upright = np.pi / 2
    angles = arm.shoulder, arm.shoulder + arm.elbow_bend, upright - touch.hand_rise, upright - touch.stick_rise
    limits = figure.limits
    ceiling = (
        limits.shoulder_flexion - arm.shoulder,
        limits.elbow_flexion - arm.elbow_bend,
        max(limits.wrist_extension - arm.extension, 0.1),
        max(limits.fingers - arm.palm, 0.1),
    )
    return _Lie(touch, missing, arm.wrist, angles, ceiling)


def _out_of_reach(score: Score, kit: Kit, limb: Limb, row: int, missing_m: float) -> None:
    note = score[row]
    where = score.tempo_map.position_at(note.tick)
    place = f"note {row + 1}, bar {where.bar + 1}, beat {where.beat + 1}"
    hand, piece = word(limb).replace("_", " "), word(kit.stand_in(note.piece))
    raise BadInput(kit.name, place, f"the {hand} cannot reach {piece}: {missing_m * 100:.0f} cm are missing")
