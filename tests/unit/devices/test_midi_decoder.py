"""Bytes as the modules' MIDI implementations and users' dumps give them; expected strokes from their note tables."""

from dataclasses import replace
from types import MappingProxyType

import pytest

from station.core.events import Choke, DeviceEvent, Hit, PedalMoved, Switched
from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.devices.mapping.presets import GENERAL_MIDI_PRESET, preset_named
from station.devices.midi.midi_decoder import MidiDecoder

AT_NS = 5_000


def decode(data: str, preset: str = "roland-td-17") -> list[DeviceEvent]:
    return MidiDecoder(preset_named(preset), "kit").feed(bytes.fromhex(data), AT_NS)


def hits(data: str, preset: str = "roland-td-17") -> list[Hit]:
    return [event for event in decode(data, preset) if isinstance(event, Hit)]


def test_a_note_is_a_hit_with_its_velocity_time_note_and_device() -> None:
    assert decode("99 26 64") == [
        Hit(AT_NS, Piece.SNARE, Zone.HEAD, 100, Articulation.NORMAL, None, 38, device="kit"),
    ]


def test_every_channel_counts() -> None:
    assert [hit.piece for hit in hits("90 24 64 9f 26 64")] == [Piece.KICK, Piece.SNARE]


def test_a_note_may_mean_another_thing_on_one_channel() -> None:
    mine = MappingProxyType({(3, 0x26): NoteMeaning(Piece.COWBELL), (3, 0x31): NoteMeaning(Piece.CHINA, Zone.EDGE)})
    decoder = MidiDecoder(replace(preset_named("roland-td-17"), channel_notes=mine), "kit")
    events = decoder.feed(bytes.fromhex("92 26 64 99 26 64 92 24 64 a2 31 7f a9 31 7f"), AT_NS)
    assert [event.piece for event in events if isinstance(event, Hit | Choke)] == [
        Piece.COWBELL,
        Piece.SNARE,
        Piece.KICK,
        Piece.CHINA,
        Piece.CRASH_1,
    ]


@pytest.mark.parametrize(
    "data",
    [
        pytest.param("99 26 00", id="velocity 0 is note off"),
        pytest.param("89 26 40", id="note off"),
        pytest.param("b9 58 40", id="high-resolution velocity prefix"),
        pytest.param("fe f8 fe", id="active sensing and clock"),
        pytest.param("f0 41 10 26 64 f7", id="system exclusive with note-like data"),
        pytest.param("a9 2e 00", id="aftertouch 0, which the VQD106 sends before its hi-hat notes"),
        pytest.param("a9 26 7f", id="aftertouch on a drum"),
        pytest.param("e9 00 40", id="pitch bend"),
    ],
)
def test_what_is_no_stroke_makes_no_event(data: str) -> None:
    assert decode(data) == []


@pytest.mark.parametrize(
    ("data", "switches"),
    [
        ("b9 40 7f", ["cc=64"]),
        ("b9 40 40", ["cc=64"]),
        ("b9 40 3f", []),  # 0 to 63 is off
        ("c9 05", ["program=5"]),
        ("b9 04 7f", []),  # the pedal of the hi-hat is none
    ],
)
def test_a_switch_on_the_floor(data: str, switches: list[str]) -> None:
    """MIDI 1.0 Detailed Specification: switches are off at 0 to 63, on at 64 to 127."""
    told = [event for event in decode(data) if isinstance(event, Switched)]
    assert told == [Switched(AT_NS, switch, "kit") for switch in switches]


@pytest.mark.parametrize(
    ("data", "velocities"),
    [
        pytest.param("b9 58 40 99 26 64", [100.5], id="64 of 128 is a half"),
        pytest.param("b9 58 00 99 26 64", [100.0], id="a prefix of nothing"),
        pytest.param("b9 58 20 99 26 64 99 26 64", [100.25, 100.0], id="for one note only"),
        pytest.param("b9 58 20 99 24 00 99 26 64", [100.0], id="a note off takes its own"),
        pytest.param("b9 58 20 89 24 40 99 26 64", [100.0], id="so does a real note off"),
        pytest.param("b9 58 20 90 26 64 99 26 64", [100.0, 100.25], id="for its own channel only"),
        pytest.param("b9 58 20 b9 04 40 99 26 64", [100.25], id="other controllers may come between"),
        pytest.param("b9 58 20 58 60 99 26 64", [100.75], id="the last prefix counts"),
    ],
)
def test_a_velocity_prefix_makes_the_next_note_of_its_channel_finer(data: str, velocities: list[float]) -> None:
    """MMA CA-031: velocity in 14 bits, of which the prefix bears the lower seven."""
    assert [hit.velocity + hit.velocity_fraction for hit in hits(data)] == velocities


def test_a_kit_that_was_unplugged_forgets_a_velocity_prefix() -> None:
    decoder = MidiDecoder(preset_named("roland-td-27"))
    decoder.feed(bytes.fromhex("b9 58 40"), AT_NS)
    decoder.reset()
    (hit,) = decoder.feed(bytes.fromhex("99 26 64"), AT_NS)
    assert isinstance(hit, Hit)
    assert hit.velocity_fraction == 0.0


def test_an_unknown_note_is_percussion_and_not_lost() -> None:
    (hit,) = hits("99 66 50")
    assert (hit.piece, hit.midi_note) == (Piece.PERCUSSION, 0x66)


