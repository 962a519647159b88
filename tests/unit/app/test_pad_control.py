"""What the kit asks for: two kicks start, two crashes or a foot switch pause, silence too. On an engine by hand."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.app.actions.equipment_actions import GiveUp, LearnVelocity
from station.app.actions.practice_actions import Begin, EndSession, Pause
from station.app.actions.settings_actions import LearnPause, SetPreferences
from station.app.controller import Controller
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.core.errors import BadInput
from station.core.events import DeviceFound, Hit, Switched
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Play, Started
from station.engine.messages import Stop as StopTransport
from station.practice.session.plan import PlanOptions, plan_practice
from tests.fakes.stations import Line, choose, room, shown, station_on, store_with

LOOPS = 4
PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(tempo_bpm=80.0, loops=LOOPS, demonstrations=0))
BAR_NS = 3 * NS_PER_S
"""Four quarters at 80 bpm."""
ZERO_NS = NS_PER_S


def station_with(sessions: Path, **chosen: object) -> tuple[Controller, Line]:
    line = Line()
    return station_on([line], store_with(sessions, **chosen), Launch(PLAN)), line


def playing(sessions: Path, **chosen: object) -> tuple[Controller, Line]:
    """A station whose student has played the first downbeat."""
    station, line = station_with(sessions, **chosen)
    station.dispatch(Begin())
    line.says.append(Started(ZERO_NS))
    station.update(ZERO_NS + 1)
    strike(station, line, at(0), Piece.KICK)
    return station, line


def at(score_ns: int) -> int:
    return ZERO_NS + PLAN.passes_start_ns + score_ns


def strike(station: Controller, line: Line, at_ns: int, *pieces: Piece) -> None:
    line.says += [Hit(at_ns, piece, Zone.HEAD, 90) for piece in pieces]
    station.update(at_ns + 1)


def kicks(station: Controller, line: Line, at_ns: int) -> None:
    """Two that stand alone, and the silence after them."""
    strike(station, line, at_ns, Piece.KICK)
    strike(station, line, at_ns + NS_PER_S // 2, Piece.KICK)
    station.update(at_ns + 2 * NS_PER_S)


def plays(line: Line) -> int:
    return [type(command) for command in line.heard].count(Play)


def begun(station: Controller) -> bool:
    return room(station).stage is Stage.PLAYING


def test_two_kicks_begin_once_what_enter_starts(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    kicks(station, line, NS_PER_S)
    assert (begun(station), plays(line)) == (True, 1)


def test_strokes_that_teach_command_nothing(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    line.says.append(DeviceFound(0, "TD-17"))
    station.update(1)
    station.dispatch(LearnVelocity(Piece.KICK))
    kicks(station, line, NS_PER_S)
    assert not begun(station)
    station.dispatch(GiveUp())
    kicks(station, line, 5 * NS_PER_S)
    assert begun(station)


def test_kicks_that_belong_to_something_start_nothing(tmp_path: Path) -> None:
    """The last bar of a groove, a kick and a crash, then the foot that rests on its pedal; and three kicks."""
    station, line = station_with(tmp_path)
    for eighth, piece in enumerate((Piece.KICK, Piece.HIHAT, Piece.SNARE, Piece.HIHAT, Piece.KICK, Piece.KICK)):
        strike(station, line, NS_PER_S + eighth * NS_PER_S // 4, piece)
    kicks(station, line, 3 * NS_PER_S)
    for quarter in range(3):
        strike(station, line, 10 * NS_PER_S + quarter * NS_PER_S // 2, Piece.KICK)
    station.update(20 * NS_PER_S)
    assert not begun(station)


def test_two_kicks_begin_a_free_take_too(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    choose(station, free=True)
    kicks(station, line, NS_PER_S)
    assert (begun(station), plays(line)) == (True, 1)


def test_the_settings_may_leave_the_kicks_alone(tmp_path: Path) -> None:
    station, line = station_with(tmp_path, kicks_start=False)
    kicks(station, line, NS_PER_S)
    assert not begun(station)


def test_in_the_middle_of_a_drill_kicks_are_kicks(tmp_path: Path) -> None:
    station, line = playing(tmp_path)
    kicks(station, line, at(NS_PER_S))
    assert plays(line) == 1
    assert not room(station).paused


def test_whoever_stops_is_waited_for_and_two_kicks_go_on(tmp_path: Path) -> None:
    """The downbeat, then silence: bars 2 and 3 are over at the end of bar 3."""
    station, line = playing(tmp_path)
    station.update(at(3 * BAR_NS))
    was_paused = [room(station).paused]
    station.update(at(3 * BAR_NS + 100 * NS_PER_MS))
    was_paused.append(room(station).paused)
    assert was_paused == [False, True]
    assert isinstance(line.heard[-1], StopTransport)
    assert shown(station, at(4 * BAR_NS)).hud.halt == "Paused"
    kicks(station, line, at(5 * BAR_NS))
    assert not room(station).paused
    assert isinstance(line.heard[-1], Play)
    assert plays(line) == 2, "it goes on, and nothing begins"


def test_a_session_that_is_stopped_in_its_pause_scores_no_silence(tmp_path: Path) -> None:
    """Of rock 1 a kick and a hi-hat stand on the downbeat: the kick was played."""
    station, _ = playing(tmp_path)
    station.update(at(3 * BAR_NS + 100 * NS_PER_MS))
    station.dispatch(EndSession())
    report = station.view().report
    assert report is not None
    counts = report.document["counts"]
    assert isinstance(counts, dict)
    assert (counts["notes"], counts["hits"], counts["misses"]) == (2, 1, 1)


def test_the_settings_may_leave_the_silence_alone(tmp_path: Path) -> None:
    station, _ = playing(tmp_path, auto_pause=False)
    station.update(at(5 * BAR_NS))
    assert not room(station).paused


def test_both_crashes_at_once_pause_and_are_not_scored(tmp_path: Path) -> None:
    station, line = playing(tmp_path)
    strike(station, line, at(NS_PER_S), Piece.CRASH_1, Piece.CRASH_2)
    assert room(station).paused
    station.dispatch(EndSession())
    report = station.view().report
    assert report is not None
    counts = report.document["counts"]
    assert isinstance(counts, dict)
    assert (counts["hits"], counts["extras"]) == (1, 0)


def test_a_foot_switch_pauses_and_goes_on(tmp_path: Path) -> None:
    station, line = playing(tmp_path, pause="cc=66")
    seen = []
    for at_s, switch in ((1, "cc=64"), (2, "cc=66"), (3, "cc=66")):
        line.says.append(Switched(at(at_s * NS_PER_S), switch, "kit"))
        station.update(at(at_s * NS_PER_S) + 1)
        seen.append(room(station).paused)
    assert seen == [False, True, False]
    assert plays(line) == 2


def test_the_report_tells_of_the_pause(tmp_path: Path) -> None:
    station, line = playing(tmp_path)
    station.dispatch(Pause())
    station.dispatch(Pause())
    line.says.append(Started(100 * NS_PER_S))
    station.update(100 * NS_PER_S + 1)
    station.dispatch(EndSession())
    report = station.view().report
    assert report is not None
    session = report.document["session"]
    assert isinstance(session, dict)
    assert session["pauses"] == [{"bar": 1, "asked": True, "strokes_again": 1}]
    (text,) = tmp_path.rglob("report.txt")
    assert "Paused once; what was played again after a pause counts as it was played last." in text.read_text()


def test_a_pass_that_moves_the_tempo_is_played_whole_again(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    choose(station, adapt=True)
    station.dispatch(Begin())
    line.says.append(Started(ZERO_NS))
    station.update(ZERO_NS + 1)
    strike(station, line, at(2 * BAR_NS), Piece.SNARE)
    station.dispatch(Pause())
    station.dispatch(Pause())
    station.dispatch(EndSession())
    report = station.view().report
    assert report is not None
    counts = report.document["counts"]
    assert isinstance(counts, dict)
    assert counts["hits"] == 0


def test_no_pads_command_while_a_question_is_open(tmp_path: Path) -> None:
    """Every stroke of the session 15 ms early, then two kicks."""
    station, line = station_with(tmp_path)
    station.dispatch(Begin())
    line.says.append(Started(ZERO_NS))
    station.update(ZERO_NS + 1)
    for at_ns, piece in zip(PLAN.score.onset_ns.tolist(), PLAN.score.notes["piece"].tolist(), strict=True):
        line.says.append(Hit(at(at_ns) - 15 * NS_PER_MS, Piece(piece), Zone.HEAD, 90))
    station.update(at(PLAN.end_ns) + 2 * NS_PER_S)
    assert room(station).stage is Stage.RESULT
    assert room(station).question
    kicks(station, line, at(PLAN.end_ns) + 3 * NS_PER_S)
    assert not begun(station)


def test_a_pause_that_cannot_be_meant_is_named(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"settings\.toml: pause: snare: expected two pads"):
        station_with(tmp_path, pause="snare")


def test_a_gesture_that_was_learnt_pauses_and_kicks_that_were_switched_off_start_nothing(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    station.dispatch(SetPreferences(replace(station.view().preferences, kicks_start=False)))
    kicks(station, line, NS_PER_S)
    assert not begun(station)
    station.dispatch(LearnPause(on=True))
    strike(station, line, 3 * NS_PER_S, Piece.CRASH_1, Piece.RIDE)
    station.dispatch(Begin())
    line.says.append(Started(4 * NS_PER_S))
    station.update(4 * NS_PER_S + 1)
    strike(station, line, 4 * NS_PER_S + PLAN.passes_start_ns, Piece.KICK)
    strike(station, line, 4 * NS_PER_S + PLAN.passes_start_ns + BAR_NS, Piece.CRASH_1, Piece.RIDE)
    assert room(station).paused
