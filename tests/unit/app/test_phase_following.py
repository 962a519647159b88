"""What the engine is told of a session whose drummer follows the student's phase."""

import pytest

from station.app.engine_client import EngineClient
from station.app.sessions.phase_following import PhaseFollowing
from station.drills.library import find_lesson
from station.engine.messages import TrackPhase
from station.practice.session.plan import PlanOptions, plan_practice
from station.scenes.demonstrator import Demonstrator
from station.scenes.session_part import AHEAD
from tests.fakes.stations import Line

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))


@pytest.mark.parametrize("sounds", [False, True])
def test_the_section_s_strokes_sound_where_that_is_wished(sounds: bool) -> None:
    line, told = Line(), list[str]()
    following = PhaseFollowing(EngineClient(lambda: line, 48_000), PLAN, Demonstrator(), told.append, sounds)
    AHEAD.submit(lambda: None).result()  # one thread makes one thing after the other: the model is there
    following.advance(0, PLAN.section, None)
    (asked,) = [command for command in line.heard if isinstance(command, TrackPhase)]
    assert asked.model is not None
    assert len(asked.triggers) == (len(PLAN.section) // asked.model.repeats if sounds else 0)
    following.end()
    assert line.heard[-1] == TrackPhase(None)
    assert told == []
