"""What to practise next among all that a student knows: by hand, from states that passes made."""

from dataclasses import replace
from datetime import date, timedelta

import pytest

from station.drills.mastery.agenda import Ahead, next_turn
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.practice_steps import PassKind
from station.drills.mastery.rules import DEFAULT_RULES
from tests.unit.drills.mastering import CLEAN, DAY, ITEM, played

FRESH = played([CLEAN] * 2)
STABLE = played([CLEAN] * 20)


def named(state: ItemState, name: str, day: date = DAY) -> ItemState:
    return replace(state, item=replace(state.item, name=name), today=day)


def left(state: ItemState) -> ItemState:
    return replace(state, step=replace(state.step, kind=PassKind.LEAVE))


def test_the_states_are_what_they_are_called() -> None:
    assert not FRESH.is_stable(DEFAULT_RULES)
    assert STABLE.is_stable(DEFAULT_RULES)


def test_what_is_due_comes_first() -> None:
    """Mastered on the first day, due after one."""
    turn = next_turn(named(FRESH, "now"), [named(FRESH, "a"), named(STABLE, "old")], DAY + timedelta(days=1))
    assert (turn.item.name, turn.why) == ("old", "it is due for review")


def test_one_item_is_blocked_until_it_is_stable() -> None:
    assert next_turn(named(FRESH, "now"), [named(FRESH, "a"), named(STABLE, "b")], DAY).item.name == "now"
    assert next_turn(named(STABLE, "now"), [named(FRESH, "a"), named(STABLE, "b")], DAY).item.name == "a"
    assert next_turn(left(named(FRESH, "now")), [named(FRESH, "a")], DAY).item.name == "a"


def test_stable_items_take_turns() -> None:
    """Three that were all played today: a session each, round and round."""
    items = {name: named(STABLE, name) for name in "abc"}
    order, now = [], "a"
    for _ in range(6):
        now = next_turn(items[now], [state for name, state in items.items() if name != now], DAY).item.name
        order.append(now)
    assert order == ["b", "c", "a", "b", "c", "a"]


def test_who_waited_longest_comes_first() -> None:
    others = [named(STABLE, "b"), named(STABLE, "c", DAY - timedelta(days=3))]
    later = [replace(state, review=replace(state.review, due=None)) for state in others]
    assert next_turn(named(STABLE, "a"), later, DAY).item.name == "c"


@pytest.mark.parametrize(("state", "says"), [(STABLE, "begin another lesson"), (left(FRESH), "enough of it for today")])
def test_where_there_is_nothing_else(state: ItemState, says: str) -> None:
    turn = next_turn(named(state, "a"), [], DAY)
    assert turn.item.name == "a"
    assert says in turn.why


def test_what_was_left_today_is_taken_up_again_tomorrow() -> None:
    others = [left(named(FRESH, "b"))]
    assert next_turn(left(named(FRESH, "a")), others, DAY).item.name == "a"
    assert next_turn(left(named(FRESH, "a", DAY)), others, DAY + timedelta(days=1)).item.name == "b"


BEFORE = replace(ITEM, name="before")
AFTER = replace(ITEM, name="after")


def test_what_comes_before_helps_who_struggles_but_for_reviews() -> None:
    ahead = Ahead(before=BEFORE, after=AFTER, course="First beats")
    turn = next_turn(named(FRESH, "now"), [named(FRESH, "a")], DAY, ahead=ahead)
    assert (turn.item.name, turn.why) == ("before", "it comes before this one, and is not mastered yet")
    due = [named(STABLE, "old")]
    assert next_turn(named(FRESH, "now"), due, DAY + timedelta(days=1), ahead=ahead).item.name == "old"


def test_a_course_goes_on_where_nothing_that_was_begun_is_unstable() -> None:
    ahead = Ahead(after=AFTER, course="First beats")
    turn = next_turn(named(STABLE, "now"), [named(STABLE, "a")], DAY, ahead=ahead)
    assert (turn.item.name, turn.why) == ("after", "it comes next in First beats")
    assert next_turn(named(STABLE, "now"), [named(FRESH, "a")], DAY, ahead=ahead).item.name == "a"
    assert next_turn(named(FRESH, "now"), [], DAY, ahead=ahead).item.name == "now"
    assert next_turn(left(named(FRESH, "now")), [], DAY, ahead=ahead).item.name == "now"
