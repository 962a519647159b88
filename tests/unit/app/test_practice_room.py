"""The room behind the window when the engine fails: nothing that was played is lost, and a new engine is woken."""

import json
from collections.abc import Callable
from datetime import datetime
from pathlib import Path

import pytest

from station.app.calibration import MeasuringProcess, Running
from station.app.first_start import FirstAnswers
from station.app.latency_methods import MeasureRequest
from station.app.model import FreeRequest, SessionRequest, Stage
from station.app.practice_room import LIVELY_NS, PracticeRoom
from station.app.processes import Processes
from station.core.errors import DeviceError
from station.core.events import DeviceFound, Hit
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import (
    Bus,
    CaptureSaved,
    Command,
    EngineEvent,
    KeyHit,
    Play,
    RecordCapture,
    SetBacking,
    SetLevel,
    Started,
)
from station.motion.sticking.hand_notes import Hands
from station.practice.demonstration.compare_by_ear import Whose
from station.practice.headless.virtual_session import practise_virtually
from station.practice.records.session_files import CAPTURE_NAME, session_folder
from station.practice.session.backing_track import BackingRequest
from station.practice.session.plan import PlanOptions, plan_practice
from station.simulation.student_spec import parse_spec

TARGET_BPM = find_lesson("rock-1").target_tempo_bpm
PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))
WISH = SessionRequest("rock-1", 80.0, 1, demonstrations=0)


class Line:
    """The other end of an engine: says what it was given to say; dead, it refuses as the process does."""

    def __init__(self) -> None:
        self.says: list[EngineEvent] = []
        self.heard: list[Command] = []
        self.dead = False

    def send(self, command: Command) -> None:
        self._live()
        self.heard.append(command)
        if isinstance(command, RecordCapture):
            self.says.append(CaptureSaved(command.path))

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        del wait_s
        self._live()
        said, self.says = self.says, []
        return said

    def close(self) -> None:
        self.dead = True

    def _live(self) -> None:
        if self.dead:
            raise DeviceError("the engine has ended")


def room_on(
    lines: list[Line], sessions: Path, measure: Callable[[MeasureRequest], Running] = MeasuringProcess
) -> PracticeRoom:
    waiting = iter(lines)
    return PracticeRoom(Processes(lambda: next(waiting), measure), Settings(sessions=str(sessions)), PLAN)


def downbeat(offset_ns: int = 0) -> Hit:
    return Hit(NS_PER_S + PLAN.passes_start_ns + offset_ns, Piece.KICK, Zone.HEAD, 90)


