"""What a teacher has asked for and is not stable yet, in the order in which it has its turn: the nearest day first.

The plan of the day and a report's next turn both go by it, so that they name the same lesson.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date

from station.drills.daily.daily_items import Assigned
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.practice_steps import PassKind, PracticeItem
from station.drills.mastery.rules import DEFAULT_RULES, Rules

ItemOf = Callable[[str, tuple[int, int] | None], PracticeItem | None]
"""The loop, or some bars, of a lesson as an item; None where it cannot be read."""
PRESSING_DAYS = 3
"""So near its day a teacher's wish gets two blocks (our choice)."""


@dataclass(frozen=True, slots=True)
class Asked:
    """An `item` that a teacher asked for, what is remembered of it (None: nothing), and `why` it comes now."""

    item: PracticeItem
    state: ItemState | None
    why: str
    is_pressing: bool


def asked_in_turn(
    assigned: Sequence[Assigned],
    item_of: ItemOf,
    states: Sequence[ItemState],
    today: date,
    rules: Rules = DEFAULT_RULES,
) -> tuple[Asked, ...]:
    """What waits of it; what is stable, was left for today, or cannot be read, does not."""
    found = []
    for one in sorted(assigned, key=lambda one: (one.due or date.max, one.lesson)):
        item = item_of(one.lesson, one.bars)
        state = next((state for state in states if state.item == item), None)
        if item is not None and (state is None or _waits(state, today, rules)):
            is_pressing = one.due is not None and (one.due - today).days <= PRESSING_DAYS
            found.append(Asked(item, state, _why(one.due, today), is_pressing))
    return tuple(found)


def _waits(state: ItemState, today: date, rules: Rules) -> bool:
    was_left = state.step.kind is PassKind.LEAVE and state.today >= today
    return not was_left and not state.is_settled(rules)


def _why(due: date | None, today: date) -> str:
    """The reason, as the agenda gives one: without a capital and a full stop."""
    if due is None:
        return "your teacher asked for it"
    days = (due - today).days
    if days < 0:
        return f"your teacher wanted it by {day_in_month(due)}: it is not stable yet"
    when = {0: "today", 1: "tomorrow"}.get(days, f"by {day_in_month(due)}")
    return f"your teacher wants it {when}"


def day_in_month(day: date) -> str:
    """A day as sentences say it."""
    return f"{day.day} {day:%B}"
