"""Real processes that are killed, and a real sound server that dies: the engine goes on, on the same transport.

Session time is one for every process, so the zero of the transport, told once, is where every click is looked for.
"""

import os
import signal
import time
from pathlib import Path

import numpy as np
import pytest

from station.core.events import DeviceFound, DeviceLost, Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import RecordKind, read_capture
from station.devices.capture.replay import replay, transport_zeros_ns
from station.devices.device_ports import DeviceRequest
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
from station.engine.messages import KeyHit, Notice, Play, Ready, RecordCapture, Sounding, Started
from station.engine.supervisor import EngineSupervisor
from tests.fakes.captures import on_disk
from tests.fakes.cues import clicks
from tests.fakes.engine_listener import EngineListener
from tests.fakes.jack_recorder import JackRecorder
from tests.fakes.jack_server import JackServer, jackd_is_installed, joined
from tests.fakes.kit_player import KitPlayer
from tests.fakes.stillness import Stillness, run_for

KEY = KeyHit(123, Piece.SNARE, Zone.HEAD, 99)
KIT = "TD-17 fake kit"
BACK_WITHIN_S = 1.0
JACK_WAITS_MS = 500
"""JACK's own choice (jackd's manual, option -t)."""
BUSY_S = 10.0
"""What a machine that others use may add: that it is within a second is for the benchmark `killed_engine_back`."""


def working(engine: EngineSupervisor) -> EngineProcess:
    assert isinstance(engine._process, EngineProcess)
    return engine._process


def spare_is_ready(engine: EngineSupervisor) -> None:
    """The spare imports for a moment after the first engine is ready; a session begins later than that."""
    assert isinstance(engine._spare, EngineProcess)
    run_for(1.0)


def kill(engine: EngineSupervisor) -> float:
    pid = working(engine).pid
    assert pid is not None
    os.kill(pid, signal.SIGKILL)
    return time.monotonic()


def jack_clients(server: JackServer) -> set[str]:
    """The station's clients on the server."""
    import jack  # needs JACK's library, which a machine may lack

    client = jack.Client("asks", servername=server.name, no_start_server=True)
    names = {port.name.partition(":")[0] for port in client.get_ports()}
    client.close()
    return names - {"system", KIT}


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system cannot kill outright")
def test_an_engine_that_is_killed_is_back_within_a_second_and_the_capture_goes_on(tmp_path: Path) -> None:
    with EngineSupervisor(EngineConfig(kits=(), sound=False)) as engine:
        listener = EngineListener(engine)
        listener.until(lambda event: isinstance(event, Ready))
        spare_is_ready(engine)
        engine.send(RecordCapture(tmp_path / "take.cap"))
        engine.send(Play(clicks([0, 60 * NS_PER_S]), 0))
        engine.send(KEY)
        listener.until(lambda event: isinstance(event, Started))
        listener.until(lambda event: isinstance(event, Hit))
        on_disk(tmp_path / "take.cap", RecordKind.STROKE)
        killed_s = kill(engine)
        listener.until(lambda event: isinstance(event, Notice) and "goes on" in event.text)
        engine.send(KEY)
        listener.until(lambda _: len(listener.hits()) == 2)
        back_s = time.monotonic() - killed_s
        engine.send(RecordCapture(None))
    assert back_s < BACK_WITHIN_S + BUSY_S
    capture = read_capture(tmp_path / "take.cap")
    assert capture.complete
    assert len([event for event in replay(capture) if isinstance(event, Hit)]) == 2
    (started,) = [event for event in listener.events if isinstance(event, Started)]
    assert transport_zeros_ns(capture) == [started.zero_ns]


@pytest.mark.jack
@pytest.mark.skipif(not jackd_is_installed(), reason="jackd is not installed")
def test_a_killed_engine_clicks_on_where_the_click_would_be(tmp_path: Path) -> None:
    """JACK itself waits for the clients of the dead process in turn, and lets nobody join until then: few, at best."""
    config = EngineConfig(kits=(DeviceRequest(KIT),), midi_driver="jack", output="jack")
    every_ns = 125 * NS_PER_MS
    with (
        JackServer(period_frames=256, client_timeout_ms=JACK_WAITS_MS) as jack_server,
        joined(jack_server),
        KitPlayer(jack_server, KIT, [], tmp_path),
        EngineSupervisor(config) as engine,
        Stillness() as stillness,
    ):
        begun_ns = time.monotonic_ns()
        listener = EngineListener(engine)
        listener.until(lambda event: isinstance(event, Ready))
        listener.until(lambda event: isinstance(event, DeviceFound))
        spare_is_ready(engine)
        assert len(jack_clients(jack_server)) == 2  # one that sounds, one that hears the kit
        engine.send(Play(clicks(np.arange(200) * every_ns), 100 * NS_PER_MS))
        started = listener.until(lambda event: isinstance(event, Started))
        assert isinstance(started, Started)
        killed_s = kill(engine)
        listener.until(lambda _: sum(isinstance(event, Ready) for event in listener.events) == 2)
        ready_s = time.monotonic() - killed_s
        with JackRecorder(jack_server, tmp_path) as recorder:
            recorder.connect("PortAudio:.*")
            run_for(1.5)
            heard = recorder.stop()
    assert ready_s < BACK_WITHIN_S + BUSY_S
    offset_ms = ((heard.at_ns[heard.onsets()] - started.zero_ns) % every_ns) / NS_PER_MS
    around_ms = (offset_ms + 62.5) % 125.0 - 62.5
    assert len(around_ms) >= 4
    if stillness.stood(begun_ns, time.monotonic_ns()):  # so has JACK's clock, or JACK has lost patience with us
        return
    assert not [event for event in listener.events if isinstance(event, DeviceLost)]  # it was there again at once
    assert len(around_ms) >= 8
    assert abs(np.median(around_ms)) < 25.0  # JACK takes a click a few periods of 5 ms before it is heard
    assert np.median(np.abs(around_ms - np.median(around_ms))) < 1.5


@pytest.mark.jack
def test_sound_comes_back_with_the_sound_server(jack_server: JackServer, tmp_path: Path) -> None:
    config = EngineConfig(kits=(DeviceRequest(KIT),), midi_driver="jack", output="jack")
    with EngineSupervisor(config) as engine:
        listener = EngineListener(engine)
        listener.until(lambda event: isinstance(event, Ready))
        engine.send(RecordCapture(tmp_path / "take.cap"))
        engine.send(Play(clicks(np.arange(500) * 125 * NS_PER_MS), 100 * NS_PER_MS))
        listener.until(lambda event: isinstance(event, Started))
        jack_server.halt()
        listener.until(lambda event: isinstance(event, Sounding) and event.output is None)
        engine.send(KEY)
        listener.until(lambda event: isinstance(event, Hit))
        listener.events.clear()
        jack_server.start()
        back = listener.until(lambda event: isinstance(event, Ready))
        assert isinstance(back, Ready)
        assert back.output == "system"
        with KitPlayer(jack_server, KIT, [], tmp_path), JackRecorder(jack_server, tmp_path) as recorder:
            listener.until(lambda event: isinstance(event, DeviceFound))
            recorder.connect("PortAudio:.*")
            run_for(0.6)
            assert len(recorder.stop().onsets()) >= 2
        engine.send(RecordCapture(None))
    assert len([event for event in listener.events if isinstance(event, Notice) and "again" in event.text]) == 1
    assert [type(event) for event in replay(read_capture(tmp_path / "take.cap")) if isinstance(event, Hit)] == [Hit]
