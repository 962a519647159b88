"""Whose it is what a virtual student plays: that of the name that was given, else nobody's who practises here."""

from dataclasses import replace

from station.core.settings import Settings
from station.practice.history.session_files import VIRTUAL_STUDENT
from station.simulation.student_spec import parse_spec


def whose(settings: Settings, named: str | None) -> Settings:
    """The settings of a virtual student, who is `named` by the command line, or bears no person's name."""
    return settings if named is not None else replace(settings, student=VIRTUAL_STUDENT)


def virtual_name(spec: str) -> str:
    """What the student of a line such as "pro,seed=3" is called; raises `BadInput` for a line that says nothing."""
    player = parse_spec(spec).player
    return f"Virtual {player}" if player else VIRTUAL_STUDENT.capitalize()
