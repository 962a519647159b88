"""Game drums and a foot switch from their reports to events, kept in a capture and played again."""

from pathlib import Path

from station.core.events import DeviceEvent, DeviceFound, Hit, Switched
from station.core.pieces import Piece
from station.devices.capture.capture import RecordKind, read_capture
from station.devices.capture.replay import replay
from station.engine.engine import Engine
from station.engine.messages import RecordCapture
from tests.fakes.hid_devices import drum_report, key_report

DRUMS, PEDAL = "Rock Band drums (Wii)", "Foot switch (PCsensor)"
SNARE, BOTH = drum_report("circle l3", b12=55), drum_report("circle l3 l1", b12=55)


def test_a_capture_replays_to_the_same_hits_and_switches(tmp_path: Path) -> None:
    engine, path = Engine(), tmp_path / "drums.capture"
    for device in (DRUMS, PEDAL):
        engine.device_found(device, 0)
    engine.feed(DRUMS, SNARE, 1)  # and is held as the capture begins
    engine.advance(2)
    engine.handle(RecordCapture(path))
    for at_ns, report in enumerate((BOTH, drum_report(), SNARE, drum_report("triangle r3 up", b11=155)), 3):
        engine.feed(DRUMS, report, at_ns)
    engine.feed(PEDAL, key_report(5), 9)
    told = [event for event in engine.advance(10) if isinstance(event, Hit | Switched)]
    engine.handle(RecordCapture(None))
    assert [(event.at_ns, event.piece) for event in told if isinstance(event, Hit)] == [
        (3, Piece.KICK),
        (5, Piece.SNARE),
        (6, Piece.HIHAT),
    ]
    assert told[-1] == Switched(9, "key=5", PEDAL)
    assert [event for event in replay(read_capture(path)) if not isinstance(event, DeviceFound)] == told


def test_a_capture_has_every_report_as_it_came(tmp_path: Path) -> None:
    engine, path = Engine(), tmp_path / "drums.capture"
    engine.handle(RecordCapture(path))
    engine.feed(DRUMS, SNARE, 1)
    engine.feed(DRUMS, b"\0" + drum_report(), 2)
    engine.handle(RecordCapture(None))
    records = [record for record in read_capture(path).records if record.kind == RecordKind.BYTES]
    assert [(record.at_ns, record.payload) for record in records if record.payload] == [
        (1, SNARE),
        (2, b"\0" + drum_report()),
    ]
    events: list[DeviceEvent] = list(replay(read_capture(path)))
    assert [event.at_ns for event in events if isinstance(event, Hit)] == [1]
