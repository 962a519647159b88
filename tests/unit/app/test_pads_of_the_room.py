"""What the kit commands: two kicks start, two crashes or a foot switch pause, silence too. A room on a line by hand."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from station.app.model import SessionRequest, Stage
from station.app.practice_room import PracticeRoom
from station.app.processes import Processes
from station.core.errors import BadInput
from station.core.events import DeviceFound, Hit, Switched
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Play, Started, Stop
from station.practice.session.plan import PlanOptions, plan_practice
from tests.unit.app.test_practice_room import Line

LOOPS = 4
PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(tempo_bpm=80.0, loops=LOOPS, demonstrations=0))
WISH = SessionRequest("rock-1", 80.0, LOOPS, demonstrations=0)
BAR_NS = 3 * NS_PER_S
"""Four quarters at 80 bpm."""
ZERO_NS = NS_PER_S


def room_with(sessions: Path, **chosen: object) -> tuple[PracticeRoom, Line]:
    line = Line()
    settings = Settings(sessions=str(sessions), **chosen)  # type: ignore[arg-type] # what a test chooses
    return PracticeRoom(Processes(lambda: line), settings, PLAN), line


def playing(sessions: Path, **chosen: object) -> tuple[PracticeRoom, Line]:
    """A room whose student has played the first downbeat."""
    room, line = room_with(sessions, **chosen)
    room.start(WISH)
    line.says.append(Started(ZERO_NS))
    room.snapshot(ZERO_NS + 1)
    strike(room, line, at(0), Piece.KICK)
    return room, line


def at(score_ns: int) -> int:
    return ZERO_NS + PLAN.passes_start_ns + score_ns


def strike(room: PracticeRoom, line: Line, at_ns: int, *pieces: Piece) -> None:
    line.says += [Hit(at_ns, piece, Zone.HEAD, 90) for piece in pieces]
    room.snapshot(at_ns + 1)


def kicks(room: PracticeRoom, line: Line, at_ns: int) -> None:
    strike(room, line, at_ns, Piece.KICK)
    strike(room, line, at_ns + NS_PER_S // 2, Piece.KICK)


def plays(line: Line) -> int:
    return [type(command) for command in line.heard].count(Play)


def asked_for(room: PracticeRoom, times: int = 2) -> Iterator[bool]:
    return (room.wants_start() for _ in range(times))


def test_two_kicks_ask_once_for_what_enter_starts(tmp_path: Path) -> None:
    room, line = room_with(tmp_path)
    kicks(room, line, NS_PER_S)
    assert list(asked_for(room)) == [True, False]


def test_strokes_that_teach_command_nothing(tmp_path: Path) -> None:
    room, line = room_with(tmp_path)
    line.says.append(DeviceFound(0, "TD-17"))
    room.snapshot(1)
    room.desk.learn_touch(Piece.KICK)
    kicks(room, line, NS_PER_S)
    assert not room.wants_start()
    room.desk.give_up()
    kicks(room, line, 3 * NS_PER_S)
    assert room.wants_start()


def test_two_kicks_begin_a_free_take_too(tmp_path: Path) -> None:
    room, line = room_with(tmp_path)
    room.preview(None)
    kicks(room, line, NS_PER_S)
    assert list(asked_for(room)) == [True, False]


def test_the_settings_may_leave_the_kicks_alone(tmp_path: Path) -> None:
    room, line = room_with(tmp_path, kicks_start=False)
    kicks(room, line, NS_PER_S)
    assert not room.wants_start()


def test_in_the_middle_of_a_drill_kicks_are_kicks(tmp_path: Path) -> None:
    room, line = playing(tmp_path)
    kicks(room, line, at(NS_PER_S))
    assert not room.wants_start()
    assert not room.room().paused


def test_whoever_stops_is_waited_for_and_two_kicks_go_on(tmp_path: Path) -> None:
    """The downbeat, then silence: bars 2 and 3 are over at the end of bar 3."""
    room, line = playing(tmp_path)
    room.snapshot(at(3 * BAR_NS))
    was_paused = [room.room().paused]
    room.snapshot(at(3 * BAR_NS + 100 * NS_PER_MS))
    was_paused.append(room.room().paused)
    assert was_paused == [False, True]
    assert isinstance(line.heard[-1], Stop)
    assert room.snapshot(at(4 * BAR_NS)).hud.message.startswith("Paused")
    kicks(room, line, at(5 * BAR_NS))
    assert not room.room().paused
    assert isinstance(line.heard[-1], Play)
    assert not room.wants_start(), "it goes on, and nothing begins"


def test_a_session_that_is_stopped_in_its_pause_scores_no_silence(tmp_path: Path) -> None:
    """Of rock 1 a kick and a hi-hat stand on the downbeat: the kick was played."""
    room, _ = playing(tmp_path)
    room.snapshot(at(3 * BAR_NS + 100 * NS_PER_MS))
    room.stop()
    report = room.report()
    assert report is not None
    counts = report.document["counts"]
    assert isinstance(counts, dict)
    assert (counts["notes"], counts["hits"], counts["misses"]) == (2, 1, 1)


def test_the_settings_may_leave_the_silence_alone(tmp_path: Path) -> None:
    room, _ = playing(tmp_path, auto_pause=False)
    room.snapshot(at(5 * BAR_NS))
    assert not room.room().paused


def test_both_crashes_at_once_pause_and_are_not_scored(tmp_path: Path) -> None:
    room, line = playing(tmp_path)
    strike(room, line, at(NS_PER_S), Piece.CRASH_1, Piece.CRASH_2)
    assert room.room().paused
    room.stop()
    report = room.report()
    assert report is not None
    counts = report.document["counts"]
    assert isinstance(counts, dict)
    assert (counts["hits"], counts["extras"]) == (1, 0)


def test_a_foot_switch_pauses_and_goes_on(tmp_path: Path) -> None:
    room, line = playing(tmp_path, pause="cc=66")
    seen = []
    for at_s, switch in ((1, "cc=64"), (2, "cc=66"), (3, "cc=66")):
        line.says.append(Switched(at(at_s * NS_PER_S), switch, "kit"))
        room.snapshot(at(at_s * NS_PER_S) + 1)
        seen.append(room.room().paused)
    assert seen == [False, True, False]
    assert plays(line) == 2


def test_the_report_tells_of_the_pause(tmp_path: Path) -> None:
    room, line = playing(tmp_path)
    room.pause()
    room.pause()
    line.says.append(Started(100 * NS_PER_S))
    room.snapshot(100 * NS_PER_S + 1)
    room.stop()
    report = room.report()
    assert report is not None
    session = report.document["session"]
    assert isinstance(session, dict)
    assert session["pauses"] == [{"bar": 1, "asked": True, "strokes_again": 1}]
    (text,) = tmp_path.rglob("report.txt")
    assert "Paused once; what was played again after a pause counts as it was played last." in text.read_text()


def test_a_pass_that_moves_the_tempo_is_played_whole_again(tmp_path: Path) -> None:
    room, line = room_with(tmp_path)
    room.start(SessionRequest("rock-1", 80.0, LOOPS, demonstrations=0, adapt=True))
    line.says.append(Started(ZERO_NS))
    room.snapshot(ZERO_NS + 1)
    strike(room, line, at(2 * BAR_NS), Piece.SNARE)
    room.pause()
    room.pause()
    room.stop()
    report = room.report()
    assert report is not None
    counts = report.document["counts"]
    assert isinstance(counts, dict)
    assert counts["hits"] == 0


def test_no_pads_command_while_a_question_is_open(tmp_path: Path) -> None:
    """Every stroke of the session 15 ms early, then two kicks."""
    room, line = room_with(tmp_path)
    room.start(WISH)
    line.says.append(Started(ZERO_NS))
    room.snapshot(ZERO_NS + 1)
    for at_ns, piece in zip(PLAN.score.onset_ns.tolist(), PLAN.score.notes["piece"].tolist(), strict=True):
        line.says.append(Hit(at(at_ns) - 15 * NS_PER_MS, Piece(piece), Zone.HEAD, 90))
    room.snapshot(at(PLAN.end_ns) + 2 * NS_PER_S)
    assert room.room().stage is Stage.RESULT
    assert room.room().question
    kicks(room, line, at(PLAN.end_ns) + 3 * NS_PER_S)
    assert not room.wants_start()


def test_a_pause_that_cannot_be_meant_is_named(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"settings\.toml: pause: snare: expected two pads"):
        room_with(tmp_path, pause="snare")


def test_a_gesture_that_was_learnt_pauses_and_kicks_that_were_switched_off_start_nothing(tmp_path: Path) -> None:
    room, line = room_with(tmp_path)
    room.habits.put(replace(room.habits.now, kicks_start=False))
    kicks(room, line, NS_PER_S)
    assert not room.wants_start()
    room.habits.learn(True)
    strike(room, line, 3 * NS_PER_S, Piece.CRASH_1, Piece.RIDE)
    room.start(WISH)
    line.says.append(Started(4 * NS_PER_S))
    room.snapshot(4 * NS_PER_S + 1)
    strike(room, line, 4 * NS_PER_S + PLAN.passes_start_ns, Piece.KICK)
    strike(room, line, 4 * NS_PER_S + PLAN.passes_start_ns + BAR_NS, Piece.CRASH_1, Piece.RIDE)
    assert room.room().paused
