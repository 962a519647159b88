"""The charts of Clone Hero and YARG as formats among the others."""

from station.music.drum_part import DrumPart
from station.music.formats.clone_hero.chart_part import part_of_chart
from station.music.formats.clone_hero.chart_text import MOST_CHART_BYTES, read_chart
from station.music.formats.clone_hero.chart_writer import KEEPS, write_chart
from station.music.formats.clone_hero.notes_midi import is_notes_midi, read_notes_midi
from station.music.formats.music_format import MusicFormat
from station.music.formats.smf.chunk_reader import MAX_BYTES


def read_chart_part(data: bytes, source: str) -> DrumPart:
    """The drums of a `.chart` file; raises `BadInput`."""
    return part_of_chart(read_chart(data, source), source)


def read_notes_part(data: bytes, source: str) -> DrumPart:
    """The drums of a `notes.mid`; raises `BadInput`."""
    return part_of_chart(read_notes_midi(data, source), source)


CHART = MusicFormat(
    "Clone Hero chart", (".chart",), read_chart_part, lambda _: True, MOST_CHART_BYTES, write_chart, KEEPS
)
NOTES_MIDI = MusicFormat(
    "Rock Band, Clone Hero and YARG notes", (".mid", ".midi"), read_notes_part, is_notes_midi, MAX_BYTES
)
