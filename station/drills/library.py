"""The lessons and courses that ship with the station, and how a word or a path finds a lesson.

In a checkout they lie in `lessons/` beside the package, in an installed wheel in `station/shipped/lessons`. A lesson's
name is its file's stem; names are unique, whatever folder a file lies in. Any other `.toml` file is a lesson by its
path. Files that end in `.course.toml` are courses.
"""

from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from difflib import get_close_matches
from functools import cache
from pathlib import Path
from types import MappingProxyType

import station
from station.core.errors import BadInput
from station.drills.course import ENDING, Course, Where, is_course, lesson_name, read_course
from station.drills.lesson import Lesson
from station.drills.lesson_row import LessonRow, rows_below
from station.drills.reading.lesson_file import read_lesson
from station.drills.rudiments import find_rudiment
from station.drills.songs.song_file import SONG_ENDING, is_song
from station.drills.songs.song_lesson import read_song_lesson
from station.music.formats.format_table import is_music_file

FIRST_LESSON = "rock-1"
"""What a newcomer meets first."""

__all__ = [
    "FIRST_LESSON",
    "LessonRow",
    "courses_in",
    "find_lesson",
    "lesson_names",
    "lesson_path",
    "lesson_rows",
    "lessons_dir",
    "lessons_for",
    "own_lessons",
    "read_any",
    "read_lesson",
    "shipped_courses",
    "shipped_lessons",
]

_ENDING = ".toml"
_NAMES_SHOWN = 5


@cache
def lessons_dir() -> Path:
    """The folder of the shipped lessons."""
    package = Path(station.__file__).parent
    checkout = package.parent / "lessons"
    return checkout if (package.parent / "pyproject.toml").is_file() else package / "shipped" / "lessons"


def _files(folder: Path) -> dict[str, Path]:
    return {path.stem: path for path in sorted(folder.rglob(f"*{_ENDING}")) if not is_course(path)}


@cache
def _shipped() -> Mapping[str, Path]:
    """The files of the shipped lessons by name; what ships stays as it is while the station runs."""
    return MappingProxyType(_files(lessons_dir()))


def lesson_names() -> list[str]:
    """Names of all shipped lessons, sorted."""
    return sorted(_shipped())


def lesson_path(name: str) -> Path:
    """The file of the shipped lesson of that name."""
    return _shipped()[name]


def find_lesson(name_or_path: str) -> Lesson:
    """The shipped lesson of that name, a rudiment by its number or title too, or the lesson in the file at that path.

    Raises `BadInput`: the file's fault, that there is none, or for an unknown name the shipped names nearest to it.
    """
    files = _shipped()
    if name_or_path in files:
        return read_lesson(files[name_or_path])
    path = Path(name_or_path)
    if is_course(path) and _is_file(path):
        raise BadInput(path, "", "this is a course; name one of its lessons, or follow it in the window")
    if _is_file(path) or _is_path(path):
        return read_any(path)
    with suppress(BadInput):
        return read_lesson(files[find_rudiment(name_or_path).name])
    raise BadInput(name_or_path, "", f"no such lesson{_like(name_or_path, list(files))}")


def read_any(path: Path) -> Lesson:
    """The lesson or the song in the file at `path`; raises `BadInput`."""
    return read_song_lesson(path) if is_song(path) else read_lesson(path)


def lessons_for(folder: Path) -> Where:
    """Finds what a course in `folder` names: a shipped lesson by its name, or a file."""
    return _found_in(folder, frozenset(lesson_names()))


def _found_in(folder: Path, shipped: Collection[str]) -> Where:
    def where(word: str) -> str | None:
        path = folder / word
        if word in shipped:
            return word
        return str(path) if word.endswith((_ENDING, SONG_ENDING)) and not is_course(path) and _is_file(path) else None

    return where


