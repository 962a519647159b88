"""The teacher's page without the window: a return is opened, heard, overruled and answered; an assignment is given."""

import csv
import io
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest

from station.app.actions.teacher_actions import (
    Give,
    JudgeReturns,
    NewAssignment,
    OpenTake,
    Overrule,
    SayToStudent,
    WriteNote,
)
from station.app.sessions.last_result import LastResult
from station.app.sessions.shown_result import SavedSession
from station.app.teacher_desk import judge_worker
from station.app.teacher_desk.teacher_page import TeacherPage
from station.cli.command_line import main
from station.core.errors import BadInput
from station.drills.library import find_lesson
from station.practice.demonstration.compare_by_ear import Whose
from station.practice.exchange.assignment_file import read_assignment
from station.practice.exchange.lesson_goals import LessonGoals
from station.practice.exchange.note_file import SessionVerdict, StrokeVerdict, read_note
from station.practice.exchange.return_file import Return, return_bytes
from station.practice.exchange.teacher_store import receive
from station.scenes.demonstrator import Demonstrator
from tests.fakes.stations import store_with
from tests.fakes.work_at_once import WorkAtOnce
from tests.parcels_made import TEXT, a_return


@pytest.fixture(scope="module")
def sent(tmp_path_factory: pytest.TempPathFactory) -> Return:
    """A return with a session of a virtual student, and one whose capture is of another lesson."""
    folder = tmp_path_factory.mktemp("take") / "x"
    words = ("practice", "rock-1", "--loops", "1", "--no-demonstration", "--headless", "--no-pictures")
    assert main([*words, "--virtual-student", "beginner,seed=1", "--report", str(folder)]) == 0
    made = a_return(folder)
    return replace(made, sessions=(made.sessions[0], replace(made.sessions[0], lesson_text=TEXT)))


class Desk:
    """A teacher's page that has one return."""

    def __init__(self, sent: Return, folder: Path) -> None:
        store = store_with(folder)
        (folder / "x.drum-return").write_bytes(return_bytes(sent))
        self.received, _ = receive(folder / "x.drum-return", store.now)
        self.shown: list[SavedSession] = []
        self.page = TeacherPage(store, self.shown.append, find_lesson, WorkAtOnce)
        self.page.advance()

    def opened(self, number: int) -> None:
        self.page.act(OpenTake(self.received.stem, number))
        self.page.advance()


@pytest.fixture
def desk(sent: Return, tmp_path: Path) -> Desk:
    return Desk(sent, tmp_path)


def test_a_take_is_opened_as_the_student_played_it_and_its_bars_are_heard(desk: Desk, sent: Return) -> None:
    desk.opened(1)
    (saved,) = desk.shown
    assert saved.report.student == "Zoë"
    assert saved.report.document["score"] == sent.sessions[0].figures.score
    assert desk.page.view().key == (desk.received.stem, 1)
    (row,) = desk.page.view().rows
    assert row.sessions[0].heard is not None, "what was opened was judged"
    last = LastResult()
    last.keep(saved, may_ask=False)
    for whose in (Whose.TEACHER, Whose.STUDENT):
        heard = last.hear(0, whose, Demonstrator())
        assert heard is not None
        seen = last.compared(None)
        assert seen is not None
        assert (seen.double is not None) == (whose is Whose.STUDENT)
        assert seen.hud is not None
        assert (
            seen.hud.phase
            == {Whose.TEACHER: "Replay of bar 1: the teacher", Whose.STUDENT: "Replay of bar 1: Zoë"}[whose]
        )


def test_strokes_are_called_as_the_students_own_table_calls_them(desk: Desk, sent: Return) -> None:
    desk.opened(1)
    opened = desk.page.view().opened
    assert opened is not None
    table = list(csv.DictReader(io.StringIO(sent.sessions[0].pairs.decode())))
    notes = {int(row["note_index"]): (int(row["bar"]), int(row["pass"])) for row in table if row["note_index"]}
    extras = {int(row["hit_index"]) for row in table if row["label"] == "extra"}
    assert {one.note: (one.bar, one.pass_number) for one in opened.strokes if one.note is not None} == notes
    assert {one.hit for one in opened.strokes if one.hit is not None} == extras
    assert sum(one.is_right for one in opened.strokes) == sent.sessions[0].figures.right


