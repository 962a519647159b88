"""`station bench`: run the benchmarks one after the other, each in its own process, and print what they measured.

A benchmark that fails, crashes or takes too long is a row without a value that says why; the others run all the same.
The whole takes at most `BUDGET_S`; what finds no time left says so. Only the long ones, which are asked for, may go on.
"""

import json
import os
import platform
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby
from types import ModuleType

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.harness.registry import BenchEntry, entries

SCHEMA = "drum-station/bench/1"
BUDGET_S = 300.0
"""Five minutes, the design's promise."""

_NOTE_LENGTH = 200
"""Of a crash's last line, so much is told (our choice)."""


@dataclass(frozen=True, slots=True)
class Result:
    """A benchmark and what it measured."""

    benchmark: Benchmark
    measured: Measurement

    def document(self) -> dict[str, object]:
        """The result as the JSON document has it."""
        row: dict[str, object] = {
            "name": self.benchmark.name,
            "value": self.measured.value,
            "unit": self.benchmark.unit,
            "target": self.benchmark.target,
            "better": self.benchmark.better,
            "peer": self.benchmark.peer,
            "peer_value": self.measured.peer_value,
        }
        return row | ({"note": self.measured.note} if self.measured.note else {})


def main(package: ModuleType, write: Callable[[str], object], as_json: bool = False, soak: bool = False) -> int:
    """Run everything in `package` (`soak`: the long ones too); `write` a table's lines, or one JSON document.

    The exit status is 0: what is short of its target is no fault.
    """
    chosen = [entry for entry in entries(package) if soak or not entry.benchmark.is_soak]
    results = run(chosen)
    if as_json:
        write(json.dumps(document(results), ensure_ascii=False, indent=2))
    else:
        write_table(results, [entry.benchmark for entry in chosen], write)
    return 0


def document(results: Iterable[Result]) -> dict[str, object]:
    """The JSON document of a run, with the computer that it ran on."""
    computer = {
        "system": platform.platform(),
        "processor": platform.processor() or platform.machine(),
        "cores": os.cpu_count(),
        "python": platform.python_version(),
    }
    return {"schema": SCHEMA, "computer": computer, "results": [result.document() for result in results]}


# --- running ----------------------------------------------------------------------------------------------------------


def run(chosen: Iterable[BenchEntry], budget_s: float = BUDGET_S) -> Iterator[Result]:
    """Measure one after the other; those that are no soak share `budget_s`."""
    end_s = time.monotonic() + budget_s
    for group in _groups(sorted(chosen, key=lambda entry: entry.benchmark.is_soak)):
        benchmarks = [entry.benchmark for entry in group]
        limit_s = max(benchmark.limit_s for benchmark in benchmarks)
        left_s = limit_s if benchmarks[0].is_soak else min(limit_s, end_s - time.monotonic())
        none = Measurement(None, note=f"no time was left of {budget_s:g} s")
        yield from map(Result, benchmarks, _in_child(group, left_s) if left_s > 0 else [none] * len(group))


def _groups(entries: list[BenchEntry]) -> Iterator[list[BenchEntry]]:
    """Those that are measured together; most are alone."""

    def together(entry: BenchEntry) -> tuple[str, str]:
        benchmark = entry.benchmark
        return entry.module, f"group {benchmark.group}" if benchmark.group else benchmark.name

    return (list(group) for _, group in groupby(entries, together))


def _in_child(group: list[BenchEntry], limit_s: float) -> list[Measurement]:
    """Run benchmarks in a child process; the process and all that it started end with them or at their limit."""
    names = [entry.benchmark.name for entry in group]
    words = [sys.executable, "-m", "station.bench.harness.child", group[0].module, *names]
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as child:
        try:
            printed, complaints = child.communicate(timeout=limit_s)
        except subprocess.TimeoutExpired:
            return [Measurement(None, note=f"was ended after {limit_s:.0f} s")] * len(group)
        finally:
            _end(child)
    try:
        return [Measurement(**result) for result in json.loads(printed)]
    except (ValueError, TypeError):
        last_line = complaints.strip().rpartition("\n")[2][:_NOTE_LENGTH]
        return [Measurement(None, note=f"ended with status {child.returncode}: {last_line or 'no word'}")] * len(group)


def _end(child: "subprocess.Popen[str]") -> None:
    if os.name == "posix":
        try:
            os.killpg(child.pid, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):  # macOS says so of a group that has just ended
            return
    elif child.poll() is None:
        child.kill()


# --- a table ----------------------------------------------------------------------------------------------------------


def write_table(results: Iterable[Result], chosen: list[Benchmark], write: Callable[[str], object]) -> None:
    """A line for every result as it comes: name, value, whether it reaches its target, the peer's value, the note."""
    width = max((len(b.name) for b in chosen), default=0)
    write(f"{'benchmark':<{width}}  {'value':>18}  {'target':>12}         peer")
    for result in results:
        write(_line(result, width))


def _line(result: Result, width: int) -> str:
    benchmark, measured = result.benchmark, result.measured
    value = "–" if measured.value is None else f"{measured.value:.4g} {benchmark.unit}"
    bound = "≤" if benchmark.better == "lower" else "≥"
    target = "" if benchmark.target is None else f"{bound} {benchmark.target:g}"
    verdict = {True: "ok", False: "short", None: ""}[benchmark.reaches(measured.value)]
    peer = "" if measured.peer_value is None else f"{benchmark.peer} {measured.peer_value:.4g}"
    return f"{benchmark.name:<{width}}  {value:>18}  {target:>12}  {verdict:<5}  {peer}  {measured.note}".rstrip()
