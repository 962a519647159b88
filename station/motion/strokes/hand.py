"""One hand's part: where its stick touches at each event, how high it rises before, and its way between them."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.labels import limb_name
from station.core.pieces import Limb, Piece, Zone, word
from station.motion.kinematics.arm import Contact
from station.motion.kinematics.figure import Figure
from station.motion.kit.kit import Kit
from station.motion.strokes.amplitudes import amplitudes, rebounds
from station.motion.strokes.contact_pose import PROTRACTION_M, ContactPose, lie_of
from station.motion.strokes.grip import Hold
from station.motion.strokes.hand_events import LAP, SHOW, HandEvents
from station.motion.strokes.stroke import StrokePlan
from station.motion.strokes.targets import Strike
from station.motion.strokes.travel import DETOUR, GIVES, HandPath, lifts
from station.music.score import Score

Array = NDArray[np.float64]

_TURNS = Contact._fields.index("turns")


@dataclass(frozen=True, eq=False)
class HandPart:
    """The events of one hand and how it makes them.

    `lies` are the kinds of contact that occur, `which` (n,) the kind of each event, `wrist_m` (n, 3) where the wrist is
    at each, naturally, and `contacts` (n, fields) what its arm is solved from; the plan of its strokes; `bump`
    (n − 1, 4) how each stretch between two events goes round (`HandPath.of`), and whether it is travelled `early` (n −
    1,); how it `gives` (n, 6) way after each event; `show`, where its stick is spun and tossed.
    """

    limb: Limb
    hold: Hold
    events: HandEvents
    lies: tuple[ContactPose, ...]
    which: NDArray[np.int64]
    wrist_m: Array
    strokes: StrokePlan
    contacts: Array
    bump: Array
    early: NDArray[np.bool_]
    gives: Array
    show: Contact

    @classmethod
    def of(
        cls, score: Score, kit: Kit, figure: Figure, hold: Hold, limb: Limb, events: HandEvents, heel: str
    ) -> "HandPart":
        """The part of `limb` with `events`; `heel` as in `Style`.

        Raises `BadInput` for a piece out of reach: it names the piece, the note and the missing distance.
        """
        kinds, which = np.unique(events.key, axis=0, return_inverse=True)
        which = which.reshape(-1)
        strikes = [Strike(Piece(p), Zone(z), a, limb) for p, z, a in kinds.tolist()]
        lies = tuple(lie_of(kit, figure, hold, strike, heel) for strike in strikes)
        for k, lie in enumerate(lies):
            if lie.missing_m > PROTRACTION_M and len(events.row):
                _out_of_reach(score, kit, strikes[k], int(events.row[np.argmax(which == k)]), lie.missing_m)
        contacts = np.array([lie.contact for lie in lies])[which]
        lengths = hold.lengths(figure)
        height = events.height_m * hold.held.height
        turns = contacts[:, _TURNS]
        amplitude = amplitudes(height, np.array([lie.angles for lie in lies])[which].T, lengths, parts(hold), turns)
        levers = lengths.ahead, lengths.hand * turns + lengths.ahead
        plan = StrokePlan(
            strike_s=events.time_s,
            height_m=height,
            amplitude=rebounds(amplitude, height, events.rebounds, events.bounces, levers),
            rebounds=events.rebounds | events.bounces,
            ceiling=np.array([lie.ceiling for lie in lies])[which].T,
            most=np.full(len(height), np.inf),
            lever_m=lengths.hand + lengths.ahead,
            rest_m=np.where(np.append(False, events.key[:-1, 2] == LAP), 0.0, hold.held.rest_m),  # there it lies
        )
        left_at_once = np.array([lie.shoulder_of_stick for lie in lies])[which]
        played = np.array([-1 if s.articulation == LAP else kit.stand_in(s.piece) for s in strikes])[which]
        wrists = np.array([lie.wrist for lie in lies])[which]
        bump = np.zeros((len(contacts) - 1, DETOUR))
        bump[:, 2] = lifts(kit, contacts, played)
        show = lie_of(kit, figure, hold, Strike(Piece.SNARE, Zone.HEAD, SHOW, limb)).contact
        gives = np.zeros((len(contacts), GIVES))
        return cls(limb, hold, events, lies, which, wrists, plan, contacts, bump, left_at_once[:-1], gives, show)

    @cached_property
    def way(self) -> HandPath:
        """The way between the contacts."""
        return HandPath.of(self.events.time_s, self.contacts, self.bump, self.early, self._easy, self.gives)

    @property
    def _easy(self) -> NDArray[np.bool_]:
        """Which stretches lead to the thigh or from it, (n − 1,)."""
        lies = self.events.key[:, 2] == LAP
        return np.asarray(lies[:-1] | lies[1:])

    def held_under(self, height_m: Array) -> "HandPart":
        """The same, no stroke higher than `height_m` (n,), whatever the sliders say."""
        most = height_m / np.maximum(self.strokes.height_m, 1e-6)
        return replace(self, strokes=replace(self.strokes, most=most))

    def led(self, bump: Array, most: Array, contacts: Array, gives: Array) -> "HandPart":
        """The same on the ways of `bump` (n − 1, 4) between `contacts`, no stroke over `most` (n,) times its height.

        `gives` (n, 6) is how the hand gives way.
        """
        return replace(self, bump=bump, contacts=contacts, gives=gives, strokes=replace(self.strokes, most=most))


def parts(hold: Hold) -> Array:
    """What `hold` makes of each joint's part in a stroke, (4, 1)."""
    return np.array([[1.0], [1.0], [hold.grip.wrist], [hold.grip.fingers]])


def _out_of_reach(score: Score, kit: Kit, strike: Strike, row: int, missing_m: float) -> None:
    where = score.tempo_map.position_at(int(score.notes["tick"][row]))
    place = f"note {row + 1}, bar {where.bar + 1}, beat {where.beat + 1}"
    hand, piece = limb_name(strike.limb), word(kit.stand_in(strike.piece))
    lack = (missing_m - PROTRACTION_M) * 100
    raise BadInput(kit.name, place, f"the {hand} cannot reach {piece}: {max(lack, 1):.0f} cm are missing")
