"""A session of the history is opened as it was at its end, also where its folder is gone."""

import json
import shutil
from collections.abc import Iterator
from datetime import date
from pathlib import Path

import pytest

from station.app.actions.action import Show
from station.app.actions.battle_actions import CloseBattle, JudgeBattle, ReplayBest
from station.app.actions.history_actions import OpenKept, WritePage
from station.app.actions.practice_actions import Begin, Dismiss, Listen
from station.app.battle.battle_shown import BattleStage
from station.app.child_programs import ChildPrograms
from station.app.controller import Controller
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.cli.command_line import main
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.drills.library import find_lesson
from station.engine.engine import Engine
from station.engine.messages import Play, RecordCapture
from station.practice.headless.virtual_session import practise_virtually
from station.practice.history.session_intake import take_in
from station.practice.history.student_history import StudentHistory
from station.practice.records.report.session_report import practice_document
from station.practice.records.save_session import SessionFolder
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.free_play import LEAD_IN_NS, FreeClick, FreePlay
from station.practice.session.plan import PlanOptions, plan_practice
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec
from station.store.database_url import sqlite_url
from station.store.opening import history_of
from tests.fakes.stations import Line, store_with
from tests.fakes.work_at_once import WorkAtOnce

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))


class Room:
    """A station whose student has a history."""

    def __init__(self, folder: Path) -> None:
        self.store = store_with(folder, student="Ada", history=sqlite_url(folder / "history.sqlite3"))
        self.history, self.line = history_of(self.store.now), Line()
        programs = ChildPrograms(lambda: self.line, work=WorkAtOnce)
        self.station = Controller(programs, self.store, Launch(PLAN))
        self.station.dispatch(Show(history=True))

    def keep(self, folder: Path, is_gone: bool) -> int:
        number = take_in(self.history, "Ada", folder)
        assert number is not None
        if is_gone:
            shutil.rmtree(folder)
        return number

    def open(self, number: int) -> str:
        """Open it; what the user reads in passing."""
        self.station.dispatch(OpenKept(number))
        self.station.update(1)
        return self.station.view().toast

    def plays(self) -> Play:
        """What sounds."""
        played = [command for command in self.line.heard if isinstance(command, Play)]
        return played[-1]


@pytest.fixture
def room(tmp_path: Path) -> Iterator[Room]:
    made = Room(tmp_path)
    yield made
    made.station.close()
    made.history.database.close()


def lesson(folder: Path, room: Room, lesson: str = "rock-fill-1") -> Path:
    folder = folder / "2026-03-01T18-30-05_x"
    folder.mkdir()
    virtual = practise_virtually(
        plan_practice(find_lesson(lesson), PlanOptions(loops=2)),
        parse_spec("seed=4,miss_pct=5"),
        folder / "session.capture",
    )
    document = practice_document(virtual.result, room.store.now)
    SessionFolder(folder, StudentHistory.of(room.store.now), is_new=False).write(virtual.result, document)
    return folder


@pytest.mark.parametrize("is_gone", [False, True])
def test_a_lesson_s_result_is_that_of_its_end(room: Room, tmp_path: Path, is_gone: bool) -> None:
    folder = lesson(tmp_path, room)
    report = json.loads((folder / "report.json").read_text())
    assert room.open(room.keep(folder, is_gone)) == ""
    state = room.station.view()
    assert state.shows_result
    assert state.report is not None
    assert state.report.document == report
    assert state.report.folder == ("" if is_gone else str(folder))
    assert state.report.day == date(2026, 3, 1)
    assert state.room.student == "you, 1 Mar 2026", "nobody takes it for what they played just now"
    dots = state.report.hits.dots
    assert len(dots) >= report["counts"]["matched"], "every stroke is there to be seen and heard"
    assert state.history.opening is None
    room.station.dispatch(Dismiss())
    assert room.station.view().room.stage is Stage.IDLE