def shipped_courses() -> list[Course]:
    """All shipped courses by level and name."""
    courses, faults = courses_in(lessons_dir())
    assert not faults, "what ships is checked by tests"
    return courses


def courses_in(folder: Path) -> tuple[list[Course], list[BadInput]]:
    """The courses in a folder and below it by level and name, and the faults of those that cannot be read."""
    courses: list[Course] = []
    faults: list[BadInput] = []
    paths = sorted(folder.rglob(f"*{ENDING}"))
    shipped = frozenset(lesson_names() if paths else ())
    for path in paths:
        try:
            courses.append(read_course(path, _found_in(path.parent, shipped)))
        except BadInput as fault:
            faults.append(fault)
    return sorted(courses, key=lambda course: (course.level, course.name)), faults


def own_lessons(courses: Iterable[Course], folder: Path, shipped: Collection[str]) -> dict[str, Lesson]:
    """The lessons that `courses` bring with them, then those in `folder`, none of them `shipped`, by name.

    What cannot be read is left out.
    """
    brought = [lesson for course in courses for lesson in course.lessons]
    own: dict[str, Lesson] = {}
    songs = {path.stem: path for path in sorted(folder.rglob(f"*{SONG_ENDING}"))}
    for found_by in dict.fromkeys([*brought, *map(str, (songs | _files(folder)).values())]):
        if lesson_name(found_by) not in {*shipped, *own}:
            with suppress(BadInput):  # `station lesson check` tells what is wrong with it
                own[lesson_name(found_by)] = read_any(Path(found_by))
    return own


def _is_path(path: Path) -> bool:
    """Whether it is written as a file, there or not, rather than as a name."""
    return len(path.parts) > 1 or path.suffix.lower() in (_ENDING, SONG_ENDING) or is_music_file(path.name)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # a name longer than the file system takes
        return False


def _like(word: str, names: list[str]) -> str:
    """The names that look like `word` or hold it; else where to look."""
    lower = word.lower().replace("_", "-").replace(" ", "-")
    close = get_close_matches(lower, names, _NAMES_SHOWN, 0.6)
    holding = [n for n in names if lower and lower in n and n not in close]
    near = (close + holding)[:_NAMES_SHOWN]
    if not near:
        return "; `station lesson list` shows all"
    return f"; the nearest {'are' if len(near) > 1 else 'is'} {', '.join(near)}"


def shipped_lessons() -> list[Lesson]:
    """All shipped lessons in the order of the list."""
    files = _shipped()
    return [read_lesson(files[row.name]) for row in lesson_rows()]


def lesson_rows() -> list[LessonRow]:
    """The list of shipped lessons: grooves, fills, rudiments …, each kind by level and name."""
    top = lessons_dir()
    kinds = {path: "" if path.parent == top else path.parent.name for path in _shipped().values()}
    return sorted(rows_below(top, kinds), key=lambda row: (_rank(row.folder), row.folder, row.level, row.name))


def lesson_prerequisites() -> dict[str, tuple[str, ...]]:
    """What each shipped lesson names as coming before it; nothing where one of them cannot be read."""
    try:
        return {row.name: row.prerequisites for row in lesson_rows()}
    except BadInput:
        return dict.fromkeys(lesson_names(), ())


def course_prerequisites() -> dict[str, tuple[str, ...]]:
    """What each shipped course names as coming before it, those that cannot be read nothing."""
    courses, _ = courses_in(lessons_dir())
    files = [path.name.removesuffix(ENDING) for path in lessons_dir().rglob(f"*{ENDING}")]
    return {**dict.fromkeys(files, ()), **{one.name: one.prerequisites for one in courses}}


KINDS = (
    *("grooves", "fills", "rudiments", "rolls", "orchestrated"),
    *("hands", "independence", "polyrhythms", "reading", "trading"),
)
"""The folders of the shipped lessons in the order of the list."""


def _rank(folder: str) -> int:
    return KINDS.index(folder) if folder in KINDS else len(KINDS)
