"""Benchmarks in a process of their own: `python -m station.bench.harness.child MODULE NAME…` prints JSON.

Standard output belongs to the result; whatever else the work prints goes to standard error.
"""

import json
import math
import os
import sys
from dataclasses import asdict

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.harness.registry import table_of
from station.core.errors import StationError


def measured(benchmark: Benchmark) -> Measurement:
    """What `benchmark` measures; a failure is a result without a value, which says why."""
    try:
        result = benchmark.measure()
    except StationError as fault:
        return Measurement(None, note=str(fault))
    except Exception as fault:
        return Measurement(None, note=f"{type(fault).__name__}: {' '.join(str(fault).split())}")
    values = (result.value, result.peer_value)
    if any(value is not None and not math.isfinite(value) for value in values):
        return Measurement(None, note=f"measured {values[0]}, peer {values[1]}: not a number")
    return result


def main(module: str, *names: str) -> None:
    """Run the benchmarks `names` of `module` and print a list of their results."""
    result_to = os.dup(sys.stdout.fileno())
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    table = {benchmark.name: benchmark for benchmark in table_of(module)}
    results = [asdict(measured(table[name])) for name in names]
    with os.fdopen(result_to, "w") as file:
        json.dump(results, file)


if __name__ == "__main__":
    main(*sys.argv[1:])
