"""Which benchmarks there are: those of every module of this package that has a table of them."""

import importlib
import pkgutil
from dataclasses import dataclass
from functools import partial
from types import ModuleType

from station.bench.harness.benchmark import Benchmark, Measurement


@dataclass(frozen=True, slots=True)
class BenchEntry:
    """A benchmark and the full name of the module whose table it stands in."""

    module: str
    benchmark: Benchmark


def entries(package: ModuleType) -> list[BenchEntry]:
    """Every benchmark of `package`, module by module in alphabetical order.

    A module that cannot be imported is one benchmark that says so: nothing is left out in silence.
    """
    names = sorted(info.name for info in pkgutil.iter_modules(package.__path__, f"{package.__name__}."))
    return [BenchEntry(name, benchmark) for name in names for benchmark in table_of(name)]


def table_of(module: str) -> tuple[Benchmark, ...]:
    """The benchmarks of the module of this full name; none if it is of another kind."""
    try:
        table: tuple[Benchmark, ...] = getattr(importlib.import_module(module), "BENCHMARKS", ())
    except Exception as fault:
        area = module.rpartition(".")[2]
        return (Benchmark(area, "", None, "lower", None, partial(_not_there, f"{type(fault).__name__}: {fault}")),)
    return table


def _not_there(why: str) -> Measurement:
    return Measurement(None, note=f"cannot be imported: {why}")