def test_a_take_sounds_again(room: Room, tmp_path: Path) -> None:
    folder = tmp_path / "2026-03-01T18-30-05_just-play"
    folder.mkdir()
    engine, play = Engine(), FreePlay(FreeClick(120.0, PLAIN))
    engine.use_preset("kit", GENERAL_MIDI_PRESET)
    engine.device_found("kit", 0)
    engine.advance(0)
    for command in (RecordCapture(folder / "session.capture"), *play.start()):
        engine.handle(command)
    for event in engine.advance(LEAD_IN_NS):
        play.handle(event)
    for at_ms, note in ((2100, 36), (2600, 38)):
        now_ns = LEAD_IN_NS + at_ms * NS_PER_MS
        for event in engine.advance(now_ns - 1):
            play.handle(event)
        engine.feed("kit", bytes([0x99, note, 100]), now_ns)
    engine.handle(RecordCapture(None))
    for event in engine.advance(LEAD_IN_NS + 4 * NS_PER_S):
        play.handle(event)
    (folder / "take.json").write_text(json.dumps(play.document("Ada")))
    assert room.open(room.keep(folder, is_gone=True)) == ""
    room.station.update(2)
    state = room.station.view()
    assert (state.room.stage, state.room.free, state.room.listening) == (Stage.IDLE, True, True)
    cues = room.plays().cues
    struck = cues[cues["velocity"] == 100]["at_ns"] // NS_PER_MS
    assert struck.tolist() == [100, 600], "from the bar of the first stroke: a bar lasts two seconds"
    room.station.dispatch(Listen())
    assert not room.station.view().room.listening


@pytest.mark.parametrize("is_gone", [False, True])
def test_a_battle_s_result_and_its_best_bar_are_there_again(room: Room, tmp_path: Path, is_gone: bool) -> None:
    folder = tmp_path / "2026-03-01T18-30-05_battle-steady"
    words = ("battle", "--headless", "--rounds", "1", "--no-final", "--tempo", "150", "--virtual-student", "pro,seed=2")
    assert main([*words, "--report", str(folder)]) == 0
    told = (folder / "battle.txt").read_text()
    assert room.open(room.keep(folder, is_gone)) == ""
    room.station.update(2)
    shown = room.station.view().battle
    assert shown.stage is BattleStage.OVER
    assert shown.result is not None
    assert [name in told for name in shown.result.names] == [True] * len(shown.result.names)
    assert (shown.result.folder, shown.result.films) == (("", False) if is_gone else (str(folder), True))
    assert shown.result.best
    room.station.dispatch(ReplayBest())
    room.station.update(3)
    assert room.station.view().battle.replays
    assert room.station.view().snapshot is not None
    room.station.dispatch(ReplayBest())
    room.station.dispatch(JudgeBattle(Level.BEGINNER))
    result = room.station.view().battle.result
    assert result is not None
    assert ("Judged as" in result.told) is not is_gone
    room.station.dispatch(CloseBattle())
    room.station.update(4)
    state = room.station.view()
    assert (state.battle.stage, state.room.stage) == (BattleStage.CLOSED, Stage.IDLE)
    assert state.room.free == state.selection.free


def test_nothing_is_opened_while_somebody_plays(room: Room, tmp_path: Path) -> None:
    number = room.keep(lesson(tmp_path, room), is_gone=True)
    room.station.dispatch(Begin())
    assert "end the session first" in room.open(number)
    assert room.station.view().room.stage is Stage.PLAYING


def test_a_session_without_its_capture_is_one_clear_line(room: Room, tmp_path: Path) -> None:
    folder = lesson(tmp_path, room)
    (folder / "session.capture").unlink()
    said = room.open(room.keep(folder, is_gone=False))
    assert "its capture is kept neither in a folder nor in the history" in said
    assert room.station.view().history.opening is None
    assert "no session of that number" in room.open(999)


def test_the_page_of_a_session_is_written_where_the_student_s_files_are(room: Room, tmp_path: Path) -> None:
    number = room.keep(lesson(tmp_path, room), is_gone=True)
    room.open(number)
    assert room.station.view().history.opened == number
    room.station.dispatch(WritePage(number, "2026-03-01T18-30-05_x"))
    assert room.station.view().history.page_files.writing == number
    room.station.update(2)
    said, files = room.station.view().toast, room.station.view().history.page_files
    (page,) = tmp_path.rglob("*.html")
    assert said.endswith("2026-03-01T18-30-05_x.html")
    assert (files.writing, dict(files.written)) == (None, {number: page})
    assert "Ada" in page.relative_to(tmp_path).parts
    assert page.read_text().startswith("<!DOCTYPE html>")


def test_a_battle_over_the_network_is_said_to_be_elsewhere(room: Room, tmp_path: Path) -> None:
    folder = tmp_path / "2026-03-01T18-30-05_battle-steady"
    words = ("battle", "--headless", "--rounds", "1", "--no-final", "--tempo", "150", "--virtual-student", "pro,seed=2")
    assert main([*words, "--report", str(folder)]) == 0
    document = json.loads((folder / "battle.json").read_text())
    (folder / "battle.json").write_text(json.dumps(document | {"network": {"with": "Bea"}}))
    assert "the friend's strokes are at their station" in room.open(room.keep(folder, is_gone=True))
