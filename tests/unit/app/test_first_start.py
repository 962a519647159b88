"""The questions of the first start, and the pages that F1 explains."""

from dataclasses import replace

from station.app.help_topics import HELP, Topic, topic_of
from station.app.room_state import RoomState, Stage
from station.app.settings.first_start import FirstAnswers, answered, student_level
from station.core.settings import Settings
from station.engine.messages import Bus, SetLevel
from station.motion.sticking.hand_notes import Hands


def test_answers_become_settings_and_the_rest_stays() -> None:
    before = Settings(theme="day", panel_scale=1.5)
    after = answered(before, FirstAnswers("  Ann   Lee ", module_sounds=True, hands=Hands.OPEN))
    assert after == replace(before, student="Ann Lee", own_sound=False, hands="open", welcomed=True)


def test_a_blank_name_is_nobody_s() -> None:
    assert answered(Settings(student="Bo"), FirstAnswers("  ")).student == "student"
    assert len(answered(Settings(), FirstAnswers("x" * 200)).student) == 40


def test_questions_put_aside_change_nothing_and_do_not_come_back() -> None:
    assert answered(Settings(student="Bo"), None) == Settings(student="Bo", welcomed=True)


def test_the_page_opens_on_what_the_settings_say() -> None:
    assert FirstAnswers.of(Settings()) == FirstAnswers("", False, Hands.RIGHT)
    assert FirstAnswers.of(Settings(student="Bo", own_sound=False, hands="left")) == FirstAnswers(
        "Bo", True, Hands.LEFT
    )


def test_a_module_that_sounds_silences_the_student_s_strokes() -> None:
    assert student_level(Settings(own_sound=False, levels="student=0.5")) == SetLevel(Bus.STUDENT, 0.0)
    assert student_level(Settings(levels="student=0.5 click=0.2")) == SetLevel(Bus.STUDENT, 0.5)
    assert student_level(Settings()) == SetLevel(Bus.STUDENT, 1.0)


def test_every_page_has_its_help() -> None:
    assert set(HELP) == set(Topic)
    assert topic_of(RoomState(), free=False) is Topic.LESSONS
    assert topic_of(RoomState(), free=True) is Topic.JUST_PLAY
    assert topic_of(RoomState(Stage.PLAYING), free=False) is Topic.PLAYING
    assert topic_of(RoomState(Stage.RESULT, question="rushed?"), free=False) is Topic.QUESTION
    assert topic_of(RoomState(Stage.RESULT), free=False) is Topic.RESULT
    assert topic_of(RoomState(Stage.RESULT, exam=True), free=False) is Topic.EXAM
