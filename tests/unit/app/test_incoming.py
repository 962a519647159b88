"""What comes by double click or drag and is no music: it is kept where its kind is kept, told, and its lesson shown."""

import time
from dataclasses import replace
from pathlib import Path

import pytest

from station.app.actions.action import Show
from station.app.actions.file_actions import Import
from station.app.child_programs import ChildPrograms
from station.app.controller import Controller
from station.app.sessions.launch import Launch
from station.app.teacher_desk.incoming import KeptParcel
from station.cli.command_line import main
from station.drills.library import find_lesson
from station.practice.exchange.assignment_file import assignment_bytes
from station.practice.exchange.note_file import note_bytes
from station.practice.exchange.parcel import Kind
from station.practice.exchange.return_file import return_bytes
from station.practice.session.plan import PlanOptions, plan_practice
from tests.fakes.stations import Line, store_with
from tests.fakes.work_at_once import WorkAtOnce
from tests.parcels_made import ASSIGNMENT, NOTE, a_return

LISTED_WITHIN_S = 60.0
PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))


@pytest.fixture
def station(tmp_path: Path) -> Controller:
    """A station with all lessons listed, whose work is done at once."""
    line = Line()
    station = Controller(ChildPrograms(lambda: line, work=WorkAtOnce), store_with(tmp_path), Launch(PLAN))
    station.dispatch(Show(catalog=True))
    until = time.monotonic() + LISTED_WITHIN_S
    while len(station.view().selection.lessons) < 2 and time.monotonic() < until:
        station.update(1)
    return station


def brought(station: Controller, path: Path, data: bytes) -> str:
    """What the window says of a file that is dropped on it."""
    path.write_bytes(data)
    station.dispatch(Import(str(path)))
    station.update(2)
    station.update(3)
    return station.view().toast


def test_an_assignment_is_taken_and_its_first_lesson_shown(station: Controller, tmp_path: Path) -> None:
    told = brought(station, tmp_path / f"x{Kind.ASSIGNMENT.ending}", assignment_bytes(ASSIGNMENT))
    assert "Week 3: taken" in told
    assert station.view().player.lesson.title == "Three"
    kept = station.view().imports.kept
    assert isinstance(kept, KeptParcel)
    assert "Due Tuesday, 1 December 2026" in kept.lines
    (own, *_) = station.view().selection.groups()
    assert [card.title for card in own.cards] == ["Four", "Three"]
    assert "taken before" in brought(station, tmp_path / "again.drum-assignment", assignment_bytes(ASSIGNMENT))


def test_a_shipped_lesson_is_shown_as_it_ships(station: Controller, tmp_path: Path) -> None:
    lesson = replace(ASSIGNMENT.lessons[0], name="rock-2", text=find_lesson("rock-2").text)
    brought(station, tmp_path / "x.drum-assignment", assignment_bytes(replace(ASSIGNMENT, lessons=(lesson,))))
    assert station.view().player.lesson.name == "rock-2"
    assert station.view().selection.groups()[0].title != "Your own"
    assert not list(tmp_path.rglob("rock-2.toml"))


def test_a_return_is_received(station: Controller, tmp_path: Path) -> None:
    words = ("practice", "rock-1", "--loops", "1", "--no-demonstration", "--headless", "--no-pictures")
    assert main([*words, "--virtual-student", "pro,seed=1", "--report", str(tmp_path / "take")]) == 0
    told = brought(station, tmp_path / "x.drum-return", return_bytes(a_return(tmp_path / "take")))
    assert "Zoë: 1 session of Week 3" in told
    assert len(list(tmp_path.rglob("returns/Tuesday-group/Zoë/*.drum-return"))) == 1


def test_a_note_to_nobody_here_is_told_in_a_line(station: Controller, tmp_path: Path) -> None:
    told = brought(station, tmp_path / "x.drum-note", note_bytes(NOTE))
    assert "it answers Week 3, which" in told
    assert "has not taken" in told


def test_a_file_that_is_none_is_told_in_a_line(station: Controller, tmp_path: Path) -> None:
    assert "is not an assignment" in brought(station, tmp_path / "x.drum-assignment", b"hello")
    assert "is not an assignment" in station.view().imports.fault
