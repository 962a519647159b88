"""Standard MIDI Files in and out: `read_midi`, then a score or a performance; and the way back.

Our own reader, because it must be quick, keep polyphonic aftertouch and controllers, know formats 0, 1 and 2 and SMPTE
time, and say of a broken file which byte is wrong; `docs/decisions` says what else was weighed. The parts: `contents`
what a file holds, `chunk_reader` and `track_events` its bytes, `drum_channels` which notes are drums, `drum_tracks`
what they mean, `track_writer` and `track_bytes` the way out.
"""

from pathlib import Path

from station.core.disk.files import read_regular
from station.music.formats.smf.chunk_reader import MAX_BYTES, parse_midi
from station.music.formats.smf.contents import MidiFile, MidiTrack
from station.music.formats.smf.drum_channels import guess_kit_map
from station.music.formats.smf.drum_tracks import performance_from_midi, score_from_midi
from station.music.formats.smf.track_writer import write_performance, write_score

__all__ = [
    "MidiFile",
    "MidiTrack",
    "guess_kit_map",
    "parse_midi",
    "performance_from_midi",
    "read_midi",
    "score_from_midi",
    "write_performance",
    "write_score",
]


def read_midi(path: str | Path) -> MidiFile:
    """The MIDI file at `path`; raises `BadInput` if it cannot be read or is no MIDI file."""
    return parse_midi(read_regular(Path(path), MAX_BYTES + 1), str(path))
