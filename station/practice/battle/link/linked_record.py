"""The record of a battle of two stations: every turn of both players, what each end says of it, and one digest of all.

A turn stands once both ends have judged it. The record is the same at both ends, or its digest says that it is not.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from hashlib import blake2b

from station.practice.battle.battle_result import JudgedTurn
from station.practice.battle.link.link_messages import Claim, PlayedTurn, encoded
from station.practice.battle.link.linked_claims import agree
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.turn_marks import TurnMarks
from station.practice.battle.turn_plan import PlannedTurn, TurnKind

DIGEST_BYTES = 16


@dataclass(frozen=True, eq=False)
class SharedTurn:
    """A turn of `side` in `round`: what was played, and the `claim` of the station that it was played at.

    `phrase` and `step` are what was to be repeated. `marks` are what this end finds, and `checked` the claim of the end
    that received it; None until they are known.
    """

    round: int
    side: int
    turn: Turn
    said: PlayedTurn
    phrase: Phrase | None = None
    step: int | None = None
    marks: TurnMarks | None = None
    checked: Claim | None = None

    @property
    def claim(self) -> Claim:
        """What its own station judges it to be."""
        return self.said.claim

    @property
    def is_disputed(self) -> bool:
        """Whether both have judged it, and otherwise."""
        return self.checked is not None and not agree(self.claim, self.checked)

    @property
    def stands(self) -> bool:
        """Whether both have judged it."""
        return self.checked is not None

    def as_judged(self, index: int) -> JudgedTurn:
        """The turn as `battle_result` counts it; what is disputed counts for nobody."""
        planned = PlannedTurn(
            index, self.round, self.side, TurnKind.ANSWER, 0, self.turn.bars, self.phrase, step=self.step
        )
        return JudgedTurn(planned, self.turn, None if self.is_disputed else self.marks)


Slot = tuple[int, int]
"""Round, from 1, and side."""


class SharedTurns:
    """All turns so far, in the order that both ends know."""

    def __init__(self, slots: Iterable[Slot], agreed: bytes) -> None:
        self.slots = tuple(slots)
        """Who plays, in order."""
        self._agreed = agreed
        self._turns: dict[Slot, SharedTurn] = {}

    @property
    def turns(self) -> Mapping[Slot, SharedTurn]:
        """Those that both ends have, by their slot."""
        return self._turns

    def add(self, shared: SharedTurn) -> None:
        """A turn is known."""
        self._turns[(shared.round, shared.side)] = shared

    def check(self, slot: Slot, claim: Claim) -> None:
        """The other judgement of a turn is known."""
        self._turns[slot] = replace(self._turns[slot], checked=claim)

    def standing(self, upto: int | None = None) -> tuple[SharedTurn, ...]:
        """The turns that stand, in order, as far as none is missing; those of rounds up to `upto` alone."""
        found: list[SharedTurn] = []
        for slot in self.slots:
            shared = self._turns.get(slot)
            if shared is None or not shared.stands or (upto is not None and slot[0] > upto):
                break
            found.append(shared)
        return tuple(found)

    def judged(self) -> tuple[JudgedTurn, ...]:
        """The same, as `battle_result` counts them."""
        return tuple(shared.as_judged(index) for index, shared in enumerate(self.standing()))

    @property
    def disputed(self) -> tuple[SharedTurn, ...]:
        """Those whose two judgements differ."""
        return tuple(shared for shared in self._turns.values() if shared.is_disputed)

    @property
    def digest(self) -> str:
        """32 hexadecimal digits of what was agreed, and of every turn that stands with both claims."""
        whole = blake2b(self._agreed, digest_size=DIGEST_BYTES)
        for shared in self.standing():
            assert shared.checked is not None, "it stands"
            whole.update(encoded(shared.said))
            whole.update(repr((shared.side, shared.step, _said(shared.claim), _said(shared.checked))).encode())
        return whole.hexdigest()


def _said(claim: Claim) -> tuple[object, ...]:
    return claim.points, claim.won, *((figure.name, figure.value) for figure in claim.figures)
