"""Benchmarks of the window while a session is played in it: its frames, its strokes' way to the screen, its memory.

The window opens as a program of its own (`station practice`), with its engine, on the screen that is there or else on
one of Xvfb's. A kit on a serial line begins the session by two kicks and plays on; each of its strokes is known again
by its velocity. It is `rock-1` at its own tempo: the score scrolls, the drummer plays along, marks and words change.
"""

import json
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from math import ceil
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.rigs.devices.serial_kit import SerialKit
from station.bench.rigs.xvfb import a_screen, installed
from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.units import NS_PER_MS, NS_PER_S

_BAUD = 115_200
_KICK, _HAT = 36, 42
_SETTLES_S, _PLAYS_S = 5.0, 5.0
"""How long the window may take to be at ease (kit found, drummer made), and how long it is then watched."""
_SETTLING = 40
"""So many frames at the least are not watched: the quality is measured in the first, and others then drawn anew."""
_BUSY = "this computer is too busy: {} frames in {:g} s"
_FOUND_S = 3.0
"""What the engine may take to find the kit after the first frame."""
_GAP_S = (0.15, 0.25)
"""Between strokes: about the sixteenths of 75 beats a minute."""
_VELOCITIES = range(40, 128)
_LOST_NS = 500 * NS_PER_MS
_PASS_S = 6.0
"""The first lesson's two bars at its own tempo."""
_MINUTE_S = 60.0
_MINUTES = 10


@dataclass(frozen=True, eq=False)
class _Played:
    """What was seen after the settling: when frames were shown, the processor's time of each, stroke to picture."""

    shown_ns: NDArray[np.int64]
    worked_ms: NDArray[np.float64]
    late_ms: NDArray[np.float64]

    @property
    def frame_ms(self) -> float:
        """The median time from frame to frame."""
        return float(np.median(np.diff(self.shown_ns))) / NS_PER_MS


class _BenchKit:
    """A kit that plays on a thread, and remembers when it sent which velocity."""

    def __init__(self, path: Path) -> None:
        self._line = SerialKit(path)
        self.device = f"{self._line.device}@{_BAUD}"
        self.sent: list[tuple[int, int]] = []
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._play, daemon=True)

    def begin(self) -> None:
        """Ask for the session by two kicks, then play."""
        self._thread.start()

    def close(self) -> None:
        """Stop, and pull the plug."""
        self._over.set()
        self._thread.join()
        self._line.unplug()

    def _play(self) -> None:
        draw = np.random.default_rng(6)
        for _ in range(2):
            self._line.play(bytes((0x99, _KICK, 100)))
            self._over.wait(0.4)
        for index in range(10**6):
            if self._over.wait(draw.uniform(*_GAP_S)):
                return
            velocity = _VELOCITIES[index % len(_VELOCITIES)]
            self.sent.append((monotonic_ns(), velocity))
            self._line.play(bytes((0x99, _HAT, velocity)))


def _played(seconds: float, each_minute: list[Counter[str]] | None = None) -> _Played | None:
    """A session of so many seconds; None without a screen. `each_minute` takes the memory of each process, in bytes."""
    with a_screen() as screen, tempfile.TemporaryDirectory() as home:
        if screen is None:
            return None
        kit = _BenchKit(Path(home) / "kit")
        folder = Path(home) / "drum-station"
        folder.mkdir()
        settings = f"welcomed = true\nsessions = '{home}/sessions'\nkit = '{kit.device}'\n"
        (folder / "settings.toml").write_text(settings, "utf-8")
        environment = {**installed(home), **screen, "XDG_CONFIG_HOME": home}
        words = [sys.executable, "-m", "station.cli.command_line", "practice", "--watch-seconds", str(seconds)]
        words += ["--loops", str(ceil(seconds / _PASS_S)), "--no-demonstration", "--no-adapt"]
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment) as window:
            assert window.stdout is not None
            window.stdout.readline()
            time.sleep(_FOUND_S)
            kit.begin()
            if each_minute is not None:
                for _ in range(_MINUTES):
                    time.sleep(_MINUTE_S)
                    each_minute.append(_memory(window.pid))
            said = window.stdout.readlines()
            kit.close()
        if window.returncode:
            raise RuntimeError(f"the window ended with exit status {window.returncode}")
        report = json.loads(said[-1])
    shown_ns = np.array(report["shown_ns"], np.int64)
    seen = (shown_ns > shown_ns[0] + _SETTLES_S * NS_PER_S) & (np.arange(len(shown_ns)) >= _SETTLING)
    if np.count_nonzero(seen) < _SETTLING:
        raise DeviceError(_BUSY.format(len(shown_ns), seconds))
    shown_ns, worked_ms = shown_ns[seen], np.diff(np.array(report["worked_s"])[seen]) * 1000
    return _Played(shown_ns, worked_ms, late_ms(kit.sent, [(at, v) for at, v in report["lit"] if at > shown_ns[0]]))


