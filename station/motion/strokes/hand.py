"""One hand's part: where its stick touches at each event, how high it rises before, and its way between them."""

from dataclasses import dataclass, replace
from functools import cached_property
from math import radians

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.labels import limb_name
from station.core.pieces import Limb, Piece, Zone, word
from station.motion.kinematics.arm import Contact, Offsets, solve
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.grip import Hold
from station.motion.kinematics.maths import MANY, blocks
from station.motion.kit.kit import Kit
from station.motion.strokes.amplitudes import amplitudes, rebounds
from station.motion.strokes.contact_pose import PROTRACTION_M, ContactPose, lie_of
from station.motion.strokes.hand_events import LAP, SHOW, HandEvents
from station.motion.strokes.lap import Thigh
from station.motion.strokes.stroke import NATURALLY, StrokePlan, Strokes
from station.motion.strokes.targets import Strike
from station.motion.strokes.travel import DETOUR, GIVES, HandPath, lifts
from station.music.score import Score

Array = NDArray[np.float64]

_SPARE_RAD = radians(5)
"""What is left of a wrist's limits sideways in the natural style, for others to use (our choice)."""
_EASINGS = 4
_LEAST_HUMP = 0.3
"""Moments at which so little of a detour is left are not helped by turning the hand (our choice)."""
SLACK_RAD = radians(10)
"""So far the stick may turn in the palm to either side: its butt still leaves under the heel (our choice)."""
_ELBOW_FOR_WRIST, _MOST_ELBOW_RAD, _WINGS_RAD = 1.0, radians(15), (radians(-10), radians(80))
"""An elbow that goes out by so much of it takes a bend to the thumb's side from the wrist, step by step."""
_VIGOROUS = 2.0
"""Styles may make strokes so much higher, and on its ways the wrist must bear them (our choice)."""
_TURNS = Contact._fields.index("turns")
_HAND_YAW, _WING = Contact._fields.index("hand_yaw"), Contact._fields.index("wing")


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
    def of(  # noqa: PLR0913, PLR0917 - who plays what, on what, with what
        cls, score: Score, kit: Kit, figure: Figure, hold: Hold, limb: Limb, events: HandEvents, thigh: Thigh
    ) -> "HandPart":
        """The part of `limb` with `events`; `thigh` on which it rests.

        Raises `BadInput` for a piece out of reach: it names the piece, the note and the missing distance.
        """
        kinds, which = np.unique(events.key, axis=0, return_inverse=True)
        which = which.reshape(-1)
        strikes = [Strike(Piece(p), Zone(z), a, limb) for p, z, a in kinds.tolist()]
        lies = tuple(lie_of(kit, figure, hold, strike, thigh) for strike in strikes)
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

    @property
    def _slack_rad(self) -> float:
        """How far the hand may turn on its stick: one that lies across the hand moves with it."""
        return SLACK_RAD if self.hold.grip.turns_hand else 0.0

    def eased(self, figure: Figure, time_s: Array, roots: tuple[Array, Array]) -> "HandPart":
        """The same, hand turned on its stick and elbow so far out that the wrist stays within its limits sideways.

        `roots` are where the shoulder is at `time_s` (k,) as the body naturally is, and as a lively one has it, which
        counts while the hand stays; (3, k) each.
        """
        limits = figure.limits
        most, least = limits.wrist_radial - _SPARE_RAD, _SPARE_RAD - limits.wrist_ulnar
        strokes = Strokes.of(self.strokes, NATURALLY)
        part, side = self, 1.0 if self.limb == Limb.RIGHT_HAND else -1.0
        out = np.zeros(len(self.contacts))
        for _ in range(_EASINGS):
            contacts = part.contacts.copy()
            bent, lively = (part._sideways(figure, time_s, root, strokes) for root in roots)
            nearest, stays = part.way.nearest(time_s)
            low, high = np.full(len(contacts), np.inf), np.full(len(contacts), -np.inf)
            np.maximum.at(high, nearest[stays], np.maximum(bent, lively)[stays])
            np.minimum.at(low, nearest[stays], np.minimum(bent, lively)[stays])
            turn = np.zeros(len(contacts))  # what the ways want, within what the stays allow
            np.maximum.at(turn, nearest, bent - most)
            under = np.zeros(len(contacts))
            np.minimum.at(under, nearest, bent - least)
            turn += under
            least_turn, most_turn = high - most, low - least
            middle = 0.5 * (least_turn + most_turn)
            turn = np.clip(turn, np.minimum(least_turn, middle), np.maximum(most_turn, middle))
            in_hand = np.clip(out + turn, -self._slack_rad, self._slack_rad) - out
            out += in_hand
            contacts[:, _HAND_YAW] -= side * in_hand
            elbow = np.clip(_ELBOW_FOR_WRIST * (turn - in_hand), -_MOST_ELBOW_RAD, _MOST_ELBOW_RAD)
            contacts[:, _WING] = side * np.clip(side * contacts[:, _WING] + elbow, *_WINGS_RAD)
            part = replace(part, contacts=contacts)
        if not len(self.bump):
            return part
        vigorous = part._sideways(figure, time_s, roots[1], strokes, _VIGOROUS)
        return part._turned_on_ways(side, time_s, (bent, vigorous), (least, most))

    def _sideways(self, figure: Figure, time_s: Array, root: Array, strokes: Strokes, share: float = 1.0) -> Array:
        """How far the wrist is bent to the thumb's side at `time_s` (k,) with the shoulder at `root` (3, k).

        With this share of the `strokes`.
        """
        right = self.limb == Limb.RIGHT_HAND
        lengths, bent = self.hold.lengths(figure, right), np.empty(len(time_s))
        for block in blocks(len(time_s)):
            at = time_s[block]
            raised = Offsets(*(share * o for o in strokes.many(at)))
            x, y, z = root[:, block]
            bent[block] = solve(MANY, lengths, (x, y, z), self.way.many(at), raised).deviation
        return bent if right else -bent

    def _turned_on_ways(
        self, side: float, time_s: Array, bends: tuple[Array, ...], bounds: tuple[float, float]
    ) -> "HandPart":
        """The same, hand turned on its stick on its ways as far as the `bends` at `time_s` are beyond `bounds`."""
        k, hump = self.way.humps(time_s)
        helped = hump > _LEAST_HUMP
        turn = np.zeros((2, len(self.bump)))
        for bent in bends:
            over = (bent - np.clip(bent, *bounds))[helped] / hump[helped]
            np.maximum.at(turn[0], k[helped], over)
            np.minimum.at(turn[1], k[helped], over)
        bump = self.bump.copy()
        bump[:, 3] -= side * np.clip(turn.sum(0), -self._slack_rad, self._slack_rad)
        return replace(self, bump=bump)

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
