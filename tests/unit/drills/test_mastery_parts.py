"""The parts of the mastery policy one by one: verdicts, rules, weak bars, reviews, equipment. Values by hand."""

from dataclasses import replace
from datetime import date

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.drills.lesson import Goals
from station.drills.library import find_lesson
from station.drills.mastery.equipment_faults import Equipment, rewired
from station.drills.mastery.goals_missed import PassFault
from station.drills.mastery.pass_measures.pass_facts import BarResult, PassResult, StruckFor
from station.drills.mastery.practice_steps import PracticeItem, item_of
from station.drills.mastery.reviews import Review
from station.drills.mastery.rules import DEFAULT_RULES, Rules
from station.drills.mastery.silent_bars import SilentBars
from station.drills.mastery.verdict import Grade, judge
from station.drills.mastery.weak_bars import tallied, weakest
from station.music.performance import HIT_DTYPE, Performance
from station.scoring.matching.hit_windows import Level
from tests.unit.drills.mastering import BAD, BROKEN, CLEAN, DAY, INTERVAL_MS, LOOSE, result


def grade(one: PassResult, rules: Rules = DEFAULT_RULES) -> Grade:
    return judge(one, rules).grade


# --- a clean pass: ≥ 90 % right, one wrong pad in 50, spread ≤ min(35, max(20, 15 % of the interval)) -----------------


@pytest.mark.parametrize(
    ("right", "notes", "expected"),
    [(36, 40, Grade.CLEAN), (35, 40, Grade.BAD), (45, 50, Grade.CLEAN), (44, 50, Grade.BAD), (32, 40, Grade.BAD)],
)
def test_right_strokes(right: int, notes: int, expected: Grade) -> None:
    assert grade(result(right, notes)) is expected


def test_less_than_four_fifths_right_is_broken() -> None:
    assert grade(result(31, 40)) is Grade.BROKEN


@pytest.mark.parametrize(
    ("wrong", "notes", "is_clean"),
    [(1, 16, True), (2, 16, False), (1, 99, True), (2, 99, False), (2, 100, True), (3, 149, False), (3, 150, True)],
)
def test_wrong_pads(wrong: int, notes: int, is_clean: bool) -> None:
    """One in each full fifty, and one where there are fewer notes."""
    assert judge(result(notes - wrong, notes, wrong_pads=wrong), Rules(min_right=0.5)).is_clean is is_clean


@pytest.mark.parametrize(
    ("interval_ms", "limit_ms"),
    [(100.0, 20.0), (133.0, 20.0), (160.0, 24.0), (200.0, 30.0), (250.0, 35.0), (600.0, 35.0), (None, 35.0)],
)
def test_the_spread_of_a_clean_pass(interval_ms: float | None, limit_ms: float) -> None:
    at_limit = PassResult(40, 40, sd_ms=limit_ms, interval_ms=interval_ms)
    assert judge(at_limit, DEFAULT_RULES).is_clean
    assert not judge(replace(at_limit, sd_ms=limit_ms + 0.1), DEFAULT_RULES).is_clean


def test_an_unknown_spread_is_no_fault() -> None:
    assert grade(result(sd_ms=None)) is Grade.CLEAN


def test_hammering_is_not_clean() -> None:
    """All 40 notes hit and 40 strokes too many: half of what was heard is right."""
    verdict = judge(replace(CLEAN, extras=40), DEFAULT_RULES)
    assert verdict.grade is Grade.BROKEN
    assert verdict.words == "50 % right (40 of 40 and 40 too many), 90 % needed"


def test_loose_is_right_but_for_a_spread_within_an_eighth_of_a_slow_interval() -> None:
    assert grade(LOOSE) is Grade.LOOSE
    assert grade(replace(LOOSE, sd_ms=61.0)) is Grade.BAD
    assert grade(replace(LOOSE, right=35)) is Grade.BAD
    assert grade(replace(CLEAN, sd_ms=36.0)) is Grade.BAD
    assert grade(LOOSE, Rules(loose_share=0.0)) is Grade.BAD


def test_a_lean_costs_nothing_unless_the_lesson_asks() -> None:
    leaning = replace(CLEAN, lean_ms=-24.0)
    assert grade(leaning) is Grade.CLEAN
    assert [miss.fault for miss in judge(leaning, Rules(max_lean_ms=20.0)).missed] == [PassFault.LEAN]


