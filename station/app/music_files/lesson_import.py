"""Makes a lesson of music that a user names, and keeps it among their own lessons."""

import os
import shlex
from dataclasses import dataclass, replace
from pathlib import Path

from station.app.music_files.named_parts import existing, is_lesson, load_part, song_file
from station.core.disk.file_names import folder_name
from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.drills.library import lesson_names, read_lesson
from station.drills.songs.song_file import SONG_ENDING
from station.drills.songs.song_folder import sounds_beside
from station.drills.transcription.transcribe import transcribe
from station.music.formats.format_table import endings
from station.music.formats.groovescribe.groove_formats import is_groove_url
from station.practice.history.session_files import CAPTURE_NAME

ENDING = ".toml"
_LINK_NAME = "groove"
"""What a lesson from a link without a title is called."""
_MOST_OF_A_NAME = 999
"""So many lessons of one name (our choice: nobody imports a file a thousand times)."""


@dataclass(frozen=True, slots=True)
class ImportedLesson:
    """The `title` and `text` of a lesson, and what was done to the music and what is lost of it, a sentence each."""

    title: str
    text: str
    remarks: tuple[str, ...] = ()
    lost: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class KeptLesson:
    """An import that lies at `path`; `is_new` where there was none of the same text before."""

    path: Path
    title: str
    bars: int
    remarks: tuple[str, ...] = ()
    lost: tuple[str, ...] = ()
    is_new: bool = True


def import_lesson(source: str, name: str) -> ImportedLesson:
    """The lesson called `name` of a music file, a take, a song's folder or a groove's link; raises `BadInput`."""
    if is_lesson(source):
        if Path(source).is_dir():
            existing(source)  # says what a folder must have
        raise BadInput(source, "", f"expected a music file ({endings()}), a take (.capture) or a groove's link")
    part = load_part(source)
    title = part.score.title or (name if is_groove_url(source) else _own_name(source))
    found = transcribe(replace(part, score=replace(part.score, title=title)), name, source)
    return ImportedLesson(found.lesson.title, found.lesson.text, (*found.remarks, *_song_remark(source)), part.lost)


def _song_remark(source: str) -> tuple[str, ...]:
    """Where the chart of a song lies with its sound, that more can be made of it than a lesson."""
    chart = song_file(source) or Path(source)
    if not chart.is_file() or not any(sounds_beside(chart)):
        return ()
    command = shlex.join(["station", "song", "new", "--part", source, "--out", f"{_own_name(source)}{SONG_ENDING}"])
    return (f"its sound lies beside it: `{command}` makes a song of it, to be played along to",)


def keep_import(source: str, folder: Path) -> KeptLesson:
    """Import `source`, which may be a lesson file too, into the `folder` of the user's own lessons.

    It gets a name that no other lesson has; the same again is not kept twice. Raises `StationError`.
    """
    if Path(source).suffix.lower() == ENDING:
        written = read_lesson(existing(source))
        made = ImportedLesson(written.title, written.text)
    else:
        made = import_lesson(source, _LINK_NAME if is_groove_url(source) else _own_name(source))
    path, is_new = place_in(folder, _file_name(source, made.title), made.text.encode())
    if is_new:
        write_whole(path, made.text.encode())
    lesson = read_lesson(path)
    return KeptLesson(path, lesson.title, lesson.score.bar_count, made.remarks, made.lost, is_new)


def _own_name(source: str) -> str:
    """What a file is called without its ending, a folder as it is, and a take as the folder that its session made."""
    path = Path(source)
    if path.name == CAPTURE_NAME:
        return path.absolute().parent.name
    return path.name if path.is_dir() else path.stem


def _file_name(source: str, title: str) -> str:
    """The same with single hyphens for what no file system likes; a link's lesson is called by its title."""
    name = title.lower() if is_groove_url(source) else _own_name(source)
    return "-".join(filter(None, folder_name(name).split("-")))


def place_in(folder: Path, name: str, text: bytes) -> tuple[Path, bool]:
    """Where a lesson goes that would be called `name`, and whether it is not there already."""
    shipped = frozenset(lesson_names())
    for number in range(1, _MOST_OF_A_NAME + 1):
        path = folder / f"{name if number == 1 else f'{name}-{number}'}{ENDING}"
        if path.stem in shipped:
            continue
        if not os.path.lexists(path):
            return path, True
        if path.is_file() and path.read_bytes() == text:
            return path, False
    raise BadInput(folder, "", f"{_MOST_OF_A_NAME} lessons are called {name} already")
