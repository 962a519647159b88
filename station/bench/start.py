"""Benchmarks of starting: how long `station --help` takes, from the shell's view."""

import subprocess
import sys

from station.bench.benchmark import Benchmark, Measured, median_s

_TIMES = 7


def _help() -> Measured:
    words = [sys.executable, "-m", "station.cli", "--help"]
    return Measured(median_s(lambda: subprocess.run(words, check=True, capture_output=True), _TIMES))


BENCHMARKS = (Benchmark("start_help", "s", 0.3, "lower", None, _help),)
