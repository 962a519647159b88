"""Guitar Pro as formats among the others; nothing is written in them."""

from station.core.errors import BadInput
from station.music.drum_part import DrumPart
from station.music.formats.guitar_pro.gpx_container import gpx_member, is_gpx
from station.music.formats.guitar_pro.score_gpif import read_gpif
from station.music.formats.guitar_pro.tab_part import part_of_song
from station.music.formats.music_format import MusicFormat
from station.music.formats.safe_xml import MOST_XML_BYTES
from station.music.formats.safe_zip import is_zip, zip_member

MOST_TAB_BYTES = 2 << 20
"""Our choice: many times the longest song as Guitar Pro 3 to 5 pack it (2 KB a track and minute)."""
_MOST_PACKED_BYTES = 32 << 20
"""A `.gp` may carry its recording beside the score (our choice)."""


def read_old_part(data: bytes, source: str) -> DrumPart:
    """The drums of a `.gp3`, `.gp4` or `.gp5` file; raises `BadInput`."""
    from station.music.formats.guitar_pro.old_tabs import read_old_tabs  # with PyGuitarPro, for such files alone

    return part_of_song(read_old_tabs(data, source), source)


def read_packed_part(data: bytes, source: str) -> DrumPart:
    """The drums of a `.gp` or `.gpx` file; raises `BadInput`."""
    if is_gpx(data):
        gpif = gpx_member(data, source, "score.gpif", MOST_XML_BYTES)
    elif is_zip(data):
        gpif = zip_member(data, source, "Content/score.gpif", MOST_XML_BYTES)
    else:
        raise BadInput(source, "byte 0", "neither the zip file that a .gp is nor the container that a .gpx is")
    return part_of_song(read_gpif(gpif, source), source)


OLD_GUITAR_PRO = MusicFormat("Guitar Pro 3–5", (".gp3", ".gp4", ".gp5"), read_old_part, lambda _: True, MOST_TAB_BYTES)
GUITAR_PRO = MusicFormat("Guitar Pro 6–8", (".gp", ".gpx"), read_packed_part, lambda _: True, _MOST_PACKED_BYTES)
