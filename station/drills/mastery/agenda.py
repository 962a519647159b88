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

    `before` should have come first and is not mastered, where the student struggles; `asked` is what a teacher wants
    next, and `asked_why` until when; `after` is what the `course` that they follow has next.
    """

    before: PracticeItem | None = None
    after: PracticeItem | None = None
    course: str = ""
    asked: PracticeItem | None = None
    asked_why: str = ""


@dataclass(frozen=True, slots=True)
class Waiting:
    """What a student knows, in the order in which it has its turn: `due` for review, `fresh`, `settled`.

    What is fresh is not stable yet. What was left for today is in neither of the last two.
    """

    due: tuple[ItemState, ...]
    fresh: tuple[ItemState, ...]
    settled: tuple[ItemState, ...]


def waiting(
    states: Sequence[ItemState], today: date, rules: Rules = DEFAULT_RULES, here: PracticeItem | None = None
) -> Waiting:
    """The `states` in turn, from those behind the item `here` on where they are equal."""
    due = sorted((state for state in states if state.review.is_due(today)), key=_due)
    rest = [state for state in states if state.step.kind is not PassKind.LEAVE or state.today < today]
    turns = sorted(_from_here_on(here, rest), key=lambda state: state.today)
    fresh = tuple(state for state in turns if not state.is_settled(rules))
    return Waiting(tuple(due), fresh, tuple(state for state in turns if state.is_settled(rules)))


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
    turns = waiting(others, today, rules, current.item)
    if (pressing := _pressing(current, turns, rules, ahead)) is not None:
        return pressing
    if turns.fresh:
        return Turn(turns.fresh[0].item, "it is not stable yet, and this one will do for now")
    return _beyond(current, turns, rules, ahead)


def other_turn(
    others: Sequence[ItemState], today: date, rules: Rules = DEFAULT_RULES, ahead: Ahead = ALONE
) -> Turn | None:
    """What a student may turn to who wants something else than what they practise, which is not among `others`."""
    turns = waiting(others, today, rules)
    if turns.due:
        return Turn(turns.due[0].item, "it is due for review")
    if ahead.asked is not None:
        return Turn(ahead.asked, ahead.asked_why)
    if ahead.after is not None:
        return Turn(ahead.after, f"it comes next in {ahead.course}")
    if turns.fresh:
        return Turn(turns.fresh[0].item, "it is not stable yet")
    return Turn(turns.settled[0].item, KEPT_WHY) if turns.settled else None


def _pressing(current: ItemState, turns: Waiting, rules: Rules, ahead: Ahead) -> Turn | None:
    """What leaves no choice."""
    if turns.due:
        return Turn(turns.due[0].item, "it is due for review")
    if ahead.before is not None:
        return Turn(ahead.before, "it comes before this one, and is not mastered yet")
    if ahead.asked is not None:
        return Turn(ahead.asked, ahead.asked_why)
    if not current.is_settled(rules) and current.step.kind is not PassKind.LEAVE:
        return Turn(current.item, "it is not stable yet, so stay with it")
    return None


def _beyond(current: ItemState, turns: Waiting, rules: Rules, ahead: Ahead) -> Turn:
    """What comes where nothing else was begun that is not stable."""
    is_settled = current.is_settled(rules)
    if is_settled and ahead.after is not None:
        return Turn(ahead.after, f"it comes next in {ahead.course}")
    if turns.settled:
        return Turn(turns.settled[0].item, KEPT_WHY)
    alone = "it is stable, and nothing else was begun: begin another lesson, and these will take turns"
    return Turn(current.item, alone if is_settled else "enough of it for today")


KEPT_WHY = "all are stable: a few minutes each in turn make them last"


def _due(state: ItemState) -> date:
    assert state.review.due is not None, "it is due"
    return state.review.due


def _from_here_on(here: PracticeItem | None, states: Sequence[ItemState]) -> list[ItemState]:
    """`states` in the order of their names, those behind the item `here` first, so that turns go round."""
    place = ("", (-1, -1)) if here is None else (here.name, here.bars)
    return sorted(
        states, key=lambda state: ((state.item.name, state.item.bars) < place, state.item.name, state.item.bars)
    )
