"""The questions of the first start, and the pages that F1 explains."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.app.actions.settings_actions import FinishFirstStart
from station.app.engine_client import DEAD, SILENT
from station.app.help_topics import HELP, Topic, topic_of
from station.app.room_state import RoomState, Stage
from station.app.sessions.launch import Launch
from station.app.settings.first_start import FirstAnswers, answered, found_lines, student_level
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.mastery.feedback_fading import Feedback
from station.engine.messages import Bus, Play, SetLevel
from station.motion.sticking.hand_notes import Hands
from station.practice.lag.first_groove import first_groove
from tests.fakes.stations import Line, room, station_on, store_with


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


@pytest.mark.parametrize(
    ("kits", "sound", "says"),
    [
        ("", "Speakers", ("plug it in now, or play on the computer's keys (Space: kick)", "Sound: Speakers")),
        ("TD-17", SILENT, ("Kit: TD-17", "plug in headphones or a loudspeaker")),
        ("TD-17, SPD-SX", DEAD, ("The Devices page learns", "No sound")),
    ],
)
def test_what_is_missing_is_said_with_what_to_do(kits: str, sound: str, says: tuple[str, str]) -> None:
    for line, words in zip(found_lines(kits, sound, "Space: kick"), says, strict=True):
        assert words in line


def test_a_newcomer_hears_the_first_groove_at_once(tmp_path: Path) -> None:
    line = Line()
    station = station_on([line], store_with(tmp_path), Launch(first_groove(Settings())))
    station.dispatch(FinishFirstStart(FirstAnswers("Ann")))
    assert room(station).stage is Stage.PLAYING
    told = station.parts.sessions.practice.session.session.feedback
    assert told is Feedback.PADS, "nobody knows yet how late the equipment is"
    (play,) = [command for command in line.heard if isinstance(command, Play)]
    first_drum_ns = play.cues["at_ns"][play.cues["bus"] == Bus.DEMONSTRATION].min()
    assert first_drum_ns <= 5 * NS_PER_S, "after a bar of count-in at 60 beats a minute"
    station.update(1)
    assert "computer's keys" in station.view().toast
    station.close()


def test_whoever_puts_the_questions_aside_is_left_alone(tmp_path: Path) -> None:
    station = station_on([Line()], store_with(tmp_path), Launch(first_groove(Settings())))
    station.dispatch(FinishFirstStart(None))
    assert room(station).stage is Stage.IDLE
    assert station.view().selection.card is not None
    station.close()
