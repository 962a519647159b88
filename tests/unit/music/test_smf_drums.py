"""What the notes of a MIDI file mean as drums, by hand."""

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.note_map import GENERAL_MIDI, V_DRUMS, KitMap
from station.core.pieces import Articulation, Dynamic, Limb, Piece, Zone
from station.core.units import PPQ
from station.music.formats.smf.midi_part import read_midi_part
from station.music.formats.smf.standard_midi import (
    MidiFile,
    guess_kit_map,
    parse_midi,
    performance_from_midi,
    score_from_midi,
)
from station.music.tempo import MeterChange, TempoChange
from tests.fakes.smf_bytes import event, file, header, meta, meter, tempo, track


def midi(data: bytes) -> MidiFile:
    return parse_midi(data, "songs/test.mid")


def drum(delta: int, number: int, velocity: int = 80) -> bytes:
    return event(delta, 0x99, number, velocity)


def pedal(delta: int, value: int) -> bytes:
    return event(delta, 0xB9, 4, value)


def press(delta: int, number: int, value: int) -> bytes:
    return event(delta, 0xA9, number, value)


def pieces(data: bytes) -> list[Piece]:
    return [hit.piece for hit in performance_from_midi(midi(data))]


# --- which notes ------------------------------------------------------------------------------------------------------


def test_channel_10_is_drums_and_others_are_not() -> None:
    assert pieces(file(drum(0, 36), event(0, 0x90, 38, 80), drum(0, 51))) == [Piece.KICK, Piece.RIDE]


@pytest.mark.parametrize("name", ["Drums", "DRUM KIT", "My kit", "Percussion", "Midi Drums", "Schlagzeug", "Batería"])
def test_a_track_that_is_named_drums_is_drums_on_any_channel(name: str) -> None:
    bass = track(meta(0, 3, b"Bass"), event(0, 0x91, 36, 80))
    drums = track(meta(0, 3, name.encode()), event(0, 0x90, 38, 80))
    assert pieces(header(1, 2) + bass + drums) == [Piece.SNARE]


@pytest.mark.parametrize("name", ["Steel Drums", "steeldrum", "Kitchen", "Piano", ""])
def test_other_names_are_not(name: str) -> None:
    data = file(meta(0, 3, name.encode()), event(0, 0x90, 61, 80))
    with pytest.raises(BadInput, match="no drums among its 1 notes"):
        pieces(data)


def test_a_named_track_with_channel_10_gives_that_channel_alone() -> None:
    """A format 0 file whose title happens to say drums."""
    assert pieces(file(meta(0, 3, b"Drum lesson"), event(0, 0x90, 38, 80), drum(0, 36))) == [Piece.KICK]


def test_a_lone_channel_of_drum_numbers_is_taken() -> None:
    groove = [event(0, 0x90, n, 80) for n in (36, 42, 38, 46)]
    assert pieces(file(*groove)) == [Piece.KICK, Piece.HIHAT, Piece.SNARE, Piece.HIHAT]


@pytest.mark.parametrize(
    "notes",
    [
        [(0x90, 36), (0x91, 38)],
        [(0x90, 36), (0x90, 60)],
        [(0x90, 43), (0x90, 48)],
    ],
    ids=["two channels", "a number of no drum", "neither kick nor snare"],
)
def test_a_lone_channel_that_may_be_a_tune_is_not(notes: list[tuple[int, int]]) -> None:
    with pytest.raises(BadInput, match=r"songs/test\.mid: no drums among its 2 notes: none on channel 10"):
        pieces(file(*[event(0, status, number, 80) for status, number in notes]))


def test_a_file_without_notes_is_silence() -> None:
    silent = midi(file(tempo(0, 400_000)))
    assert len(performance_from_midi(silent)) == 0
    score = score_from_midi(silent)
    assert (len(score), score.bar_count, score.tempo_map.bpm_at(0)) == (0, 1, 150)
    assert len(score_from_midi(midi(header(tracks=0)))) == 0


# --- which map --------------------------------------------------------------------------------------------------------

PLAIN = [drum(0, 36), drum(0, 48)]


