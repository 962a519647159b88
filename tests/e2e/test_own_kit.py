"""A kit is taught and from then on understood so: the real command, a pty that speaks as its module, the real engine.

The module is home-made: its kick is note 61 and makes the snare, note 62, answer 3 ms before it.
"""

import io
import sys
import time
from pathlib import Path

import pytest

from station.bench.rigs.devices.serial_kit import SerialKit
from station.cli.command_line import main
from station.core.events import DeviceFound, Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay
from station.devices.device_ports import parse_devices
from station.devices.mapping.device_file import own_kit_path
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
from station.engine.messages import CaptureSaved, Notice, Ready, RecordCapture
from tests.fakes.engine_listener import EngineListener

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")

RULES = """
notes.61 = { piece = "kick" }
notes.62 = { piece = "snare" }
[[crosstalk]]
source = "kick"
victim = "snare"
share = 0.3
before_ms = 8
"""


def test_a_kit_is_taught_and_practice_understands_it_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("JACK_DEFAULT_SERVER", "drum-test-no-such-server")
    monkeypatch.setenv("JACK_NO_START_SERVER", "1")
    monkeypatch.setattr(sys, "stdin", io.StringIO("f\n\n"))  # leave all to the preset, and keep it
    with SerialKit(tmp_path / "ttyUSB0") as kit:
        assert main(["devices", "learn", "--kit", kit.device, "--seconds", "20"]) == 0
        path = own_kit_path(kit.device)
        path.write_text(path.read_text() + RULES)
        with EngineProcess(EngineConfig(kits=parse_devices(kit.device), sound=False)) as engine:
            listener = EngineListener(engine)
            listener.until(lambda event: isinstance(event, Ready))
            listener.until(lambda event: isinstance(event, DeviceFound))
            listener.until(lambda event: isinstance(event, Notice) and "as you taught it" in event.text)
            engine.send(RecordCapture(tmp_path / "take.cap"))
            listener.until(lambda event: isinstance(event, CaptureSaved))
            kit.play(bytes((0x99, 62, 20, 0x99, 61, 100)))  # the ghost comes first
            listener.until(lambda event: isinstance(event, Hit) and event.velocity == 100)
            time.sleep(0.2)
            kit.play(bytes((0x99, 62, 25)))
            listener.until(lambda event: isinstance(event, Hit) and event.velocity == 25)
            engine.send(RecordCapture(None))
            listener.until(lambda event: isinstance(event, CaptureSaved) and event.path is None)
    told = [event for event in listener.events if isinstance(event, Hit)]
    assert [(hit.piece, hit.velocity) for hit in told] == [(Piece.KICK, 100), (Piece.SNARE, 25)]
    assert told[1].at_ns - told[0].at_ns > 150 * NS_PER_MS
    path.unlink()  # a capture needs nothing but itself
    assert [event for event in replay(read_capture(tmp_path / "take.cap")) if isinstance(event, Hit)] == told
