"""A serial kit and the real engine process: a pty speaks raw MIDI, is unplugged in mid-message and comes back.

The expected values are what was sent.
"""

import sys
import time
from pathlib import Path

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.events import DeviceFound, DeviceLost, Hit
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay
from station.devices.device_ports import parse_devices
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
from station.engine.messages import CaptureSaved, Ready, RecordCapture
from tests.fakes.engine_listener import EngineListener

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")

STROKES = [bytes((0x99, 36 + 2 * (index % 2), 60 + index)) for index in range(40)]
APART_S = 0.05
"""Two hands as fast as they play, so that nothing looks like the tremor of a pad."""


def heard_from(listener: EngineListener, kit: SerialKit) -> DeviceFound:
    """Wait until the engine has found `kit`."""
    found = listener.until(lambda event: isinstance(event, DeviceFound) and event.device == kit.device)
    assert isinstance(found, DeviceFound)
    return found


def played(kit: SerialKit, strokes: list[bytes]) -> list[int]:
    """Play `strokes` on the kit; when the last byte of each was sent."""
    sent_ns = []
    for stroke in strokes:
        time.sleep(APART_S)
        sent_ns.append(kit.play_at_wire_speed(stroke, 31_250)[-1])
    return sent_ns


def test_two_serial_kits_are_heard_unplugged_and_heard_again(tmp_path: Path) -> None:
    with SerialKit(tmp_path / "ttyUSB0") as first, SerialKit(tmp_path / "ttyUSB1") as second:
        kits = parse_devices(f"{first.device}; {second.device}@115200")
        with EngineProcess(EngineConfig(kits=kits, sound=False)) as engine:
            listener = EngineListener(engine)
            listener.until(lambda event: isinstance(event, Ready))
            heard_from(listener, first)
            heard_from(listener, second)
            assert (first.rate(), second.rate()) == ((31_250, 31_250), (115_200, 115_200))
            engine.send(RecordCapture(tmp_path / "take.cap"))
            sent_ns = played(first, STROKES[:20])
            listener.until(lambda event: isinstance(event, Hit) and event.velocity == 79)  # a hang-up drops the unread
            first.play(STROKES[0][:2])
            first.unplug()
            listener.until(lambda event: isinstance(event, DeviceLost) and event.device == first.device)
            second.play(STROKES[39])
            first.plug()
            plugged_ns = time.monotonic_ns()
            listener.events.clear()
            assert heard_from(listener, first).at_ns - plugged_ns < 10 * NS_PER_S  # 1 s, and what a busy machine adds
            sent_ns += played(first, STROKES[20:])
            listener.until(
                lambda event: isinstance(event, Hit) and (event.device, event.velocity) == (first.device, 99)
            )
            engine.send(RecordCapture(None))
            listener.until(lambda event: isinstance(event, CaptureSaved) and event.path is None)
    hits = [event for event in replay(read_capture(tmp_path / "take.cap")) if isinstance(event, Hit)]
    by_first = [hit for hit in hits if hit.device == first.device]
    assert [bytes((0x99, hit.midi_note, hit.velocity)) for hit in by_first] == STROKES
    assert [hit.velocity for hit in hits if hit.device == second.device] == [99]
    late_ns = sorted(hit.at_ns - sent for hit, sent in zip(by_first, sent_ns, strict=True))
    assert late_ns[0] > -NS_PER_MS
    assert late_ns[len(late_ns) // 10] < 5 * NS_PER_MS  # a busy machine lets many wait, and wrong stamps are all late
