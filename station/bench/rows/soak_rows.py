"""Soaks without a clock: a million hostile inputs to the engine, and captures damaged in every way."""

import time
from collections.abc import Callable
from functools import partial

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.rigs.devices.engine_fuzz import Fuzzed, fuzz_captures, fuzz_engine

_INPUTS, _CAPTURES = 1_000_000, 20_000


def _faults(fuzz: Callable[[int, int], Fuzzed], inputs: int) -> Measurement:
    seed = time.time_ns() & 0xFFFF  # another every time; the note says which, so that a fault can be had again
    result = fuzz(inputs, seed)
    return Measurement(result.faults, note="; ".join((f"{result.inputs} inputs, seed {seed}", *result.told)))


BENCHMARKS = (
    Benchmark(
        "fuzz_engine_faults", "faults", 0.0, "lower", None, partial(_faults, fuzz_engine, _INPUTS), True, 1_800.0
    ),
    Benchmark(
        "fuzz_captures_faults", "faults", 0.0, "lower", None, partial(_faults, fuzz_captures, _CAPTURES), True, 600.0
    ),
)
