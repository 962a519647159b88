"""The teacher's page behind the window: what came, a take opened, what is judged otherwise, notes and assignments.

The folders are read beside what goes on by an executor, takes are judged in processes with limits. What is said and
overruled is kept for each return until its note is written.
"""

import uuid
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, Future
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import assert_never

from station.app.actions.teacher_actions import (
    Give,
    JudgeReturns,
    NewAssignment,
    OpenTake,
    Overrule,
    SayToStudent,
    TeacherAction,
    WriteNote,
)
from station.app.sessions.shown_result import SavedSession
from station.app.settings.settings_store import SettingsStore
from station.app.teacher_desk.judge_worker import LimitedWork
from station.app.teacher_desk.open_take import OpenedTake, opened_take
from station.app.teacher_desk.parcel_out import parcel_path
from station.app.teacher_desk.returns_desk import LessonRow, Looked, ReturnsDesk, SessionKey, looked
from station.app.worker_process import StartWork, WorkerProcess
from station.core.disk.file_names import folder_name
from station.core.disk.files import write_whole
from station.core.errors import BadInput, StationError
from station.drills.lesson import Lesson
from station.practice.exchange.assignment_file import AssignedLesson, Assignment
from station.practice.exchange.lesson_goals import LessonGoals
from station.practice.exchange.note_file import Note, SessionVerdict
from station.practice.exchange.parcel import Kind
from station.practice.exchange.parcel_json import meaning
from station.practice.exchange.plain_words import due_day
from station.practice.exchange.teacher_store import Received, keep_given, keep_note_on, teacher_of


@dataclass(frozen=True, slots=True, eq=False)
class Answer:
    """What will stand in the note on a return: the teacher's `words`, what is `next`, and verdicts by session."""

    words: str = ""
    next: str = ""
    verdicts: Mapping[int, SessionVerdict] = field(default_factory=dict)
    is_written: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class TeacherView:
    """What the page shows: what came in `rows`, the take that is `opened` (`key`), `answers` by the returns' stems.

    `reads` while the folders are read, `judging` sessions are still to be judged, `opening` is the one that is being
    opened; `told` what was done last.
    """

    rows: tuple[LessonRow, ...] = ()
    given: tuple[Assignment, ...] = ()
    answers: Mapping[str, Answer] = field(default_factory=dict)
    key: SessionKey | None = None
    opened: OpenedTake | None = None
    opening: SessionKey | None = None
    judging: int = 0
    reads: bool = False
    told: str = ""


