"""Whom the picture of a session shows."""

from dataclasses import replace
from pathlib import Path

from station.app.demonstrator import Demonstrator
from station.app.pictures import drummer_of
from station.drills.library import find_lesson
from station.motion.figure import load_figure
from station.motion.style import Style
from station.practice.headless import practise_virtually
from station.practice.plan import Wishes, plan_practice
from station.practice.student_spec import parse_spec


def test_the_picture_shows_who_demonstrated_in_his_own_style(tmp_path: Path) -> None:
    plan = plan_practice(find_lesson("rock-1"), Wishes(loops=2))
    result = practise_virtually(plan, parse_spec("pro,seed=3"), tmp_path / "session.capture").result
    who = Demonstrator(load_figure("median"), replace(Style(), amplitude_gain=80.0))
    drummer = drummer_of(result, who)
    assert drummer.style.amplitude_gain == 80.0
    assert drummer.figure is who.figure
    assert drummer.score is result.score
