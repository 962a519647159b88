"""What a name means that a user has given: a lesson, music in a file, a folder or a link, a take."""

from pathlib import Path

from station.app.music_files.read_captures import is_capture
from station.core.errors import BadInput
from station.music.drum_part import DrumPart
from station.music.formats.format_table import is_music_file, read_part
from station.music.formats.groovescribe.groove_formats import is_groove_url, read_url

SONG_FILES = ("notes.chart", "notes.mid")
"""What a song's folder of Clone Hero or YARG has its notes in (their wiki's "song folder"); the first is preferred, as
the games do."""


def is_lesson(name: str) -> bool:
    """Whether `name` means a lesson, and not music in another file, in a link or in a song's folder."""
    return not (is_music_file(name) or is_capture(name) or is_groove_url(name) or song_file(name) is not None)


def song_file(name: str) -> Path | None:
    """The notes in the song's folder `name`; None where it is no such folder."""
    try:
        return next((path for path in (Path(name) / each for each in SONG_FILES) if path.is_file()), None)
    except (OSError, ValueError):  # a name that the file system does not take
        return None


def existing(name: str) -> Path:
    """The path `name`; raises `BadInput` when there is no such file."""
    path = Path(name)
    if not path.is_file():
        is_folder = f"is a folder without {' or '.join(SONG_FILES)}" if path.is_dir() else "no such file"
        raise BadInput(name, "", is_folder)
    return path


def load_part(name: str) -> DrumPart:
    """The part that `name` means: a groove's link, a music file, a song's folder or a take, else a lesson.

    Raises `BadInput`.
    """
    if is_groove_url(name):
        return read_url(name)
    if song := song_file(name):
        return read_part(song)
    if is_capture(name):
        from station.app.music_files.read_takes import take_as_score

        return DrumPart(take_as_score(existing(name)), is_played=True)
    if is_music_file(name):
        return read_part(existing(name))
    from station.app.music_files.find_own_lesson import find_any_lesson
    from station.drills.writing.lesson_part import part_of

    return part_of(find_any_lesson(name))
