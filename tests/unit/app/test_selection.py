"""The lessons page's state, the keyboard's table, the quality's choice."""

from dataclasses import replace

import pytest

from station.app.room_state import LessonCard, SessionRequest
from station.app.selection import MAX_LOOPS, Selection
from station.core.pieces import HAND_PIECES, Piece, Zone
from station.drills.course import Course, CoursePart
from station.gui.keyboard_kit import KEYS
from station.practice.records.lesson_progress import LessonProgress
from station.scoring.matching.hit_windows import Level

ROCK = LessonCard(
    "rock-1", "Rock 1: eighths", 1, "first steps", "The first groove", "Ada", 80.0, 2, 8, "4/4", ("rock",)
)
PARADIDDLE = LessonCard("paradiddle", "Single paradiddle", 2, "beginner", "RLRR LRLL", "Ben", 100.0, 1, 12)


def test_the_first_lesson_is_chosen_at_its_own_tempo() -> None:
    assert Selection.of([ROCK, PARADIDDLE]).request() == SessionRequest("rock-1", 80.0, 8, adapt=True)


def test_more_lessons_to_choose_from_change_nothing_that_is_chosen() -> None:
    selection = Selection.of([PARADIDDLE])
    selection = replace(selection, tempo_bpm=71.0).offer([ROCK, PARADIDDLE])
    assert selection.visible() == [ROCK, PARADIDDLE]
    assert (selection.card, selection.tempo_bpm) == (PARADIDDLE, 71.0)


def test_without_lessons_there_is_nothing_to_start() -> None:
    assert Selection.of([]).request() is None


def test_choosing_takes_the_author_s_tempo_and_passes() -> None:
    selection = Selection.of([ROCK, PARADIDDLE])
    selection = replace(selection, tempo_bpm=140.0).choose(replace(PARADIDDLE, passes=500))
    assert selection.request() == SessionRequest("paradiddle", 100.0, MAX_LOOPS, adapt=True)


@pytest.mark.parametrize(
    ("search", "found"),
    [
        ("", ["rock-1", "paradiddle"]),
        ("ROCK", ["rock-1"]),
        ("ada eighths", ["rock-1"]),
        ("beginner", ["paradiddle"]),
        ("rock paradiddle", []),
    ],
)
def test_search_wants_every_word(search: str, found: list[str]) -> None:
    selection = replace(Selection.of([ROCK, PARADIDDLE]), search=search)
    assert [card.name for card in selection.visible()] == found


def test_the_keyboard_has_a_kit() -> None:
    pieces = {stroke.piece for stroke in KEYS.values()}
    assert {Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.HIHAT_PEDAL, Piece.RIDE, Piece.CRASH_1} <= pieces
    assert len({stroke.cap for stroke in KEYS.values()}) == len(KEYS)


def test_every_key_says_what_it_plays() -> None:
    words = {stroke.cap: stroke.words for stroke in KEYS.values()}
    assert words["S"] == "hi-hat, open"
    assert words["G"] == "snare, cross stick"
    assert words[";"] == "ride, bell"
    assert words["Space"] == "kick"


def test_keys_strike_zones_that_their_pieces_have() -> None:
    drums = HAND_PIECES - {Piece.HIHAT, Piece.RIDE, Piece.CRASH_1}
    for stroke in KEYS.values():
        if stroke.piece in drums | {Piece.KICK}:
            assert stroke.zone in {Zone.HEAD, Zone.RIM}


def test_the_window_opens_on_what_was_asked_for() -> None:
    asked = SessionRequest("paradiddle", 84.0, 3, bars=(1, 1), demonstrations=0)
    selection = Selection.of([ROCK, PARADIDDLE], asked)
    assert selection.request() == asked
    selection = selection.choose(ROCK)
    request = selection.request()
    assert request is not None
    assert (request.lesson, request.bars) == ("rock-1", None)


def test_a_tempo_is_said_in_the_lesson_s_own_beat_and_stays_within_the_slider() -> None:
    selection = Selection.of([replace(ROCK, beat_quarters=1.5)])
    assert selection.at_beats(120.0).tempo_bpm == pytest.approx(180.0)  # 120 dotted quarters a minute
    assert selection.at_beats(600.0).tempo_bpm == pytest.approx(1.5 * 260.0)  # 600 is beyond the slider


