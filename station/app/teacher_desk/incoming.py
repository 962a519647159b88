"""What comes to the window by double click or drag: music, a lesson, an assignment, a return, a note."""

from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from station.app.music_files.lesson_import import KeptLesson, keep_import
from station.core.counts import counted
from station.core.settings import Settings
from station.practice.exchange.parcel import Kind, kind_by_name


@dataclass(frozen=True, slots=True)
class KeptParcel:
    """A parcel that was kept: its `title`, what was `told` of it, what it says in `lines`, the lessons it brings."""

    title: str
    told: str
    lines: tuple[str, ...]
    lessons: tuple[Path, ...] = ()


def keep_incoming(source: str, settings: Settings) -> KeptLesson | KeptParcel:
    """Keep what `source` names where such things are kept; raises `StationError`."""
    match kind_by_name(source):
        case Kind.ASSIGNMENT:
            return _taken(Path(source), settings)
        case Kind.RETURN:
            return _received(Path(source), settings)
        case Kind.NOTE:
            return _noted(Path(source), settings)
        case None:
            return keep_import(source, settings.own_lessons_dir)


def _taken(path: Path, settings: Settings) -> KeptParcel:
    from station.drills.library import lesson_names, lesson_path
    from station.practice.exchange.assignment_file import readme_text
    from station.practice.exchange.student_store import take

    one, done = take(path, settings, datetime.now())
    own, shipped = settings.own_lessons_dir / one.folder.name, lesson_names()
    lessons = tuple(lesson_path(here) if here in shipped else own / f"{here}.toml" for _, here in one.taken.lessons)
    lines = tuple(row.removeprefix("* ") for row in readme_text(one.assignment).split("\n")[1:] if row)
    return KeptParcel(one.assignment.title, f"{one.assignment.title}: {done}", lines, lessons)


def _received(path: Path, settings: Settings) -> KeptParcel:
    from station.practice.exchange.return_file import readme_text
    from station.practice.exchange.teacher_store import receive

    one, is_new = receive(path, settings)
    sent = one.returned
    told = f"{sent.student}: {counted(len(sent.sessions), 'session')} of {sent.assignment.title}"
    lines = tuple(filter(None, readme_text(sent).split("\n")))
    return KeptParcel(sent.assignment.title, f"{told}{'' if is_new else ', which came before'}", lines)


def _noted(path: Path, settings: Settings) -> KeptParcel:
    from station.practice.exchange.student_store import keep_note

    one, note, _ = keep_note(path, settings)
    return KeptParcel(one.assignment.title, f"A note from {note.teacher} on {one.assignment.title}", note.lines)