class TeacherPage:
    """The page of whoever the settings of `store` name; `show` shows a take, `lesson_of` finds a lesson by its name."""

    def __init__(
        self,
        store: SettingsStore,
        show: Callable[[SavedSession], None],
        lesson_of: Callable[[str], Lesson],
        start: StartWork = WorkerProcess,
        reader: Executor | None = None,
    ) -> None:
        self._store, self._show, self._lesson_of, self._start, self._reader = store, show, lesson_of, start, reader
        self._desk = ReturnsDesk(store, start)
        self._looking: Future[Looked] | None = None
        self._is_stale = True
        self._answers: dict[str, Answer] = {}
        self._opening: tuple[SessionKey, LimitedWork[OpenedTake]] | None = None
        self._opened: tuple[SessionKey, OpenedTake] | None = None
        self._told = ""
        self._written: set[Path] = set()
        self._view: TeacherView | None = None

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def look_again(self) -> None:
        """Something came: read the folders when the page is seen."""
        self._is_stale = True

    def advance(self) -> None:
        """Move on; raises `StationError` for a take that cannot be opened."""
        self._view = None
        self._look()
        self._desk.advance()
        if self._opening is not None:
            self._collect(*self._opening)

    def _look(self) -> None:
        if self._looking is None and self._is_stale:
            self._is_stale = False
            if self._reader is None:
                self._desk.take(looked(self._store.now))
            else:
                self._looking = self._reader.submit(looked, self._store.now)
        if self._looking is not None and self._looking.done():
            looking, self._looking = self._looking, None
            self._desk.take(looking.result())

    def _collect(self, key: SessionKey, work: LimitedWork[OpenedTake]) -> None:
        try:
            found = work.result()
        except StationError as fault:
            self._desk.know(key, str(fault))
            self._end_opening()
            raise
        if found is not None:
            self._end_opening()
            self._desk.know(key, found.heard)
            self._opened = key, found
            self._show(found.saved)

    def _end_opening(self) -> None:
        if self._opening is not None:
            self._opening[1].end()
            self._opening = None

    def view(self) -> TeacherView:
        """What is shown."""
        if self._view is None:
            self._view = self._seen()
        return self._view

    def _seen(self) -> TeacherView:
        key, opened = self._opened or (None, None)
        return TeacherView(
            rows=tuple(self._desk.rows()),
            given=self._desk.now.given,
            answers={stem: self._answer(stem) for stem in self._desk.now.received},
            key=key,
            opened=opened,
            opening=None if self._opening is None else self._opening[0],
            judging=self._desk.waiting,
            reads=self._looking is not None or self._is_stale,
            told=self._told or "\n".join(map(str, self._desk.now.faults)),
        )

    # --- what the teacher does ---------------------------------------------------------------------------------------

    def act(self, action: TeacherAction) -> None:
        """Do what the teacher asks; raises `StationError`."""
        self._view = None
        match action:
            case OpenTake(stem, number):
                self._open(stem, number)
            case JudgeReturns():
                self._desk.judge(each.key for row in self._desk.rows() for each in row.sessions)
            case Overrule(stem, verdict):
                answer = self._answer(stem)
                self._answers[stem] = replace(
                    answer, verdicts={**answer.verdicts, verdict.number: verdict}, is_written=False
                )
            case SayToStudent(stem, words, following):
                self._answers[stem] = replace(self._answer(stem), words=words, next=following, is_written=False)
            case WriteNote(stem, out, teacher):
                self._write_note(stem, out, teacher)
            case Give(assignment, out):
                self._give(assignment, out)
            case _:
                assert_never(action)

    def _open(self, stem: str, number: int) -> None:
        received = self._of(stem)
        self._end_opening()
        work = LimitedWork(self._start, opened_take, received.path, number, self._store.now)
        self._opening = (stem, number), work

    def _of(self, stem: str) -> Received:
        one = self._desk.now.received.get(stem)
        if one is None:
            raise BadInput(stem, "", "this return is no longer there")
        return one

    def _answer(self, stem: str) -> Answer:
        """What was said since, else what the note on the return says."""
        if stem in self._answers:
            return self._answers[stem]
        note = self._of(stem).note
        if note is None:
            return Answer()
        return Answer(note.words, note.next, {one.number: one for one in note.sessions}, is_written=True)

    def _write_note(self, stem: str, out: str, teacher: str) -> None:
        one, answer = self._of(stem), self._answer(stem)
        path = self._path(out, Kind.NOTE)
        said = (verdict for _, verdict in sorted(answer.verdicts.items()) if says_something(verdict))
        sent = one.returned
        note = Note(
            id=uuid.uuid4().hex,
            return_id=sent.id,
            assignment_id=sent.assignment.id,
            title=sent.assignment.title,
            teacher=teacher or teacher_of(one, self._store.now),
            student=sent.student,
            made=datetime.now(UTC).replace(microsecond=0),
            words=answer.words,
            next=answer.next,
            sessions=tuple(said),
        )
        self._keep(path, keep_note_on(one, note))
        self._answers[stem] = replace(answer, is_written=True)
        self._told = f"the note to {sent.student} is in {path}: send them that file"
        self._is_stale = True

    def _give(self, new: NewAssignment, out: str) -> None:
        path = self._path(out, Kind.ASSIGNMENT)
        if not new.lessons:
            raise BadInput(new.title or "assignment", "", "has no lesson yet: choose one in the list and add it")
        due = meaning(new.due.strip(), due_day, "assignment", "due") if new.due.strip() else None
        assignment = Assignment(
            id=uuid.uuid4().hex,
            revision=1,
            title=new.title or path.name.removesuffix(Kind.ASSIGNMENT.ending),
            teacher=new.teacher or self._store.now.student,
            made=datetime.now(UTC).replace(microsecond=0),
            lessons=tuple(self._lesson(name, goals) for name, goals in new.lessons),
            group=new.group,
            due=due,
            words=new.words,
        )
        self._keep(path, keep_given(assignment, self._store.now))
        self._told = f"{assignment.title} is in {path}: send your students that file"
        self._is_stale = True

    def _lesson(self, name: str, goals: LessonGoals) -> AssignedLesson:
        lesson = self._lesson_of(name)
        return AssignedLesson(folder_name(lesson.name), lesson.title, lesson.text, goals)

    def _path(self, out: str, kind: Kind) -> Path:
        return parcel_path(out, kind, self._written)

    def _keep(self, path: Path, data: bytes) -> None:
        write_whole(path, data)
        self._written.add(path)

    def close(self) -> None:
        """End what is judged and read; what was not written is dropped."""
        self._desk.close()
        self._end_opening()
        if self._reader is not None:
            self._reader.shutdown(wait=False, cancel_futures=True)


def says_something(verdict: SessionVerdict) -> bool:
    """Whether a verdict has anything to tell the student."""
    return bool(verdict.words or verdict.strokes or verdict.score is not None or verdict.reached is not None)
