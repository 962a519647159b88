"""Which of all remembered items to practise next: block each until it is stable, then interleave.

What is due for review comes first. An item that is not stable yet is gone on with (TEACHING: block until stable), until
it is left for the day. Then comes another that is not stable, and where all are, they take turns, which makes them last
(then interleave): a session each, the one that was not played for longest first. Pure: states in, an item and why out.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date

from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.practice_steps import PassKind, PracticeItem
from station.drills.mastery.rules import DEFAULT_RULES, Rules


@dataclass(frozen=True, slots=True)
class Turn:
    """The `item` to practise next, and `why`."""

    item: PracticeItem
    why: str


def next_turn(current: ItemState, others: Sequence[ItemState], today: date, rules: Rules = DEFAULT_RULES) -> Turn:
    """What comes after a session on `current` for a student who also knows `others`, in any fixed order."""
    due = [state for state in others if state.review.is_due(today)]
    if due:
        return Turn(min(due, key=_due).item, "it is due for review")
    if not current.is_settled(rules) and current.step.kind is not PassKind.LEAVE:
        return Turn(current.item, "it is not stable yet, so stay with it")
    rest = [state for state in others if state.step.kind is not PassKind.LEAVE or state.today < today]
    rest = _from_current_on(current, rest)
    fresh = [state for state in rest if not state.is_settled(rules)]
    if fresh:
        return Turn(_longest_ago(fresh).item, "it is not stable yet, and this one will do for now")
    if rest:
        return Turn(_longest_ago(rest).item, "all are stable: a few minutes each in turn make them last")
    if current.is_settled(rules):
        return Turn(
            current.item, "it is stable, and nothing else was begun: begin another lesson, and these will take turns"
        )
    return Turn(current.item, "enough of it for today")


def _due(state: ItemState) -> date:
    assert state.review.due is not None, "it is due"
    return state.review.due


def _from_current_on(current: ItemState, others: list[ItemState]) -> list[ItemState]:
    """`others` in the order of their names, those behind the current one first, so that turns go round."""
    here = (current.item.name, current.item.bars)
    return sorted(
        others, key=lambda state: ((state.item.name, state.item.bars) < here, state.item.name, state.item.bars)
    )


def _longest_ago(states: list[ItemState]) -> ItemState:
    return min(states, key=lambda state: state.today)
