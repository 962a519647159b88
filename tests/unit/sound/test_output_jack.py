"""The real PortAudio on a real sound server, in processes of their own: PortAudio is one for a whole process."""

import itertools
import json
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import numpy as np
import pytest

from station.sound.output.fade_gate import FADE_S
from tests.fakes.jack_recorder import JackRecorder
from tests.fakes.jack_server import JackServer, jackd_is_installed, joined

pytestmark = [
    pytest.mark.jack,
    pytest.mark.skipif(not jackd_is_installed(), reason="jackd is not installed"),
]


STANDS_NS = 50_000_000
"""Where so long no block was asked for, by 20 times a period, the machine stood still."""


class Program:
    """A Python program that says and hears lines."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def hears(self) -> str:
        return self._pipe(self._process.stdout).readline().strip()

    def says(self, line: str) -> None:
        pipe = self._pipe(self._process.stdin)
        pipe.write(line + "\n")
        pipe.flush()

    def ends_well(self) -> None:
        assert self._process.wait(30) == 0, self._pipe(self._process.stderr).read()

    @staticmethod
    def _pipe(pipe: IO[str] | None) -> IO[str]:
        assert pipe is not None
        return pipe


@contextmanager
def running(program: str, env: dict[str, str] | None = None) -> Iterator[Program]:
    with subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(program)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=env,
    ) as process:
        try:
            yield Program(process)
        finally:
            process.kill()


def test_blocks_are_asked_for_with_the_time_at_which_they_are_heard() -> None:
    program = """
        import json, time
        import numpy as np
        from station.sound.output.sound_output import open_output
        asked = []

        def render(frames, dac_ns):
            asked.append((time.monotonic_ns(), dac_ns, frames))
            return np.zeros((frames, 2), np.float32)

        output = open_output("system", 0, 48_000)
        output.start(render)
        time.sleep(2.0)
        faults, latency_ms, rate_hz = output.fault, output.latency_ms, output.rate_hz
        output.close()
        output.close()
        print(json.dumps({"asked": asked, "fault": str(faults), "latency_ms": latency_ms, "rate_hz": rate_hz}))
    """
    with JackServer(48_000, 128) as server, running(program, server.env) as child:
        told = json.loads(child.hears())
        child.ends_well()
    asked = told["asked"]
    assert told["fault"] == "None"
    assert told["rate_hz"] == 48_000
    assert 0.0 < told["latency_ms"] < 50.0
    steps = [(b[0] - a[0], a[2]) for a, b in itertools.pairwise(asked)]
    ran = [(step_ns, frames) for step_ns, frames in steps if step_ns < STANDS_NS]
    ran_s = sum(step_ns for step_ns, _ in ran) / 1e9
    if ran_s > 0.5:  # else the machine stood still nearly all the time
        assert sum(frames for _, frames in ran) == pytest.approx(ran_s * 48_000, rel=0.25)
    leads_ms = sorted((dac_ns - now_ns) / 1e6 for now_ns, dac_ns, _ in asked)
    assert 1.0 < leads_ms[len(leads_ms) // 2] < 10.0  # the dummy's two periods of 2.67 ms, less what has passed
    steps_ms = sorted((b[1] - a[1]) / 1e6 for a, b in itertools.pairwise(asked))
    tenth = len(steps_ms) // 10
    assert steps_ms[tenth] == pytest.approx(128 / 48, rel=0.02)
    assert steps_ms[-tenth] == pytest.approx(128 / 48, rel=0.02)


def test_a_server_that_dies_is_told_of_and_not_waited_for() -> None:
    program = """
        import sys, time
        import numpy as np
        from station.core.errors import DeviceError
        from station.sound.output.sound_output import list_outputs, open_output
        output = open_output("", 0, 48_000)
        output.start(lambda frames, dac_ns: np.zeros((frames, 2), np.float32))
        time.sleep(0.2)
        assert output.fault is None
        print("plays", flush=True)
        sys.stdin.readline()
        until_s = time.monotonic() + 10.0
        while output.fault is None and time.monotonic() < until_s:
            time.sleep(0.02)
        print(output.fault, flush=True)
        begun = time.monotonic()
        output.close()
        print(time.monotonic() - begun, flush=True)
    """
    with JackServer(48_000, 128) as server, running(program, server.env) as child:
        assert child.hears() == "plays"
        server.stop()
        child.says("the server is gone")
        assert "stopped" in child.hears()
        assert float(child.hears()) < 5.0  # PortAudio alone would wait ten minutes
        child.ends_well()


def test_a_server_that_starts_later_is_found() -> None:
    program = """
        import os, sys
        from station.core.errors import DeviceError
        from station.sound.output.sound_output import list_outputs, open_output
        os.environ["JACK_NO_START_SERVER"] = "1"
        os.environ["JACK_DEFAULT_SERVER"] = "drum-test-nobody"
        print(any("JACK" in device.host for device in list_outputs()), flush=True)
        os.environ["JACK_DEFAULT_SERVER"] = sys.stdin.readline().strip()
        print(any("JACK" in device.host for device in list_outputs()), flush=True)
    """
    with running(program) as child:
        assert child.hears() == "False"
        with JackServer() as server:
            child.says(server.name)
            assert child.hears() == "True"
            child.ends_well()


def test_a_stream_that_pauses_does_not_click(tmp_path: Path) -> None:
    """A constant is played and stopped (which parts JACK's connection): without a fade that is a step of a half."""
    program = """
        import sys, time
        import numpy as np
        from station.sound.output.sound_output import open_output
        output = open_output("system", 0, 48_000)
        output.start(lambda frames, dac_ns: np.full((frames, 2), 0.5, np.float32))
        print("plays", flush=True)
        sys.stdin.readline()
        time.sleep(0.5)
        output.pause()
        time.sleep(0.1)
        output.close()
        print("ended", output.underflows, flush=True)
    """
    with JackServer(48_000, 256) as server, running(program, server.env) as child:
        assert child.hears() == "plays"
        with joined(server), JackRecorder(server, tmp_path) as recorder:
            recorder.connect("PortAudio:.*")
            child.says("go on")
            child.hears()
            child.ends_well()
            heard = recorder.stop()
    mono = heard.sound[:, 0]
    assert mono.max() == 0.5
    last = int(np.flatnonzero(mono)[-1])
    assert mono[last] <= 1.01 * 0.5 / (FADE_S * 48_000)
    assert np.all(np.diff(mono[last - round(0.8 * FADE_S * 48_000) : last]) < 0.0)
