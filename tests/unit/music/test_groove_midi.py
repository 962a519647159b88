"""MIDI as GrooveScribe writes it, made here event by event after its midiFile.js."""

from collections.abc import Sequence

import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Ornament, Piece
from station.core.units import PPQ
from station.music.formats.groovescribe.groove_midi import is_groove_midi, read_groove_midi
from station.music.swing import Swing


def groove_file(*events: tuple[int, int, int], bar_ends: Sequence[int], tempo_us: int = 500_000) -> bytes:
    """A file with note ons `events` (tick, number, velocity) and marks where bars end."""
    body = b"\0\xff\x51\x03" + tempo_us.to_bytes(3) + b"\0\xc0\x13\x01\x89\x3c\x5a"
    marked = sorted([(tick, 1, bytes([0x99, note, velocity])) for tick, note, velocity in events]
                    + [(tick, 0, b"\x80\x3c\x5a") for tick in bar_ends])  # fmt: skip
    at = 1
    for tick, _, message in marked:
        delta = tick - at
        body += (bytes([0x80 | delta >> 7]) if delta >= 0x80 else b"") + bytes([delta & 0x7F]) + message
        at = tick
    body += b"\0\xff\x2f\0"
    return b"MThd\0\0\0\x06\0\0\0\x01\0\x80MTrk" + len(body).to_bytes(4) + body


STRAIGHT = groove_file(*((1 + 64 * i, 42, 85) for i in range(8)), (129, 22, 85), (1, 35, 85), bar_ends=[512])


def test_its_files_are_known_by_how_they_begin() -> None:
    assert is_groove_midi(STRAIGHT)
    assert not is_groove_midi(STRAIGHT.replace(b"\xc0\x13", b"\xc0\x14"))
    assert not is_groove_midi(b"MThd\0\0\0\x06\0\0\0\x01\0\x80")


def test_note_22_is_the_accented_snare() -> None:
    part = read_groove_midi(STRAIGHT, "groove.mid")
    snare = [note for note in part.score if note.piece is Piece.SNARE]
    assert [(note.tick, note.dynamic) for note in snare] == [(PPQ, Dynamic.ACCENT)]
    assert [note.tick for note in part.score if note.piece is Piece.HIHAT] == [i * PPQ // 2 for i in range(8)]
    assert part.score.end_tick == 4 * PPQ


def test_triplets_that_fell_behind_are_put_back() -> None:
    ticks = [1, 43, 85, 127, 169, 211]  # 42.664 a stroke, cut to 42
    data = groove_file(*((tick, 42, 85) for tick in ticks), bar_ends=[252])
    part = read_groove_midi(data, "groove.mid")
    assert [note.tick for note in part.score] == [i * PPQ // 3 for i in range(6)]
    assert part.score.end_tick == 2 * PPQ


def test_swing_is_found() -> None:
    # eighths of 76.8 and 51.2 ticks, each sum of its 32nds cut: 20 % swing
    data = groove_file(*((tick, 42, 85) for tick in (1, 77, 128, 204, 255, 331, 382, 458)), bar_ends=[508])
    part = read_groove_midi(data, "groove.mid")
    assert part.swing == Swing(1.5, PPQ // 2)
    assert [note.tick - note.swing_ticks for note in part.score] == [i * PPQ // 2 for i in range(8)]


def test_the_metronome_is_no_stroke() -> None:
    data = groove_file((1, 76, 120), (1, 42, 85), (129, 77, 120), (257, 77, 85), bar_ends=[512])
    part = read_groove_midi(data, "groove.mid")
    assert [(note.tick, note.piece) for note in part.score] == [(0, Piece.HIHAT), (2 * PPQ, Piece.PERCUSSION)]
    assert part.lost == ("clicks of the metronome, left out: 2",)


def test_flams_drags_and_buzzes_are_one_note_each() -> None:
    data = groove_file((1, 107, 85), (129, 103, 85), (257, 104, 85), bar_ends=[512])
    mains = [note for note in read_groove_midi(data, "groove.mid").score if not note.lead_ms]
    assert [note.ornament for note in mains] == [Ornament.FLAM, Ornament.DRAG, Ornament.ROLL]
    assert mains[2].articulation is Articulation.BUZZ


def test_general_midi_says_accents_by_velocity() -> None:
    data = groove_file((1, 38, 120), (129, 38, 50), (257, 42, 120), bar_ends=[512])
    found = [note.dynamic for note in read_groove_midi(data, "groove.mid").score]
    assert found == [Dynamic.ACCENT, Dynamic.GHOST, Dynamic.ACCENT]


def test_seven_eight_in_two_bars() -> None:
    data = groove_file((1, 35, 85), (448, 35, 85), bar_ends=[448, 895])
    part = read_groove_midi(data, "groove.mid")
    assert [note.tick for note in part.score] == [0, 7 * PPQ // 2]
    assert str(part.score.tempo_map.meters[0]) == "7/8"


def test_a_track_that_ends_before_its_first_note_is_refused() -> None:
    cut = STRAIGHT[:18] + (10).to_bytes(4) + STRAIGHT[22:]  # the tempo and the instrument alone
    assert is_groove_midi(cut)
    with pytest.raises(BadInput, match=r"groove\.mid"):
        read_groove_midi(cut, "groove.mid")


def test_bars_without_end_are_refused() -> None:
    with pytest.raises(BadInput, match=r"groove\.mid"):
        read_groove_midi(groove_file((1, 35, 85), bar_ends=[200_000 >> 4]), "groove.mid")
