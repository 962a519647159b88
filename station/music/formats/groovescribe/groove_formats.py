"""GrooveScribe among the other formats: its links in files, and its MIDI."""

from dataclasses import replace

from station.core.disk.utf8 import utf8_text
from station.music.drum_part import DrumPart
from station.music.formats.groovescribe.groove_midi import is_groove_midi, read_groove_midi
from station.music.formats.groovescribe.groove_query import find_groove_url, is_groove_url
from station.music.formats.groovescribe.groove_reader import read_groove
from station.music.formats.groovescribe.groove_writer import KEEPS, write_groove
from station.music.formats.music_format import MusicFormat, WrittenFile
from station.music.formats.smf.midi_part import MIDI

__all__ = ["GROOVESCRIBE", "GROOVESCRIBE_MIDI", "GROOVE_SHORTCUT", "GROOVE_TEXT", "is_groove_url", "read_url"]

_MOST_BYTES = 1 << 20
"""A text with a link in it (our choice; a link is at most 64 KiB)."""


def read_url(text: str) -> DrumPart:
    """The part in a link to a groove; raises `BadInput`."""
    return read_groove(text, "GrooveScribe link")


def _read_file(data: bytes, source: str) -> DrumPart:
    text = utf8_text(data, source, "the link of a groove")
    return read_groove(find_groove_url(text) or text, source)


def _write_shortcut(part: DrumPart) -> WrittenFile:
    """The link in an Internet shortcut, an INI file with lines of Windows' ends."""
    written = write_groove(part)
    return replace(written, data=b"[InternetShortcut]\r\nURL=" + written.data.strip() + b"\r\n")


def _holds_link(data: bytes) -> bool:
    return bool(find_groove_url(data.decode("utf-8-sig", errors="replace")))


GROOVESCRIBE = MusicFormat("GrooveScribe", (".groove",), _read_file, _holds_link, _MOST_BYTES, write_groove, KEEPS)
"""A file with nothing in it but a link, to be pasted or sent."""
GROOVE_SHORTCUT = MusicFormat(
    "GrooveScribe shortcut", (".url",), _read_file, _holds_link, _MOST_BYTES, _write_shortcut, KEEPS
)
"""A link as Windows keeps it: a double click opens the groove in the browser."""
GROOVE_TEXT = MusicFormat("GrooveScribe link", (".txt",), _read_file, _holds_link, _MOST_BYTES)
"""A link that a person put into a text."""
GROOVESCRIBE_MIDI = MusicFormat("GrooveScribe's MIDI", MIDI.endings, read_groove_midi, is_groove_midi, MIDI.most_bytes)
