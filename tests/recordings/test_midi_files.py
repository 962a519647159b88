"""MIDI files beside mido's account of them; what is refused, is refused in one clear line."""

from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.music.formats.smf.standard_midi import performance_from_midi, read_midi
from tests.real_data import DATA, real_files
from tests.recordings.beside_mido import check_drum_notes, check_file
from tests.recordings.whole_song import whole_song

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


@pytest.mark.parametrize("path", real_files("midi/**/*.mid", "gmd/**/*.mid"))
def test_a_file_reads_as_mido_reads_it_or_is_refused(path: Path) -> None:
    if path.name in REFUSED:
        with pytest.raises(BadInput) as raised:
            read_midi(path)
        assert str(raised.value) == f"{path}: {REFUSED[path.name]}"
    elif path.name in MIDO_READS_NOT:
        assert read_midi(path).oddities == ("byte 14: a chunk of another kind, Junk, was skipped",)
    else:
        check_file(path)


@pytest.mark.parametrize("path", real_files("gmd/**/*.mid"))
def test_score_and_performance_hold_every_drum_note(path: Path) -> None:
    check_drum_notes(path)


@pytest.mark.parametrize("form", [0, 1])
def test_a_whole_song_reads_as_mido_reads_it(form: int, tmp_path: Path) -> None:
    """Of our own making; `make oracles` reads songs from elsewhere."""
    path = tmp_path / "song.mid"
    whole_song(form).save(path)
    check_file(path)
    check_drum_notes(path)


def test_crashes_of_a_v_drums_file_are_no_chinas() -> None:
    """The numbers 52 and 55 are a crash's edge on a TD-11, a china and a splash in General MIDI."""
    hits = performance_from_midi(read_midi(DATA / "gmd/drummer7/session1/10_rock_93_beat_4-4.mid")).hits
    crashes = np.isin(hits["midi_note"], [49, 55, 52, 57])
    assert set(hits["piece"][crashes].tolist()) == {Piece.CRASH_1, Piece.CRASH_2}


def test_the_pedal_tells_how_open_the_hi_hat_is() -> None:
    """This drummer's pedal says 90 when it is shut; most strokes on the closed numbers 42 and 22 come with it."""
    hits = performance_from_midi(read_midi(DATA / "gmd/drummer8/session2/14_afrobeat_103_beat_4-4.mid")).hits
    closed = hits["openness"][np.isin(hits["midi_note"], [42, 22])]
    opened = hits["openness"][np.isin(hits["midi_note"], [46, 26])]
    assert (closed < 0.1).mean() > 0.9
    assert 0.5 < np.median(opened) < 1, "neither shut nor all the way open: the pedal was heard"


def test_chokes_of_a_real_drummer() -> None:
    """Bow and edge of one cymbal are pressed together at ticks 21312, 52032, 79126 and 167095 of 480 a quarter."""
    midi = read_midi(DATA / "gmd/drummer6/session3/4_rock_127_beat_4-4.mid")
    chokes = performance_from_midi(midi).chokes
    us_per_quarter = midi.tracks[0].tempos[0].us_per_quarter
    expected = [round(tick * us_per_quarter * 1000 / 480) for tick in (21312, 52032, 79126, 167095)]
    assert chokes["at_ns"].tolist() == expected
    assert set(chokes["piece"].tolist()) == {Piece.CRASH_1}
