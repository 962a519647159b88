"""Every kind of action that a user may ask for has a handler."""

from pathlib import Path
from typing import get_args

from station.app.actions.action import Action
from station.app.handlers.handler_table import handlers_of
from station.app.sessions.launch import Launch
from station.drills.library import find_lesson
from station.practice.session.plan import PlanOptions, plan_practice
from tests.fakes.stations import Line, station_on, store_with


def test_no_action_is_forgotten_and_none_unknown(tmp_path: Path) -> None:
    launch = Launch(plan_practice(find_lesson("rock-1"), PlanOptions()))
    station = station_on([Line()], store_with(tmp_path), launch)
    assert set(handlers_of(station.parts)) == set(get_args(Action))
    station.close()
