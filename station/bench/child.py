"""One benchmark in a process of its own: `python -m station.bench.child MODULE NAME` prints its result as JSON.

Standard output belongs to the result; whatever else the work prints goes to standard error.
"""

import json
import math
import os
import sys

from station.bench.benchmark import Benchmark, Measured
from station.bench.registry import table_of
from station.core.errors import StationError


def measured(benchmark: Benchmark) -> Measured:
    """What `benchmark` measures; a failure is a result without a value, which says why."""
    try:
        result = benchmark.measure()
    except StationError as fault:
        return Measured(None, note=str(fault))
    except Exception as fault:
        return Measured(None, note=f"{type(fault).__name__}: {' '.join(str(fault).split())}")
    values = (result.value, result.peer_value)
    if any(value is not None and not math.isfinite(value) for value in values):
        return Measured(None, note=f"measured {values[0]}, peer {values[1]}: not a number")
    return result


def main(module: str, name: str) -> None:
    """Run the benchmark `name` of `module` and print its result."""
    result_to = os.dup(sys.stdout.fileno())
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    benchmark = next(b for b in table_of(module) if b.name == name)
    result = measured(benchmark)
    with os.fdopen(result_to, "w") as file:
        json.dump({"value": result.value, "peer_value": result.peer_value, "note": result.note}, file)


if __name__ == "__main__":
    main(*sys.argv[1:])
