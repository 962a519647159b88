"""Real playing on a TD-11 (Groove MIDI Dataset) through the preset and through rules: what is told, what is lost."""

from dataclasses import replace
from types import MappingProxyType

import mido

from station.core.events import DeviceEvent, Hit
from station.core.pieces import TOMS, Piece
from station.core.units import NS_PER_MS, ns_from_s
from station.devices.decoders import DecoderBank
from station.devices.mapping.device_map import Crosstalk, DeviceMap, Foot, Pad
from station.devices.mapping.presets import preset_named
from tests.real_data import DATA

TAKES = [
    DATA / "gmd" / take
    for take in (
        "drummer1/eval_session/1_funk-groove1_138_beat_4-4.mid",
        "drummer2/session2/1_rock_130_beat_4-4.mid",  # tells positions
        "drummer8/session2/14_afrobeat_103_beat_4-4.mid",
        "drummer9/session1/13_rock_120_beat_4-4.mid",
    )
]
TD_11 = preset_named("roland-td-11")
RULES = replace(
    TD_11,
    pads=MappingProxyType({piece: Pad(mask_ns=9 * NS_PER_MS) for piece in Piece}),
    crosstalk=(
        Crosstalk(Piece.KICK, Piece.SNARE, 0.25),
        Crosstalk(Piece.SNARE, Piece.TOM_1, 0.25),
        Crosstalk(Piece.HIHAT_PEDAL, Piece.HIHAT, 0.8),
    ),
    foot=Foot(least_travel=0.3),
)


def certain(kit: DeviceMap) -> list[DeviceEvent]:
    """What all the takes are understood as."""
    found: list[DeviceEvent] = []
    for take in TAKES:
        bank, at_s = DecoderBank(), 0.0
        bank.add("TD-11", kit)
        for message in mido.MidiFile(take):
            at_s += message.time
            if not message.is_meta:
                found += bank.feed("TD-11", bytes(message.bin()), ns_from_s(at_s)).certain
        found += bank.flush()
    return found


def test_closed_notes_are_closed_and_positions_are_of_their_pads() -> None:
    hits = [event for event in certain(TD_11) if isinstance(event, Hit)]
    closed = [hit.openness for hit in hits if hit.midi_note == 42]
    assert closed
    assert sum(openness == 0.0 for openness in closed) / len(closed) > 0.99
    with_position = {hit.piece for hit in hits if hit.position is not None}
    assert with_position
    assert with_position <= {Piece.SNARE, Piece.RIDE, *TOMS}


def test_rules_take_next_to_nothing_from_clean_playing() -> None:
    plain, ruled = (sum(isinstance(event, Hit) for event in certain(kit)) for kit in (TD_11, RULES))
    assert 0.99 * plain < ruled < plain
