"""A session over several items: block until stable, then rotate. Who plays all clean needs 14 passes an item."""

from dataclasses import replace
from datetime import timedelta
from itertools import pairwise

from station.drills.mastery.agenda import Agenda, Break, Turn, advance, open_session
from station.drills.mastery.passes import PassResult
from station.drills.mastery.policy import fix_tempo, new_item
from station.drills.mastery.rules import Rules
from station.drills.mastery.steps import Kind
from tests.unit.drills.mastering import BAD, BROKEN, CLEAN, DAY, ITEM, played

LONG = Rules(session_s=10_000.0, gaps=())
"""No end by the clock, and no longer passes for a silent click. A pass of the item takes 8 s at its target tempo."""


def session(count: int, rules: Rules = LONG) -> Agenda:
    fresh = tuple(new_item(replace(ITEM, name=str(i)), DAY, rules) for i in range(count))
    return open_session(fresh, DAY, rules)


def turns(agenda: Agenda, passes: list[PassResult], rules: Rules = LONG) -> list[Turn]:
    said = []
    for one in passes:
        agenda, turn = advance(agenda, one, rules)
        said.append(turn)
    return said


def test_each_item_is_blocked_until_it_is_stable() -> None:
    said = turns(session(3), [CLEAN] * 42)
    assert [turn.item for turn in said] == [0] * 13 + [1] * 14 + [2] * 14 + [0]
    assert [i for i, turn in enumerate(said) if turn.why] == [13, 27, 41]


def test_three_stable_items_rotate_by_three_minutes() -> None:
    """A turn is the first pass that ends at 180 s or later: 23 passes of about 8 s."""
    said = turns(session(3), [CLEAN] * 160)[41:]
    order = [turn.item for i, turn in enumerate(said) if i == 0 or turn.why]
    assert order[:6] == [0, 1, 2, 0, 1, 2]
    changes = [i for i, turn in enumerate(said) if turn.why]
    assert all(20 <= b - a <= 25 for a, b in pairwise(changes))


def test_the_next_group_follows_once_each_has_had_its_turn() -> None:
    order = [turn.item for turn in turns(session(4), [CLEAN] * 160) if turn.why]
    assert order[:6] == [1, 2, 0, 1, 2, 3]


def test_an_item_that_is_left_makes_room() -> None:
    """Two passes to the floor, five that break down there."""
    said = turns(session(2), [BROKEN] * 7)
    assert [turn.item for turn in said] == [0] * 6 + [1]


def test_a_session_ends_when_all_are_left() -> None:
    said = turns(session(1), [BROKEN] * 7)
    assert [turn.pause for turn in said] == [Break.NONE] * 6 + [Break.END]


def test_a_breath_after_five_minutes_and_an_end_after_twenty_five() -> None:
    """Passes at 70 % last 8/0.7 = 11.43 s: the 27th ends at 308.6 s; the session of 1500 s ends with the 132nd.

    The tempo is fixed, and clean and bad in turn.
    """
    rules = Rules(runs_to_leave=100)
    state, _ = fix_tempo(new_item(ITEM, DAY, rules), 84.0, rules)
    said = turns(open_session((state,), DAY, rules), [CLEAN, BAD] * 66, rules)
    assert [i + 1 for i, turn in enumerate(said) if turn.pause is Break.BREATH] == [27, 54, 81, 108]
    assert [i + 1 for i, turn in enumerate(said) if turn.pause is Break.END] == [132]


def test_reviews_come_first() -> None:
    mastered = played([CLEAN] * 14)
    agenda = open_session((new_item(ITEM, DAY), mastered), DAY + timedelta(days=1), LONG)
    assert (agenda.current, agenda.step.kind) == (1, Kind.REVIEW)
    agenda, turn = advance(agenda, CLEAN, LONG)
    assert (turn.item, turn.step.kind) == (0, Kind.WHOLE)


def test_a_failed_review_is_learnt_again_today() -> None:
    agenda = open_session((played([CLEAN] * 14),), DAY + timedelta(days=1), LONG)
    agenda, turn = advance(agenda, BAD, LONG)
    assert (turn.item, turn.step.kind, turn.step.pct) == (0, Kind.WHOLE, 92.0)