def test_swing_and_points_where_a_lesson_asks() -> None:
    swung = replace(CLEAN, swing_ratio=1.5, points=70.0)
    assert grade(swung) is Grade.CLEAN
    assert [miss.fault for miss in judge(swung, Rules(max_swing_error=0.3, swing_ratio=2.0)).missed] == [
        PassFault.SWING
    ]
    assert judge(swung, Rules(max_swing_error=0.6, swing_ratio=2.0)).is_clean
    assert [miss.fault for miss in judge(swung, Rules(min_points=75.0)).missed] == [PassFault.POINTS]


# --- rules ------------------------------------------------------------------------------------------------------------


def test_a_lessons_goals_are_rules() -> None:
    lesson = replace(find_lesson("shuffle-1"), goals=Goals(min_accuracy=0.8, max_sd_ms=25.0, max_swing_error=0.4))
    rules = DEFAULT_RULES.for_lesson(lesson, Level.STUDIO)
    assert (rules.min_right, rules.max_sd_ms, rules.max_swing_error, rules.swing_ratio) == (0.8, 25.0, 0.4, 2.0)
    assert rules.sd_limit_ms(1000.0) == 25.0


def test_a_teachers_changes() -> None:
    assert DEFAULT_RULES.changed({"start_pct": 75, "review_days": [2, 5]}).review_days == (2, 5)


@pytest.mark.parametrize(
    ("changes", "place"),
    [
        ({"start": 75}, "start"),
        ({"start_pct": "fast"}, "start_pct"),
        ({"start_pct": 30.0}, "start_pct"),
        ({"clean_to_climb": 0}, "clean_to_climb"),
        ({"clean_to_climb": 2.5}, "clean_to_climb"),
        ({"min_right": 90.0}, "min_right"),
        ({"review_days": [3, 1]}, "review_days"),
        ({"fades": []}, "fades"),
    ],
)
def test_changes_that_cannot_be(changes: dict[str, object], place: str) -> None:
    with pytest.raises(BadInput) as fault:
        DEFAULT_RULES.changed(changes)
    assert fault.value.place == place


# --- weak bars --------------------------------------------------------------------------------------------------------


def bars(*faults: int) -> list[BarResult]:
    return [BarResult(i, 10, 10 - f) for i, f in enumerate(faults)]


def test_older_passes_weigh_less() -> None:
    """0.6 · 5 + 1 faults in 0.6 · 10 + 10 notes."""
    tally = tallied(tallied((), bars(5, 0), DEFAULT_RULES), bars(1, 0), DEFAULT_RULES)
    assert tally[0].faults == pytest.approx(4.0)
    assert tally[0].notes == pytest.approx(16.0)


@pytest.mark.parametrize(
    ("faults", "weak"),
    [
        ((0, 4, 0, 0), 1),
        ((0, 2, 0, 0), None),  # fewer than three faults
        ((3, 4, 3, 3), None),  # 40 % against 30 %: not one and a half times the others
        ((2, 4, 2, 2), 1),  # 40 % against 20 %
        ((4, 4, 0, 0), 0),  # 40 % against 13 %: the first of two alike
    ],
)
def test_which_bar_is_weak(faults: tuple[int, ...], weak: int | None) -> None:
    found = weakest(tallied((), bars(*faults), DEFAULT_RULES), DEFAULT_RULES)
    assert (found.bar if found else None) == weak


def test_one_bar_is_never_the_weak_one() -> None:
    assert weakest(tallied((), bars(9), DEFAULT_RULES), DEFAULT_RULES) is None


# --- reviews ----------------------------------------------------------------------------------------------------------


def test_reviews_come_after_1_3_7_and_21_days() -> None:
    """Counted from 1 March 2024: 2, 4, 8 and 22 March, and no more."""
    review, due = Review().mastered(DAY, Level.BEGINNER, DEFAULT_RULES), []
    while review.due:
        due.append(review.due)
        review = review.after(True, review.due, DEFAULT_RULES)
    assert due == [date(2024, 3, d) for d in (2, 4, 8, 22)]


def test_who_comes_late_has_the_next_review_tomorrow() -> None:
    review = Review().mastered(DAY, Level.BEGINNER, DEFAULT_RULES).after(True, date(2024, 3, 10), DEFAULT_RULES)
    assert (review.passed, review.due) == (1, date(2024, 3, 11))


def test_mastering_again_on_a_later_day_does_not_move_the_reviews() -> None:
    review = Review().mastered(DAY, Level.ELEMENTARY, DEFAULT_RULES)
    assert review.mastered(date(2024, 3, 5), Level.BEGINNER, DEFAULT_RULES) == review
    narrower = review.mastered(date(2024, 3, 5), Level.ADVANCED, DEFAULT_RULES)
    assert (narrower.level, narrower.mastered_on, narrower.due) == (Level.ADVANCED, DAY, review.due)


