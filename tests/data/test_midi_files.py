"""Every real MIDI file against mido, note for note and time for time; what is refused, is refused in one clear line."""

from pathlib import Path

import mido
import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.formats.smf.standard_midi import (
    MidiFile,
    MidiTrack,
    performance_from_midi,
    read_midi,
    score_from_midi,
)
from tests.real_data import real_file, real_files

MIDI_FILES = real_files("midi/**/*.mid", "gmd/**/*.mid", "charts/**/*.mid")

REFUSED = {
    "test-empty-file.mid": "byte 0: the file is empty",
    "test-not-a-midi-file.mid": "byte 0: not a MIDI file: not  where MThd should be",
    "test-illegal-message-f4.mid": "byte 205: undefined status byte F4",
    "test-illegal-message-f5.mid": "byte 205: undefined status byte F5",
    "test-illegal-message-f9.mid": "byte 205: undefined status byte F9",
    "MIDIBadHeaderChunk.mid": "byte 0: not a MIDI file: MT0d where MThd should be",
    "MIDIBadHeaderFormat.mid": "byte 8: MIDI file format 3; there are only 0, 1 and 2",
    "MIDIBadHeaderSMTPE.mid": "byte 12: 16 frames of 96 ticks a second; SMPTE has 24, 25, 29 or 30 frames",
    "MIDIBadHeaderTracksNum.mid": "byte 81: the file ends with 1 of its 2 tracks",
    "MIDIBadTrackLength.mid": "byte 18: a chunk of 16777275 bytes, the file has 59 left",
}
"""The files made to be wrong; offsets counted in a hex dump."""

MIDO_READS_NOT = {"test-non-midi-track.mid"}
"""A chunk of another kind, which RP-001 says to skip."""

Row = tuple[int, ...]


def rows_of(track: MidiTrack, table: str, *fields: str) -> list[Row]:
    return [tuple(row) for row in getattr(track, table)[list(fields)].tolist()]


def absolute(track: mido.MidiTrack) -> list[tuple[int, mido.Message]]:
    tick, timed = 0, []
    for message in track:
        tick += message.time
        timed.append((tick, message))
    return timed


def mido_notes(track: mido.MidiTrack) -> list[Row]:
    """(tick, duration, channel, number, velocity), a note ending with the next on or off of its number."""
    notes: list[Row] = []
    sounding: dict[tuple[int, int], int] = {}
    for tick, message in absolute(track):
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


@pytest.mark.parametrize("path", MIDI_FILES)
def test_a_file_reads_as_mido_reads_it_or_is_refused(path: Path) -> None:
    if path.name in REFUSED:
        with pytest.raises(BadInput) as raised:
            read_midi(path)
        assert str(raised.value) == f"{path}: {REFUSED[path.name]}"
        return
    ours = read_midi(path)
    if path.name in MIDO_READS_NOT:
        assert ours.oddities == ("byte 14: a chunk of another kind, Junk, was skipped",)
        return
    theirs = mido.MidiFile(path)
    assert (ours.format, len(ours.tracks)) == (theirs.type, len(theirs.tracks))
    assert ours.division.ticks == theirs.ticks_per_beat
    for mine, track in zip(ours.tracks, theirs.tracks, strict=True):
        check_track(mine, track)
    check_times(ours, theirs)


def check_track(ours: MidiTrack, theirs: mido.MidiTrack) -> None:
    timed = absolute(theirs)
    of_type = {kind: [(t, m) for t, m in timed if m.type == kind] for kind in {m.type for _, m in timed}}
    assert rows_of(ours, "notes", "tick", "duration_ticks", "channel", "number", "velocity") == mido_notes(theirs)
    assert rows_of(ours, "controllers", "tick", "channel", "number", "value") == [
        (t, m.channel, m.control, m.value) for t, m in of_type.get("control_change", [])
    ]
    assert rows_of(ours, "aftertouch", "tick", "channel", "number", "value") == [
        (t, m.channel, m.note, m.value) for t, m in of_type.get("polytouch", [])
    ]
    assert [(c.tick, c.us_per_quarter) for c in ours.tempos] == [(t, m.tempo) for t, m in of_type.get("set_tempo", [])]
    assert [(c.tick, c.beats, c.unit) for c in ours.meters] == [
        (t, m.numerator, m.denominator) for t, m in of_type.get("time_signature", [])
    ]
    assert [(s.tick, s.data) for s in ours.sysex] == [(t, bytes(m.data)) for t, m in of_type.get("sysex", [])]
    assert ours.end_tick == timed[-1][0]
    assert ours.name.split() == theirs.name.split()


def check_times(ours: MidiFile, theirs: mido.MidiFile) -> None:
    """Seconds as mido counts them in one file of many tracks, or tick by tick where tracks are on their own."""
    if theirs.type == 2:
        for sequence, track in zip(ours.sequences, theirs.tracks, strict=True):
            assert len(sequence.tempos) == 1
            tempo = sequence.tempos[0].us_per_quarter
            expected = [mido.tick2second(t, theirs.ticks_per_beat, tempo) for t, *_ in mido_notes(track)]
            assert sequence.ns_at(sequence.tracks[0].notes["tick"]) / 1e9 == pytest.approx(expected, abs=1e-9)
        return
    now_s, expected = 0.0, []
    for message in theirs:
        now_s += message.time
        if message.type == "note_on" and message.velocity:
            expected.append(now_s)
    ticks = np.sort(np.concatenate([track.notes["tick"] for track in ours.tracks]))
    assert ours.sequences[0].ns_at(ticks) / 1e9 == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("path", real_files("gmd/**/*.mid", "midi/opengameart/**/*.mid"))
def test_score_and_performance_hold_every_drum_note(path: Path) -> None:
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


def test_crashes_of_a_v_drums_file_are_no_chinas() -> None:
    """The numbers 52 and 55 are a crash's edge on a TD-11, a china and a splash in General MIDI."""
    hits = performance_from_midi(read_midi(real_file("gmd/drummer7/session1/10_rock_93_beat_4-4.mid"))).hits
    crashes = np.isin(hits["midi_note"], [49, 55, 52, 57])
    assert set(hits["piece"][crashes].tolist()) == {Piece.CRASH_1, Piece.CRASH_2}


def test_the_pedal_tells_how_open_the_hi_hat_is() -> None:
    """This drummer's pedal says 90 when it is shut; most strokes on the closed numbers 42 and 22 come with it."""
    hits = performance_from_midi(read_midi(real_file("gmd/drummer8/session2/14_afrobeat_103_beat_4-4.mid"))).hits
    closed = hits["openness"][np.isin(hits["midi_note"], [42, 22])]
    opened = hits["openness"][np.isin(hits["midi_note"], [46, 26])]
    assert (closed < 0.1).mean() > 0.9
    assert 0.5 < np.median(opened) < 1, "neither shut nor all the way open: the pedal was heard"


def test_chokes_of_a_real_drummer() -> None:
    """Bow and edge of one cymbal are pressed together at ticks 21312, 52032, 79126 and 167095 of 480 a quarter."""
    midi = read_midi(next(real_file("gmd").glob("*/session3/4_rock_127_beat_4-4.mid")))
    chokes = performance_from_midi(midi).chokes
    us_per_quarter = midi.tracks[0].tempos[0].us_per_quarter
    expected = [round(tick * us_per_quarter * 1000 / 480) for tick in (21312, 52032, 79126, 167095)]
    assert chokes["at_ns"].tolist() == expected
    assert set(chokes["piece"].tolist()) == {Piece.CRASH_1}
