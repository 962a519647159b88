"""All formats of music that the station reads and writes; `read_part` finds the one that a file is in."""

from pathlib import Path

from station.core.disk.files import read_regular
from station.core.errors import BadInput
from station.music.drum_part import DrumPart
from station.music.formats.ascii_tab.tab_writer import ASCII_TAB
from station.music.formats.clone_hero.clone_hero_format import CHART, NOTES_MIDI
from station.music.formats.dtx.dtx_writer import DTX
from station.music.formats.groovescribe.groove_formats import (
    GROOVE_SHORTCUT,
    GROOVE_TEXT,
    GROOVESCRIBE,
    GROOVESCRIBE_MIDI,
)
from station.music.formats.guitar_pro.guitar_pro_format import GUITAR_PRO, OLD_GUITAR_PRO
from station.music.formats.hydrogen.hydrogen_formats import HYDROGEN_PATTERN, HYDROGEN_SONG
from station.music.formats.music_format import MusicFormat
from station.music.formats.music_xml.music_xml_format import COMPRESSED_MUSIC_XML, MUSIC_XML
from station.music.formats.smf.midi_part import MIDI
from station.music.formats.text_score import TEXT_SCORE

FORMATS: tuple[MusicFormat, ...] = (
    NOTES_MIDI,
    GROOVESCRIBE_MIDI,
    MIDI,
    MUSIC_XML,
    COMPRESSED_MUSIC_XML,
    OLD_GUITAR_PRO,
    GUITAR_PRO,
    CHART,
    GROOVESCRIBE,
    HYDROGEN_SONG,
    HYDROGEN_PATTERN,
    DTX,
    GROOVE_SHORTCUT,
    GROOVE_TEXT,
    ASCII_TAB,
    TEXT_SCORE,
)
"""Of several with the same ending, the choosy ones first."""
MOST_STROKES = 50_000
"""Of a file, whatever its format (our choice: 2,000 bars of 25): the rest of the program takes time for each."""


def is_music_file(name: str) -> bool:
    """Whether `name` ends as a file of one of the formats does."""
    return any(ending in known.endings for known in FORMATS) if (ending := _ending(name)) else False


def read_part(path: Path) -> DrumPart:
    """The part in the file at `path`, by its ending and its bytes; raises `BadInput`."""
    known = [each for each in FORMATS if _ending(path.name) in each.endings]
    if not known:
        raise BadInput(path, "", f"expected a file that ends in {endings()}")
    data = read_regular(path, max(each.most_bytes for each in known))
    found = next((each for each in known if each.recognises(data)), known[0] if len(known) == 1 else None)
    if found is None:
        raise BadInput(path, "", f"is none of those that end so: {', '.join(each.name for each in known)}")
    if len(data) > found.most_bytes:
        raise BadInput(path, "", f"is larger than {found.most_bytes >> 20} MiB, which no {found.name} file is")
    part = found.read(data, str(path))
    if len(part.score) > MOST_STROKES:
        raise BadInput(path, "", f"{len(part.score):,} strokes; expected at most {MOST_STROKES:,}")
    return part


def writer_for(path: Path) -> MusicFormat:
    """The format that a file of this name is written in; raises `BadInput` where there is none."""
    for each in FORMATS:
        if each.write is not None and _ending(path.name) in each.endings:
            return each
    raise BadInput(path, "", f"expected a name that ends in {endings(written=True)}")


def endings(written: bool = False) -> str:
    """The endings of all formats, or of those that are written, for messages."""
    found = [ending for each in FORMATS if each.write or not written for ending in each.endings]
    return ", ".join(dict.fromkeys(found))


def _ending(name: str) -> str:
    return Path(name).suffix.lower()
