"""A kit with every rule there is, played wildly: whatever the engine told, its capture replays, and no hit is invented.

Bytes may come late (a driver that stalled): their stamps lie before the time to which the engine was already advanced.
Expected: what the engine told; and of the notes that were sent, each at most once, with its own time and velocity.
"""

import tempfile
from collections import Counter
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.events import DeviceEvent, Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay
from station.devices.mapping.device_map import Crosstalk, Foot, Pad
from station.devices.mapping.presets import preset_named
from station.engine.engine import Engine
from station.engine.messages import EngineEvent, RecordCapture

DEVICE = "TD-17"
KIT = replace(
    preset_named("roland-td-17"),
    name="own",
    base="roland-td-17",
    pads=MappingProxyType({piece: Pad(threshold=3, mask_ns=9 * NS_PER_MS) for piece in Piece}),
    crosstalk=(
        Crosstalk(Piece.KICK, Piece.SNARE, 0.5, 30 * NS_PER_MS, 8 * NS_PER_MS),
        Crosstalk(Piece.SNARE, Piece.KICK, 0.5, 30 * NS_PER_MS, 3 * NS_PER_MS),
        Crosstalk(Piece.HIHAT_PEDAL, Piece.HIHAT, 0.9),
    ),
    grab_velocity=40,
    foot=Foot(least_travel=0.3, splash_ns=60 * NS_PER_MS),
)
NUMBERS = [36, 38, 42, 44, 49]
MESSAGE = st.one_of(
    st.builds(lambda n, v: bytes((0x99, n, v)), st.sampled_from(NUMBERS), st.integers(1, 127)),
    st.builds(lambda v: bytes((0xB9, 4, v)), st.integers(0, 127)),
    st.builds(lambda v: bytes((0xA9, 49, v)), st.sampled_from([0, 127])),
)
MOVES = st.lists(st.tuples(st.integers(0, 20), st.integers(0, 12), st.integers(0, 12), MESSAGE), max_size=40)
"""Each: ms to the next stamp, how late its bytes come, how many ms the engine is advanced after it; the message."""


@settings(max_examples=60)
@given(MOVES)
def test_what_was_told_is_what_a_capture_replays(moves: list[tuple[int, int, int, bytes]]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "take.cap"
        engine, told, sent = Engine(own_kit=lambda _: KIT), list[EngineEvent](), Counter[tuple[int, int, int]]()
        engine.device_found(DEVICE, 0)
        engine.handle(RecordCapture(path))
        engine.advance(0)
        at_ns = now_ns = 0
        for wait_ms, late_ms, on_ms, message in moves:
            at_ns += wait_ms * NS_PER_MS
            now_ns = max(now_ns, at_ns + late_ms * NS_PER_MS)
            told += engine.advance(now_ns)
            engine.feed(DEVICE, message, at_ns)
            now_ns += on_ms * NS_PER_MS
            told += engine.advance(now_ns)
            if message[0] == 0x99:
                sent[at_ns, message[1], message[2]] += 1
        engine.handle(RecordCapture(None))
        told += engine.advance(now_ns)
        heard: list[DeviceEvent] = [event for event in told if isinstance(event, DeviceEvent)]
        assert list(replay(read_capture(path))) == heard
        hits = Counter((hit.at_ns, hit.midi_note, hit.velocity) for hit in heard if isinstance(hit, Hit))
        assert hits <= sent