def late_ms(sent: Iterable[tuple[int, int]], shown: Iterable[tuple[int, int]]) -> NDArray[np.float64]:
    """From each stroke to the first picture of it; strokes that are long past are others of the same velocity."""
    when: dict[int, list[int]] = {}
    for at_ns, velocity in sent:
        when.setdefault(velocity, []).append(at_ns)
    late = []
    for shown_ns, velocity in shown:
        before = [at_ns for at_ns in when.get(velocity, []) if 0 <= shown_ns - at_ns < _LOST_NS]
        if before:
            late.append((shown_ns - before[-1]) / NS_PER_MS)
    return np.array(late)


def _memory(pid: int) -> Counter[str]:
    """The proportional share of memory of a process and its children, by their names, in bytes (Linux)."""
    found: Counter[str] = Counter()
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text("ascii").split()
    for name, number in (("window", pid), *((f"engine {k}", int(child)) for k, child in enumerate(children))):
        for line in Path(f"/proc/{number}/smaps_rollup").read_text("ascii").splitlines():
            if line.startswith("Pss_Anon:"):
                found[name] += int(line.split()[1]) * 1024
    return found


_NO_SCREEN = Measurement(None, note="no screen, and no Xvfb to make one")


@cache
def _session() -> _Played | None:
    """One that both rows look at."""
    return _played(_SETTLES_S + _PLAYS_S)


def _frames() -> Measurement:
    seen = _session()
    if seen is None:
        return _NO_SCREEN
    note = f"{len(seen.shown_ns)} frames, {np.median(seen.worked_ms):.1f} ms of processor time each"
    return Measurement(1000 / seen.frame_ms, note=note)


def _stroke_to_picture() -> Measurement:
    seen = _session()
    if seen is None:
        return _NO_SCREEN
    if not len(seen.late_ms):
        return Measurement(None, note=f"no stroke was on the screen within {_LOST_NS / NS_PER_MS:g} ms")
    median, most = np.percentile(seen.late_ms, (50, 99))
    note = f"median {median:.1f} ms, p99 {most:.1f}, a frame {seen.frame_ms:.1f}, {len(seen.late_ms)} strokes"
    return Measurement(float(most) - seen.frame_ms, note=note)


def _memory_growth() -> Measurement:
    if not Path("/proc/self/smaps_rollup").exists():
        return Measurement(None, note="memory is read from /proc (Linux)")
    minutes: list[Counter[str]] = []
    if _played(_MINUTES * _MINUTE_S + 2 * _SETTLES_S, minutes) is None:
        return _NO_SCREEN
    grown = {name: (minutes[-1][name] - minutes[0][name]) / 1e6 for name in minutes[0]}
    lines = [f"{name} {minutes[0][name] / 1e6:.1f} MB, {mb:+.1f}" for name, mb in grown.items()]
    return Measurement(max(grown.values()), note="; ".join(lines))


BENCHMARKS = (
    Benchmark("window_frames_while_playing", "frames/s", 30.0, "higher", None, _frames, group="session"),
    Benchmark(
        "window_stroke_to_picture_beyond_a_frame_p99", "ms", 5.0, "lower", None, _stroke_to_picture, group="session"
    ),
    Benchmark("window_ten_minutes_memory_growth", "MB", 5.0, "lower", None, _memory_growth, True, 900.0),
)
