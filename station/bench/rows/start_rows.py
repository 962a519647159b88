"""Benchmarks of starting, from the shell's view: `station --help`, and the window's first frame and first picture.

The window opens as a program of its own (`station`), with its engine, on the screen that is there or else on one of
Xvfb's. What is measured is a second start: one before it leaves Python's bytecode, as an installed program has it, and
what the station keeps in the user's folder for caches.
"""

import json
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path
from statistics import median

from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.bench.rigs.xvfb import a_screen, installed
from station.core.clock import monotonic_ns
from station.core.units import NS_PER_S

_TIMES, _OPENINGS = 7, 2
_WITHIN_S = 50.0
_FIRST_PICTURE = 2
"""The frame, from 1, that shows the drummer (`app.window`)."""


def _help() -> Measurement:
    words = [sys.executable, "-m", "station.cli.command_line", "--help"]
    with tempfile.TemporaryDirectory() as home:
        run = partial(subprocess.run, words, check=True, capture_output=True, env=installed(home))
        return Measurement(median_s(run, _TIMES))


def _first_frame() -> Measurement:
    return _opening(1)


def _first_picture() -> Measurement:
    return _opening(_FIRST_PICTURE)


def _opening(frame: int) -> Measurement:
    """From the command until `frame` is on the screen, the median of some openings, and this process's own time."""
    with a_screen() as screen, tempfile.TemporaryDirectory() as home:
        if screen is None:
            return Measurement(None, note="no screen, and no Xvfb to make one")
        folder = Path(home) / "drum-station"
        folder.mkdir()
        (folder / "settings.toml").write_text(f"welcomed = true\nsessions = '{home}'\n", "utf-8")
        environment = {**installed(home), **screen, "XDG_CONFIG_HOME": home}
        _opened(frame, environment)
        openings = [_opened(frame, environment) for _ in range(_OPENINGS)]
    taken_s, worked_s = (median(column) for column in zip(*openings, strict=True))
    return Measurement(taken_s, note=f"{worked_s:.2f} s of processor time")


def _opened(frame: int, environment: dict[str, str]) -> tuple[float, float]:
    begun_ns = monotonic_ns()
    words = [sys.executable, "-m", "station.cli.command_line", "--watch-frames", str(frame)]
    done = subprocess.run(words, check=True, capture_output=True, text=True, env=environment, timeout=_WITHIN_S)
    seen = json.loads(done.stdout.splitlines()[-1])
    return (seen["shown_ns"][frame - 1] - begun_ns) / NS_PER_S, seen["worked_s"][frame - 1]


BENCHMARKS = (
    Benchmark("start_help", "s", 0.3, "lower", None, _help),
    Benchmark("start_first_frame", "s", 2.0, "lower", None, _first_frame),
    Benchmark("start_first_picture", "s", 2.0, "lower", None, _first_picture),
)
