"""Benchmarks of MIDI files: how long 100,000 notes take to read, mido's time beside ours."""

import tempfile
from pathlib import Path

import mido

from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.music.formats.smf.standard_midi import read_midi

NOTES = 100_000
_DIVISION = 480
_CHORDS = ((36, 42), (42,), (38, 42), (46,))
"""An eighth-note groove: kick and hat, hat, snare and hat, open hat."""
_TIMES, _PEER_TIMES = 9, 1


def drum_file(notes: int) -> bytes:
    """A format 0 file of a groove with at least `notes` notes, note offs and velocities as a module sends them."""
    events, count = [], 0
    while count < notes:
        for chord in _CHORDS:
            events += [bytes([0, 0x99, number, 40 + (count * 7 + number) % 80]) for number in chord]
            events += [bytes([60 if i == 0 else 0, 0x89, number, 64]) for i, number in enumerate(chord)]
            events.append(bytes([0x81, 0x34, 0xB9, 4, count % 128]))  # the pedal, 180 ticks later
            count += len(chord)
    content = b"".join(events) + b"\x00\xff\x2f\x00"
    header = b"MThd\0\0\0\x06\0\0\0\x01" + _DIVISION.to_bytes(2, "big")
    return header + b"MTrk" + len(content).to_bytes(4, "big") + content


def _read() -> Measurement:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "groove.mid"
        path.write_bytes(drum_file(NOTES))
        ours_s = median_s(lambda: read_midi(path), _TIMES)
        theirs_s = median_s(lambda: mido.MidiFile(path), _PEER_TIMES)
    return Measurement(ours_s * 1000, theirs_s * 1000)


BENCHMARKS = (Benchmark("midi_read_100k_notes", "ms", 70, "lower", "mido", _read),)
