"""Standard MIDI Files in and out: `read_midi`, then a score or a performance; and the way back.

Our own reader, because it must be quick, keep polyphonic aftertouch and controllers, know formats 0, 1 and 2 and SMPTE
time, and say of a broken file which byte is wrong; `docs/decisions` says what else was weighed. The parts: `smf_file`
what a file holds, `smf_read` and `smf_events` its bytes, `smf_kit` which notes are drums, `smf_drums` what they mean,
`smf_write` and `smf_out` the way out.
"""

from pathlib import Path

from station.core.errors import BadInput
from station.music.formats.smf_drums import performance_from_midi, score_from_midi
from station.music.formats.smf_file import MidiFile, MidiTrack
from station.music.formats.smf_kit import guess_kit_map
from station.music.formats.smf_read import MAX_BYTES, parse_midi
from station.music.formats.smf_write import write_performance, write_score

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
    try:
        with Path(path).open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as fault:
        raise BadInput(path, "", fault.strerror or str(fault)) from fault
    return parse_midi(data, str(path))
