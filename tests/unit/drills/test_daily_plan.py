"""The plan of a day, from states that passes made by hand and from the lessons that ship."""

from collections import Counter
from dataclasses import replace
from datetime import date, timedelta
from functools import cache

import pytest

from station.core.errors import BadInput
from station.drills.daily.asked import asked_in_turn
from station.drills.daily.daily_items import Assigned, DailyPlan, ItemKind, PastDay
from station.drills.daily.day_facts import DayFacts
from station.drills.daily.day_plan import daily_plan
from station.drills.lesson_row import LessonRow
from station.drills.library import find_lesson, lesson_rows
from station.drills.mastery.agenda import Ahead, next_turn
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.practice_steps import PassKind, PracticeItem, item_of
from tests.unit.drills.mastering import CLEAN, DAY, played, weak_second_bar

FRESH, STABLE = played([CLEAN] * 2), played([CLEAN] * 20)
WEAK = played([CLEAN, CLEAN, weak_second_bar(), weak_second_bar()])
SHIPPED = {row.name: row for row in sorted(lesson_rows(), key=lambda row: (row.level, row.difficulty))}
HANDS = [row.name for row in SHIPPED.values() if row.folder == "rudiments"]
MUSIC = [row.name for row in SHIPPED.values() if row.folder == "grooves"]


@cache
def shipped_item(name: str, bars: tuple[int, int] | None = None) -> PracticeItem | None:
    return item_of(find_lesson(name), bars) if name in SHIPPED else None


def known(state: ItemState, name: str, days_ago: int = 1, due_in: int | None = None) -> ItemState:
    """A state of one of the shipped lessons, practised last so long ago; its review due in so many days."""
    item = shipped_item(name)
    assert item is not None
    state = replace(state, item=item, today=DAY - timedelta(days=days_ago))
    due = None if due_in is None else DAY + timedelta(days=due_in)
    mastered = state.review.mastered_on
    return replace(state, review=replace(state.review, due=due, mastered_on=mastered and DAY - timedelta(days=30)))


def facts(*states: ItemState, minutes: int = 20, rows: dict[str, LessonRow] | None = None) -> DayFacts:
    return DayFacts(DAY, states, SHIPPED if rows is None else rows, shipped_item, minutes=minutes)


def kinds(plan: DailyPlan) -> list[str]:
    return [item.kind.value for item in plan.items]


def lessons(plan: DailyPlan, kind: ItemKind) -> list[str]:
    return [item.lesson for item in plan.items if item.kind is kind]


# --- whole days


def test_nobodys_first_day_has_a_warm_up_something_new_and_ends_with_playing() -> None:
    plan = daily_plan(facts())
    assert kinds(plan) == ["warm-up", "new", "go on", "play"]
    assert [item.minutes for item in plan.items] == [2, 7, 7, 4]
    warm, new, again, last = plan.items
    assert again.lesson == new.lesson
    assert SHIPPED[warm.lesson].folder in ("rudiments", "hands", "rolls")
    assert SHIPPED[new.lesson].level == 1
    assert new.tempo_pct == 70  # TEACHING: start at 70 to 75 % of the tempo
    assert last.lesson == new.lesson


def test_nothing_at_all_is_there() -> None:
    plan = daily_plan(facts(rows={}))
    assert kinds(plan) == ["play"]
    assert (plan.items[0].lesson, plan.minutes) == ("", 20)


@pytest.mark.parametrize(
    "states",
    [
        (),
        (known(FRESH, "rock-1"),),
        (known(WEAK, "rock-1"),),
        tuple(known(STABLE, name, due_in=0) for name in MUSIC[:9]),
        (*(known(STABLE, name) for name in MUSIC[:5]), known(FRESH, "rock-2"), known(STABLE, HANDS[0], due_in=-3)),
    ],
)
def test_minutes_are_kept(states: tuple[ItemState, ...]) -> None:
    plans = {minutes: daily_plan(facts(*states, minutes=minutes)) for minutes in range(5, 61)}
    assert {minutes: plan.minutes for minutes, plan in plans.items()} == {minutes: minutes for minutes in plans}
    for item in (item for plan in plans.values() for item in plan.items):
        assert item.minutes >= 1
        assert item.passes >= 1
        assert item.why.endswith(".")
        assert item.tempo_why.endswith(".")


@pytest.mark.parametrize("minutes", [-1, 0, 4, 61, 10**9])
def test_minutes_that_no_day_has(minutes: int) -> None:
    with pytest.raises(BadInput, match="expected 5 to 60"):
        daily_plan(facts(minutes=minutes))


def test_equal_facts_give_equal_plans() -> None:
    states = [known(STABLE, name) for name in (*MUSIC[:4], *HANDS[:6])]
    assert daily_plan(facts(*states)) == daily_plan(facts(*states))


