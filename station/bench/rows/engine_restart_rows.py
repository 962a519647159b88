"""How long the station is without an engine when its process is killed, with sound and a kit on a JACK server.

From SIGKILL to the next engine's word that it sounds and hears. JACK's own wait for a dead client, half a second by its
default, is within.
"""

import os
import signal
import statistics
import time

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.rigs.devices.engine_hearing import KIT, WITHIN_S
from station.bench.rigs.devices.jack_server import JackServer
from station.bench.rigs.devices.playing_kit import PlayingKit
from station.core.errors import DeviceError
from station.devices.device_ports import DeviceRequest
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
from station.engine.messages import Ready
from station.engine.supervisor import EngineSupervisor

JACK_WAITS_MS = 500
"""JACK's own time-limit for its clients (jackd's manual, option -t)."""
_KILLS = 3
"""As many as an engine is started anew for within half a minute."""
_SPARE_S = 5.0
"""What a spare takes to get ready on a busy computer; nobody is told when it is."""


def _back() -> Measurement:
    processes: list[EngineProcess] = []

    def start() -> EngineProcess:
        processes.append(EngineProcess())
        return processes[-1]

    config = EngineConfig(kits=(DeviceRequest(KIT),), midi_driver="jack", output="jack")
    with JackServer(client_timeout_ms=JACK_WAITS_MS) as server:
        os.environ.update(server.env)
        with PlayingKit("jack", KIT), EngineSupervisor(config, start) as engine:
            _until_ready(engine)
            taken_s = []
            for kill in range(_KILLS):
                time.sleep(_SPARE_S)
                pid = processes[kill].pid
                assert pid is not None, "it works"
                os.kill(pid, signal.SIGKILL)
                killed_s = time.monotonic()
                _until_ready(engine)
                taken_s.append(time.monotonic() - killed_s)
    return Measurement(statistics.median(taken_s), note=f"{min(taken_s):.2f} to {max(taken_s):.2f} s")


def _until_ready(engine: EngineSupervisor) -> None:
    give_up_s = time.monotonic() + WITHIN_S
    while time.monotonic() < give_up_s:
        if any(isinstance(event, Ready) for event in engine.events(0.01)):
            return
    raise DeviceError(f"no engine was ready within {WITHIN_S:g} s")


BENCHMARKS = (Benchmark("killed_engine_back", "s", 1.0, "lower", None, _back),)
