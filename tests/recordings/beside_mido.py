"""Checks of a MIDI file as the station reads it against mido, note for note and time for time."""

from pathlib import Path

import mido
import numpy as np
import pytest

from station.core.units import PPQ
from station.music.formats.smf.standard_midi import (
    MidiFile,
    MidiTrack,
    performance_from_midi,
    read_midi,
    score_from_midi,
)

_Row = tuple[int, ...]


def _rows_of(track: MidiTrack, table: str, *fields: str) -> list[_Row]:
    return [tuple(row) for row in getattr(track, table)[list(fields)].tolist()]


def _absolute(track: mido.MidiTrack) -> list[tuple[int, mido.Message]]:
    tick, timed = 0, []
    for message in track:
        tick += message.time
        timed.append((tick, message))
    return timed


def _mido_notes(track: mido.MidiTrack) -> list[_Row]:
    """(tick, duration, channel, number, velocity), a note ending with the next on or off of its number."""
    notes: list[_Row] = []
    sounding: dict[tuple[int, int], int] = {}
    for tick, message in _absolute(track):
        if message.type not in ("note_on", "note_off"):
            continue
        before = sounding.pop((message.channel, message.note), None)
        if before is not None:
            start, _, *rest = notes[before]
            notes[before] = (start, tick - start, *rest)
        if message.type == "note_on" and message.velocity:
            sounding[message.channel, message.note] = len(notes)
            notes.append((tick, -1, message.channel, message.note, message.velocity))
    return notes


def check_file(path: Path) -> None:
    """Tracks, events and times of a file are those that mido reads."""
    ours, theirs = read_midi(path), mido.MidiFile(path)
    assert (ours.format, len(ours.tracks)) == (theirs.type, len(theirs.tracks))
    assert ours.division.ticks == theirs.ticks_per_beat
    for mine, track in zip(ours.tracks, theirs.tracks, strict=True):
        _check_track(mine, track)
    _check_times(ours, theirs)


def _check_track(ours: MidiTrack, theirs: mido.MidiTrack) -> None:
    timed = _absolute(theirs)
    of_type = {kind: [(t, m) for t, m in timed if m.type == kind] for kind in {m.type for _, m in timed}}
    assert _rows_of(ours, "notes", "tick", "duration_ticks", "channel", "number", "velocity") == _mido_notes(theirs)
    assert _rows_of(ours, "controllers", "tick", "channel", "number", "value") == [
        (t, m.channel, m.control, m.value) for t, m in of_type.get("control_change", [])
    ]
    assert _rows_of(ours, "aftertouch", "tick", "channel", "number", "value") == [
        (t, m.channel, m.note, m.value) for t, m in of_type.get("polytouch", [])
    ]
    assert [(c.tick, c.us_per_quarter) for c in ours.tempos] == [(t, m.tempo) for t, m in of_type.get("set_tempo", [])]
    assert [(c.tick, c.beats, c.unit) for c in ours.meters] == [
        (t, m.numerator, m.denominator) for t, m in of_type.get("time_signature", [])
    ]
    assert [(s.tick, s.data) for s in ours.sysex] == [(t, bytes(m.data)) for t, m in of_type.get("sysex", [])]
    assert ours.end_tick == timed[-1][0]
    assert ours.name.split() == theirs.name.split()


def _check_times(ours: MidiFile, theirs: mido.MidiFile) -> None:
    """Seconds as mido counts them in one file of many tracks, or tick by tick where tracks are on their own."""
    if theirs.type == 2:
        for sequence, track in zip(ours.sequences, theirs.tracks, strict=True):
            assert len(sequence.tempos) == 1
            tempo = sequence.tempos[0].us_per_quarter
            expected = [mido.tick2second(t, theirs.ticks_per_beat, tempo) for t, *_ in _mido_notes(track)]
            assert sequence.ns_at(sequence.tracks[0].notes["tick"]) / 1e9 == pytest.approx(expected, abs=1e-9)
        return
    now_s, expected = 0.0, []
    for message in theirs:
        now_s += message.time
        if message.type == "note_on" and message.velocity:
            expected.append(now_s)
    ticks = np.sort(np.concatenate([track.notes["tick"] for track in ours.tracks]))
    assert ours.sequences[0].ns_at(ticks) / 1e9 == pytest.approx(expected, abs=1e-6)


def check_drum_notes(path: Path) -> None:
    """Channel 10 as mido reads it: numbers, velocities, times; the score has them to half a tick."""
    theirs = mido.MidiFile(path)
    now_s, played = 0.0, []
    for message in theirs:
        now_s += message.time
        if message.type == "note_on" and message.velocity and message.channel == 9:
            played.append((now_s, message.note, message.velocity))
    midi = read_midi(path)
    hits = performance_from_midi(midi).hits
    assert sorted(zip(hits["midi_note"].tolist(), hits["velocity"].tolist(), strict=True)) == sorted(
        (number, velocity) for _, number, velocity in played
    )
    assert (hits["at_ns"] / 1e9).tolist() == pytest.approx([at_s for at_s, _, _ in played], abs=1e-6)
    score = score_from_midi(midi)
    half_tick_s = max(c.us_per_quarter for c in score.tempo_map.tempos) / 1e6 / PPQ / 2
    onsets = sorted({at_s for at_s, _, _ in played})
    assert np.unique(score.onset_s).tolist() == pytest.approx(onsets, abs=half_tick_s + 1e-6)
    assert {(n.midi_note, n.velocity) for n in score} <= {(number, velocity) for _, number, velocity in played}