# --- the hi-hat: controller 4 goes from 0 open to 127 closed on Roland modules ---------------------------------------


def test_the_pedal_tells_the_openness_of_the_next_stroke() -> None:
    (hit,) = hits("b9 04 40 99 2e 64")
    assert hit.openness == pytest.approx(63 / 127)


def test_the_pedal_keeps_its_place_from_stroke_to_stroke() -> None:
    assert [hit.openness for hit in hits("b9 04 7f 99 2a 64 99 16 64")] == [0.0, 0.0]


def test_without_a_pedal_the_note_tells() -> None:
    assert [hit.openness for hit in hits("99 2e 64 99 2a 64")] == [1.0, 0.0]


def test_a_controller_that_is_stuck_does_not_close_an_open_hat() -> None:
    assert [hit.openness for hit in hits("b9 04 7f 99 2e 64", "general-midi")] == [1.0]


def test_a_note_that_does_not_tell_takes_the_pedals_word() -> None:
    assert [hit.openness for hit in hits("99 08 64 b9 04 00 99 08 64", "alesis-crimson-2")] == [None, 1.0]


def test_a_moving_pedal_is_told_once_a_place() -> None:
    assert decode("b9 04 00 b9 04 00 b9 04 7f") == [PedalMoved(AT_NS, 1.0, "kit"), PedalMoved(AT_NS, 0.0, "kit")]


def test_a_pedal_that_ends_at_90_is_shut_there() -> None:
    assert decode("b9 04 5a", "roland-vqd106") == [PedalMoved(AT_NS, 0.0, "kit")]


def test_other_pieces_do_not_take_the_pedals_place() -> None:
    assert [hit.openness for hit in hits("b9 04 40 99 26 64 99 2c 64")] == [None, 0.0]


# --- chokes ----------------------------------------------------------------------------------------------------------


def test_a_grabbed_cymbal_is_choked_once_though_bow_and_edge_both_say_so() -> None:
    assert decode("a9 31 7f a9 37 7f a9 31 00 a9 37 00") == [Choke(AT_NS, Piece.CRASH_1, "kit")]


def test_a_cymbal_can_be_grabbed_again() -> None:
    assert len(decode("a9 33 7f a9 33 00 a9 33 7f")) == 2


def test_a_stroke_ends_a_grip_whose_release_was_lost() -> None:
    events = decode("a9 33 7f 99 33 64 a9 33 7f")
    assert [type(event) for event in events] == [Choke, Hit, Choke]


def test_a_note_may_say_that_a_cymbal_was_grabbed() -> None:
    kit = replace(preset_named("roland-td-17"), choke_notes={60: Piece.CRASH_1})
    assert MidiDecoder(kit, "kit").feed(bytes.fromhex("99 3c 40 99 3c 00"), AT_NS) == [
        Choke(AT_NS, Piece.CRASH_1, "kit")
    ]


def test_a_one_note_hi_hat_is_as_open_as_its_pedal() -> None:
    assert [hit.openness for hit in hits("99 2e 64 b9 04 7f 99 2e 64 b9 04 00 99 2e 64", "alesis-dm10")] == [
        None,
        0.0,
        1.0,
    ]


def test_the_restart_state_of_a_decoder_brings_another_to_it() -> None:
    first, second = (MidiDecoder(preset_named("roland-td-11"), "kit") for _ in range(2))
    first.feed(bytes.fromhex("b9 04 00 b9 04 5a b9 04 7f b9 10 40 99 2e"), 0)
    second.feed(first.restart_state(), 1)
    rest = bytes.fromhex("64 99 26 64 99 2a 64")
    assert second.feed(rest, 2) == first.feed(rest, 2)


# --- position --------------------------------------------------------------------------------------------------------


def test_the_position_comes_before_its_note() -> None:
    assert [hit.position for hit in hits("b9 10 7f 99 26 64 99 24 64", "roland-td-27")] == [1.0, None]


def test_a_position_is_that_of_the_next_stroke_on_its_pieces_alone() -> None:
    stream = "b9 10 00 b9 12 7f 99 24 64 99 30 64 99 26 64 99 2d 64 99 26 64"
    expected = [None, 1.0, 0.0, None, None]
    assert [hit.position for hit in hits(stream, "roland-td-11")] == expected


def test_a_kit_without_position_ignores_the_controller() -> None:
    assert [hit.position for hit in hits("b9 10 7f 99 26 64", "alesis-nitro")] == [None]


# --- state -----------------------------------------------------------------------------------------------------------


def test_each_message_has_the_time_of_the_bytes_that_completed_it() -> None:
    decoder = MidiDecoder(GENERAL_MIDI_PRESET)
    assert decoder.feed(bytes.fromhex("99 26 64 26"), 10)[0].at_ns == 10
    assert decoder.feed(bytes.fromhex("40"), 20)[0].at_ns == 20


def test_a_reset_forgets_pedal_and_half_a_message() -> None:
    decoder = MidiDecoder(preset_named("roland-td-17"))
    decoder.feed(bytes.fromhex("b9 04 00 99 26"), 0)
    decoder.reset()
    assert decoder.feed(bytes.fromhex("64"), 0) == []
    (hit,) = decoder.feed(bytes.fromhex("99 2a 64"), 0)
    assert isinstance(hit, Hit)
    assert hit.openness == 0.0
