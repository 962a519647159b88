"""The exam behind the window: seen when it is looked at, one take that nothing stops or tells of, marks at the end."""

import json
from pathlib import Path

import pytest

from station.app.actions.action import Show
from station.app.actions.editor_actions import NewLesson
from station.app.actions.exam_actions import BeginExam, ChooseExam, DrawPiece, LeaveExam, ReadyForExam
from station.app.actions.practice_actions import Begin, Dismiss, Drill, EndSession, Leave, Pause
from station.app.controller import Controller
from station.app.exam_page import ExamStage, ExamView
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_S
from station.drills.exam.exam_piece import Unseen, reading_piece
from station.drills.library import find_lesson
from station.engine.messages import Play, Started
from station.practice.exam.exam_sitting import Sitting
from station.practice.session.plan import Phase, PlanOptions, plan_practice
from tests.fakes.stations import Line, station_on, store_with

UNSEEN = Unseen(2, 11)
PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))


@pytest.fixture
def line() -> Line:
    return Line()


@pytest.fixture
def station(line: Line, tmp_path: Path) -> Controller:
    station = station_on([line], store_with(tmp_path), Launch(PLAN))
    station.dispatch(Show(exam=True))
    station.update(1)
    station.dispatch(ChooseExam(UNSEEN))
    return station


def view(station: Controller) -> ExamView:
    return station.view().exam


def said(station: Controller) -> str:
    station.update(1)
    return station.view().toast


def kept(sessions: Path) -> list[dict[str, object]]:
    return [json.loads(path.read_text()) for path in sessions.glob("*/*/exam.json")]


def played(line: Line, station: Controller) -> None:
    """Every note of the piece at its time; then it is over."""
    plan = station.parts.sessions.practice.session.plan
    line.says.append(Started(NS_PER_S))
    station.update(NS_PER_S + 1)
    from_ns = NS_PER_S + plan.passes_start_ns
    for note, at_ns in zip(plan.score.notes, plan.score.onset_ns.tolist(), strict=True):
        line.says.append(Hit(from_ns + at_ns, Piece(note["piece"]), Zone(note["zone"]), 90))
    station.update(from_ns + plan.score.length_ns)
    station.update(from_ns + plan.end_ns + 10 * NS_PER_S)


def test_the_rubric_is_shown_before_and_nothing_is_kept(station: Controller, tmp_path: Path) -> None:
    asked = view(station)
    assert asked.stage is ExamStage.ASKED
    assert asked.piece is not None
    assert sum(line.worth for line in asked.piece.rubric.lines) == pytest.approx(100)
    assert asked.piece.lesson.text == reading_piece(UNSEEN).lesson.text
    assert not asked.shows_notes
    assert kept(tmp_path) == []


def test_whoever_begins_to_look_has_seen_it_though_they_leave(station: Controller, tmp_path: Path) -> None:
    station.dispatch(BeginExam())
    assert view(station).stage is ExamStage.LOOKING
    assert view(station).shows_notes
    assert not view(station).seen_before
    (document,) = kept(tmp_path)
    assert (document["unseen"], document["marks"]) == ({"level": 2, "seed": 11}, None)
    station.dispatch(Leave())
    assert view(station).stage is ExamStage.ASKED
    station.dispatch(BeginExam())
    assert view(station).seen_before


def test_the_time_to_look_runs_down_and_the_take_begins(station: Controller, line: Line) -> None:
    station.dispatch(BeginExam())
    station.update(1 + 30 * NS_PER_S)
    assert view(station).left_s == pytest.approx(60)
    assert not any(isinstance(command, Play) for command in line.heard), "nothing is demonstrated"
    station.update(1 + 90 * NS_PER_S)
    assert view(station).stage is ExamStage.PLAYING
    plan = station.parts.sessions.practice.session.plan
    assert [segment.phase for segment in plan.segments] == [Phase.COUNT_IN, Phase.PASS]


