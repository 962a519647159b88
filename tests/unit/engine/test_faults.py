"""What the world does to an engine: floods, plugs that come and go, a clock that is set, a disk that is full.

Time is moved by hand; wires, files and threads are real. Expected values are what was sent.
"""

import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.events import DeviceEvent, DeviceFound, DeviceLost, Hit
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay
from station.devices.device_ports import parse_device, ports_for
from station.devices.port_watch import PortWatch
from station.engine.engine import Engine
from station.engine.engine_step import Runner
from station.engine.messages import EngineEvent, Play, RecordCapture, Started
from tests.fakes.cues import clicks
from tests.fakes.ports import FakeDriver

PORT = "TD-17 20:0"
SNARE = bytes.fromhex("99 26 64")
FLOOD_HZ, FLOOD_S = 1_000, 20

FULL_DISK = """
import resource, sys, time
from pathlib import Path
from station.devices.capture.capture import RecordKind, CaptureRecord
from station.devices.capture.capture_writer import CaptureFile
_, most = resource.getrlimit(resource.RLIMIT_FSIZE)
resource.setrlimit(resource.RLIMIT_FSIZE, (500, most))
capture = CaptureFile(Path(sys.argv[1]), 0)
for index in range(100):
    capture.append(CaptureRecord(RecordKind.BYTES, 1, index, b"hit"))
while capture.fault is None:
    time.sleep(0.01)
print(capture.fault, flush=True)
resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
for index in range(100, 200):
    capture.append(CaptureRecord(RecordKind.BYTES, 1, index, b"hit"))
capture.close(200)
print(capture.fault, flush=True)
"""
"""A limit on the size of files stands for a disk that is full and then is not: a write is cut short, then refused."""

on_linux = pytest.mark.skipif(sys.platform != "linux", reason="ptys and /proc are Linux's")


def device_events(events: list[EngineEvent]) -> list[DeviceEvent]:
    return [event for event in events if isinstance(event, DeviceEvent)]


def test_a_flood_costs_no_hit(tmp_path: Path) -> None:
    """1,000 messages a second: strokes, note offs, the pedal and the clock; looked at every 4 ms.

    The soak plays a minute of it.
    """
    engine, driver = Engine(), FakeDriver(PORT)
    runner = Runner(engine, [PortWatch(driver)], None)
    runner.start(0)
    runner.step(0)
    engine.handle(RecordCapture(tmp_path / "flood.cap"))
    heard: list[EngineEvent] = []
    sent = []
    for index in range(FLOOD_HZ * FLOOD_S):
        at_ns = index * NS_PER_S // FLOOD_HZ
        velocity = 1 + index % 127
        driver.play(PORT, (bytes((0x99, 38, velocity)), SNARE[:2] + b"\0", b"\xb9\x04\x40", b"\xf8")[index % 4], at_ns)
        if index % 4 == 0:
            sent.append((at_ns, velocity))
            heard += runner.step(at_ns)
    heard += runner.step(FLOOD_S * NS_PER_S)
    runner.close()
    assert [(hit.at_ns, hit.velocity) for hit in heard if isinstance(hit, Hit)] == sent
    replayed = replay(read_capture(tmp_path / "flood.cap"))
    assert sum(isinstance(event, Hit) for event in replayed) == len(sent)


@on_linux
def test_a_hundred_plug_cycles_leave_no_thread_file_or_port(tmp_path: Path) -> None:
    """A real pty comes and goes, each time in the middle of a message, each time heard and recorded."""
    engine = Engine()
    with SerialKit(tmp_path / "ttyUSB0", plugged=False) as kit:
        runner = Runner(engine, [PortWatch(ports_for(parse_device(kit.device), None), kit.device)], None)
        runner.start(0)
        runner.step(0)
        files, threads = held()
        engine.handle(RecordCapture(tmp_path / "plugs.cap"))
        now_ns, events = 0, list[EngineEvent]()
        for _ in range(100):
            now_ns += NS_PER_S
            kit.plug()
            events += runner.step(now_ns)
            kit.play(SNARE + SNARE[:2])
            events += _until_hit(runner, now_ns)
            kit.unplug()
            now_ns += NS_PER_S
            events += runner.step(now_ns)
        engine.handle(RecordCapture(None))
        runner.step(now_ns)
        left_files, left_threads = held()
        assert left_files <= files  # what an earlier test left may go meanwhile
        assert left_threads <= threads
        runner.close()
    kinds = [type(event) for event in device_events(events)]
    assert kinds == [DeviceFound, Hit, DeviceLost] * 100
    assert [type(event) for event in replay(read_capture(tmp_path / "plugs.cap"))] == kinds


