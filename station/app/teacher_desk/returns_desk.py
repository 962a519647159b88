"""The returns that a teacher has, per student and lesson, and what the captures in them give where that was asked.

`looked` reads the folder, which takes a moment, `take` has what it found; `judge` asks for sessions to be judged again,
`advance` moves that on, one after the other.
"""

from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from station.app.settings.settings_store import SettingsStore
from station.app.teacher_desk.judge_worker import Heard, LimitedWork, heard
from station.app.worker_process import StartWork, WorkerProcess
from station.core.errors import BadInput, StationError
from station.core.settings import Settings
from station.practice.exchange.assignment_file import Assignment
from station.practice.exchange.lesson_goals import GoalState
from station.practice.exchange.note_file import SessionVerdict
from station.practice.exchange.return_file import ReturnedSession
from station.practice.exchange.teacher_store import Received, given, goals_of, received

SessionKey = tuple[str, int]
"""A session: the stem of its return's file, and its number there, from 1."""


@dataclass(frozen=True, slots=True, eq=False)
class SessionRow:
    """A session that came: what its report says, what its capture gives, or why it gives nothing.

    `heard` and `fault` are None before it was judged again; `verdict` is what the teacher's note says of it, None where
    it says nothing.
    """

    key: SessionKey
    told: ReturnedSession
    verdict: SessionVerdict | None = None
    heard: Heard | None = None
    fault: str | None = None

    @property
    def is_judged(self) -> bool:
        """Whether it was judged again, or cannot be."""
        return self.heard is not None or self.fault is not None


@dataclass(frozen=True, slots=True, eq=False)
class LessonRow:
    """A lesson that a student of a class sent sessions of, with what was asked of it and what is reached of that.

    `stem` names the return, `words` are what the student says of it.
    """

    stem: str
    shelf: str
    student: str
    title: str
    lesson: str
    goals: tuple[GoalState, ...]
    sessions: tuple[SessionRow, ...]
    is_answered: bool
    words: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Looked:
    """What lies in a teacher's folders: returns without what was played, assignments given, what cannot be read."""

    received: Mapping[str, Received] = field(default_factory=dict)
    goals: Mapping[str, Mapping[str, list[GoalState]]] = field(default_factory=dict)
    given: tuple[Assignment, ...] = ()
    faults: tuple[BadInput, ...] = ()


def looked(settings: Settings) -> Looked:
    """What is there now, read from the disk; of a class's year only the figures stay in memory."""
    before = given(settings)
    found, faults = received(settings)
    goals = {one.stem: goals_of(one, before) for one in found}
    return Looked({one.stem: _light(one) for one in found}, goals, tuple(before), tuple(faults))


def _light(one: Received) -> Received:
    sessions = tuple(
        replace(each, lesson_text="", capture=b"", report=b"", pairs=b"") for each in one.returned.sessions
    )
    return Received(one.path, replace(one.returned, sessions=sessions), one.note)


class ReturnsDesk:
    """The returns below the folder that the settings of `store` name; `start` begins the judging."""

    def __init__(self, store: SettingsStore, start: StartWork = WorkerProcess) -> None:
        self._store, self._start = store, start
        self.now = Looked()
        self._heard: dict[SessionKey, Heard | str] = {}
        self._due: deque[SessionKey] = deque()
        self._work: LimitedWork[Heard] | None = None

    def take(self, found: Looked) -> None:
        """From now on this is what is there; what is no longer there is judged no more."""
        self.now = found
        if self._work is None:
            self._due = deque(key for key in self._due if key[0] in found.received)

    def rows(self) -> list[LessonRow]:
        """By class, student and day: every lesson of every return."""
        return [row for one in self.now.received.values() for row in self._rows_of(one)]

    def judge(self, keys: Iterable[SessionKey]) -> None:
        """Have these sessions judged again, each once."""
        self._due += [key for key in keys if key not in self._heard and key not in self._due]

    def know(self, key: SessionKey, found: Heard | str) -> None:
        """A session was judged elsewhere, or why it cannot be."""
        self._heard[key] = found

    @property
    def waiting(self) -> int:
        """How many sessions are still to be judged."""
        return len(self._due)

    def advance(self) -> bool:
        """Move on; whether there is more to judge."""
        if self._work is None and self._due:
            stem, number = self._due[0]
            path = self.now.received[stem].path
            self._work = LimitedWork(self._start, heard, path, number, self._store.now)
        if self._work is not None:
            self._collect(self._work)
        return bool(self._due)

    def close(self) -> None:
        """End what is judged; what waits is dropped."""
        self._due.clear()
        if self._work is not None:
            self._work.end()
            self._work = None

    def _collect(self, work: LimitedWork[Heard]) -> None:
        found: Heard | str | None
        try:
            found = work.result()
        except StationError as fault:
            found = str(fault)
        if found is not None:
            work.end()
            self._work = None
            self.know(self._due.popleft(), found)

    def _rows_of(self, one: Received) -> list[LessonRow]:
        sent, goals = one.returned, self.now.goals[one.stem]
        names = dict.fromkeys(session.lesson for session in sent.sessions)
        return [
            LessonRow(
                one.stem,
                sent.assignment.shelf,
                sent.student,
                sent.assignment.title,
                name,
                tuple(goals.get(name, ())),
                tuple(
                    self._session(one, number) for number, each in enumerate(sent.sessions, 1) if each.lesson == name
                ),
                one.note is not None,
                sent.words,
            )
            for name in names
        ]

    def _session(self, one: Received, number: int) -> SessionRow:
        verdicts = () if one.note is None else one.note.sessions
        verdict = next((each for each in verdicts if each.number == number), None)
        found = self._heard.get((one.stem, number))
        heard_of_it, fault = (None, found) if isinstance(found, str) else (found, None)
        return SessionRow((one.stem, number), one.returned.sessions[number - 1], verdict, heard_of_it, fault)