def test_hits_on_their_way_when_the_session_is_stopped_are_judged(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    room.start(WISH)
    line.says.append(Started(NS_PER_S))
    room.snapshot(NS_PER_S + PLAN.passes_start_ns + 10)
    line.says.append(downbeat())
    room.stop()
    report = room.report()
    assert report is not None
    counts = report.document["counts"]
    assert isinstance(counts, dict)
    assert counts["hits"] == 1


def test_a_stroke_while_the_frame_is_drawn_is_in_its_picture(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    assert room.news(0) is None, "nobody plays"
    room.start(WISH)
    line.says += [Started(0)]
    room.snapshot(1)
    assert room.news(2) is None
    line.says += [downbeat()]
    at_ns = downbeat().at_ns + 1
    news = room.news(at_ns)
    assert news is not None
    assert [strike.piece for strike in news.strikes] == [downbeat().piece]
    assert room.news(at_ns) is None, "it is told once"


def test_a_window_spares_no_frame_while_a_kit_is_played(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    room.snapshot(0)
    assert not room.is_lively(0)
    line.says += [downbeat()]
    struck_ns = downbeat().at_ns
    room.snapshot(struck_ns + 100)
    assert room.is_lively(struck_ns + LIVELY_NS - 1)
    assert not room.is_lively(struck_ns + LIVELY_NS)
    room.start(WISH)
    assert room.is_lively(struck_ns + LIVELY_NS)


def test_an_engine_that_dies_costs_no_hit_and_the_next_start_wakes_another(tmp_path: Path) -> None:
    first, second = Line(), Line()
    room = room_on([first, second], tmp_path)
    room.start(WISH)
    first.says += [Started(NS_PER_S), downbeat()]
    room.snapshot(NS_PER_S + PLAN.passes_start_ns + 10)
    first.dead = True
    room.snapshot(NS_PER_S + PLAN.passes_start_ns + 20)
    assert room.room().stage is Stage.RESULT
    assert any("ended" in notice for notice in room.room().notices)
    assert len(list(tmp_path.rglob("report.json"))) == 1
    room.dismiss()
    room.start(WISH)
    assert any(isinstance(command, RecordCapture) for command in second.heard)


def test_a_session_that_cannot_begin_leaves_no_folder(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    line.dead = True
    with pytest.raises(DeviceError):
        room.start(WISH)
    assert not list(tmp_path.rglob("*_rock-1"))


def test_keys_to_a_dead_engine_are_harmless(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    line.dead = True
    room.key(KeyHit(0, Piece.SNARE, Zone.HEAD, 90))
    assert line.heard == []


def test_where_the_tempo_follows_the_student_the_next_pass_begins_by_itself(tmp_path: Path) -> None:
    """Silence on both: the second pass is the first once more, and then nobody is there."""
    line = Line()
    room = room_on([line], tmp_path)
    room.start(SessionRequest("rock-1", 80.0, 5, demonstrations=0, adapt=True))
    now_ns = 0
    for _ in range(2):
        line.says.append(Started(now_ns))
        room.snapshot(now_ns + 1)
        assert room.room().stage is Stage.PLAYING
        now_ns += 60 * NS_PER_S
        room.snapshot(now_ns)
    assert [type(command) for command in line.heard].count(Play) == 2
    assert room.room().stage is Stage.RESULT
    report = room.report()
    assert report is not None
    mastery = report.document["mastery"]
    assert isinstance(mastery, dict)
    assert [one["tempo_bpm"] for one in mastery["passes"]] == [pytest.approx(0.7 * TARGET_BPM)] * 2
    assert len(list(tmp_path.glob("*/mastery/rock-1_*.json"))) == 1
    assert report.facts.words.subtitle.endswith(" · Not yet shown in a blind pass.")


def test_a_change_may_be_refused_while_the_next_pass_is_counted_in(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    room.start(SessionRequest("rock-1", 80.0, 5, demonstrations=0, adapt=True))
    line.says.append(Started(0))
    room.snapshot(1)
    assert not room.room().can_veto
    line.says.append(Hit(3 * NS_PER_S, Piece.KICK, Zone.HEAD, 90))
    room.snapshot(60 * NS_PER_S)
    line.says.append(Started(60 * NS_PER_S))
    room.snapshot(60 * NS_PER_S + 1)
    assert room.room().can_veto
    assert "down to" in room.room().why
    room.veto()
    assert room.room().why == "As you wish: all stays as it was."


def test_a_pass_that_was_refused_when_the_engine_had_ended_is_none(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    room.start(SessionRequest("rock-1", 80.0, 5, demonstrations=0, adapt=True))
    line.says += [Started(0), Hit(3 * NS_PER_S, Piece.KICK, Zone.HEAD, 90)]
    room.snapshot(60 * NS_PER_S)
    line.says.append(Started(60 * NS_PER_S))
    room.snapshot(60 * NS_PER_S + 1)
    line.dead = True
    room.veto()
    (kept,) = tmp_path.glob("*/*_rock-1/report.json")
    assert len(json.loads(kept.read_text("utf-8"))["mastery"]["passes"]) == 1


def played_early(room: PracticeRoom, line: Line, from_ns: int) -> None:
    """A whole session of rock 1, every stroke 15 ms early."""
    room.start(WISH)
    zero_ns = from_ns + PLAN.passes_start_ns
    line.says.append(Started(from_ns))
    room.snapshot(from_ns + 1)
    for at_ns, piece in zip(PLAN.score.onset_ns.tolist(), PLAN.score.notes["piece"].tolist(), strict=True):
        line.says.append(Hit(zero_ns + at_ns - 15 * NS_PER_MS, Piece(piece), Zone.HEAD, 90))
    room.snapshot(from_ns + PLAN.end_ns + 2 * NS_PER_S)
    assert room.room().stage is Stage.RESULT


def test_the_student_is_asked_before_the_result_and_answers_with_a_pad(tmp_path: Path) -> None:
    """24 strokes to a click: once a lesson."""
    line = Line()
    room = room_on([line], tmp_path)
    played_early(room, line, NS_PER_S)
    assert "did you rush" in room.room().question
    assert room.report() is None
    line.says.append(Hit(90 * NS_PER_S, Piece.HIHAT, Zone.BOW, 90))
    room.snapshot(90 * NS_PER_S)
    assert room.room().question == ""
    assert room.report() is not None
    assert room.room().notices[-1] == "You said rushed, and you were 15 ms early on average: your ear is right."
    room.dismiss()
    played_early(room, line, 100 * NS_PER_S)
    assert room.room().question == ""
    assert room.report() is not None


def test_who_does_not_want_to_be_asked_is_not(tmp_path: Path) -> None:
    line = Line()
    room = PracticeRoom(Processes(lambda: line), Settings(sessions=str(tmp_path), ask_first=False), PLAN)
    played_early(room, line, NS_PER_S)
    assert room.room().question == ""
    assert room.report() is not None


def test_a_question_may_be_left_open(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    played_early(room, line, NS_PER_S)
    room.dismiss()
    assert (room.room().stage, room.room().question) == (Stage.IDLE, "")


def test_a_free_take_is_kept_with_its_capture_and_judges_nothing(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    room.preview(None)
    room.just_play(FreeRequest(100.0))
    assert room.room().stage is Stage.PLAYING
    line.says.append(Started(NS_PER_S))
    room.snapshot(NS_PER_S + 1)
    line.says.append(Hit(2 * NS_PER_S, Piece.SNARE, Zone.HEAD, 90))
    picture = room.snapshot(2 * NS_PER_S + 1)
    assert picture.strip is not None
    assert picture.strip.played.hits["at_ns"].tolist() == [NS_PER_S]
    assert [strike.piece for strike in picture.strikes] == [Piece.SNARE]
    assert picture.hud.judged == 0
    room.stop()
    assert (room.room().stage, room.report()) == (Stage.IDLE, None)
    assert room.room().take is not None
    assert len(list(tmp_path.glob("*/*_just-play/take.json"))) == 1
    assert [command.path.name for command in line.heard if isinstance(command, RecordCapture) and command.path] == [
        "session.capture"
    ]


def test_strokes_light_the_kit_before_a_take_and_are_not_kept(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    room.preview(None)
    line.says.append(Hit(NS_PER_S, Piece.RIDE, Zone.BOW, 90))
    picture = room.snapshot(NS_PER_S)
    assert [strike.piece for strike in picture.strikes] == [Piece.RIDE]
    assert picture.strip is not None
    assert len(picture.strip.played) == 0


def test_an_engine_that_dies_in_a_take_loses_none_of_it(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    room.just_play(FreeRequest(100.0))
    line.says += [Started(NS_PER_S), Hit(2 * NS_PER_S, Piece.SNARE, Zone.HEAD, 90)]
    room.snapshot(2 * NS_PER_S + 1)
    line.dead = True
    room.snapshot(3 * NS_PER_S)
    assert room.room().stage is Stage.IDLE
    assert room.room().take is not None
    assert len(list(tmp_path.glob("*/*_just-play/take.json"))) == 1


def test_whoever_was_met_is_kept_through_a_new_engine(tmp_path: Path) -> None:
    first, second = Line(), Line()
    room = room_on([first, second], tmp_path)
    room.meet(FirstAnswers("Ann", module_sounds=True, hands=Hands.LEFT))
    assert first.heard == [SetLevel(Bus.STUDENT, 0.0)]
    room.preview(WISH)
    assert room.snapshot(0).kit.left_handed
    first.dead = True
    room.snapshot(1)
    room.start(WISH)
    assert second.heard[0] == SetLevel(Bus.STUDENT, 0.0), "the new engine keeps silent too"
    room.close()
    assert list((tmp_path / "Ann").rglob("*.json")), "her sessions are hers"


def test_a_free_take_has_no_track_of_a_lesson(tmp_path: Path) -> None:
    """A track sounds whenever the transport runs, so it is taken away first."""
    line = Line()
    wish = BackingRequest(tmp_path / "song.mp3")
    room = PracticeRoom(Processes(lambda: line), Settings(sessions=str(tmp_path)), PLAN, backing=wish)
    room.just_play(FreeRequest(100.0))
    line.says += [Started(NS_PER_S), Hit(2 * NS_PER_S, Piece.SNARE, Zone.HEAD, 90)]
    room.snapshot(2 * NS_PER_S + 1)
    room.stop()
    before_play = [
        line.heard[i - 1] for i, command in enumerate(line.heard) if isinstance(command, RecordCapture | Play)
    ]
    assert isinstance(before_play[0], SetBacking)
    assert before_play[0].track is None


def test_a_bar_is_heard_and_ends_by_itself(tmp_path: Path) -> None:
    line = Line()
    room = PracticeRoom(Processes(lambda: line), Settings(sessions=str(tmp_path), ask_first=False), PLAN)
    played_early(room, line, NS_PER_S)
    for whose in Whose:
        room.hear_bar(1, whose)
        assert isinstance(line.heard[-1], Play)
        assert room.room().listening
    line.says.append(Started(100 * NS_PER_S))
    room.snapshot(100 * NS_PER_S + 1)
    room.snapshot(160 * NS_PER_S)
    assert not room.room().listening, "it ends by itself"


def test_an_end_that_a_key_finds_is_told_and_the_session_is_kept(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    room.start(WISH)
    line.says += [DeviceFound(0, "TD-17"), Started(NS_PER_S)]
    room.snapshot(NS_PER_S + PLAN.passes_start_ns + 10)
    assert room.room().kit == "TD-17"
    line.dead = True
    room.key(KeyHit(0, Piece.SNARE, Zone.HEAD, 90))
    room.snapshot(NS_PER_S + PLAN.passes_start_ns + 20)
    assert room.room().stage is Stage.RESULT
    assert any("ended" in notice for notice in room.room().notices)
    assert room.room().kit == ""


def test_what_is_played_in_a_session_is_never_learnt_as_a_gesture(tmp_path: Path) -> None:
    line = Line()
    room = room_on([line], tmp_path)
    before = room.habits.now
    room.habits.learn(on=True)
    room.start(WISH)
    at_ns = NS_PER_S + PLAN.passes_start_ns
    line.says += [Started(NS_PER_S), downbeat(), Hit(at_ns, Piece.CRASH_1, Zone.EDGE, 90)]
    room.snapshot(at_ns + 10)
    assert room.habits.now == before
    assert not room.habits.learns


def test_a_session_that_was_cut_off_is_told_of_when_the_window_opens(tmp_path: Path) -> None:
    assert room_on([Line()], tmp_path).room().notices == ()
    folder = session_folder(tmp_path, Settings().student, "rock-1", datetime(2026, 3, 1, 10))
    practise_virtually(PLAN, parse_spec("pro"), folder / CAPTURE_NAME)
    (told,) = room_on([Line()], tmp_path).room().notices
    assert told.startswith("a session was cut off before it was judged: 2026-03-01T10-00-00_rock-1; station practice")
