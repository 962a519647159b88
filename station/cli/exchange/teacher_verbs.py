"""The teacher's side of `station assignment`: new, receive, review, answer."""

import uuid
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, date, datetime
from itertools import groupby
from pathlib import Path

from station.app.teacher_desk.judge_worker import hear
from station.cli.console import print_json, say, write
from station.cli.exchange.keyed_words import goals_in, verdict_in
from station.cli.exchange.student_verbs import check_out, settings_of
from station.cli.options.option_fields import argument, arguments, day, flag, option, repeated, required
from station.core.counts import counted
from station.core.disk.file_names import folder_name
from station.core.disk.files import write_whole
from station.core.errors import BadInput, StationError
from station.core.settings import Settings
from station.practice.exchange.assignment_file import AssignedLesson, Assignment, read_assignment
from station.practice.exchange.lesson_goals import LessonGoals
from station.practice.exchange.note_file import Note
from station.practice.exchange.parcel import Kind
from station.practice.exchange.return_file import ReturnedSession, session_words
from station.practice.exchange.teacher_store import (
    Received,
    find_received,
    given,
    goals_of,
    keep_given,
    keep_note_on,
    receive,
    received,
    teacher_of,
)

SCHEMA = "drum-station/returns/1"


@dataclass(frozen=True, slots=True, kw_only=True)
class NewOptions:
    """What is given, to whom, until when."""

    lesson: tuple[str, ...] = repeated("NAME", "a lesson's name or file; say it for each")
    goal: tuple[str, ...] = repeated(
        "LESSON:KEY=VALUE,…", "what is asked of a lesson: tempo, level, passes, minutes, words"
    )
    song: tuple[str, ...] = repeated("LESSON:NAME", "the song that a lesson is played to, by its name alone")
    title: str = option("TEXT", "what it is called", str, "")
    due: date | None = option("DAY", "until when, such as 2026-12-01", day, None)
    words: str = option("TEXT", "what you say to the student", str, "")
    teacher: str = option("NAME", "who gives it (you)", str, "")
    group: str = option("--class NAME", "the class that it is for", str, "")
    replaces: Path | None = option("FILE", "an assignment of which this is a later version", Path, None)
    out: Path = required("FILE", f"the file to write; it ends in {Kind.ASSIGNMENT.ending}", Path)
    overwrite: bool = flag("write FILE even if there is one already")


@dataclass(frozen=True, slots=True, kw_only=True)
class ReceiveOptions:
    """Which returns came."""

    files: tuple[str, ...] = arguments("FILE", "returns that came")


@dataclass(frozen=True, slots=True, kw_only=True)
class ReviewOptions:
    """How the returns are listed."""

    judge: bool = flag("judge every session again from its capture, and tell where a report says otherwise")
    json: bool = flag("print one JSON document")


@dataclass(frozen=True, slots=True, kw_only=True)
class AnswerOptions:
    """What is said to a return."""

    received: str = argument("RETURN", "the first letters of a return, as review lists them", str)
    words: str = option("TEXT", "what you say to the student", str, "")
    next: str = option("TEXT", "what to do next", str, "")
    verdict: tuple[str, ...] = repeated(
        "N:KEY=VALUE,…", "of session N: score, reached=yes, counts=note3+hit5, refused=hit4, words"
    )
    teacher: str = option("NAME", "who says it (who gave the assignment)", str, "")
    out: Path = required("FILE", f"the file to write; it ends in {Kind.NOTE.ending}", Path)
    overwrite: bool = flag("write FILE even if there is one already")


# --- giving -----------------------------------------------------------------------------------------------------------


def make_assignment(options: NewOptions) -> int:
    """Write an assignment into a file."""
    check_out(options.out, Kind.ASSIGNMENT, options.overwrite)
    settings = settings_of(None)
    before = None if options.replaces is None else read_assignment(options.replaces)
    assignment = Assignment(
        id=uuid.uuid4().hex if before is None else before.id,
        revision=1 if before is None else before.revision + 1,
        title=options.title or (before.title if before else options.out.name.removesuffix(Kind.ASSIGNMENT.ending)),
        teacher=options.teacher or (before.teacher if before else settings.student),
        made=datetime.now(UTC).replace(microsecond=0),
        lessons=_lessons(options) or (before.lessons if before else ()),
        group=options.group or (before.group if before else ""),
        due=options.due or (before.due if before else None),
        words=options.words or (before.words if before else ""),
    )
    write_whole(options.out, keep_given(assignment, settings))
    say(f"assignment {options.out}: {counted(len(assignment.lessons), 'lesson')}, version {assignment.revision}")
    return 0


def _lessons(options: NewOptions) -> tuple[AssignedLesson, ...]:
    from station.app.music_files.find_own_lesson import find_any_lesson

    if not options.lesson and options.replaces is None:
        raise BadInput("--lesson", "", "which lessons? Say at least one")
    found = [find_any_lesson(name) for name in options.lesson]
    names = {name: folder_name(each.name) for name, each in zip(options.lesson, found, strict=True)}
    goals = dict(goals_in("--goal", text) for text in options.goal)
    songs = dict(_song(text) for text in options.song)
    for option_name, said in (("--goal", goals), ("--song", songs)):
        _check_named(option_name, said, names)
    return tuple(
        AssignedLesson(
            names[name],
            each.title,
            each.text,
            goals.get(name, goals.get(names[name], LessonGoals())),
            songs.get(name, songs.get(names[name], "")),
        )
        for name, each in zip(options.lesson, found, strict=True)
    )


