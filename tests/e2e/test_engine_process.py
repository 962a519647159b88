"""The engine process without kit or card: it says what is missing, obeys, and does not outlive its parent."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from station.core.errors import DeviceError
from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS
from station.devices.capture.capture import RecordKind, read_capture
from station.devices.capture.replay import replay
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
from station.engine.messages import CaptureSaved, KeyHit, Notice, Play, Ready, RecordCapture, Started
from tests.fakes.captures import on_disk
from tests.fakes.cues import clicks
from tests.fakes.engine_listener import EngineListener

KEY = KeyHit(123, Piece.SNARE, Zone.HEAD, 99)
NO_JACK = "drum-test-no-such-server"

PARENT = """
import sys, time
from station.engine.messages import Ready
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
if __name__ == "__main__":
    engine = EngineProcess(EngineConfig(kits=(), sound=False))
    while not any(isinstance(event, Ready) for event in engine.events(1.0)):
        pass
    print(engine.pid, flush=True)
    time.sleep(60)
"""


CTRL_C_PARENT = """
import signal
import time
from station.engine.messages import Ready
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # who runs tests in the background has them ignore Ctrl-C
    with EngineProcess(EngineConfig(kits=(), sound=False)) as engine:
        try:
            print("the child imports", flush=True)
            while True:  # one long sleep would swallow a signal that comes just before it begins
                time.sleep(0.02)
        except KeyboardInterrupt:
            print("Ctrl-C", flush=True)
        while not any(isinstance(event, Ready) for event in engine.events(1.0)):
            pass
        print("the child is up", flush=True)
"""


@pytest.fixture(autouse=True)
def _without_jack(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("JACK_DEFAULT_SERVER", NO_JACK)
    monkeypatch.setenv("JACK_NO_START_SERVER", "1")


def ready(engine: EngineProcess) -> EngineListener:
    listener = EngineListener(engine)
    listener.until(lambda event: isinstance(event, Ready))
    return listener


def wait_for_end(pid: int, within_s: float = 60.0) -> bool:
    give_up_s = time.monotonic() + within_s
    while time.monotonic() < give_up_s:
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.02)
    return False


def test_what_is_missing_is_said_once_and_the_transport_runs() -> None:
    with EngineProcess(EngineConfig(output="no such card", midi_driver="jack")) as engine:
        listener = ready(engine)
        engine.send(Play(clicks([0]), 50 * NS_PER_MS))
        listener.until(lambda event: isinstance(event, Started))
        texts = [event.text for event in listener.events if isinstance(event, Notice)]
    assert len(texts) == 2
    assert "no MIDI kit can be heard" in texts[0]
    assert "JACK" in texts[0]
    assert "running silent" in texts[1]


def test_keys_are_played_and_recorded(tmp_path: Path) -> None:
    with EngineProcess(EngineConfig(kits=(), sound=False)) as engine:
        listener = ready(engine)
        engine.send(RecordCapture(tmp_path / "take.cap"))
        engine.send(KEY)
        hit = listener.until(lambda event: isinstance(event, Hit))
    assert hit == Hit(123, Piece.SNARE, Zone.HEAD, 99, device="keyboard")
    assert list(replay(read_capture(tmp_path / "take.cap"))) == [hit]


def test_leaving_ends_the_process_and_leaving_twice_is_harmless() -> None:
    with EngineProcess(EngineConfig(kits=(), sound=False)) as engine:
        ready(engine)
        pid = engine.pid
        assert pid is not None
    engine.close()
    assert wait_for_end(pid)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_what_is_said_at_the_very_end_is_not_lost() -> None:
    engine = EngineProcess(EngineConfig(kits=(), sound=False))
    ready(engine)
    engine.send(RecordCapture(Path("/dev/full")))
    engine.send(KEY)
    said = engine.close()
    kinds = [type(event) for event in said if isinstance(event, CaptureSaved | Hit | Notice)]
    assert kinds[-3:] == [CaptureSaved, Hit, Notice]  # before them perhaps that no kit can be heard
    assert "No space left" in [event.text for event in said if isinstance(event, Notice)][-1]
    assert engine.close() == []


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="this system has no process groups")
def test_ctrl_c_while_the_engine_starts_is_the_parents_alone() -> None:
    with subprocess.Popen(
        [sys.executable, "-c", CTRL_C_PARENT],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as parent:
        assert parent.stdout is not None
        parent.stdout.readline()
        os.killpg(parent.pid, signal.SIGINT)
        out, err = parent.communicate(timeout=100)
    assert (out, err, parent.returncode) == ("Ctrl-C\nthe child is up\n", "", 0)


def test_leaving_at_once_is_no_trouble() -> None:
    with EngineProcess(EngineConfig(kits=(), sound=False)):
        pass


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system cannot kill outright")
def test_an_engine_that_is_killed_is_noticed_and_keeps_its_capture(tmp_path: Path) -> None:
    with EngineProcess(EngineConfig(kits=(), sound=False)) as engine:
        listener = ready(engine)
        engine.send(RecordCapture(tmp_path / "take.cap"))
        engine.send(KEY)
        listener.until(lambda event: isinstance(event, Hit))
        on_disk(tmp_path / "take.cap", RecordKind.STROKE)
        assert engine.pid is not None
        os.kill(engine.pid, signal.SIGKILL)
        with pytest.raises(DeviceError, match=r"has ended \(exit code -9\)"):
            listener.until(lambda _: False)
        assert not engine.is_alive
        with pytest.raises(DeviceError, match="has ended"):
            engine.send(KEY)
    assert [type(event) for event in replay(read_capture(tmp_path / "take.cap"))] == [Hit]


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system cannot kill outright")
def test_an_engine_whose_parent_is_killed_ends() -> None:
    with subprocess.Popen([sys.executable, "-c", PARENT], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        pid = int(parent.stdout.readline())
        parent.kill()
    assert wait_for_end(pid)