@pytest.mark.parametrize(
    ("events", "kit_map"),
    [
        (PLAIN, GENERAL_MIDI),
        ([*PLAIN, drum(0, 26)], V_DRUMS),
        ([*PLAIN, pedal(0, 90)], V_DRUMS),
        ([*PLAIN, event(0, 0xB9, 16, 5)], V_DRUMS),
        ([*PLAIN, event(0, 0xB0, 4, 5)], GENERAL_MIDI),
        ([*PLAIN, event(0, 0xF0, 5, 0x7E, 0x7F, 0x09, 0x01, 0xF7), pedal(0, 90)], GENERAL_MIDI),
        ([*PLAIN, meta(0, 4, b"V-Drums")], V_DRUMS),
        ([*PLAIN, meta(0, 4, b"General MIDI"), drum(0, 26)], GENERAL_MIDI),
    ],
    ids=["plain", "edge", "pedal", "position", "other channel", "gm on", "named v-drums", "named gm"],
)
def test_the_map_is_declared_or_guessed(events: list[bytes], kit_map: KitMap) -> None:
    assert guess_kit_map(midi(file(*events))) is kit_map
    tom = Piece.TOM_1 if kit_map is V_DRUMS else Piece.TOM_2
    assert pieces(file(*events))[1] is tom


def test_files_of_one_kit_speak_for_each_other() -> None:
    plain, played = midi(file(*PLAIN)), midi(file(*PLAIN, pedal(0, 90)))
    declared = midi(file(*PLAIN, meta(0, 4, b"General MIDI")))
    assert guess_kit_map(plain, played) is V_DRUMS
    assert guess_kit_map(declared, played) is GENERAL_MIDI
    assert guess_kit_map(plain, declared) is GENERAL_MIDI


def test_a_map_that_is_given_is_taken() -> None:
    assert [h.piece for h in performance_from_midi(midi(file(*PLAIN)), V_DRUMS)] == [Piece.KICK, Piece.TOM_1]
    assert [n.piece for n in score_from_midi(midi(file(*PLAIN)), V_DRUMS)] == [Piece.KICK, Piece.TOM_1]


# --- a performance ----------------------------------------------------------------------------------------------------


def test_a_hit_has_all_that_its_note_says() -> None:
    hit = performance_from_midi(midi(file(tempo(0, 600_000), drum(96, 37, 99))))[0]
    assert (hit.at_ns, hit.piece, hit.zone, hit.articulation) == (
        600_000_000,
        Piece.SNARE,
        Zone.RIM,
        Articulation.CROSS_STICK,
    )
    assert (hit.velocity, hit.midi_note, hit.limb, hit.position, hit.openness) == (99, 37, Limb.UNKNOWN, None, None)


def openness(*events: bytes) -> list[float | None]:
    return [hit.openness for hit in performance_from_midi(midi(file(*events)))]


def test_without_a_pedal_the_number_says_how_open() -> None:
    assert openness(drum(0, 42), drum(0, 46), drum(0, 44), drum(0, 38)) == [0.0, 1.0, 0.0, None]


def test_the_pedal_before_a_note_refines_it() -> None:
    """127 is shut: 64 is 63/127 open, 0 wide open. What comes after a note does not touch it."""
    got = openness(drum(0, 46), pedal(1, 64), drum(1, 46), pedal(1, 0), drum(1, 46), pedal(1, 127))
    assert got == pytest.approx([1.0, 63 / 127, 1.0])


def test_shut_is_where_this_kit_says_it_is() -> None:
    """A TD-11 sends 90 for shut: the closed number mostly comes with it."""
    closed = [pedal(0, 90), drum(1, 42), drum(1, 42), pedal(0, 45), drum(1, 46)]
    assert openness(*closed) == pytest.approx([0.0, 0.0, 0.5])


def test_a_pedal_that_contradicts_the_number_is_not_believed() -> None:
    assert openness(pedal(0, 127), drum(0, 42), drum(1, 46)) == [0.0, 1.0]


def test_a_pedal_that_is_not_sent_leaves_closed_notes_closed() -> None:
    assert openness(pedal(0, 0), drum(0, 42), drum(1, 42)) == [0.0, 0.0]


