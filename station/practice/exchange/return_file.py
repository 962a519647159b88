"""Returns: what a student practised of an assignment, as one file that ends in `.drum-return`.

Its table (`parcel`) holds `id`, `assignment` (`id`, `revision`, `title`, `group`), `student`, `made`, `words` (what the
student says of it), `left_out` (sessions for which there was no room) and `sessions`, each with `lesson`, `played` (by
the student's clock), `seconds`. Session 1 has the members `sessions/1/session.capture`, `report.json`, `pairs.csv` and
`lesson.toml`, the text that was practised.

Reading one judges nothing: what a report says is a student's word until `return_judging` has heard the capture.
"""

from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Any

from station.core.toml.schema import Field, Fields, Reader, list_of, needed, number, record, whole
from station.practice.exchange.assignment_file import MOST_REVISIONS, Assignment
from station.practice.exchange.lesson_member import lesson_text, lesson_title
from station.practice.exchange.parcel import Kind, Parcel, packed, parse_parcel, read_parcel
from station.practice.exchange.parcel_json import MOST_JSON_BYTES
from station.practice.exchange.plain_words import identity, line, line_or_none, moment, moment_text, played_at, words
from station.practice.exchange.session_figures import LONGEST_S, SessionFigures, report_figures
from station.practice.history.session_files import CAPTURE_NAME, DOCUMENT_NAME, PAIRS_NAME

LESSON_NAME = "lesson.toml"
MOST_SESSIONS = 40
"""Our choice: six a day for a week; the newest are sent."""
MOST_CAPTURE_BYTES = 24 << 20
"""Of one session (our choice: an hour of strokes is 1 MiB, twenty minutes of sensors on both sticks are these)."""
MOST_REPORTS_BYTES = 2 << 20
"""Of the reports of all sessions (our choice: half an hour of practice in each of forty, read within a second)."""
MOST_PAIRS_BYTES = 4 << 20
"""Of a table with a line a stroke (our choice: forty thousand strokes)."""


@dataclass(frozen=True, slots=True)
class AssignmentWord:
    """Which assignment is answered, as the student has it."""

    id: str
    revision: int
    title: str
    group: str = ""

    @classmethod
    def of(cls, assignment: Assignment) -> "AssignmentWord":
        """That of `assignment`."""
        return cls(assignment.id, assignment.revision, assignment.title, assignment.group)

    @property
    def shelf(self) -> str:
        """Under what a teacher keeps its returns: the class, or the title."""
        return self.group or self.title


@dataclass(frozen=True, slots=True, eq=False)
class ReturnedSession:
    """A session as it was sent: `lesson` as the assignment calls it, `played` by the student's clock (naive).

    `figures` are what its report says, with how long it took.
    """

    lesson: str
    played: datetime
    figures: SessionFigures
    lesson_text: str
    capture: bytes
    report: bytes
    pairs: bytes

    @property
    def seconds(self) -> float:
        """How long it took, by the student's word."""
        return self.figures.seconds


@dataclass(frozen=True, slots=True, eq=False)
class Return:
    """What a student sends; `made` is aware, `left_out` says how many sessions there was no room for."""

    id: str
    assignment: AssignmentWord
    student: str
    made: datetime
    sessions: tuple[ReturnedSession, ...]
    words: str = ""
    left_out: int = 0

    def of_lesson(self, lesson: str) -> tuple[ReturnedSession, ...]:
        """The sessions of that lesson of the assignment."""
        return tuple(one for one in self.sessions if one.lesson == lesson)


# --- writing ----------------------------------------------------------------------------------------------------------


def return_bytes(sent: Return) -> bytes:
    """The file; raises `BadInput` where it could not be read again."""
    members: dict[str, bytes] = {}
    for number_, one in enumerate(sent.sessions, 1):
        members |= {f"sessions/{number_}/{name}": data for name, data in _files(one).items()}
    data = packed(Kind.RETURN, _table(sent), readme_text(sent), members)
    parse_return(data, "return")
    return data


def _files(session: ReturnedSession) -> dict[str, bytes]:
    return {
        CAPTURE_NAME: session.capture,
        DOCUMENT_NAME: session.report,
        PAIRS_NAME: session.pairs,
        LESSON_NAME: session.lesson_text.encode(),
    }


def size_of(session: ReturnedSession) -> int:
    """How many bytes it takes in the file, before they are packed."""
    return sum(map(len, _files(session).values()))


