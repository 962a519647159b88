"""One hand's part: where its stick touches at each event, how high it rises before, and its way between them."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece, Zone, word
from station.motion.contacts import PROTRACTION_M, Lie, Strike, lie_of
from station.motion.events import HandEvents
from station.motion.figure import Figure
from station.motion.grip import Hold
from station.motion.kit import Kit
from station.motion.stroke import StrokePlan, amplitudes
from station.motion.travel import Way, lifts
from station.music.score import Score

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class HandPart:
    """The events of one hand and how it makes them.

    `lies` are the kinds of contact that occur, `which` (n,) the kind of each event, `wrist_m` (n, 3) where the wrist is
    at each, naturally; the plan of its strokes and its way between them.
    """

    limb: Limb
    hold: Hold
    events: HandEvents
    lies: tuple[Lie, ...]
    which: NDArray[np.int64]
    wrist_m: Array
    strokes: StrokePlan
    way: Way

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
        way = Way.of(events.time_s, contacts, lifts(kit, contacts, played), left_at_once[:-1])
        return cls(limb, hold, events, lies, which, np.array([lie.wrist for lie in lies])[which], plan, way)

    def cleared(self, height_m: Array, lift_m: Array) -> "HandPart":
        """The same, no stroke higher than `height_m` (n,), whatever the sliders say, the ways lifted by `lift_m`."""
        most = height_m / np.maximum(self.strokes.height_m, 1e-6)
        return replace(self, strokes=replace(self.strokes, most=most), way=self.way.lifted(lift_m))


def parts(hold: Hold) -> Array:
    """What `hold` makes of each joint's part in a stroke, (4, 1)."""
    return np.array([[1.0], [1.0], [hold.grip.wrist], [hold.grip.fingers]])


def _out_of_reach(score: Score, kit: Kit, strike: Strike, row: int, missing_m: float) -> None:
    where = score.tempo_map.position_at(int(score.notes["tick"][row]))
    place = f"note {row + 1}, bar {where.bar + 1}, beat {where.beat + 1}"
    hand, piece = word(strike.limb).replace("_", " "), word(kit.stand_in(strike.piece))
    lack = (missing_m - PROTRACTION_M) * 100
    raise BadInput(kit.name, place, f"the {hand} cannot reach {piece}: {max(lack, 1):.0f} cm are missing")