# --- what comes first


def test_reviews_come_before_all_the_oldest_first() -> None:
    plan = daily_plan(
        facts(known(FRESH, "rock-1"), known(STABLE, "rock-2", due_in=0), known(STABLE, "rock-3", due_in=-4))
    )
    assert kinds(plan) == ["warm-up", "due", "due", "go on", "new", "play"]
    assert lessons(plan, ItemKind.DUE) == ["rock-3", "rock-2"]
    assert plan.items[1].tempo_pct == 100
    assert "its review is due since 26 February" in plan.items[1].why


def test_two_hundred_mastered_lessons_leave_room_for_more_than_reviews() -> None:
    """All due, the last first: half of the sixteen minutes between the ends is four reviews of two minutes."""
    many = [
        replace(known(STABLE, "rock-1", due_in=-i), item=replace(STABLE.item, name=f"own-{i:03}")) for i in range(200)
    ]
    plan = daily_plan(facts(*many, known(FRESH, "rock-2")))
    assert lessons(plan, ItemKind.DUE) == ["own-199", "own-198", "own-197", "own-196"]
    assert "rock-2" in lessons(plan, ItemKind.GO_ON)


def test_reviews_alone_may_have_all_the_time() -> None:
    many = [known(STABLE, name, due_in=-1) for name in MUSIC[:12]]
    plan = daily_plan(replace(facts(*many), lessons={}, course_lessons=()))
    assert Counter(kinds(plan))["due"] >= 6


def test_a_teachers_day_comes_before_what_else_was_begun_and_gets_two_blocks_when_it_is_near() -> None:
    wanted = (Assigned("rock-4", DAY + timedelta(days=9)), Assigned("rock-3", DAY + timedelta(days=2)))
    plan = daily_plan(replace(facts(known(FRESH, "rock-1")), assigned=wanted))
    assert [item.lesson for item in plan.items[1:3]] == ["rock-3", "rock-4"]
    assert (plan.items[1].minutes, plan.items[1].why) == (10, "Your teacher wants it by 3 March.")


def test_what_a_teacher_wants_is_done_when_it_is_stable() -> None:
    plan = daily_plan(replace(facts(known(STABLE, "rock-3")), assigned=(Assigned("rock-3", DAY),)))
    assert all("teacher" not in item.why for item in plan.items)


def test_what_was_begun_is_gone_on_with_before_anything_is_new() -> None:
    plan = daily_plan(facts(known(FRESH, "rock-1"), *(known(STABLE, name) for name in MUSIC[5:9])))
    order = [kind for kind in kinds(plan) if kind in ("go on", "new", "keep")]
    assert order == ["go on", "new", "keep"]
    assert lessons(plan, ItemKind.GO_ON) == ["rock-1"]


def test_what_has_its_review_today_is_not_under_way_besides() -> None:
    """Rock 2 was mastered once and is not stable now: its review asks for it, and the day has room for another."""
    plan = daily_plan(facts(known(FRESH, "rock-1"), known(FRESH, "rock-2", due_in=0)))
    assert kinds(plan) == ["warm-up", "due", "go on", "new", "play"]


def test_nothing_is_new_while_two_lessons_are_under_way_and_what_is_stable_has_a_quarter_of_the_time() -> None:
    stable = [known(STABLE, name) for name in MUSIC[5:9]]
    plan = daily_plan(facts(known(FRESH, "rock-1"), known(FRESH, "rock-2"), *stable))
    minutes = Counter[str]()
    for item in plan.items:
        minutes[item.kind.value] += item.minutes
    assert (minutes["new"], minutes["keep"]) == (0, 3)
    assert minutes["go on"] >= 12


def test_the_course_says_what_is_new() -> None:
    course = replace(facts(known(STABLE, "rock-1")), course="First beats", course_lessons=("rock-1", "rock-5"))
    plan = daily_plan(course)
    assert lessons(plan, ItemKind.NEW) == ["rock-5"]
    assert "it comes next in First beats" in next(item.why for item in plan.items if item.kind is ItemKind.NEW)


def test_a_bar_that_goes_wrong_is_played_alone_and_slowly_before_the_whole() -> None:
    """The second bar had all faults: bars 1 and 2, from 10 % below the tempo of the day up to it."""
    here = replace(WEAK, today=DAY - timedelta(days=1))
    plan = daily_plan(DayFacts(DAY, (here,), {}, lambda _name, _bars: here.item))
    weak, whole = [item for item in plan.items if item.kind in (ItemKind.WEAK_BARS, ItemKind.GO_ON)][:2]
    assert (weak.bars, whole.bars) == ((0, 1), (0, 3))
    assert weak.tempo_pct == pytest.approx(whole.tempo_pct - 10, abs=1)
    assert weak.rise == f"4/4:{round(1.2 * whole.tempo_pct)}"
    assert "Bar 2 had" in weak.why


