"""One hand's part: where its stick touches at each event, how high it rises before, and its way between them."""

from dataclasses import dataclass, replace
from functools import cached_property
from math import radians

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece, Zone, word
from station.motion.arm import Contact, Offsets, solve
from station.motion.contacts import PROTRACTION_M, Lie, Strike, lie_of
from station.motion.events import HandEvents
from station.motion.figure import Figure
from station.motion.grip import Hold
from station.motion.kit import Kit
from station.motion.maths import MANY, Point
from station.motion.stroke import StrokePlan, amplitudes
from station.motion.travel import HIGHEST_M, Way, lifts
from station.music.score import Score

Array = NDArray[np.float64]

EASE_RAD = radians(12)
"""How far a wrist is bent sideways at most at a strike (our choice; its limits are 20° and 30°)."""
_HAND_YAW = Contact._fields.index("hand_yaw")


@dataclass(frozen=True, eq=False)
class HandPart:
    """The events of one hand and how it makes them.

    `lies` are the kinds of contact that occur, `which` (n,) the kind of each event, `wrist_m` (n, 3) where the wrist is
    at each, naturally, and `contacts` (n, fields) what its arm is solved from; the plan of its strokes; how far each
    stretch between two events (n − 1,) is lifted, and whether it is travelled early.
    """

    limb: Limb
    hold: Hold
    events: HandEvents
    lies: tuple[Lie, ...]
    which: NDArray[np.int64]
    wrist_m: Array
    strokes: StrokePlan
    contacts: Array
    lift_m: Array
    early: NDArray[np.bool_]

    @classmethod
    def of(cls, score: Score, kit: Kit, figure: Figure, hold: Hold, limb: Limb, events: HandEvents) -> "HandPart":
        """The part of `limb` with `events`.

        Raises `BadInput` for a piece out of reach: it names the piece, the note and the missing distance.
        """
        kinds, which = np.unique(events.key, axis=0, return_inverse=True)
        which = which.reshape(-1)
        strikes = [Strike(Piece(p), Zone(z), a, limb) for p, z, a in kinds.tolist()]
        lies = tuple(lie_of(kit, figure, hold, strike) for strike in strikes)
        for k, lie in enumerate(lies):
            if lie.missing_m > PROTRACTION_M and len(events.row):
                _out_of_reach(score, kit, strikes[k], int(events.row[np.argmax(which == k)]), lie.missing_m)
        contacts = np.array([lie.contact for lie in lies])[which]
        lengths = hold.lengths(figure)
        height = events.height_m * hold.held.height
        plan = StrokePlan(
            strike_s=events.time_s,
            height_m=height,
            amplitude=amplitudes(height, np.array([lie.angles for lie in lies])[which].T, lengths, parts(hold)),
            ceiling=np.array([lie.ceiling for lie in lies])[which].T,
            most=np.full(len(height), np.inf),
            lever_m=lengths.hand + lengths.ahead,
        )
        left_at_once = np.array([lie.shoulder_of_stick for lie in lies])[which]
        played = np.array([kit.stand_in(s.piece) for s in strikes])[which]
        wrists = np.array([lie.wrist for lie in lies])[which]
        lift_m = lifts(kit, contacts, played)
        return cls(limb, hold, events, lies, which, wrists, plan, contacts, lift_m, left_at_once[:-1])

    @cached_property
    def way(self) -> Way:
        """The way between the contacts."""
        return Way.of(self.events.time_s, self.contacts, np.minimum(self.lift_m, HIGHEST_M), self.early)

    def eased(self, figure: Figure, roots: Point) -> "HandPart":
        """The same with every hand pointed so that its wrist is not bent sideways beyond ease.

        `roots` are the shoulder's x, y, z (n,) as the body naturally is at each event.
        """
        contacts = self.contacts.copy()
        lengths = self.hold.lengths(figure, self.limb == Limb.RIGHT_HAND)
        for _ in range(2):
            arm = solve(MANY, lengths, roots, Contact(*contacts.T), Offsets(0.0, 0.0, 0.0, 0.0))
            contacts[:, _HAND_YAW] -= arm.deviation - np.clip(arm.deviation, -EASE_RAD, EASE_RAD)
        return replace(self, contacts=contacts)

    def cleared(self, height_m: Array, lift_m: Array) -> "HandPart":
        """The same, no stroke higher than `height_m` (n,), whatever the sliders say, the ways lifted by `lift_m`."""
        most = height_m / np.maximum(self.strokes.height_m, 1e-6)
        strokes = replace(self.strokes, most=most)
        return replace(self, strokes=strokes, lift_m=np.maximum(self.lift_m, lift_m))


def parts(hold: Hold) -> Array:
    """What `hold` makes of each joint's part in a stroke, (4, 1)."""
    return np.array([[1.0], [1.0], [hold.grip.wrist], [hold.grip.fingers]])


def _out_of_reach(score: Score, kit: Kit, strike: Strike, row: int, missing_m: float) -> None:
    where = score.tempo_map.position_at(int(score.notes["tick"][row]))
    place = f"note {row + 1}, bar {where.bar + 1}, beat {where.beat + 1}"
    hand, piece = word(strike.limb).replace("_", " "), word(kit.stand_in(strike.piece))
    lack = (missing_m - PROTRACTION_M) * 100
    raise BadInput(kit.name, place, f"the {hand} cannot reach {piece}: {max(lack, 1):.0f} cm are missing")