def _table(sent: Return) -> dict[str, object]:
    asked = sent.assignment
    return {
        "id": sent.id,
        "assignment": {"id": asked.id, "revision": asked.revision, "title": asked.title, "group": asked.group},
        "student": sent.student,
        "made": moment_text(sent.made),
        "words": sent.words,
        "left_out": sent.left_out,
        "sessions": [
            {"lesson": one.lesson, "played": f"{one.played:%Y-%m-%dT%H:%M:%S}", "seconds": round(one.seconds, 1)}
            for one in sent.sessions
        ],
    }


def session_words(figures: SessionFigures) -> str:
    """A session's figures in a few words."""
    score = "no score" if figures.score is None else f"score {figures.score:.0f}"
    early = "" if figures.complete else ", stopped early"
    return f"{figures.beats_a_minute:g} bpm, {score}, {figures.right} of {figures.notes} right, {figures.level}{early}"


def readme_text(sent: Return) -> str:
    """The return for people who open the file without a station."""
    said = f"\n{sent.words}\n" if sent.words else ""
    rows = [
        f"{number_}. {one.lesson}, {one.played:%Y-%m-%d %H:%M}: {session_words(one.figures)}"
        for number_, one in enumerate(sent.sessions, 1)
    ]
    left = f"\nLeft out for lack of room: {sent.left_out}\n" if sent.left_out else ""
    return f"{sent.assignment.title}\n{sent.student}\n{said}\n" + "\n".join(rows) + f"\n{left}"


# --- reading ----------------------------------------------------------------------------------------------------------


def read_return(path: Path) -> Return:
    """The return in the file at `path`; raises `BadInput`."""
    return _return(read_parcel(path, Kind.RETURN))


def parse_return(data: bytes, source: str) -> Return:
    """The return in `data`; raises `BadInput` of `source`."""
    return _return(parse_parcel(data, source, Kind.RETURN))


def _return(parcel: Parcel) -> Return:
    said = parcel.meaning(_RETURN)
    count = len(said["sessions"])
    if not 1 <= count <= MOST_SESSIONS:
        raise parcel.fault("sessions", f"expected 1 to {MOST_SESSIONS}, found {count}")
    beyond = next((name for name in parcel.members if name.startswith("sessions/") and _number_of(name) > count), None)
    if beyond is not None:
        raise parcel.fault(beyond, "belongs to no session of the table")
    if sum(len(data) for name, data in parcel.members.items() if name.endswith(DOCUMENT_NAME)) > MOST_REPORTS_BYTES:
        raise parcel.fault("sessions", f"reports of more than {MOST_REPORTS_BYTES >> 20} MiB together")
    sessions = tuple(_session(parcel, number_, one) for number_, one in enumerate(said["sessions"], 1))
    return Return(**{**said, "sessions": sessions})


def _number_of(member: str) -> int:
    return int(member.split("/")[1])


def _session(parcel: Parcel, number_: int, said: dict[str, Any]) -> ReturnedSession:
    folder = f"sessions/{number_}/"
    report = _member(parcel, folder + DOCUMENT_NAME, MOST_JSON_BYTES)
    figures = report_figures(report, parcel.source, folder + DOCUMENT_NAME)
    return ReturnedSession(
        lesson=said["lesson"],
        played=said["played"],
        figures=replace(figures, seconds=said["seconds"]),
        lesson_text=lesson_text(parcel, folder + LESSON_NAME),
        capture=_member(parcel, folder + CAPTURE_NAME, MOST_CAPTURE_BYTES),
        report=report,
        pairs=_member(parcel, folder + PAIRS_NAME, MOST_PAIRS_BYTES),
    )


def _member(parcel: Parcel, name: str, most_bytes: int) -> bytes:
    data = parcel.members.get(name)
    if data is None:
        raise parcel.fault(name, "is missing")
    if len(data) > most_bytes:
        raise parcel.fault(name, f"is longer than {most_bytes} bytes")
    return data


_ASSIGNMENT: Fields = {
    "id": needed(identity),
    "revision": needed(whole(1, MOST_REVISIONS)),
    "title": needed(line),
    "group": Field(line_or_none, ""),
}
_SESSION: Reader[dict[str, Any]] = record(
    dict,
    {"lesson": needed(lesson_title), "played": needed(played_at), "seconds": Field(number(0, LONGEST_S), 0.0)},
)
_RETURN: Reader[dict[str, Any]] = record(
    dict,
    {
        "id": needed(identity),
        "assignment": needed(record(AssignmentWord, _ASSIGNMENT)),
        "student": needed(line),
        "made": needed(moment),
        "words": Field(words, ""),
        "left_out": Field(whole(0, 1_000_000), 0),
        "sessions": needed(list_of(_SESSION, "a list of sessions")),
    },
)