def held() -> tuple[set[str], set[threading.Thread]]:
    """The numbers of the open files, and the threads."""
    return set(os.listdir("/proc/self/fd")), set(threading.enumerate())  # noqa: PTH208 - names alone


def _until_hit(runner: Runner, now_ns: int) -> list[EngineEvent]:
    """Step, with time at a stand, until the pty has passed a stroke on."""
    events: list[EngineEvent] = []
    give_up_s = time.monotonic() + 60.0
    while time.monotonic() < give_up_s and not any(isinstance(event, Hit) for event in events):
        events += runner.step(now_ns + NS_PER_MS)
    return events


def test_a_wall_clock_that_is_set_moves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Daylight saving, a time server, a user: session time is another clock, and captures keep to it."""
    wall_ns = [1_700_000_000 * NS_PER_S]
    monkeypatch.setattr(time, "time_ns", lambda: wall_ns[0])
    engine = Engine()
    engine.advance(0)
    engine.device_found("TD-17", 0)
    engine.handle(RecordCapture(tmp_path / "take.cap"))
    engine.handle(Play(clicks([0]), NS_PER_S))
    events: list[EngineEvent] = []
    for at_ms in range(0, 3_000, 10):
        if at_ms % 1_000 == 500:
            wall_ns[0] += (-7_200, 10**6, -(10**9))[at_ms // 1_000] * NS_PER_S
            engine.handle(RecordCapture(tmp_path / "take.cap"))  # the capture is left and continued under the new time
        engine.feed("TD-17", SNARE, at_ms * NS_PER_MS)
        events += engine.advance(at_ms * NS_PER_MS)
    engine.close()
    assert [hit.at_ns for hit in events if isinstance(hit, Hit)] == [at * NS_PER_MS for at in range(0, 3_000, 10)]
    assert [event.zero_ns for event in events if isinstance(event, Started)] == [NS_PER_S]
    replayed = [event.at_ns for event in replay(read_capture(tmp_path / "take.cap")) if isinstance(event, Hit)]
    assert replayed == [hit.at_ns for hit in events if isinstance(hit, Hit)]


def test_a_computer_that_slept_for_an_hour_goes_on() -> None:
    """Session time jumps: the kit is still there or is found again, and what is played then has its own time."""
    driver = FakeDriver(PORT)
    runner = Runner(Engine(), [PortWatch(driver)], None)
    runner.start(0)
    runner.step(NS_PER_MS)
    awake_ns = 3_600 * NS_PER_S
    driver.play(PORT, SNARE, awake_ns)
    events = runner.step(awake_ns)
    assert [event.at_ns for event in events if isinstance(event, Hit)] == [awake_ns]
    assert not any(isinstance(event, DeviceLost) for event in events)


@pytest.mark.skipif(sys.platform == "win32", reason="no limit on the size of files stands for a full disk here")
def test_a_disk_that_was_full_gets_every_record_once_there_is_room(tmp_path: Path) -> None:
    path = tmp_path / "take.cap"
    words = [sys.executable, "-c", FULL_DISK, str(path)]
    told = subprocess.run(words, capture_output=True, text=True, check=True, timeout=100).stdout.splitlines()
    assert "the capture waits in memory" in told[0]
    assert told[1] == "None"
    capture = read_capture(path)
    assert capture.complete
    assert [record.at_ns for record in capture.records if record.payload == b"hit"] == list(range(200))
