"""One benchmark for each way to end."""

import ctypes
import os
import subprocess
import sys
import time

from station.bench.harness.benchmark import Benchmark, Measurement
from station.core.errors import DeviceError


def noisy() -> Measurement:
    sys.stdout.write("chatter on standard output\n")
    sys.stdout.flush()
    os.write(1, b"and from below Python\n")
    return Measurement(12.5, 50.0, "all well")


def no_device() -> Measurement:
    raise DeviceError("no sound card")


def fails() -> Measurement:
    raise ValueError("two\nlines")


def crashes() -> Measurement:
    sys.stderr.write("the driver gives up\n")
    sys.stderr.flush()
    ctypes.string_at(0)
    return Measurement(1.0)


def leaves() -> Measurement:
    sys.stderr.write("I quit\n")
    sys.stderr.flush()
    os._exit(3)


def hangs() -> Measurement:
    """With a child that holds on to our pipes."""
    subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    time.sleep(60)
    return Measurement(1.0)


def not_a_number() -> Measurement:
    return Measurement(float("nan"))


def process() -> Measurement:
    return Measurement(float(os.getpid()))


BENCHMARKS = (
    Benchmark("noisy", "ms", 20, "lower", "rival", noisy),
    Benchmark("no_device", "ms", 20, "lower", None, no_device),
    Benchmark("fails", "fps", 60, "higher", None, fails),
    Benchmark("crashes", "fps", None, "higher", None, crashes),
    Benchmark("leaves", "s", None, "lower", None, leaves),
    Benchmark("hangs", "s", None, "lower", None, hangs, limit_s=1.5),
    Benchmark("not_a_number", "s", None, "lower", None, not_a_number),
    Benchmark("first_together", "", None, "lower", None, process, group="pair"),
    Benchmark("second_together", "", None, "lower", None, process, group="pair"),
    Benchmark("alone", "", None, "lower", None, process),
    Benchmark("falls_with_it", "", None, "lower", None, process, group="doomed"),
    Benchmark("falls", "", None, "lower", None, leaves, group="doomed"),
    Benchmark("long", "s", None, "lower", None, noisy, is_soak=True),
)