def test_a_take_that_cannot_be_judged_is_said_and_nothing_is_shown(desk: Desk) -> None:
    with pytest.raises(BadInput, match="holds no session of rock-1"):
        desk.opened(2)
    assert desk.shown == []
    (row,) = desk.page.view().rows
    assert row.sessions[1].fault is not None
    desk.page.act(JudgeReturns())
    desk.page.advance()
    assert desk.page.view().judging == 0


def test_what_is_overruled_and_said_stands_in_the_note(desk: Desk, tmp_path: Path) -> None:
    stem, out = desk.received.stem, tmp_path / "zoe"
    desk.opened(1)
    verdict = SessionVerdict(1, "rock-1", "softer", 91.0, True, (StrokeVerdict(False, note=3),))
    desk.page.act(Overrule(stem, verdict))
    desk.page.act(Overrule(stem, SessionVerdict(2, "rock-1")))
    desk.page.act(SayToStudent(stem, "Well done.", "the same at 100"))
    assert not desk.page.view().answers[stem].is_written
    desk.page.act(WriteNote(stem, str(out), "Ms Okafor"))
    note = read_note(tmp_path / "zoe.drum-note")
    assert (note.teacher, note.student, note.words, note.next) == ("Ms Okafor", "Zoë", "Well done.", "the same at 100")
    beside = replace(verdict, reported=desk.received.returned.sessions[0].figures.score)
    assert note.sessions == (beside,), "a session of which nothing is said is not there"
    assert desk.page.view().answers[stem].is_written
    desk.page.act(WriteNote(stem, str(out)))
    (tmp_path / "other.drum-note").write_text("somebody's")
    with pytest.raises(BadInput, match="is there already"):
        desk.page.act(WriteNote(stem, str(tmp_path / "other.drum-note")))
    again = TeacherPage(store_with(tmp_path), desk.shown.append, find_lesson, WorkAtOnce)
    again.advance()
    assert again.view().answers[stem].verdicts == {1: beside}, "it is there the next day"


def test_an_assignment_is_made_of_lessons_with_goals_and_a_day(desk: Desk, tmp_path: Path) -> None:
    goals = LessonGoals(tempo_bpm=90.0, words="hands low")
    new = NewAssignment("Week 4", (("rock-1", goals),), "Ms Okafor", "Tuesday", " 2026-12-01 ", "Slowly first.")
    desk.page.act(Give(new, str(tmp_path / "week4")))
    given = read_assignment(tmp_path / "week4.drum-assignment")
    assert (given.title, given.group, given.due, given.words) == (
        "Week 4",
        "Tuesday",
        date(2026, 12, 1),
        "Slowly first.",
    )
    (lesson,) = given.lessons
    assert (lesson.name, lesson.text, lesson.goals) == ("rock-1", find_lesson("rock-1").text, goals)
    desk.page.advance()
    assert [one.title for one in desk.page.view().given] == ["Week 4"]
    with pytest.raises(BadInput, match=r"due: expected a day such as 2026-12-01, found \"soon\""):
        desk.page.act(Give(replace(new, due="soon"), str(tmp_path / "soon")))
    with pytest.raises(BadInput, match="no lesson yet"):
        desk.page.act(Give(replace(new, lessons=()), str(tmp_path / "none")))


class NeverDone(WorkAtOnce):
    """Work that goes on for ever."""

    def result(self) -> None:
        return None


def test_a_take_that_takes_too_long_is_ended(sent: Return, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(judge_worker, "LONGEST_WAIT_S", -1.0)
    desk = Desk(sent, tmp_path)
    desk.page = TeacherPage(store_with(tmp_path), desk.shown.append, find_lesson, NeverDone)
    desk.page.advance()
    with pytest.raises(BadInput, match="s to judge"):
        desk.opened(1)
    assert desk.page.view().opening is None
