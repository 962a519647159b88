"""Notes: what a teacher says to a return, as one file that ends in `.drum-note`.

Its table (`parcel`) holds `id`, `return` (its id), `assignment` (id and title), `teacher`, `student`, `made`, `words`,
`next` (what to do next) and `sessions`: of the return's session `number` (from 1) its `lesson`, the teacher's `words`,
and what they overrule, null where they leave it: `score` 0–100, `reached` (whether the goals are), and `strokes`, each
the index of a `note` or of a `hit` as the session's pairs.csv counts them, whether it `counts`, and `words`.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from datetime import datetime
from pathlib import Path

from station.core.toml.schema import Field, Fields, Reader, flag, list_of, needed, number, record, whole
from station.core.toml.toml_faults import wrong
from station.practice.exchange.lesson_member import lesson_title
from station.practice.exchange.parcel import Kind, Parcel, packed, parse_parcel, read_parcel
from station.practice.exchange.plain_words import identity, line, line_or_none, moment, moment_text, or_none, words
from station.practice.exchange.return_file import MOST_SESSIONS
from station.practice.exchange.session_figures import SessionFigures

_MOST_INDEX = 10_000_000
MOST_STROKES = 2000
"""So many strokes of a session a teacher overrules one by one (our choice: more is a session's score)."""


@dataclass(frozen=True, slots=True)
class StrokeVerdict:
    """A stroke that the teacher judges otherwise: a `note` that was asked for, or a `hit`; whether it `counts`."""

    counts: bool
    note: int | None = None
    hit: int | None = None
    words: str = ""


@dataclass(frozen=True, slots=True)
class SessionVerdict:
    """What the teacher says of the return's session `number`, from 1; None overrules nothing.

    `reported` is the score that the report of the session says, beside which the teacher's own stands.
    """

    number: int
    lesson: str
    words: str = ""
    score: float | None = None
    reached: bool | None = None
    strokes: tuple[StrokeVerdict, ...] = ()
    reported: float | None = None


@dataclass(frozen=True, slots=True)
class Note:
    """A teacher's answer to the return `return_id`; `made` is aware, `next` says what to do next."""

    id: str
    return_id: str
    assignment_id: str
    title: str
    teacher: str
    student: str
    made: datetime
    words: str = ""
    next: str = ""
    sessions: tuple[SessionVerdict, ...] = ()

    @property
    def lines(self) -> tuple[str, ...]:
        """It for a student, a line each."""
        said = [*self.words.split("\n"), *map(verdict_words, self.sessions)]
        return (*filter(None, said), *([f"Next: {' '.join(self.next.split())}"] if self.next else []))


def verdict_words(verdict: SessionVerdict) -> str:
    """What is said of a session, in a line."""
    reached = {True: "goals reached", False: "goals not yet reached", None: ""}[verdict.reached]
    score = "" if verdict.score is None else f"score {verdict.score:g}"
    if verdict.score is not None and verdict.reported is not None:
        score += f" (the report says {verdict.reported:.0f})"
    taken = sum(one.counts for one in verdict.strokes)
    strokes = [
        f"{count} {word}"
        for count, word in ((taken, "accepted"), (len(verdict.strokes) - taken, "not accepted"))
        if count
    ]
    told = ", ".join(filter(None, (reached, score, f"strokes: {' and '.join(strokes)}" if strokes else "")))
    parts = filter(None, (told, verdict.words.replace("\n", " ")))
    return f"{verdict.lesson}, session {verdict.number}: {'; '.join(parts) or 'seen'}"


def overruled(figures: SessionFigures, verdict: SessionVerdict | None) -> SessionFigures:
    """The figures of a session as the teacher who gave `verdict` on it has them."""
    if verdict is None:
        return figures
    score = figures.score if verdict.score is None else verdict.score
    return replace(figures, score=score, ruled=verdict.reached)


# --- writing ----------------------------------------------------------------------------------------------------------


def note_bytes(note: Note) -> bytes:
    """The file; raises `BadInput` where it could not be read again."""
    table = {
        "id": note.id,
        "return": note.return_id,
        "assignment": {"id": note.assignment_id, "title": note.title},
        "teacher": note.teacher,
        "student": note.student,
        "made": moment_text(note.made),
        "words": note.words,
        "next": note.next,
        "sessions": [asdict(one) for one in note.sessions],
    }
    readme = f"{note.title}\n{note.teacher} to {note.student}\n\n" + "\n".join(note.lines) + "\n"
    data = packed(Kind.NOTE, table, readme, {})
    parse_note(data, "note")
    return data


# --- reading ----------------------------------------------------------------------------------------------------------


def read_note(path: Path) -> Note:
    """The note in the file at `path`; raises `BadInput`."""
    return _note(read_parcel(path, Kind.NOTE))


def parse_note(data: bytes, source: str) -> Note:
    """The note in `data`; raises `BadInput` of `source`."""
    return _note(parse_parcel(data, source, Kind.NOTE))


def _note(parcel: Parcel) -> Note:
    note = parcel.meaning(_NOTE)
    numbers = [one.number for one in note.sessions]
    if len(set(numbers)) < len(numbers):
        raise parcel.fault("sessions", "a session is there twice")
    return note


def _stroke(note: int | None, hit: int | None, counts: bool, words: str) -> StrokeVerdict:
    if (note is None) == (hit is None):
        raise wrong("expected a note or a hit")
    return StrokeVerdict(counts, note, hit, words)


def _few(read: Reader[tuple[StrokeVerdict, ...]]) -> Reader[tuple[StrokeVerdict, ...]]:
    def read_few(value: object) -> tuple[StrokeVerdict, ...]:
        if isinstance(value, Sequence) and len(value) > MOST_STROKES:
            raise wrong(f"expected {MOST_STROKES} strokes at most, found {len(value)}")
        return read(value)

    return read_few


_INDEX = Field(or_none(whole(0, _MOST_INDEX)), None)
_STROKE: Fields = {"note": _INDEX, "hit": _INDEX, "counts": needed(flag), "words": Field(line_or_none, "")}
VERDICT_FIELDS: Fields = {
    "number": needed(whole(1, MOST_SESSIONS)),
    "lesson": needed(lesson_title),
    "words": Field(words, ""),
    "score": Field(or_none(number(0, 100)), None),
    "reached": Field(or_none(flag), None),
    "strokes": Field(_few(list_of(record(_stroke, _STROKE), "a list of strokes")), ()),
    "reported": Field(or_none(number(0, 100)), None),
}
_ABOUT: Reader[tuple[str, str]] = record(lambda id, title: (id, title), {"id": needed(identity), "title": needed(line)})  # noqa: A006


def _built(about: tuple[str, str], **said: object) -> Note:
    return Note(assignment_id=about[0], title=about[1], **said)  # type: ignore[arg-type] # the table was read


_NOTE: Reader[Note] = record(
    _built,
    {
        "id": needed(identity),
        "return": Field(identity, "", "", "return_id"),
        "assignment": Field(_ABOUT, ("", ""), "", "about"),
        "teacher": needed(line),
        "student": needed(line),
        "made": needed(moment),
        "words": Field(words, ""),
        "next": Field(words, ""),
        "sessions": Field(list_of(record(SessionVerdict, VERDICT_FIELDS), "a list of sessions"), ()),
    },
)
