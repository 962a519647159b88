"""MIDI files that we write, read back by mido."""

from pathlib import Path

import mido
import numpy as np
import pytest

from station.core.errors import BadInput, DeviceError
from station.core.events import Choke, Hit
from station.core.note_map import GENERAL_MIDI, V_DRUMS
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import PPQ
from station.music.formats.smf.standard_midi import (
    guess_kit_map,
    performance_from_midi,
    read_midi,
    score_from_midi,
    write_performance,
    write_score,
)
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap


def score(*notes: Note, tempo_map: TempoMap | None = None, title: str = "") -> Score:
    return Score.from_notes(notes, tempo_map or TempoMap(), title=title)


def drum_track(path: Path) -> list[tuple[int, mido.Message]]:
    """The last track's messages with absolute ticks."""
    tick, timed = 0, []
    for message in mido.MidiFile(path).tracks[-1]:
        tick += message.time
        timed.append((tick, message))
    return timed


def strokes(path: Path) -> list[tuple[int, int, int]]:
    return [(tick, m.note, m.velocity) for tick, m in drum_track(path) if m.type == "note_on" and m.velocity]


def test_a_score_is_a_file_of_format_1_on_channel_10(tmp_path: Path) -> None:
    path = tmp_path / "groove.mid"
    notes = [Note(0, Piece.KICK, velocity=99), Note(PPQ // 2, Piece.HIHAT, Zone.BOW, 70), Note(PPQ, Piece.SNARE)]
    tempo_map = TempoMap.build([TempoChange(0, 600_000), TempoChange(PPQ, 500_000)], [MeterChange(0, 7, 8)])
    write_score(score(*notes, tempo_map=tempo_map, title="Übung\nzwei"), path)
    file = mido.MidiFile(path, charset="utf-8")
    assert (file.type, file.ticks_per_beat, len(file.tracks)) == (1, 480, 2)
    assert file.tracks[0].name == "Übung zwei"
    assert [(m.time, m.tempo) for m in file.tracks[0] if m.type == "set_tempo"] == [(0, 600_000), (480, 500_000)]
    assert [(m.numerator, m.denominator) for m in file.tracks[0] if m.type == "time_signature"] == [(7, 8)]
    assert strokes(path) == [(0, 36, 99), (240, 42, 70), (480, 38, 80)]
    assert {m.channel for m in file.tracks[1] if not m.is_meta} == {9}
    assert drum_track(path)[-1][0] == 480 * 7 // 2, "the file ends with the bar"


def test_what_480_cannot_hold_is_written_finer(tmp_path: Path) -> None:
    """A septuplet: PPQ/7 is 15360 ticks, 3840 of 26880."""
    write_score(score(Note(0, Piece.KICK), Note(PPQ // 7, Piece.SNARE)), tmp_path / "seven.mid")
    assert mido.MidiFile(tmp_path / "seven.mid").ticks_per_beat == 26_880
    assert [tick for tick, *_ in strokes(tmp_path / "seven.mid")] == [0, 3840]


def test_a_stroke_ends_where_its_number_is_struck_again(tmp_path: Path) -> None:
    """A 32nd long (60 of 480), a roll as long as it is written, and neither over the next stroke."""
    notes = [Note(0, Piece.SNARE, duration_ticks=PPQ), Note(PPQ // 2, Piece.SNARE), Note(PPQ // 2 + 448, Piece.SNARE)]
    write_score(score(*notes), tmp_path / "roll.mid")
    ends = [tick for tick, m in drum_track(tmp_path / "roll.mid") if m.type == "note_off"]
    assert ends == [240, 242, 302]


def test_a_grace_stroke_stands_before_its_main_stroke(tmp_path: Path) -> None:
    """30 ms at 120 bpm are 0.06 quarters, 1612.8 of 26880 ticks."""
    flam = [Note(PPQ, Piece.SNARE, velocity=40, lead_ms=30), Note(PPQ, Piece.SNARE, velocity=100)]
    write_score(score(*flam), tmp_path / "flam.mid")
    assert strokes(tmp_path / "flam.mid") == [(26_880 - 1_613, 38, 40), (26_880, 38, 100)]


def test_an_empty_bar_makes_room_for_a_grace_stroke_at_the_start(tmp_path: Path) -> None:
    flam = [Note(0, Piece.SNARE, lead_ms=30), Note(0, Piece.SNARE), Note(3 * PPQ, Piece.KICK)]
    tempo_map = TempoMap.build([TempoChange(3 * PPQ, 250_000)], [MeterChange(0, 3, 4)])
    write_score(score(*flam, tempo_map=tempo_map), tmp_path / "flam.mid")
    again = score_from_midi(read_midi(tmp_path / "flam.mid"))
    assert again.notes["tick"].tolist()[1:] == [3 * PPQ, 6 * PPQ]
    assert again.tempo_map.tempos == (TempoChange(0, 500_000), TempoChange(6 * PPQ, 250_000))
    assert again.tempo_map.meters == (MeterChange(0, 3, 4),)


def test_half_open_strokes_bring_the_pedal(tmp_path: Path) -> None:
    hats = [Note(i * PPQ, Piece.HIHAT, Zone.BOW, openness=o) for i, o in enumerate((0.0, 0.5, 0.5, 0.25, 1.0, None))]
    write_score(score(*hats), tmp_path / "hats.mid")
    moves = [(t, m.value) for t, m in drum_track(tmp_path / "hats.mid") if m.type == "control_change"]
    assert moves == [(0, 127), (480, 64), (1440, 95), (1920, 0), (2400, 127)]
    assert [n for _, n, _ in strokes(tmp_path / "hats.mid")] == [42, 46, 46, 42, 46, 42]
    assert guess_kit_map(read_midi(tmp_path / "hats.mid")) is GENERAL_MIDI


def test_without_half_open_strokes_the_numbers_suffice(tmp_path: Path) -> None:
    write_score(score(Note(0, Piece.HIHAT, openness=0.0), Note(PPQ, Piece.HIHAT, openness=1.0)), tmp_path / "hats.mid")
    assert [m.type for _, m in drum_track(tmp_path / "hats.mid") if m.type == "control_change"] == []


def test_a_choke_is_key_pressure(tmp_path: Path) -> None:
    write_score(score(Note(0, Piece.CRASH_1, Zone.EDGE, choke_ticks=PPQ)), tmp_path / "choke.mid")
    grabs = [(t, m.note, m.value) for t, m in drum_track(tmp_path / "choke.mid") if m.type == "polytouch"]
    assert grabs == [(480, 49, 127), (480, 49, 0)]


def test_percussion_keeps_its_number(tmp_path: Path) -> None:
    write_score(score(Note(0, Piece.PERCUSSION, midi_note=76), Note(0, Piece.KICK)), tmp_path / "block.mid")
    assert sorted(n for _, n, _ in strokes(tmp_path / "block.mid")) == [36, 76]


def test_an_empty_score_is_a_file(tmp_path: Path) -> None:
    write_score(score(), tmp_path / "empty.mid")
    assert strokes(tmp_path / "empty.mid") == []
    assert score_from_midi(read_midi(tmp_path / "empty.mid")).bar_count == 1


@pytest.mark.parametrize(
    ("tempo_map", "fault"),
    [
        (TempoMap.build([TempoChange(PPQ, 1 << 24)]), f"tick {PPQ}: MIDI has no tempo below 3.58"),
        (TempoMap.build([], [MeterChange(0, 300, 4)]), "tick 0: MIDI cannot write a meter of 300/4"),
        (TempoMap.build([], [MeterChange(0, 4, 6)]), "tick 0: MIDI cannot write a meter of 4/6"),
    ],
)
def test_what_midi_cannot_say_is_refused(tmp_path: Path, tempo_map: TempoMap, fault: str) -> None:
    with pytest.raises(BadInput) as raised:
        write_score(score(tempo_map=tempo_map), tmp_path / "no.mid")
    assert str(raised.value).startswith(f"{tmp_path / 'no.mid'}: {fault}")
    assert not (tmp_path / "no.mid").exists()


def test_a_disk_that_refuses_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(DeviceError, match="cannot be written"):
        write_score(score(), tmp_path / "file" / "no.mid")


# --- a performance ----------------------------------------------------------------------------------------------------

MS = 1_000_000


def test_a_performance_is_in_real_time(tmp_path: Path) -> None:
    """120 bpm, 31250 ticks a quarter: 16 µs a tick. Read back by mido's own clock."""
    hits = [Hit(1_000 * MS, Piece.SNARE, Zone.HEAD, 90), Hit(1_250 * MS + 16_000, Piece.KICK, Zone.HEAD, 64)]
    write_performance(Performance.from_hits(hits), tmp_path / "take.mid")
    file = mido.MidiFile(tmp_path / "take.mid")
    assert file.type == 0
    now_s, played = 0.0, []
    for message in file:
        now_s += message.time
        if message.type == "note_on" and message.velocity:
            played.append((round(now_s, 9), message.note, message.velocity))
    assert played == [(1.0, 38, 90), (1.250016, 36, 64)]


def test_a_hit_before_zero_moves_the_start_and_loses_nothing(tmp_path: Path) -> None:
    hits = [Hit(at, Piece.SNARE, Zone.HEAD, 90) for at in (-8 * MS, 0, 500 * MS)]
    write_performance(Performance.from_hits(hits), tmp_path / "early.mid")
    assert performance_from_midi(read_midi(tmp_path / "early.mid")).hits["at_ns"].tolist() == [0, 8 * MS, 508 * MS]


def test_a_long_silence_is_bridged(tmp_path: Path) -> None:
    """Three hours: more than the 71 minutes that one delta time can hold."""
    hits = [Hit(0, Piece.SNARE, Zone.HEAD, 90), Hit(3 * 3600 * 1000 * MS, Piece.SNARE, Zone.HEAD, 91)]
    write_performance(Performance.from_hits(hits), tmp_path / "long.mid")
    assert performance_from_midi(read_midi(tmp_path / "long.mid")).hits["at_ns"].tolist() == [h.at_ns for h in hits]


def test_the_kits_own_numbers_stay_where_they_read_back(tmp_path: Path) -> None:
    hits = [
        Hit(0, Piece.TOM_1, Zone.HEAD, 90, midi_note=48),
        Hit(MS, Piece.HIHAT, Zone.EDGE, 80, openness=0.75, midi_note=26),
        Hit(2 * MS, Piece.SNARE, Zone.HEAD, 70, position=0.5, midi_note=38),
    ]
    write_performance(Performance.from_hits(hits), tmp_path / "td.mid")
    midi = read_midi(tmp_path / "td.mid")
    assert guess_kit_map(midi) is V_DRUMS
    again = list(performance_from_midi(midi))
    assert [(h.piece, h.zone, h.midi_note) for h in again] == [(h.piece, h.zone, h.midi_note) for h in hits]
    assert again[1].openness == pytest.approx(0.75, abs=1 / 254)
    assert again[2].position == pytest.approx(0.5, abs=1 / 254)


def test_numbers_of_an_unknown_kit_become_general_midi(tmp_path: Path) -> None:
    """A kit that sends 31 for the snare and 33 for the kick."""
    hits = [Hit(0, Piece.SNARE, Zone.HEAD, 90, midi_note=31), Hit(MS, Piece.KICK, Zone.HEAD, 90, midi_note=33)]
    write_performance(Performance.from_hits(hits), tmp_path / "dtx.mid")
    assert [n for _, n, _ in strokes(tmp_path / "dtx.mid")] == [38, 36]
    assert [h.piece for h in performance_from_midi(read_midi(tmp_path / "dtx.mid"))] == [Piece.SNARE, Piece.KICK]


def test_articulations_are_kept(tmp_path: Path) -> None:
    hits = [Hit(0, Piece.SNARE, Zone.RIM, 90, Articulation.CROSS_STICK), Hit(MS, Piece.RIDE, Zone.BELL, 90)]
    write_performance(Performance.from_hits(hits), tmp_path / "rim.mid")
    again = performance_from_midi(read_midi(tmp_path / "rim.mid"))
    assert [(h.articulation, h.zone) for h in again] == [(h.articulation, h.zone) for h in hits]


def test_chokes_are_kept(tmp_path: Path) -> None:
    crash = [Hit(0, Piece.CRASH_2, Zone.BOW, 90, midi_note=57), Hit(MS, Piece.HIHAT, Zone.EDGE, 9, midi_note=22)]
    taken = Performance.from_hits(crash, [Choke(500 * MS, Piece.CRASH_2), Choke(600 * MS, Piece.RIDE)])
    write_performance(taken, tmp_path / "choke.mid")
    again = performance_from_midi(read_midi(tmp_path / "choke.mid"))
    assert again.chokes.tolist() == taken.chokes.tolist()


def test_nothing_played_is_a_file_too(tmp_path: Path) -> None:
    write_performance(Performance.from_hits([]), tmp_path / "silence.mid")
    assert np.size(performance_from_midi(read_midi(tmp_path / "silence.mid")).hits) == 0
