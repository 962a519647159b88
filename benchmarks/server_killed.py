"""A sound server that is killed and started again, time after time, while somebody practises in a terminal.

    PYTHONPATH=. .venv/bin/python benchmarks/server_killed.py [--times 8]

`station practice` runs in a pseudo-terminal with a kit and its sound on JACK. Each time the server and the kit are
killed (SIGKILL) and come back after some seconds; a line tells how long after the kit's return its strokes were in the
capture again. At the end the session is ended by Ctrl-C, and what the terminal has shown is printed: no library's words
are among it, the exit status is 0, and the report tells where nothing could be heard.

Target: heard again within 2 s, every time.
"""

import argparse
import os
import pty
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from station.bench.rigs.devices.jack_server import JackServer
from station.bench.rigs.devices.playing_kit import PlayingKit
from station.core.clock import monotonic_ns
from station.core.units import NS_PER_S
from station.devices.capture.capture import RecordKind, read_capture
from station.practice.history.session_files import CAPTURE_NAME

KIT = "TD-17 fake"
_WITHIN_S = 30.0
_PLAYS_S = 2.0
_LIBRARY = re.compile(r"CheckRes|Cannot read socket|JackSocket|Server is not running|Assertion|ALSA lib|Expression '")
_MARKS = re.compile(r"[|<>ox+~·?]{5,}")


def heard_since(capture: Path, at_ns: int) -> bool:
    """Whether bytes of the kit are in the capture that came after `at_ns`."""
    return any(r.kind == RecordKind.BYTES and r.at_ns > at_ns for r in read_capture(capture).records)


def until_heard(kit: PlayingKit, capture: Path) -> float:
    """Strike until the capture has it; the seconds that took, `_WITHIN_S` where it never came."""
    begun_ns = monotonic_ns()
    while monotonic_ns() < begun_ns + _WITHIN_S * NS_PER_S:
        kit.command(f"play {monotonic_ns()} 1000000 1")
        kit.hear()
        time.sleep(0.05)
        if capture.exists() and heard_since(capture, begun_ns):
            return (monotonic_ns() - begun_ns) / NS_PER_S
    return _WITHIN_S


def main() -> None:
    """Kill, wait and tell."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--times", type=int, default=8)
    times = parser.parse_args().times
    shown: list[bytes] = []
    with tempfile.TemporaryDirectory() as name, JackServer() as server:
        os.environ.update(server.env)
        kit = PlayingKit("jack", KIT)
        master, slave = pty.openpty()
        words = ["practice", "rock-1", "--no-demonstration", "--no-pictures", "--loops", "500", "--kit", KIT]
        with subprocess.Popen(
            [sys.executable, "-m", "station.cli.command_line", *words, "--report", f"{name}/session"],
            env={**os.environ, "XDG_CONFIG_HOME": name, "XDG_DATA_HOME": name, "HOME": name},
            stdin=slave,
            stdout=slave,
            stderr=slave,
            start_new_session=True,
        ) as station:
            os.close(slave)
            threading.Thread(target=_read, args=(master, shown), daemon=True).start()
            capture = Path(name) / "session" / CAPTURE_NAME
            print(f"first heard after {until_heard(kit, capture):.2f} s", flush=True)
            back_s = []
            for number in range(times):
                time.sleep(_PLAYS_S)
                _kill(server, kit)
                time.sleep(1.0 + 0.7 * (number % 3))
                server.start()
                kit = PlayingKit("jack", KIT)
                back_s.append(until_heard(kit, capture))
                print(f"heard again after {back_s[-1]:.2f} s", flush=True)
            station.send_signal(signal.SIGINT)
            station.wait(_WITHIN_S)
        kit.unplug()
        text = _MARKS.sub("…", b"".join(shown).decode("utf-8", "replace"))
    print(text)
    libraries = [line for line in text.splitlines() if _LIBRARY.search(line)]
    print(f"{times} times: median {statistics.median(back_s):.2f} s, at most {max(back_s):.2f} s (≤ 2)")
    print(f"exit status {station.returncode}, {len(libraries)} lines of libraries {libraries[:2]}")


def _kill(server: JackServer, kit: PlayingKit) -> None:
    for process in (server._process, kit._process):
        assert process is not None, "they run"
        process.kill()
        process.wait()


def _read(master: int, shown: list[bytes]) -> None:
    while True:
        try:
            data = os.read(master, 65_536)
        except OSError:  # the station has ended
            return
        shown.append(data)


if __name__ == "__main__":
    main()
