"""Which of all remembered items to practise next: block each until it is stable, then interleave.

What is due for review comes first, then what a teacher put before an item with which the student struggles. An item
that is not stable yet is gone on with (TEACHING: block until stable), until it is left for the day. Then comes another
that is not stable, then what the course has next, and where all are stable, they take turns, which makes them last
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


@dataclass(frozen=True, slots=True)
class Ahead:
    """What a teacher has put beside the current item; None where there is nothing, or nothing that helps now.

    `before` should have come first and is not mastered, where the student struggles; `after` is what the `course` that
    they follow has next.
    """

    before: PracticeItem | None = None
    after: PracticeItem | None = None
    course: str = ""


ALONE = Ahead()
"""Nothing stands beside it."""


def next_turn(
    current: ItemState,
    others: Sequence[ItemState],
    today: date,
    rules: Rules = DEFAULT_RULES,
    ahead: Ahead = ALONE,
) -> Turn:
    """What comes after a session on `current` for a student who also knows `others`, in any fixed order."""
    if (pressing := _pressing(current, others, today, rules, ahead)) is not None:
        return pressing
    rest = [state for state in others if state.step.kind is not PassKind.LEAVE or state.today < today]
    rest = _from_current_on(current, rest)
    fresh = [state for state in rest if not state.is_settled(rules)]
    if fresh:
        return Turn(_longest_ago(fresh).item, "it is not stable yet, and this one will do for now")
    return _beyond(current, rest, rules, ahead)


def _pressing(current: ItemState, others: Sequence[ItemState], today: date, rules: Rules, ahead: Ahead) -> Turn | None:
    """What leaves no choice."""
    due = [state for state in others if state.review.is_due(today)]
    if due:
        return Turn(min(due, key=_due).item, "it is due for review")
    if ahead.before is not None:
        return Turn(ahead.before, "it comes before this one, and is not mastered yet")
    if not current.is_settled(rules) and current.step.kind is not PassKind.LEAVE:
        return Turn(current.item, "it is not stable yet, so stay with it")
    return None


def _beyond(current: ItemState, rest: list[ItemState], rules: Rules, ahead: Ahead) -> Turn:
    """What comes where nothing else was begun that is not stable."""
    is_settled = current.is_settled(rules)
    if is_settled and ahead.after is not None:
        return Turn(ahead.after, f"it comes next in {ahead.course}")
    if rest:
        return Turn(_longest_ago(rest).item, "all are stable: a few minutes each in turn make them last")
    alone = "it is stable, and nothing else was begun: begin another lesson, and these will take turns"
    return Turn(current.item, alone if is_settled else "enough of it for today")


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
