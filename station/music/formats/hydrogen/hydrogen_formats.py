"""Hydrogen among the other formats."""

from dataclasses import replace

from station.music.drum_part import DrumPart
from station.music.formats.hydrogen.part_to_song import PATTERN_KEEPS, SONG_KEEPS, pattern_of_part, song_of_part
from station.music.formats.hydrogen.song_reader import PATTERN_ROOTS, SONG_ROOTS, parse_pattern, parse_song
from station.music.formats.hydrogen.song_to_part import kit_of_pattern, part_of_song
from station.music.formats.hydrogen.song_writer import pattern_bytes, song_bytes
from station.music.formats.music_format import MusicFormat, WrittenFile
from station.music.formats.safe_xml import MOST_XML_BYTES, root_name


def _read_song(data: bytes, source: str) -> DrumPart:
    return part_of_song(parse_song(data, source), source)


def _read_pattern(data: bytes, source: str) -> DrumPart:
    song = kit_of_pattern(*parse_pattern(data, source))
    return replace(part_of_song(song, source), is_meter_said=len(song.columns) == 1)


def _write_song(part: DrumPart) -> WrittenFile:
    song, lost = song_of_part(part)
    return WrittenFile(song_bytes(song), lost)


def _write_pattern(part: DrumPart) -> WrittenFile:
    song, lost = pattern_of_part(part)
    return WrittenFile(pattern_bytes(song), lost)


HYDROGEN_SONG = MusicFormat(
    "Hydrogen song",
    (".h2song",),
    _read_song,
    lambda data: root_name(data) in SONG_ROOTS,
    MOST_XML_BYTES,
    _write_song,
    SONG_KEEPS,
)
HYDROGEN_PATTERN = MusicFormat(
    "Hydrogen pattern",
    (".h2pattern",),
    _read_pattern,
    lambda data: root_name(data) in PATTERN_ROOTS,
    MOST_XML_BYTES,
    _write_pattern,
    PATTERN_KEEPS,
)
