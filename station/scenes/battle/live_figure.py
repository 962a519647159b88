"""A player's figure, moved by strokes that nobody wrote, limb by limb.

What a limb does about a stroke is borrowed from a vocabulary take; its rebound is its preparation backwards. Between
two strokes it goes from the rebound of the one to the preparation of the other in minimum jerk, and where no other is
known home. A stroke that is heard cannot be prepared: the limb goes to the piece within `ATTACK_S`, which is over
before one sees that it is late, while the piece lights up at once. A stroke that is expected, for the phrase is known
that is repeated, is prepared, and waited for above the piece; one that is known beforehand falls when it sounds.

Which hand struck nobody knows but a kit that says it: it is the one that would come there soonest, for its way and for
its last stroke; in a row of quick strokes the hands alternate so. The trunk is between what both hands' strokes ask of
it; where it leaves a shoulder elsewhere than the borrowed arm had it, the elbow makes up for it (`pose_mix`).

Times are battle time in seconds.
"""

from bisect import insort
from dataclasses import dataclass, field
from math import sin

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.pose import Pose
from station.music.score import Score
from station.scenes.battle.pose_mix import minimum_jerk, restore_lengths
from station.scenes.battle.vocabulary import Vocabulary
from station.scenes.student_figure import LIMB_FIELDS

ATTACK_S = 0.033
"""A limb is at a piece that it was not expected at so soon after the stroke was heard: two pictures of sixty a second.
People see a flash and hear a beep as one to some 80 ms (our choice: well within)."""
REBOUND_S, REBOUNDS = 0.14, 0.6
"""How long and how high a stick rises from a contact, of what it fell; then the limb stays raised, or goes on its way
(our choice). It goes back the way that it came: the vocabulary's own strokes are followed by a rest, and stay low."""
PREPARED_S = 0.22
"""So long before a contact the borrowed preparation begins (our choice)."""
WAITS_S = 0.07
"""A limb that expects a stroke waits so long before its contact, where the stick begins to fall (our choice)."""
HOME_AFTER_S, HOME_S = 0.6, 0.7
"""A limb that has struck nothing for so long goes home, and takes so long (our choice)."""
EXPECTS_S = 1.0
"""Strokes that are expected within so long are prepared (our choice)."""
_FAST_M_S = 4.0
"""What a hand's way costs, in seconds: drummers' moves are seldom faster (docs/motion.md counts from 3 m/s on)."""
_AGAIN_S, _AGAIN_COSTS = 0.18, 4.0
"""A hand that struck less than this ago is so much less likely by what lacks of it: hands alternate from six to eight
strokes a second on."""
_LEADS_S = 0.12
"""So much sooner, as it were, the leading hand is at a hi-hat or a cymbal, and the other one at the snare: as drummers
sit (docs/motion.md, our choice of how much)."""
_SOFT, _HARD = 0.35, 1.15
"""Heights of the softest and the hardest stroke, of the borrowed one (our choice)."""
_KEPT = 12
_BREATH_M, _BREATH_HZ = 0.004, 0.25
HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)
_TRUNK = np.array(sorted(set(range(frame.PLAYED)) - {int(i) for fields in LIMB_FIELDS.values() for i in fields}))
_SHOULDERS = Joint.RIGHT_SHOULDER, Joint.LEFT_SHOULDER


@dataclass(frozen=True, slots=True, order=True)
class Stroke:
    """A limb struck a piece of the kit at `at_s`; `is_known` beforehand, so that it is prepared."""

    at_s: float
    limb: Limb = field(compare=False)
    piece: Piece = field(compare=False)
    velocity: int = field(compare=False, default=96)
    is_known: bool = field(compare=False, default=False)

    @property
    def seen_s(self) -> float:
        """When its contact is seen."""
        return self.at_s if self.is_known else self.at_s + ATTACK_S