def _song(text: str) -> tuple[str, str]:
    lesson, colon, song = text.partition(":")
    if not colon or not song.strip():
        raise BadInput("--song", text, "expected LESSON:NAME")
    return lesson.strip(), song.strip()


def _check_named(option_name: str, said: Iterable[str], names: dict[str, str]) -> None:
    """Raises `BadInput` for what is said of a lesson that is not given."""
    for lesson in said:
        if lesson not in names and lesson not in names.values():
            raise BadInput(option_name, lesson, f"is none of the lessons given: {', '.join(names)}")


# --- receiving --------------------------------------------------------------------------------------------------------


def receive_files(options: ReceiveOptions) -> int:
    """Keep returns that came; one that cannot be read keeps no other from being kept."""
    settings, fault_count = settings_of(None), 0
    for name in options.files:
        try:
            one, is_new = receive(Path(name), settings)
        except StationError as fault:
            say(f"station: {fault}")
            fault_count += 1
            continue
        told = "received" if is_new else "came before"
        sent = one.returned
        write(f"{one.stem}: {told}: {sent.student}, {sent.assignment.title}, {counted(len(sent.sessions), 'session')}")
    return 2 if fault_count else 0


def review(options: ReviewOptions) -> int:
    """List what students sent, per student and lesson."""
    settings = settings_of(None)
    found, faults = received(settings)
    for fault in faults:
        say(str(fault))
    if options.json:
        print_json({"schema": SCHEMA, "returns": [_document(one, settings, options.judge) for one in found]})
        return 0
    if not found:
        say("no return came yet: `station assignment receive FILE` keeps one")
    before = given(settings)
    for (shelf, student), some in groupby(found, lambda one: (one.returned.assignment.shelf, one.returned.student)):
        write(f"{shelf}: {student}")
        for one in some:
            write(_text(one, before, settings, options.judge))
    return 0


def _text(one: Received, before: list[Assignment], settings: Settings, judge: bool) -> str:
    sent = one.returned
    said = f": {' '.join(sent.words.split())}" if sent.words else ""
    rows = [f"  {one.stem}  {sent.assignment.title}, {sent.made:%Y-%m-%d}{said}"]
    for number, session in enumerate(sent.sessions, 1):
        rows.append(
            f"    {number:2} {session.lesson:16} {session.played:%Y-%m-%d %H:%M}  {session_words(session.figures)}"
        )
        rows += [f"       {line}" for line in (_heard_lines(one, number, settings) if judge else ())]
    for lesson, states in goals_of(one, before).items():
        marks = {True: "reached", False: "not yet", None: "yours to say"}
        rows += [f"    {lesson}: {state.words}: {marks[state.reached]}" for state in states]
    if sent.left_out:
        rows.append(f"    {counted(sent.left_out, 'session')} left out for lack of room")
    rows.append("    no note yet" if one.note is None else f"    note: {' / '.join(one.note.lines) or 'empty'}")
    return "\n".join(rows)


def _heard_lines(one: Received, number: int, settings: Settings) -> tuple[str, ...]:
    try:
        found = hear(one.path, number, settings)
    except StationError as fault:
        return (str(fault),)
    return found.differences or ("the capture gives the same",)


def _document(one: Received, settings: Settings, judge: bool) -> dict[str, object]:
    sent = one.returned
    return {
        "return": one.stem,
        "id": sent.id,
        "assignment": sent.assignment.id,
        "title": sent.assignment.title,
        "group": sent.assignment.group,
        "student": sent.student,
        "made": f"{sent.made:%Y-%m-%dT%H:%M:%SZ}",
        "words": sent.words,
        "left_out": sent.left_out,
        "sessions": [
            _session(each, _heard_lines(one, number, settings) if judge else None)
            for number, each in enumerate(sent.sessions, 1)
        ],
        "note": None if one.note is None else list(one.note.lines),
    }


def _session(session: ReturnedSession, heard: tuple[str, ...] | None) -> dict[str, object]:
    said = session.figures
    return {
        "lesson": session.lesson,
        "played": f"{session.played:%Y-%m-%dT%H:%M:%S}",
        "score": said.score,
        "notes": said.notes,
        "right": said.right,
        "level": said.level,
        "beats_a_minute": said.beats_a_minute,
        "passes": said.passes,
        "complete": said.complete,
        "seconds": said.seconds,
        "heard": None if heard is None else list(heard),
    }


# --- answering --------------------------------------------------------------------------------------------------------


def answer(options: AnswerOptions) -> int:
    """Write a note on a return into a file for the student."""
    check_out(options.out, Kind.NOTE, options.overwrite)
    settings = settings_of(None)
    one = find_received(settings, options.received)
    sent = one.returned

    def lesson_of(number: int) -> str:
        if not 1 <= number <= len(sent.sessions):
            raise BadInput("--verdict", str(number), f"the return has sessions 1 to {len(sent.sessions)}")
        return sent.sessions[number - 1].lesson

    note = Note(
        id=uuid.uuid4().hex,
        return_id=sent.id,
        assignment_id=sent.assignment.id,
        title=sent.assignment.title,
        teacher=options.teacher or teacher_of(one, settings),
        student=sent.student,
        made=datetime.now(UTC).replace(microsecond=0),
        words=options.words,
        next=options.next,
        sessions=tuple(verdict_in("--verdict", text, lesson_of) for text in options.verdict),
    )
    write_whole(options.out, keep_note_on(one, note))
    say(f"note     {options.out}")
    return 0
