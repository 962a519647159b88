"""The lessons page's state, the keyboard's table, the quality's choice."""

from dataclasses import replace

import pytest

from station.app.model import LessonCard, SessionRequest
from station.app.selection import MAX_LOOPS, Selection
from station.core.pieces import HAND_PIECES, Piece, Zone
from station.core.units import NS_PER_S
from station.drills.course import Course
from station.gui.keyboard_kit import KEYS
from station.gui.viewport import quality_for
from station.practice.records.lesson_progress import LessonProgress

ROCK = LessonCard(
    "rock-1", "Rock 1: eighths", 1, "first steps", "The first groove", "Ada", 80.0, 2, 8, "4/4", ("rock",)
)
PARADIDDLE = LessonCard("paradiddle", "Single paradiddle", 2, "beginner", "RLRR LRLL", "Ben", 100.0, 1, 12)


def test_the_first_lesson_is_chosen_at_its_own_tempo() -> None:
    assert Selection([ROCK, PARADIDDLE]).wish() == SessionRequest("rock-1", 80.0, 8, adapt=True)


def test_more_lessons_to_choose_from_change_nothing_that_is_chosen() -> None:
    choice = Selection([PARADIDDLE])
    choice.tempo_bpm = 71.0
    choice.offer([ROCK, PARADIDDLE])
    assert choice.visible() == [ROCK, PARADIDDLE]
    assert (choice.card, choice.tempo_bpm) == (PARADIDDLE, 71.0)


def test_without_lessons_there_is_nothing_to_start() -> None:
    assert Selection([]).wish() is None


def test_choosing_takes_the_author_s_tempo_and_passes() -> None:
    choice = Selection([ROCK, PARADIDDLE])
    choice.tempo_bpm = 140.0
    choice.choose(replace(PARADIDDLE, passes=500))
    assert choice.wish() == SessionRequest("paradiddle", 100.0, MAX_LOOPS, adapt=True)


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
    choice = Selection([ROCK, PARADIDDLE])
    choice.search = search
    assert [card.name for card in choice.visible()] == found


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


@pytest.mark.parametrize(("lowest_ms", "level"), [(1.0, 2), (2.0, 2), (4.0, 1), (6.0, 1), (6.1, 0), (40.0, 0)])
def test_faster_machines_draw_more(lowest_ms: float, level: int) -> None:
    assert quality_for(lowest_ms) == level


def test_the_window_opens_on_what_was_asked_for() -> None:
    asked = SessionRequest("paradiddle", 84.0, 3, bars=(1, 1), demonstrations=0)
    choice = Selection([ROCK, PARADIDDLE], asked)
    assert choice.wish() == asked
    choice.choose(ROCK)
    wish = choice.wish()
    assert wish is not None
    assert (wish.lesson, wish.bars) == ("rock-1", None)


def test_tapped_beats_set_the_tempo_in_the_lesson_s_own_beat() -> None:
    choice = Selection([replace(ROCK, beat_quarters=1.5)])
    for tap in range(4):
        choice.tap(round((10 + 0.5 * tap) * NS_PER_S), (30.0, 260.0))
    assert choice.tempo_bpm == pytest.approx(180.0)  # 120 dotted quarters a minute
    for tap in range(9):
        choice.tap(round((30 + 0.1 * tap) * NS_PER_S), (30.0, 260.0))
    assert choice.tempo_bpm == pytest.approx(1.5 * 260.0)  # 600 is beyond the slider


def test_just_playing_takes_the_place_of_a_lesson_and_taps_quarters() -> None:
    """Taps half a second apart are 120; a lesson in 6/8 would make 180 quarters of them."""
    choice = Selection([replace(ROCK, beat_quarters=1.5)])
    choice.free = True
    for tap in range(3):
        choice.tap(tap * NS_PER_S // 2, (30, 260))
    assert choice.wish() is None
    wish = choice.free_wish()
    assert wish is not None
    assert wish.tempo_bpm == pytest.approx(120.0)
    assert wish.click
    choice.choose(ROCK)
    assert choice.free_wish() is None
    assert choice.wish() is not None


def test_a_course_lists_its_lessons_in_its_order_and_begins_where_the_student_is() -> None:
    course = Course("hands", "Hands", "", "", 1, ("paradiddle", "rock-1", "gone"))
    choice = Selection([ROCK, PARADIDDLE])
    choice.offer([ROCK, PARADIDDLE], [course])
    assert (choice.course, choice.visible()) == (None, [ROCK, PARADIDDLE])
    choice.follow(course)
    assert choice.visible() == [PARADIDDLE, ROCK]
    assert choice.card is PARADIDDLE
    choice.progress = {"paradiddle": LessonProgress(100.0, 100.0, True), "rock-1": LessonProgress(80.0, 75.0, False)}
    assert choice.mastered(course) == 1
    choice.follow(course)
    assert choice.card is ROCK
    choice.follow(None)
    assert (choice.visible(), choice.card) == ([ROCK, PARADIDDLE], ROCK)


def test_a_course_that_was_followed_is_listed_again_and_one_that_is_gone_is_not() -> None:
    course = Course("hands", "Hands", "", "", 1, ("paradiddle",))
    choice = Selection([ROCK])
    choice.offer([ROCK, PARADIDDLE], [course], "hands")
    assert (choice.course, choice.card) == (course, ROCK)
    choice.offer([ROCK, PARADIDDLE], [course], "none")
    assert choice.course is None