class LiveFigure:
    """The figure of whoever plays, over their `vocabulary`."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self.kit = vocabulary.drummer.kit
        self._strokes: dict[Limb, list[Stroke]] = {limb: [] for limb in Limb if limb is not Limb.UNKNOWN}
        self._expected: dict[Limb, list[Stroke]] = {limb: [] for limb in self._strokes}
        self._rest = vocabulary.drummer.pose(-60.0)
        kicks, hats = self.kit.feet
        self._pedals = {kicks: [frame.BEATER], hats: [frame.GAP, frame.SLAVE_BOARD, frame.SLAVE_BEATER]}

    def strike(
        self, at_s: float, piece: Piece, velocity: int, limb: Limb = Limb.UNKNOWN, is_known: bool = False
    ) -> None:
        """Take in a stroke on `piece`, which the kit may lack; `limb` where it is known who struck."""
        own = self._own(piece)
        able = self._vocabulary.limbs(own)
        if not able:
            return
        who = limb if limb in able else min(able, key=lambda each: self._cost_s(each, own, at_s))
        row = self._strokes[who]
        insort(row, Stroke(at_s, who, own, velocity, is_known))
        del row[:-_KEPT]

    def forget_from(self, at_s: float) -> None:
        """Forget what was struck from then on."""
        for limb, row in self._strokes.items():
            self._strokes[limb] = [stroke for stroke in row if stroke.at_s < at_s]

    def expect(self, score: Score, start_s: float) -> None:
        """What is written from `start_s` on, and not heard yet; what was expected before is forgotten."""
        for row in self._expected.values():
            row.clear()
        for at_s, note in zip((score.onset_s + start_s).tolist(), score.notes, strict=True):
            limb, piece = Limb(int(note["limb"])), self._own(Piece(int(note["piece"])))
            if (limb, piece) in self._vocabulary.at_s:
                insort(self._expected[limb], Stroke(at_s, limb, piece, int(note["velocity"])))

    def _own(self, piece: Piece) -> Piece:
        """What the kit has in place of a piece."""
        return piece if piece is Piece.HIHAT_PEDAL else self.kit.stand_in(piece)

    def _cost_s(self, limb: Limb, piece: Piece, at_s: float) -> float:
        """How long it would take a limb to come to a piece."""
        before = self._strokes[limb]
        if not limb.is_hand:
            return 0.0
        tip = frame.TIP.start + 3 * HANDS.index(limb)
        here, there = self._row(limb, at_s)[tip : tip + 3], self._vocabulary.contact((limb, piece))[tip : tip + 3]
        way_s = float(np.linalg.norm(here - there)) / _FAST_M_S
        since_s = at_s - before[-1].at_s if before else np.inf
        leads = (limb is Limb.LEFT_HAND) is self.kit.left_handed
        if leads is (self.kit.pieces[piece].kind in ("cymbal", "hihat")) and not self._is_tom(piece):
            way_s -= _LEADS_S
        return way_s + _AGAIN_COSTS * max(_AGAIN_S - since_s, 0.0)

    def _is_tom(self, piece: Piece) -> bool:
        return self.kit.pieces[piece].kind not in ("cymbal", "hihat") and piece is not Piece.SNARE

    # --- how it stands ------------------------------------------------------------------------------------------------

    def pose(self, at_s: float) -> Pose:
        """How the figure stands at a time."""
        rows = {limb: self._row(limb, at_s) for limb in self._strokes}
        row = np.array(self._rest.row)
        row[_TRUNK] = (rows[HANDS[0]][_TRUNK] + rows[HANDS[1]][_TRUNK]) / 2
        row[frame.JOINTS][2::3][1:5] += _BREATH_M * sin(2 * np.pi * _BREATH_HZ * at_s)
        for limb, fields in LIMB_FIELDS.items():
            row[fields] = rows[limb][fields]
            row[self._pedals.get(limb, [])] = rows[limb][self._pedals.get(limb, [])]
        self._join(row, rows)
        row[frame.PLAYED :] = 0.0
        return Pose(at_s, row, self._rest.holds)

    def _join(self, row: NDArray[np.float64], rows: dict[Limb, NDArray[np.float64]]) -> None:
        """Put both shoulders where the trunk has them, and give limbs their lengths."""
        for shoulder in _SHOULDERS:
            at = slice(3 * shoulder, 3 * shoulder + 3)
            row[at] = (rows[HANDS[0]][at] + rows[HANDS[1]][at]) / 2
        restore_lengths(row, self._rest.row)

    def _row(self, limb: Limb, at_s: float) -> NDArray[np.float64]:
        """A row in which the limb is right, and the trunk as it would have it."""
        return self._before(limb, at_s, len(self._strokes[limb]))

    def _before(self, limb: Limb, at_s: float, count: int) -> NDArray[np.float64]:
        """The same if only the first `count` of its strokes were heard."""
        strokes = self._strokes[limb][:count]
        past = [stroke for stroke in strokes if stroke.seen_s <= at_s]
        here = self._after(past[-1], at_s) if past else self._home(limb)
        coming = next((s for s in strokes[len(past) :] if s.is_known or s.at_s <= at_s), None)
        if coming is not None and not coming.is_known:
            contact = self._contact(coming, 0.0)
            share = minimum_jerk((at_s - coming.at_s) / ATTACK_S)
            was = self._before(limb, at_s, strokes.index(coming))
            return was + share * (contact - was)
        awaited = coming or self._awaited(limb, past[-1].at_s if past else -np.inf, at_s)
        return here if awaited is None else self._towards(here, past[-1] if past else None, awaited, at_s)

    def _awaited(self, limb: Limb, after_s: float, at_s: float) -> Stroke | None:
        """The next stroke that is expected of a limb and was not struck yet."""
        found = (stroke for stroke in self._expected[limb] if stroke.at_s > after_s + ATTACK_S)
        stroke = next((stroke for stroke in found if stroke.at_s > at_s - WAITS_S), None)
        return stroke if stroke is not None and stroke.at_s - at_s < EXPECTS_S else None

    def _towards(
        self, here: NDArray[np.float64], last: Stroke | None, coming: Stroke, at_s: float
    ) -> NDArray[np.float64]:
        """On the way from where the last stroke leaves the limb to the preparation of the coming one."""
        left_s = coming.at_s - at_s
        begins_s = max(coming.at_s - EXPECTS_S, last.seen_s if last else -np.inf)
        ends_s = coming.at_s - (0.0 if coming.is_known else WAITS_S)
        share = minimum_jerk((at_s - begins_s) / max(ends_s - begins_s, 1e-3))
        raised = self._contact(coming, -min(max(left_s, 0.0 if coming.is_known else WAITS_S), PREPARED_S))
        return here + share * (raised - here)

    def _after(self, stroke: Stroke, at_s: float) -> NDArray[np.float64]:
        """What the limb does after a stroke: rebounds, stays, and at last goes home."""
        since_s = at_s - stroke.seen_s
        row = self._contact(stroke, -min(since_s, REBOUND_S), REBOUNDS)
        share = minimum_jerk((since_s - HOME_AFTER_S) / HOME_S)
        return row if share <= 0 else row + share * (self._home(stroke.limb) - row)

    def _contact(self, stroke: Stroke, after_s: float, share: float = 1.0) -> NDArray[np.float64]:
        """The borrowed row so long after the stroke's contact, that `share` of as high as it was loud."""
        made = stroke.limb, stroke.piece
        contact = self._vocabulary.contact(made)
        if not after_s:
            return contact
        high = _SOFT + (_HARD - _SOFT) * stroke.velocity / 127
        return contact + share * high * (self._vocabulary.pose(made, after_s).row - contact)

    def _home(self, limb: Limb) -> NDArray[np.float64]:
        """Where a limb waits: a hand over the snare, a foot on its pedal."""
        if not limb.is_hand:
            return self._rest.row
        made = (limb, Piece.SNARE)
        return (
            self._contact(Stroke(0.0, *made, velocity=40), REBOUND_S)
            if made in self._vocabulary.at_s
            else self._rest.row
        )
