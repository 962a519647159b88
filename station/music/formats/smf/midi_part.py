"""Standard MIDI Files as a format among the others: a part in, a part out."""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.pieces import Articulation, Piece, Zone
from station.music.drum_part import DrumPart
from station.music.formats.music_format import Feature, Loss, MusicFormat, WrittenFile
from station.music.formats.smf.chunk_reader import MAX_BYTES, parse_midi
from station.music.formats.smf.drum_tracks import score_from_midi
from station.music.score import Score

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
_CUT = (Loss(Feature.TIMES, "bars of rest at the end: a MIDI file is read to the bar of its last note"),)


def read_midi_part(data: bytes, source: str) -> DrumPart:
    """The drums of a MIDI file; raises `BadInput` of `source`."""
    contents = parse_midi(data, source)
    score = _with_a_plain_snare(score_from_midi(contents))
    return DrumPart(score, is_meter_said=any(track.meters for track in contents.tracks))


def _with_a_plain_snare(score: Score) -> Score:
    """A snare that is only ever struck as a rim shot is a file's electric snare, struck as any snare is.

    Note 40 is the Electric Snare in General MIDI 1, and the rim of many modules' snare, beside 38 for its head.
    """
    rows = score.notes.copy()
    snare = (rows["piece"] == Piece.SNARE) & (rows["articulation"] != Articulation.CROSS_STICK)
    if not snare.any() or (rows["articulation"][snare] != Articulation.RIM_SHOT).any():
        return score
    rows["articulation"][snare], rows["zone"][snare] = Articulation.NORMAL, Zone.HEAD
    return Score.from_array(rows, score.tempo_map, score.end_tick, score.title, score.loudness)


def write_midi_part(part: DrumPart) -> WrittenFile:
    """The part as a MIDI file of format 1; raises `BadInput` for a tempo or meter that MIDI cannot write."""
    from station.music.formats.smf.track_writer import bars_before, score_bytes  # with mido; a reader does without

    data = score_bytes(part.score, part.score.title or "part")
    lost = (*(_MOVED if bars_before(part.score) else ()), *(_CUT if part.score.closing_rest_bars else ()))
    return WrittenFile(data, lost)


MIDI = MusicFormat(
    "MIDI", (".mid", ".midi", ".smf", ".kar"), read_midi_part, lambda _: True, MAX_BYTES, write_midi_part, _KEEPS
)
