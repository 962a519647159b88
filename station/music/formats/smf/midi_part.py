"""Standard MIDI Files as a format among the others: a part in, a part out."""

from collections.abc import Mapping
from types import MappingProxyType

from station.music.drum_part import DrumPart
from station.music.formats.music_format import Feature, Loss, MusicFormat, WrittenFile
from station.music.formats.smf.chunk_reader import MAX_BYTES, parse_midi
from station.music.formats.smf.drum_tracks import score_from_midi

_KEEPS: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.TIMES: "to 1/26880 of a quarter note; grace strokes and rolls are strokes like others",
        Feature.TEMPO: "",
        Feature.METERS: "",
        Feature.VELOCITIES: "",
        Feature.PIECES: "",
        Feature.TITLE: "",
    }
)
_MOVED = tuple(
    Loss(feature, f"{feature.value}: all a bar later, for the grace strokes before the first")
    for feature in (Feature.TIMES, Feature.TEMPO, Feature.METERS)
)


def read_midi_part(data: bytes, source: str) -> DrumPart:
    """The drums of a MIDI file; raises `BadInput` of `source`."""
    return DrumPart(score_from_midi(parse_midi(data, source)))


def write_midi_part(part: DrumPart) -> WrittenFile:
    """The part as a MIDI file of format 1; raises `BadInput` for a tempo or meter that MIDI cannot write."""
    from station.music.formats.smf.track_writer import bars_before, score_bytes  # with mido; a reader does without

    data = score_bytes(part.score, part.score.title or "part")
    return WrittenFile(data, _MOVED if bars_before(part.score) else ())


MIDI = MusicFormat(
    "MIDI", (".mid", ".midi", ".smf", ".kar"), read_midi_part, lambda _: True, MAX_BYTES, write_midi_part, _KEEPS
)