def test_strokes_that_try_the_piece_begin_nothing_and_enter_does(station: Controller, line: Line) -> None:
    station.dispatch(BeginExam())
    for n in range(4):
        line.says.append(Hit(2 * NS_PER_S + n * NS_PER_S // 4, Piece.KICK, Zone.HEAD, 90))
        station.update(2 * NS_PER_S + n * NS_PER_S // 4 + 1)
    assert view(station).stage is ExamStage.LOOKING
    station.dispatch(Begin())
    assert view(station).stage is ExamStage.PLAYING


def test_a_whole_take_is_marked_without_a_question_and_no_lesson_is_left_of_it(
    station: Controller, line: Line, tmp_path: Path
) -> None:
    names = [card.name for card in station.view().selection.lessons]
    station.dispatch(BeginExam())
    station.dispatch(ReadyForExam())
    played(line, station)
    marked = view(station)
    assert marked.stage is ExamStage.MARKED
    assert marked.marks is not None
    assert marked.marks.band.name == "distinction"
    assert station.view().room.stage is Stage.RESULT
    assert station.view().room.question == ""
    (document,) = kept(tmp_path)
    assert isinstance(document["marks"], dict)
    assert document["marks"]["total"] == pytest.approx(marked.marks.total, abs=1e-3)
    station.dispatch(Dismiss())
    station.update(10**12)
    assert view(station).marks is not None, "they can still be read"
    assert station.view().player.lesson.name == "rock-1"
    assert [card.name for card in station.view().selection.lessons] == names
    station.dispatch(LeaveExam())
    assert view(station).stage is ExamStage.ASKED


def test_nothing_pauses_it_nothing_shows_and_the_drummer_sits_still(station: Controller, line: Line) -> None:
    station.dispatch(BeginExam())
    station.dispatch(ReadyForExam())
    plan = station.parts.sessions.practice.session.plan
    line.says.append(Started(NS_PER_S))
    station.update(NS_PER_S + 1)
    from_ns = NS_PER_S + plan.passes_start_ns
    line.says.append(Hit(from_ns, Piece.SNARE, Zone.HEAD, 90))
    station.update(from_ns + NS_PER_S)
    station.dispatch(Pause())
    room, snapshot = station.view().room, station.view().snapshot
    assert not room.paused
    assert not room.can_pause
    assert room.exam
    assert snapshot is not None
    assert (snapshot.double, snapshot.hud.judged, snapshot.extras) == (None, 0, ())
    assert snapshot.marks is not None
    assert (snapshot.marks["label"] < 0).all()
    station.dispatch(Show(exam=True, curves=True))
    assert station.view().curves is None


def test_what_is_played_after_the_marks_takes_their_place(station: Controller, line: Line) -> None:
    station.dispatch(BeginExam())
    station.dispatch(ReadyForExam())
    station.dispatch(EndSession())
    station.update(2)
    station.dispatch(Dismiss())
    station.update(3)
    station.dispatch(Begin())
    station.update(4)
    assert view(station).stage is ExamStage.ASKED
    assert not station.view().room.exam


def test_an_exam_begins_from_a_result(station: Controller) -> None:
    station.dispatch(Begin())
    station.dispatch(EndSession())
    station.update(2)
    assert station.view().room.stage is Stage.RESULT
    station.dispatch(BeginExam())
    assert view(station).stage is ExamStage.LOOKING
    assert station.view().room.stage is Stage.IDLE


def test_who_stops_in_the_count_in_has_no_marks_but_an_exam(station: Controller, tmp_path: Path) -> None:
    station.dispatch(BeginExam())
    station.dispatch(ReadyForExam())
    station.dispatch(EndSession())
    station.update(2)
    assert view(station).marks is not None
    assert view(station).marks.total == 0  # type: ignore[union-attr]
    assert len(kept(tmp_path)) == 1


def test_once_more_and_a_bar_alone_are_no_exam(station: Controller, line: Line) -> None:
    station.dispatch(BeginExam())
    station.dispatch(ReadyForExam())
    played(line, station)
    for action in (Begin(), Drill(1)):
        station.dispatch(action)
        assert station.view().room.stage is Stage.RESULT
        assert "one take" in said(station)


def test_a_dead_engine_ends_it_and_what_was_played_is_marked(station: Controller, line: Line) -> None:
    station.dispatch(BeginExam())
    station.dispatch(ReadyForExam())
    line.says.append(Started(NS_PER_S))
    station.update(NS_PER_S + 1)
    line.dead = True
    station.update(2 * NS_PER_S)
    station.update(2 * NS_PER_S + 1)
    assert view(station).stage is ExamStage.MARKED


def test_the_chosen_lesson_is_played_at_once_at_its_goal(station: Controller) -> None:
    station.dispatch(ChooseExam(None))
    asked = view(station).piece
    assert asked is not None
    assert (asked.lesson.name, asked.preview_s) == ("rock-1", 0)
    station.dispatch(BeginExam())
    assert view(station).stage is ExamStage.PLAYING
    assert not view(station).shows_notes, "the score moves as in practice"
    session = station.parts.sessions.practice.session
    assert session.plan.lesson.name == "rock-1"
    assert isinstance(session.sitting, Sitting)


def test_another_piece_is_of_the_same_level(station: Controller) -> None:
    station.dispatch(DrawPiece())
    drawn = view(station).unseen
    assert drawn is not None
    assert drawn.level == 2
    assert 1 <= drawn.seed < 1_000_000


def test_what_cannot_be_is_said_in_a_line(station: Controller) -> None:
    station.dispatch(ChooseExam(Unseen(9, 1)))
    assert view(station).piece is None
    assert "1 to 5" in view(station).fault
    station.dispatch(BeginExam())
    assert "1 to 5" in said(station)
    station.dispatch(ChooseExam(UNSEEN))
    station.dispatch(NewLesson())
    station.dispatch(BeginExam())
    assert "close the editor" in said(station)
    assert view(station).stage is ExamStage.ASKED


def test_the_editor_ends_the_look(station: Controller) -> None:
    station.dispatch(BeginExam())
    station.dispatch(NewLesson())
    assert not view(station).shows_notes
    assert station.view().editor is not None


def test_every_note_that_is_marked_is_on_the_page_with_the_hands_of_the_student(tmp_path: Path) -> None:
    station = station_on([Line()], store_with(tmp_path, hands="left"), Launch(PLAN))
    for level in range(1, 6):
        station.dispatch(ChooseExam(Unseen(level, 3)))
        station.dispatch(BeginExam())
        station.update(1)
        notes, written = view(station).notes, reading_piece(Unseen(level, 3)).lesson.score
        assert notes is not None
        assert len(notes) == len(written), "no landing that nobody was shown"
        hand = written.notes["limb"].tolist()[0]
        assert notes.notes["limb"].tolist()[0] == {0: 1, 1: 0, 2: 3, 3: 2}[hand]
        station.dispatch(LeaveExam())