# --- equipment --------------------------------------------------------------------------------------------------------

CROSSED = (StruckFor(Piece.TOM_1, Piece.TOM_2, 6), StruckFor(Piece.TOM_2, Piece.TOM_1, 6))


@pytest.mark.parametrize(
    ("answers", "found"),
    [
        (CROSSED, True),
        (CROSSED[:1], False),  # a habit, not a cable: only one way
        ((*CROSSED, StruckFor(Piece.TOM_1, Piece.TOM_1, 2)), True),  # 6 of 8 are 75 %
        ((*CROSSED, StruckFor(Piece.TOM_1, Piece.TOM_1, 3)), False),
        (tuple(replace(a, count=5) for a in CROSSED), False),  # too few to tell
    ],
)
def test_cables_are_swapped_where_two_pads_answer_for_each_other(answers: tuple[StruckFor, ...], found: bool) -> None:
    known, notice = Equipment().after(replace(CLEAN, answers=answers), DEFAULT_RULES)
    assert (known.swap is not None, notice is not None) == (found, found)


def test_cables_that_were_put_right_are_noticed() -> None:
    """Judged as swapped, they answer for each other again."""
    swapped, _ = Equipment().after(replace(CLEAN, answers=CROSSED), DEFAULT_RULES)
    mended, notice = swapped.after(replace(CLEAN, answers=CROSSED), DEFAULT_RULES)
    assert mended.swap is None
    assert notice == "High tom and middle tom are as they should be again."


def test_hits_on_swapped_pads_are_put_right() -> None:
    hits = np.zeros(3, HIT_DTYPE)
    hits["piece"] = [Piece.TOM_1, Piece.SNARE, Piece.TOM_2]
    mended = rewired(Performance.from_array(hits), (Piece.TOM_1, Piece.TOM_2))
    assert mended.hits["piece"].tolist() == [Piece.TOM_2, Piece.SNARE, Piece.TOM_1]


def test_a_steady_lean_of_60_ms_is_latency_a_habit_is_not() -> None:
    def told(lean_ms: float, passes: int) -> bool:
        known = Equipment()
        for _ in range(passes):
            known, _ = known.after(replace(CLEAN, lean_ms=lean_ms), DEFAULT_RULES)
        return known.told_latency

    assert told(60.0, 3)
    assert told(-60.0, 3)
    assert not told(60.0, 2)
    assert not told(59.0, 9)


# --- items ------------------------------------------------------------------------------------------------------------


def test_an_item_of_a_lesson() -> None:
    """rock-1: two bars of twelve strokes; four beats a bar at its target tempo."""
    lesson = find_lesson("rock-1")
    item = item_of(lesson)
    assert (item.bars, item.bar_notes) == ((0, 1), (12, 12))
    assert item.bar_s == pytest.approx((240 / lesson.target_tempo_bpm,) * 2)


def test_the_grades_of_the_fixtures() -> None:
    assert [grade(one) for one in (CLEAN, LOOSE, BAD, BROKEN)] == list(Grade)
    assert INTERVAL_MS * DEFAULT_RULES.sd_interval_share > DEFAULT_RULES.sd_ceiling_ms


def test_the_click_falls_silent_longer_and_longer_and_comes_back() -> None:
    """TEACHING: 4 on 1 off, 2/2, 1/3; two clean passes a level, one that is not clean goes back."""
    gaps, seen = SilentBars(), []
    for is_clean in (True,) * 8 + (False,) * 4:
        gaps = gaps.after(is_clean, DEFAULT_RULES)
        seen.append(gaps.bars(DEFAULT_RULES))
    rising = [None, (4, 1), (4, 1), (2, 2), (2, 2), (1, 3), (1, 3), (1, 3)]
    assert seen == [*rising, (2, 2), (4, 1), None, None]


def test_a_pass_with_a_silent_click_is_long_enough_for_its_return() -> None:
    """A loop of two bars: 4 on, 1 off and the bar after it are six bars, three times round."""
    item = PracticeItem("x", 100.0, 0, (16, 16), (2.4, 2.4))
    assert item.repeats((0, 1), DEFAULT_RULES) == 1
    assert item.repeats((0, 1), DEFAULT_RULES, (4, 1)) == 3
    assert item.repeats((0, 1), DEFAULT_RULES, (1, 3)) == 3


@pytest.mark.parametrize("gaps", [[[0, 1]], [[4]], [4, 1]])
def test_gaps_that_are_none_are_refused(gaps: list[object]) -> None:
    with pytest.raises(BadInput, match="gaps"):
        DEFAULT_RULES.changed({"gaps": gaps})
