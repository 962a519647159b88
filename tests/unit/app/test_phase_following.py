"""A session follows the student's sticks: the engine gets the model, its phases move the drummer, and it is let go."""

from dataclasses import replace

import numpy as np
import pytest

from station.app.engine_client import EngineClient
from station.app.sessions.phase_following import PhaseFollowing
from station.core.events import PhaseEstimate
from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import TrackPhase
from station.music.score import Score
from station.practice.session.device_latency import Latency
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.runner import SessionRunner
from station.scenes.session_part import AHEAD
from tests.fakes.stations import Line

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=2, demonstrations=0))


def following(plan: Plan = PLAN, sounds: bool = False) -> tuple[Line, PhaseFollowing, list[str]]:
    """One whose model is made: the thread that makes drummers works in order."""
    line, notes = Line(), list[str]()
    followed = PhaseFollowing(EngineClient(lambda: line, 48_000), SessionRunner(plan, Latency()), notes.append, sounds)
    assert followed.advance(0, plan.section, 0.0) is None
    AHEAD.submit(lambda: None).result()
    return line, followed, notes


def asked(line: Line) -> list[TrackPhase]:
    return [command for command in line.heard if isinstance(command, TrackPhase)]


def test_the_engine_gets_the_model_and_its_phases_say_where_the_drummer_is() -> None:
    line, followed, notes = following()
    assert followed.advance(0, PLAN.section, 0.0) is None
    (command,) = asked(line)
    model = command.model
    assert model is not None
    for k in range(300):  # at four fifths of the tempo, from the beginning on
        at_ns = k * 10_000_000
        turn = k * 0.01 * 0.8 / model.cycle_s
        phase = np.pi - (np.pi - 2 * np.pi * turn) % (2 * np.pi)
        followed.handle(PhaseEstimate(at_ns, phase, 0.9, 1.0, 2 * np.pi * 0.8 / model.cycle_s, locked=True))
        place_s = followed.advance(at_ns, PLAN.section, at_ns / NS_PER_S)
    assert place_s == pytest.approx(299 * 0.01 * 0.8, abs=0.01)
    faster = PLAN.section.at_speed(2.0)
    assert followed.advance(at_ns, faster, 0.5) == pytest.approx(299 * 0.01 * 0.4, abs=0.01)
    assert followed.advance(at_ns, PLAN.section, None) is None, "outside of the passes nobody is followed"
    followed.end()
    assert asked(line)[-1] == TrackPhase(None)
    assert notes == []


def test_where_no_hand_plays_the_student_is_told_and_the_clock_holds() -> None:
    notes = PLAN.section.notes
    feet = Score.from_array(notes[notes["piece"] == Piece.KICK], PLAN.section.tempo_map)
    line, followed, said = following(replace(PLAN, section=feet))
    assert followed.advance(0, feet, 0.0) is None
    assert asked(line) == []
    assert len(said) == 1
    assert "no hand plays" in said[0]


@pytest.mark.parametrize("sounds", [False, True])
def test_the_section_s_strokes_sound_where_that_is_wished(sounds: bool) -> None:
    line, followed, notes = following(sounds=sounds)
    followed.advance(0, PLAN.section, None)
    (command,) = asked(line)
    assert command.model is not None
    assert len(command.triggers) == (len(PLAN.section) // command.model.repeats if sounds else 0)
    assert notes == []
