"""Song files: TOML that ends in `.song`, read into a `Song` and written back; docs/songs.md describes it for teachers.

Files are named from the song's folder, beside it or below it; a full path is the user's own word and taken as it is. A
path that climbs out of the folder, or leads to another computer, is refused: who sends a song sends its files with it.
"""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from station.core.expected import LINE, expects
from station.core.toml.schema import (
    Field,
    Fields,
    Reader,
    checked_values,
    list_of,
    number,
    prose,
    read,
    said,
    title,
    whole,
)
from station.core.toml.toml_faults import wrong
from station.core.toml.toml_source import read_source
from station.core.toml.toml_write import toml_value
from station.drills.grid.line_group import MAX_BARS
from station.drills.songs.song import Song, SongPoint, SongSection

SONG_ENDING = ".song"
MOST_POINTS = 3000
"""Five minutes tapped at 600 a minute, or ten at 300 (our choice)."""
MOST_FILES = 20
"""Stems of a song (our choice: Clone Hero knows thirteen)."""
MOST_BEATS = 20_000
"""An hour at 330 beats a minute (our choice)."""
LONGEST_S = 3600.0
EARLIEST_S = -600.0
"""A part may begin before its sound does (our choice: as much as is ever played of a track)."""
_LONGEST_PATH = 1000
_PLAIN_TIMES = 10
"""Times that stand in a row of the file (our choice: a row of 80 letters)."""


@expects(LINE)
def own_file(value: object) -> Path:
    """A file beside the song or below its folder, or anywhere by its full path."""
    name = title(value)
    if len(name) > _LONGEST_PATH:
        raise wrong(f"a path of {len(name)} letters; expected at most {_LONGEST_PATH}")
    if name.startswith(("//", "\\\\")) or "://" in name:
        raise wrong("expected a file on this computer")
    if ".." in PurePosixPath(name).parts or ".." in PureWindowsPath(name).parts:
        raise wrong("expected a file beside the song or below its folder, or a full path")
    return Path(name)


_FILES = list_of(own_file, 'a list of sound files, such as ["bass.ogg", "guitar.ogg"]')


@expects({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]})
def own_files(value: object) -> tuple[Path, ...]:
    """A file or a list of files."""
    return _at_most(_FILES, MOST_FILES)(value) if isinstance(value, list) else (own_file(value),)


def _at_most(reader: Reader[tuple[Any, ...]], most: int) -> Callable[[object], tuple[Any, ...]]:
    def read_some(value: object) -> tuple[Any, ...]:
        if isinstance(value, list) and len(value) > most:
            raise wrong(f"{len(value):,} entries; expected at most {most:,}")
        return reader(value)

    return read_some


_TIME = number(EARLIEST_S, LONGEST_S)
_POINT: Fields = {
    "bar": Field(whole(1, MAX_BARS), 1, "bar = 1"),
    "beat": Field(number(1, 100), 1.0),
    "at_s": Field(_TIME, 0.0, "at_s = 0.512"),
}
_SECTION: Fields = {
    "name": Field(title, "", 'name = "verse"'),
    "bar": Field(whole(1, MAX_BARS), 1, "bar = 5"),
}
FIELDS: Fields = {
    "title": Field(title, "", 'title = "Our song"'),
    "author": Field(prose, ""),
    "about": Field(prose, ""),
    "part": Field(own_file, Path(), 'part = "our-song.mid"'),
    "sound": Field(own_files, (), called="others"),
    "drums": Field(own_files, ()),
    "quarters_s": Field(_at_most(list_of(_TIME, "a list of seconds"), MOST_BEATS), ()),
    "point": Field(_at_most(list_of(said(_POINT), "tables [[point]]"), MOST_POINTS), ()),
    "section": Field(_at_most(list_of(said(_SECTION), "tables [[section]]"), MAX_BARS), ()),
}
"""The schema of the file; whether the files are there is asked when they are read."""


def is_song(path: Path) -> bool:
    """Whether a file is one by its name."""
    return path.suffix.lower() == SONG_ENDING


def read_song(path: Path) -> Song:
    """The song in the file at `path`, its own files by their whole paths; raises `BadInput` with the first fault."""
    song = read(read_source(path), song_reader(path))
    home = path.parent
    return replace(
        song,
        part=home / song.part,
        others=tuple(home / one for one in song.others),
        drums=tuple(home / one for one in song.drums),
    )


def song_reader(path: Path) -> Reader[Song]:
    """The schema of the song in the file at `path`; the files that it names are as it names them."""

    def read_table(raw: object) -> Song:
        values, faults = checked_values(raw, FIELDS)
        points = tuple(SongPoint(**{"beat": 1.0, **one}) for one in values.pop("point"))
        sections = tuple(SongSection(**one) for one in values.pop("section"))
        for index, (before, after) in enumerate(pairwise(sections), 1):
            if after.bar <= before.bar:
                faults.add(("section", index, "bar"), f"expected a bar after {before.bar}, where {before.name} begins")
        faults.check()
        values["others"] = values.pop("sound")
        return Song(path, **values, points=points, sections=sections)

    return read_table


# --- writing ----------------------------------------------------------------------------------------------------------


def song_text(song: Song) -> str:
    """The file's text; files in or below its folder are named from there, others by their full path."""
    home = song.source.parent.absolute()
    top = [f"{key} = {toml_value(value)}" for key, value in _top(song, home).items() if value]
    tables = [_table("point", {"bar": p.bar, "beat": _plain(p.beat), "at_s": round(p.at_s, 4)}) for p in song.points]
    tables += [_table("section", {"name": one.name, "bar": one.bar}) for one in song.sections]
    times = [_times(song.quarters_s)] if song.quarters_s else []
    return "\n\n".join(["\n".join([*top, *times]), *tables]) + "\n"


def _top(song: Song, home: Path) -> dict[str, object]:
    return {
        "title": song.title,
        "author": song.author,
        "about": song.about,
        "part": _named(song.part, home),
        "sound": _one_or_more([_named(one, home) for one in song.others]),
        "drums": _one_or_more([_named(one, home) for one in song.drums]),
    }


def _named(path: Path, home: Path) -> str:
    whole_path = path.absolute()
    return whole_path.relative_to(home).as_posix() if whole_path.is_relative_to(home) else str(whole_path)


def _one_or_more(names: list[str]) -> str | list[str]:
    return names[0] if len(names) == 1 else names


def _plain(beat: float) -> float | int:
    return int(beat) if beat == int(beat) else beat


def _table(name: str, values: dict[str, object]) -> str:
    return "\n".join([f"[[{name}]]", *(f"{key} = {toml_value(value)}" for key, value in values.items())])


def _times(quarters_s: tuple[float, ...]) -> str:
    """The beats' times to a tenth of a millisecond, some of them in a row."""
    words = [f"{at_s:.4f}" for at_s in quarters_s]
    rows = [", ".join(words[i : i + _PLAIN_TIMES]) for i in range(0, len(words), _PLAIN_TIMES)]
    return "quarters_s = [\n" + "".join(f"    {row},\n" for row in rows) + "]"