# --- from day to day


def test_the_warm_up_changes_from_day_to_day() -> None:
    states = [known(STABLE, name) for name in (*HANDS[:6], *MUSIC[:3])]
    history: list[PastDay] = []
    warm_ups = []
    for day in range(12):
        today = replace(facts(*states), today=DAY + timedelta(days=day), history=tuple(history))
        plan = daily_plan(today)
        warm_ups.append(plan.items[0].lesson)
        history.append(PastDay(plan.day, tuple((item.kind, item.lesson) for item in plan.items)))
    assert all(len(set(warm_ups[day : day + 4])) == 4 for day in range(9))


def test_what_was_left_undone_is_there_again_without_a_word_of_blame() -> None:
    states = (known(FRESH, "rock-1", 2), known(FRESH, "rock-2", 2))
    first = daily_plan(replace(facts(*states), today=DAY - timedelta(days=1)))
    past = PastDay(first.day, tuple((item.kind, item.lesson) for item in first.items), frozenset({"rock-1"}))
    later = known(FRESH, "rock-1", 1), known(FRESH, "rock-2", 2)
    again = daily_plan(replace(facts(*later), history=(past,)))
    assert lessons(again, ItemKind.GO_ON) == ["rock-2", "rock-1"]
    assert next(item.why for item in again.items if item.lesson == "rock-2") == (
        "Not stable yet, so on with it; there was no time for it last time."
    )


def test_after_a_long_break_the_day_begins_gently() -> None:
    """Three weeks later: five minutes of warm-up instead of three, and as much of the rest as there is time for."""
    away = [known(STABLE, name, 21, due_in=-14) for name in MUSIC[:6]]
    plan = daily_plan(facts(*away))
    assert plan.items[0].minutes == 5
    assert "after 21 days away" in plan.items[0].why
    assert plan.minutes == 20


def test_what_holds_without_the_click_is_played_with_a_random_one() -> None:
    """Twenty-one clean passes and more lead beyond 4/1 and 2/2 to 1/3, the last of TEACHING's gaps."""
    held = played([CLEAN] * 40)
    assert held.gaps.level == 3
    plan = daily_plan(facts(*(known(held, name, 9) for name in MUSIC[:9])))
    assert plan.items[-1].kind is ItemKind.PLAY
    assert plan.items[-1].gap.startswith("random:20-40%:")


# --- one answer


@pytest.mark.parametrize("case", range(64))
def test_the_plan_begins_with_what_the_agenda_says_comes_next(case: int) -> None:
    """After the warm-up the first block is the agenda's turn, whatever of due, begun and stable lessons there is."""
    names = ["rock-1", "rock-2", "rock-3", "rock-4", "rock-5", "disco-1"]
    made = [(STABLE, -2), (FRESH, None), (STABLE, None), (STABLE, 0), (FRESH, None), (STABLE, 5)]
    chosen = [
        known(state, name, 1 + (case * i) % 5, due)
        for i, (name, (state, due)) in enumerate(zip(names, made, strict=True))
        if case >> i & 1
    ]
    warm = known(STABLE, HANDS[0])
    here = replace(facts(warm, *chosen), lessons={HANDS[0]: SHIPPED[HANDS[0]]})
    if chosen:
        plan = daily_plan(here)
        assert plan.items[0].lesson == HANDS[0]
        assert plan.items[1].lesson == next_turn(warm, chosen, DAY).item.name
    wanted = tuple(Assigned(name, DAY + timedelta(days=n)) for n, name in enumerate(("rock-3", "rock-5", "rock-4")))
    first = asked_in_turn(wanted, shipped_item, chosen, DAY)[0]
    ahead = Ahead(asked=first.item, asked_why=first.why)
    plan = daily_plan(replace(here, assigned=wanted))
    assert plan.items[1].lesson == next_turn(warm, chosen, DAY, ahead=ahead).item.name


def test_what_a_teacher_wants_and_was_left_for_today_waits_until_tomorrow() -> None:
    left = known(FRESH, "rock-3", 0)
    left = replace(left, step=replace(left.step, kind=PassKind.LEAVE))
    wanted = (Assigned("rock-3", DAY), Assigned("rock-4", None))

    def names(today: date) -> list[str]:
        return [one.item.name for one in asked_in_turn(wanted, shipped_item, [left], today)]

    assert names(DAY) == ["rock-4"]
    assert names(DAY + timedelta(days=1)) == ["rock-3", "rock-4"]


def test_a_review_that_is_due_is_no_warm_up() -> None:
    due = known(STABLE, HANDS[0], due_in=0)
    assert daily_plan(facts(due, known(STABLE, HANDS[1]))).items[0].lesson != HANDS[0]
