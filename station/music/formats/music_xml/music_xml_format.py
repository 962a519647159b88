"""MusicXML as a format among the others."""

from collections.abc import Mapping
from types import MappingProxyType

from station.music.drum_part import DrumPart
from station.music.formats.music_format import Feature, MusicFormat, WrittenFile
from station.music.formats.music_xml.mxl_container import packed_score
from station.music.formats.music_xml.reading.music_xml_reader import ROOTS, read_music_xml
from station.music.formats.music_xml.writing.music_xml_writer import write_music_xml
from station.music.formats.safe_xml import MOST_XML_BYTES, root_name
from station.music.formats.safe_zip import is_zip

KEEPS: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.TIMES: "note values to 256ths and tuplets to 15; what lies on none is moved to sixty-fourths",
        Feature.PIECES: "",
        Feature.TEMPO: "",
        Feature.METERS: "a bar cut short becomes a meter of its own",
        Feature.METER_GROUPS: "",
        Feature.BEAT: "plain and dotted note values",
        Feature.SWING: "of eighths or sixteenths, in whole bars",
        Feature.VELOCITIES: "",
        Feature.DYNAMICS: "",
        Feature.ZONES: "",
        Feature.CROSS_STICKS: "on the snare",
        Feature.RIM_SHOTS: "",
        Feature.OPENNESS: "closed, half open, open",
        Feature.FOOT_SPLASHES: "",
        Feature.FLAMS: "",
        Feature.DRAGS: "",
        Feature.GRACE_SPACING: "their loudness; their spacing is the usual one",
        Feature.DIDDLES: "where one note value of a quarter or less has both strokes",
        Feature.BUZZES: "",
        Feature.CHOKES: "",
        Feature.STICKING: "",
        Feature.FEET: "",
        Feature.LOUDNESS: "",
        Feature.TITLE: "",
        Feature.AUTHOR: "",
        Feature.ABOUT: "",
        Feature.SECTIONS: "",
    }
)


def _is_music_xml(data: bytes) -> bool:
    return is_zip(data) or root_name(data) in ROOTS


def _write_packed(part: DrumPart) -> WrittenFile:
    written = write_music_xml(part)
    return WrittenFile(packed_score(written.data), written.lost)


MUSIC_XML = MusicFormat(
    "MusicXML", (".musicxml", ".xml"), read_music_xml, _is_music_xml, MOST_XML_BYTES, write_music_xml, KEEPS
)
COMPRESSED_MUSIC_XML = MusicFormat(
    "compressed MusicXML", (".mxl",), read_music_xml, _is_music_xml, MOST_XML_BYTES, _write_packed, KEEPS
)
"""Each reads the other's files as well, for people rename them."""
