"""The engine with kits that their owners taught it: what sounds, what is told, what a capture replays."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.core.events import DeviceEvent, Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay
from station.devices.mapping.device_map import Crosstalk, DeviceMap
from station.devices.mapping.presets import preset_named
from station.engine.engine import Engine
from station.engine.messages import EngineEvent, Notice, RecordCapture

DEVICE = "TD-17"
OWN = replace(
    preset_named("roland-td-17"),
    name="TD-17",
    title="my kit",
    base="roland-td-17",
    crosstalk=(Crosstalk(Piece.KICK, Piece.SNARE, 0.4, 30 * NS_PER_MS, 5 * NS_PER_MS),),
)


def own_kit(device: str) -> DeviceMap | None:
    return OWN if device == DEVICE else None


def broken_kit(device: str) -> DeviceMap | None:
    raise BadInput(f"{device}.toml", "line 3, column 5", "expected a number")


def note(number: int, velocity: int) -> bytes:
    return bytes((0x99, number, velocity))


def hits(events: list[EngineEvent]) -> list[tuple[float, Piece]]:
    return [(event.at_ns / NS_PER_MS, event.piece) for event in events if isinstance(event, Hit)]


def test_an_own_kit_holds_from_the_moment_its_device_is_found_and_is_told_once() -> None:
    engine = Engine(own_kit=own_kit)
    for _ in range(2):
        engine.device_found(DEVICE, 0)
    engine.device_found("other", 0)
    notices = [event.text for event in engine.advance(0) if isinstance(event, Notice)]
    assert notices == ["TD-17 is understood as you taught it: my kit"]
    engine.feed(DEVICE, note(36, 100), 10 * NS_PER_MS)
    engine.feed(DEVICE, note(38, 20), 20 * NS_PER_MS)
    assert hits(engine.advance(100 * NS_PER_MS)) == [(10, Piece.KICK)]


def test_a_broken_file_is_told_with_its_place_and_the_preset_holds() -> None:
    engine = Engine(own_kit=broken_kit)
    engine.device_found(DEVICE, 0)
    engine.feed(DEVICE, note(26, 100), 1)
    events = engine.advance(2)
    (text,) = [event.text for event in events if isinstance(event, Notice)]
    assert text == "TD-17.toml: line 3, column 5: expected a number; TD-17 is taken for Roland TD-17"
    assert hits(events) == [(1e-6, Piece.HIHAT)]


def test_a_doubtful_hit_is_told_by_the_clock_with_its_own_time() -> None:
    engine = Engine(own_kit=own_kit)
    engine.device_found(DEVICE, 0)
    engine.feed(DEVICE, note(38, 20), 10 * NS_PER_MS)
    assert hits(engine.advance(18 * NS_PER_MS)) == []
    assert hits(engine.advance(19 * NS_PER_MS)) == [(10, Piece.SNARE)]


@pytest.mark.parametrize("step_ms", [1, 20])
def test_a_capture_replays_what_was_told_even_if_bytes_came_late(tmp_path: Path, step_ms: int) -> None:
    """A driver hands over a kick 8 ms after it was played: whether the soft snare before it was already told depends
    on how often the engine was advanced, and the capture knows."""
    engine, path = Engine(own_kit=own_kit), tmp_path / "take.cap"
    engine.device_found(DEVICE, 0)
    engine.handle(RecordCapture(path))
    told: list[EngineEvent] = engine.advance(0)
    engine.feed(DEVICE, note(38, 20), 10 * NS_PER_MS)
    for now_ms in range(10, 20, step_ms):
        told += engine.advance(now_ms * NS_PER_MS)
    engine.feed(DEVICE, note(36, 100), 12 * NS_PER_MS)
    engine.feed(DEVICE, note(38, 20), 50 * NS_PER_MS)
    engine.handle(RecordCapture(None))
    told += engine.advance(60 * NS_PER_MS)
    expected = [(10, Piece.SNARE)] if step_ms == 1 else []
    assert hits(told) == [*expected, (12, Piece.KICK), (50, Piece.SNARE)]
    replayed: list[DeviceEvent] = list(replay(read_capture(path)))
    assert replayed == [event for event in told if isinstance(event, Hit)]
