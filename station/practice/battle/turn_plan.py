"""Who plays when: the turns of a battle in bars from its first downbeat, one after another without a gap.

A round is laid out in parts, each chosen at once shortly before it begins: a call and the answers to it, or where
players trade with each other a turn of everybody.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from enum import Enum

from station.practice.battle.battle_rules import DRUMMER, BattleMode, BattleRules
from station.practice.battle.phrase import Phrase


class TurnKind(Enum):
    """What somebody does in a turn."""

    CALL = "call"
    """The drummer plays what is to be repeated, or answered."""
    ANSWER = "answer"
    """A player repeats it, or improvises."""
    CHANGEOVER = "changeover"
    """The click goes on while players change seats; the turn's side is who plays next."""


@dataclass(frozen=True, eq=False)
class PlannedTurn:
    """A turn of `side` in `round` (from 1), `bars` long, from bar `first_bar` of the battle on.

    `phrase` is what the drummer plays in a call, and what is to be repeated in an answer; None in an improvised answer.
    `keeping` is how the drummer keeps time under it, None where the click does alone. `call` is the index of the call
    that an answer answers, `step` how hard what is repeated is, both None where there is none.
    """

    index: int
    round: int
    side: int
    kind: TurnKind
    first_bar: int
    bars: int
    phrase: Phrase | None = None
    keeping: Phrase | None = None
    call: int | None = None
    step: int | None = None

    @property
    def end_bar(self) -> int:
        """The bar after its last."""
        return self.first_bar + self.bars


Part = tuple[tuple[TurnKind, int], ...]
"""What follows each other, and whose it is."""


def parts_of_round(rules: BattleRules, number: int, sides: Collection[int]) -> tuple[Part, ...]:
    """The parts of round `number`, from 1, for the players' `sides` that are still in; change-overs apart.

    Where a call is repeated the players begin in turn, so that nobody always hears the others first; on one kit each
    hears the call anew, and whoever has just played begins. With a handicap each has a call of their own step. Who
    trades keeps to the order.
    """
    order = [side for side in rules.player_sides if side in sides]
    if rules.mode is BattleMode.IMPROVISE and not rules.is_solo:
        return (tuple((TurnKind.ANSWER, side) for side in order),)
    if not (rules.is_hot_seat or rules.has_handicap):
        answers = ((TurnKind.ANSWER, side) for side in _rotated(order, number - 1))
        return (((TurnKind.CALL, DRUMMER), *answers),)
    ordered = order if number % 2 else order[::-1]
    return tuple(((TurnKind.CALL, DRUMMER), (TurnKind.ANSWER, side)) for side in ordered)


def with_changeovers(part: Part, seated: int | None) -> Part:
    """The part with a change-over wherever somebody else has to sit down; `seated` has played last, None: nobody."""
    turns: list[tuple[TurnKind, int]] = []
    for place, (kind, side) in enumerate(part):
        player = next(other for what, other in part[place:] if what is TurnKind.ANSWER)
        if seated not in (None, player):
            turns.append((TurnKind.CHANGEOVER, player))
        seated = player
        turns.append((kind, side))
    return tuple(turns)


def _rotated(order: Sequence[int], by: int) -> Sequence[int]:
    place = by % len(order) if order else 0
    return [*order[place:], *order[:place]]
