"""Whom the picture of a session shows."""

from dataclasses import replace
from pathlib import Path

from station.drills.library import find_lesson
from station.motion.kinematics.figure import load_figure
from station.motion.style.style import Style
from station.practice.headless.virtual_session import practise_virtually
from station.practice.session.plan import PlanOptions, plan_practice
from station.scenes.demonstrator import Demonstrator
from station.scenes.pictures import drummer_of
from station.simulation.student_spec import parse_spec


def test_the_picture_shows_who_demonstrated_in_his_own_style(tmp_path: Path) -> None:
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(loops=2))
    result = practise_virtually(plan, parse_spec("pro,seed=3"), tmp_path / "session.capture").result
    demonstrator = Demonstrator(load_figure("headphones"), replace(Style(), amplitude_gain=80.0))
    drummer = drummer_of(result, demonstrator)
    assert drummer.style.amplitude_gain == 80.0
    assert drummer.figure is demonstrator.figure
    assert drummer.score is result.score
