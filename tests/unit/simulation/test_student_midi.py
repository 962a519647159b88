"""What the engine's decoder reads from the bytes is what the student played; single messages after MIDI's tables."""

import math

import pytest

from station.core.errors import BadInput
from station.core.events import Choke, DeviceEvent, Hit, PedalMoved
from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.presets import PRESETS
from station.devices.midi.midi_decoder import MidiDecoder
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.simulation.student_midi import TimedBytes, as_sent, midi_stream
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play
from tests.fakes import scores

GM = PRESETS["general-midi"]
HUMAN = parse_spec("seed=2,sd_ms=15,miss_pct=5,extra_pct=5,wrong_piece_pct=5,velocity_sd=9")


def _decoded(messages: list[TimedBytes], preset: DeviceMap) -> list[DeviceEvent]:
    decoder = MidiDecoder(preset)
    return [event for at_ns, data in messages for event in decoder.feed(data, at_ns)]


def _without_limbs(performance: Performance) -> list[Hit]:
    hits = performance.hits.copy()
    hits["limb"] = Limb.UNKNOWN
    return list(Performance.from_array(hits))


def _close(a: Hit, b: Hit) -> bool:
    """Alike, with openness as a 32-bit float."""
    same = [getattr(a, n) == getattr(b, n) for n in ("at_ns", "piece", "zone", "velocity", "articulation", "midi_note")]
    open_a, open_b = (math.nan if h.openness is None else h.openness for h in (a, b))
    return all(same) and (a.openness is None) == (b.openness is None) and not abs(open_a - open_b) > 1e-6


@pytest.mark.parametrize("preset", PRESETS.values(), ids=PRESETS)
def test_the_decoder_reads_what_was_played(preset: DeviceMap) -> None:
    for score in (scores.rock_beat(20), scores.swing_ride(10), scores.flams(10), scores.beat_and_fill(3)):
        played = play(score, HUMAN, preset)
        hits = [event for event in _decoded(played.midi, preset) if isinstance(event, Hit)]
        expected = _without_limbs(played.performance)
        assert len(hits) == len(expected)
        assert all(_close(a, b) for a, b in zip(hits, expected, strict=True))


def _one(note: Note) -> Score:
    return Score.from_notes([note], TempoMap.constant(120))


def _messages(note: Note, preset: DeviceMap = GM) -> list[TimedBytes]:
    return play(_one(note), parse_spec("seed=1"), preset).midi


@pytest.mark.parametrize(
    ("note", "number"),
    [
        (Note(0, Piece.KICK), 36),
        (Note(0, Piece.SNARE), 38),
        (Note(0, Piece.SNARE, Zone.RIM, articulation=Articulation.CROSS_STICK), 37),
        (Note(0, Piece.SNARE, Zone.RIM, articulation=Articulation.RIM_SHOT), 40),
        (Note(0, Piece.RIDE, Zone.BELL), 53),
        (Note(0, Piece.RIDE, Zone.BOW), 51),
        (Note(0, Piece.CRASH_2, Zone.EDGE), 57),
        (Note(0, Piece.FLOOR_TOM_1), 43),
        (Note(0, Piece.HIHAT_PEDAL, Zone.PEDAL, articulation=Articulation.CHICK), 44),
        (Note(0, Piece.PERCUSSION), 60),
        (Note(0, Piece.PERCUSSION, midi_note=75), 75),
    ],
)
def test_numbers_are_those_of_general_midi(note: Note, number: int) -> None:
    assert _messages(note) == [(0, bytes((0x99, number, 80))), (40 * NS_PER_MS, bytes((0x89, number, 64)))]


@pytest.mark.parametrize(
    ("openness", "control", "number"), [(0.0, 127, 42), (None, 127, 42), (0.25, 95, 42), (1.0, 0, 46)]
)
def test_the_pedal_comes_before_the_hat(openness: float | None, control: int, number: int) -> None:
    first, second, _ = _messages(Note(0, Piece.HIHAT, Zone.BOW, openness=openness))
    assert (first, second) == ((0, bytes((0xB9, 4, control))), (0, bytes((0x99, number, 80))))


def test_a_kit_without_a_pedal_controller_says_it_by_the_number() -> None:
    nitro = PRESETS["alesis-nitro"]
    assert _messages(Note(0, Piece.HIHAT, Zone.BOW, openness=0.45), nitro)[0] == (0, bytes((0x99, 23, 80)))


def test_a_grabbed_cymbal_is_aftertouch_on_and_off() -> None:
    score = _one(Note(0, Piece.CRASH_1, Zone.EDGE, choke_ticks=PPQ))
    played = play(score, parse_spec("bias_ms=10"))
    assert played.midi[-2:] == [(510 * NS_PER_MS, b"\xa9\x31\x7f"), (610 * NS_PER_MS, b"\xa9\x31\x00")]
    chokes = [event for event in _decoded(played.midi, GM) if isinstance(event, Choke)]
    assert chokes == [Choke(510 * NS_PER_MS, Piece.CRASH_1)]
    assert played.performance.chokes.tolist() == [(510 * NS_PER_MS, Piece.CRASH_1)]


def test_a_note_is_off_before_it_is_struck_again() -> None:
    hits = [Hit(i * 20 * NS_PER_MS, Piece.SNARE, Zone.HEAD, 80) for i in range(3)]
    messages = midi_stream(as_sent(Performance.from_hits(hits), GM), GM)
    assert [(at // NS_PER_MS, data[0]) for at, data in messages] == [
        (0, 0x99), (10, 0x89), (20, 0x99), (30, 0x89), (40, 0x99), (80, 0x89),
    ]  # fmt: skip


def test_messages_are_in_order_of_time() -> None:
    times = [at for at, _ in play(scores.rock_beat(20), HUMAN).midi]
    assert times == sorted(times)


def test_only_known_status_bytes_are_sent() -> None:
    played = play(scores.rock_beat(20), HUMAN)
    assert {data[0] for _, data in played.midi} == {0x99, 0x89, 0xB9}
    assert all(len(data) == 3 and max(data[1:]) < 128 for _, data in played.midi)
    moves = [e for e in _decoded(played.midi, GM) if isinstance(e, PedalMoved)]
    assert [move.openness for move in moves] == [0.0]


def test_a_piece_that_the_kit_lacks_is_named() -> None:
    with pytest.raises(BadInput, match="Roland TD-17: china: this kit has no such piece"):
        _messages(Note(0, Piece.CHINA), PRESETS["roland-td-17"])
