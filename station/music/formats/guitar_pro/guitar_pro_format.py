"""Guitar Pro as a format among the others; nothing is written in it."""

from station.music.drum_part import DrumPart
from station.music.formats.guitar_pro.tab_part import part_of_song
from station.music.formats.music_format import MusicFormat

MOST_TAB_BYTES = 2 << 20
"""Our choice: many times the longest song as Guitar Pro 3 to 5 pack it (2 KB a track and minute)."""


def read_old_part(data: bytes, source: str) -> DrumPart:
    """The drums of a `.gp3`, `.gp4` or `.gp5` file; raises `BadInput`."""
    from station.music.formats.guitar_pro.old_tabs import read_old_tabs  # with PyGuitarPro, for such files alone

    return part_of_song(read_old_tabs(data, source), source)


OLD_GUITAR_PRO = MusicFormat("Guitar Pro 3–5", (".gp3", ".gp4", ".gp5"), read_old_part, lambda _: True, MOST_TAB_BYTES)