def test_just_playing_takes_the_place_of_a_lesson_and_counts_quarters() -> None:
    """At 120 beats a minute a lesson in 6/8 would make 180 quarters of them."""
    selection = replace(Selection.of([replace(ROCK, beat_quarters=1.5)]), free=True).at_beats(120.0)
    assert selection.request() is None
    request = selection.free_request()
    assert request is not None
    assert request.tempo_bpm == pytest.approx(120.0)
    assert request.click
    selection = selection.choose(ROCK)
    assert selection.free_request() is None
    assert selection.request() is not None


def test_a_course_lists_its_lessons_in_its_order_and_begins_where_the_student_is() -> None:
    course = Course("hands", "Hands", "", "", 1, (CoursePart("", ("paradiddle", "rock-1", "gone")),))
    selection = Selection.of([ROCK, PARADIDDLE])
    selection = selection.offer([ROCK, PARADIDDLE], [course])
    assert (selection.course, selection.visible()) == (None, [ROCK, PARADIDDLE])
    selection = selection.follow(course)
    assert selection.visible() == [PARADIDDLE, ROCK]
    assert selection.card is PARADIDDLE
    progress = {"paradiddle": LessonProgress(100.0, 100.0, Level.BEGINNER), "rock-1": LessonProgress(80.0, 75.0, None)}
    selection = replace(selection, progress=progress)
    assert selection.finished(course) == 1
    assert selection.finished(replace(course, mastery=Level.ELEMENTARY)) == 0
    selection = selection.follow(course)
    assert selection.card is ROCK
    selection = selection.follow(None)
    assert (selection.visible(), selection.card) == ([ROCK, PARADIDDLE], ROCK)


def test_a_course_that_was_followed_is_listed_again_and_one_that_is_gone_is_not() -> None:
    course = Course("hands", "Hands", "", "", 1, (CoursePart("", ("paradiddle",)),))
    selection = Selection.of([ROCK])
    selection = selection.offer([ROCK, PARADIDDLE], [course], "hands")
    assert (selection.course, selection.card) == (course, ROCK)
    selection = selection.offer([ROCK, PARADIDDLE], [course], "none")
    assert selection.course is None


def test_lessons_are_listed_by_kind_those_of_ones_own_last() -> None:
    groove, roll, own = (
        replace(ROCK, name=name, kind=kind) for name, kind in (("g", "grooves"), ("r", "rolls"), ("o", ""))
    )
    groups = Selection.of([groove, roll, replace(groove, name="h"), own]).groups()
    assert [(group.title, [card.name for card in group.cards]) for group in groups] == [
        ("Grooves", ["g", "h"]),
        ("Rolls", ["r"]),
        ("Your own", ["o"]),
    ]


def test_lessons_of_a_kind_stand_by_level_each_level_once() -> None:
    """Imports come to the front of one's own, whatever their level."""
    easy, hard, later = (replace(ROCK, name=name, level=level) for name, level in (("a", 1), ("b", 4), ("c", 1)))
    (group,) = Selection.of([later, hard, easy]).groups()
    assert [card.name for card in group.cards] == ["c", "a", "b"]


def test_a_search_leaves_out_kinds_and_parts_in_which_nothing_is_found() -> None:
    groove, roll = replace(ROCK, kind="grooves"), replace(PARADIDDLE, kind="rolls")
    course = Course("c", "C", "", "", 1, (CoursePart("One", ("rock-1",)), CoursePart("Two", ("paradiddle",))))
    selection = replace(Selection.of([groove, roll]), search="rlrr paradiddle")
    assert selection.groups() == []
    for course_or_none, title in ((None, "Rolls"), (course, "Two")):
        found = replace(selection, search="paradiddle", course=course_or_none).groups()
        assert [(group.title, group.cards) for group in found] == [(title, (roll,))]


def test_what_comes_before_is_named_by_its_title() -> None:
    known = {"paradiddle": LessonProgress(100.0, 100.0, Level.BEGINNER)}
    selection = replace(Selection.of([ROCK, PARADIDDLE]), progress=known)
    assert selection.first_words(replace(ROCK, prerequisites=("paradiddle", "gone"))) == [
        "First: Single paradiddle – mastered",
        "First: gone – not yet mastered",
    ]
