"""`station bench`: how fast and exact the station is on this computer."""

from dataclasses import dataclass
from functools import partial

from station.cli.console import write
from station.cli.options.option_fields import Command, flag


@dataclass(frozen=True, slots=True, kw_only=True)
class BenchOptions:
    """Which benchmarks, and how their results are printed."""

    soak: bool = flag("add the long ones")
    json: bool = flag("print one JSON document")


def run(options: BenchOptions) -> int:
    """Measure and print."""
    from station.bench import rows
    from station.bench.harness.run import main

    return main(rows, partial(write, flush=True), options.json, options.soak)


COMMAND = Command(BenchOptions, run)