def test_position_is_of_the_snare_alone() -> None:
    hits = list(performance_from_midi(midi(file(drum(0, 38), event(1, 0xB9, 16, 127), drum(1, 38), drum(0, 36)))))
    assert [h.position for h in hits] == [None, 1.0, None]


def chokes(*events: bytes) -> list[tuple[int, Piece]]:
    """(tick, piece): a tick of this division at 120 bpm lasts 1 ms."""
    grabbed = performance_from_midi(midi(file(*events, division=500))).chokes
    return [(int(row["at_ns"]) // 1_000_000, Piece(row["piece"])) for row in grabbed]


def test_a_grab_of_bow_and_edge_is_one_choke() -> None:
    both = [press(10, 49, 127), press(0, 55, 127), press(5, 49, 0), press(0, 55, 0)]
    named = meta(0, 4, b"V-Drums")
    assert chokes(named, drum(0, 49), *both, *both) == [(10, Piece.CRASH_1), (25, Piece.CRASH_1)]


def test_a_pressure_of_nothing_is_no_grab() -> None:
    assert chokes(press(0, 42, 0), drum(0, 42), press(1, 49, 0)) == []


def test_pressure_on_a_drum_is_no_choke() -> None:
    assert chokes(drum(0, 38), press(1, 38, 127)) == []


def test_a_new_stroke_lets_the_cymbal_go() -> None:
    assert chokes(drum(0, 49), press(10, 49, 127), press(5, 49, 90), drum(5, 49), press(5, 49, 127)) == [
        (10, Piece.CRASH_1),
        (25, Piece.CRASH_1),
    ]


def test_patterns_of_format_2_are_played_one_after_the_other() -> None:
    first = track(tempo(0, 1_000_000), drum(0, 36), event(96, 0x89, 36, 0))
    second = track(drum(0, 38), event(48, 0x89, 38, 0))
    data = header(2, 3) + first + second + first
    hits = performance_from_midi(midi(data)).hits
    assert hits["at_ns"].tolist() == [0, 1_000_000_000, 1_250_000_000]
    score = score_from_midi(midi(data))
    assert score.onset_ns.tolist() == hits["at_ns"].tolist()
    assert score.notes["tick"].tolist() == [0, PPQ, PPQ + PPQ // 2]


# --- a score ----------------------------------------------------------------------------------------------------------


def test_a_score_has_the_files_tempo_meter_and_title() -> None:
    conductor = track(meta(0, 3, b"Song"), meter(0, 3, 2), tempo(0, 400_000), tempo(288, 300_000), meter(0, 6, 3))
    score = score_from_midi(midi(header(1, 2) + conductor + track(drum(0, 36), drum(288 + 32, 38))))
    assert score.title == "Song"
    assert score.tempo_map.tempos == (TempoChange(0, 400_000), TempoChange(3 * PPQ, 300_000))
    assert score.tempo_map.meters == (MeterChange(0, 3, 4), MeterChange(3 * PPQ, 6, 8))
    assert score.notes["tick"].tolist() == [0, 3 * PPQ + PPQ // 3]
    assert (score.bar_count, score.end_tick) == (2, 6 * PPQ)


@pytest.mark.parametrize("named", [None, b"", b"MIDI", b"Track 1", b"untitled"])
def test_a_file_without_a_name_is_titled_by_its_path(named: bytes | None) -> None:
    name = b"" if named is None else meta(0, 3, named)
    assert score_from_midi(midi(file(name + drum(0, 36)))).title == "test"


def test_a_note_is_a_plain_stroke() -> None:
    note = score_from_midi(midi(file(drum(96, 53, 127), event(96, 0x89, 53, 0))))[0]
    assert (note.tick, note.piece, note.zone, note.velocity, note.midi_note) == (PPQ, Piece.RIDE, Zone.BELL, 127, 53)
    assert (note.dynamic, note.limb, note.duration_ticks, note.lead_ms) == (Dynamic.NORMAL, Limb.UNKNOWN, 0, 0)


@pytest.mark.parametrize("division", [1, 24, 96, 120, 192, 384, 480, 960, 1024, 15_360, 26_880])
def test_a_common_division_is_exact(division: int) -> None:
    score = score_from_midi(midi(file(drum(1, 36), drum(division, 38), division=division)))
    assert score.notes["tick"].tolist() == [PPQ // division, PPQ // division + PPQ]


def test_an_odd_division_goes_to_the_nearest_tick() -> None:
    """PPQ/1000 is 107.52."""
    score = score_from_midi(midi(file(drum(1, 36), drum(1, 38), drum(998, 36), division=1000)))
    assert score.notes["tick"].tolist() == [108, 215, PPQ]


def test_smpte_files_keep_their_times_under_their_tempo() -> None:
    """1000 ticks a second; 60 bpm for the first second, then 120: a quarter every 1000, then every 500 ticks."""
    events = [tempo(0, 1_000_000), drum(500, 36), tempo(500, 500_000), drum(0, 38), drum(250, 36)]
    score = score_from_midi(midi(file(*events, division=0xE7 << 8 | 40)))
    assert score.tempo_map.tempos == (TempoChange(0, 1_000_000), TempoChange(PPQ, 500_000))
    assert score.notes["tick"].tolist() == [PPQ // 2, PPQ, PPQ + PPQ // 2]
    assert score.onset_s.tolist() == [0.5, 1.0, 1.25]


def test_layers_of_one_strike_are_one_stroke_the_loudest() -> None:
    events = [drum(0, 35, 60), drum(0, 36, 90), drum(0, 38, 50), drum(0, 38, 40), drum(0, 40, 70), drum(0, 42, 80)]
    score = score_from_midi(midi(file(*events)))
    assert [(n.midi_note, n.velocity) for n in score] == [(36, 90), (38, 50), (40, 70), (42, 80)]
    assert len(performance_from_midi(midi(file(*events)))) == 6, "what was played stays as it was played"


def test_percussion_of_different_numbers_is_not_one_stroke() -> None:
    score = score_from_midi(midi(file(drum(0, 36), drum(0, 76), drum(0, 77), drum(0, 76))))
    assert sorted(score.notes["midi_note"].tolist()) == [36, 76, 77]


def test_a_choke_belongs_to_the_stroke_before_it() -> None:
    events = [drum(96, 49), press(24, 49, 127), press(0, 49, 0), press(24, 49, 127), press(0, 49, 0), drum(0, 57)]
    later = [drum(24, 49), press(0, 57, 1)]
    score = score_from_midi(midi(file(*events, *later)))
    choked = {(n.piece, n.tick): n.choke_ticks for n in score}
    assert choked == {
        (Piece.CRASH_1, PPQ): PPQ // 4,
        (Piece.CRASH_2, PPQ + PPQ // 2): PPQ // 4,
        (Piece.CRASH_1, PPQ + 3 * PPQ // 4): 0,
    }


def test_a_choke_before_any_stroke_is_nobodys() -> None:
    score = score_from_midi(midi(file(press(0, 49, 127), drum(5, 49))))
    assert np.count_nonzero(score.notes["choke_ticks"]) == 0


def test_on_one_tick_what_comes_first_in_the_file_came_first() -> None:
    """The pedal at the tick of a note, once before it and once after it."""
    assert openness(pedal(0, 64), drum(0, 46), pedal(0, 0)) == pytest.approx([63 / 127])


def test_on_one_tick_an_earlier_track_comes_first() -> None:
    data = header(1, 2) + track(drum(0, 36), pedal(0, 64)) + track(drum(0, 46))
    assert performance_from_midi(midi(data)).hits["openness"].tolist()[1] == pytest.approx(63 / 127)


@pytest.mark.parametrize(
    ("numbers", "struck"),
    [
        ((40, 40), [Articulation.NORMAL, Articulation.NORMAL]),
        ((37, 40), [Articulation.CROSS_STICK, Articulation.NORMAL]),
        ((38, 40), [Articulation.NORMAL, Articulation.RIM_SHOT]),
    ],
)
def test_an_electric_snare_alone_is_a_snare_and_beside_38_a_rim_shot(
    numbers: tuple[int, ...], struck: list[Articulation]
) -> None:
    data = file(*(drum(96 * (i > 0), number) for i, number in enumerate(numbers)))
    assert [note.articulation for note in read_midi_part(data, "song.mid").score] == struck
