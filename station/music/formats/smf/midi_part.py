"""Standard MIDI Files as a format among the others: a part in, a part out."""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.disk.utf8 import one_line
from station.core.pieces import Articulation, Piece, Zone
from station.music.drum_part import DrumPart
from station.music.formats.music_format import Feature, Loss, MusicFormat, WrittenFile
from station.music.formats.section_marks import sections_from_marks
from station.music.formats.smf.chunk_reader import MAX_BYTES, parse_midi
from station.music.formats.smf.contents import MidiFile
from station.music.formats.smf.drum_tracks import score_from_midi, score_ticks
from station.music.score import Score

_KEEPS: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.TIMES: "to 1/26880 of a quarter note; grace strokes and rolls are strokes like others",
        Feature.TEMPO: "",
        Feature.METERS: "",
        Feature.VELOCITIES: "",
        Feature.PIECES: "",
        Feature.TITLE: "",
        Feature.SECTIONS: "",
    }
)
_PLAYED = tuple(
    Loss(feature, f"{feature.value}: strokes stand where they sound; an import takes that for a take's")
    for feature in (Feature.TIMES, Feature.TIMING)
)
_MOVED = tuple(
    Loss(feature, f"{feature.value}: all a bar later, for the strokes that sound before the first beat")
    for feature in (Feature.TIMES, Feature.TEMPO, Feature.METERS, Feature.SECTIONS)
)
_CUT = tuple(
    Loss(feature, "bars of rest at the end: a MIDI file is read to the bar of its last note")
    for feature in (Feature.TIMES, Feature.SECTIONS)
)
_MARKER = 6
"""The number of the meta event (RP-001)."""


def read_midi_part(data: bytes, source: str) -> DrumPart:
    """The drums of a MIDI file; raises `BadInput` of `source`."""
    contents = parse_midi(data, source)
    score = _with_a_plain_snare(score_from_midi(contents))
    sections = sections_from_marks(_markers(contents, score), score)
    return DrumPart(score, sections=sections, is_meter_said=any(track.meters for track in contents.tracks))


def _markers(contents: MidiFile, score: Score) -> list[tuple[int, str]]:
    """Score ticks and texts of the markers of what sounds together; of patterns one after the other there are none."""
    if len(contents.sequences) != 1:
        return []
    (sequence,) = contents.sequences
    found = [text for track in sequence.tracks for text in track.texts if text.kind == _MARKER]
    ticks = score_ticks(sequence, score.tempo_map, [min(text.tick, sequence.end_tick) for text in found])
    return [(tick, text.text) for tick, text in zip(ticks.tolist(), found, strict=True)]


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

    data = score_bytes(part.score, part.score.title or "part", _section_markers(part))
    score = part.score
    conditions = (
        (_PLAYED, score.notes["late_ms"].any()),
        (_MOVED, bars_before(score)),
        (_CUT, score.closing_rest_bars),
    )
    lost = [loss for losses, holds in conditions if holds for loss in losses]
    of_sections = () if part.sections else (Feature.SECTIONS,)
    return WrittenFile(data, tuple(loss for loss in lost if loss.feature not in of_sections))


def _section_markers(part: DrumPart) -> list[tuple[int, str]]:
    """The names of the sections where they begin, and an empty one where a section ends and none follows."""
    ends = {section.last_bar + 1: "" for section in part.sections if section.last_bar + 1 < part.score.bar_count}
    names = ends | {section.first_bar: one_line(section.name) for section in part.sections}
    return [(part.score.tempo_map.bar_start(bar), name) for bar, name in sorted(names.items())]


MIDI = MusicFormat(
    "MIDI", (".mid", ".midi", ".smf", ".kar"), read_midi_part, lambda _: True, MAX_BYTES, write_midi_part, _KEEPS
)
