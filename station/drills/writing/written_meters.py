"""The meters that the grids of a lesson are written in, by the path of each table: what the layout of its lines needs.

`raw` is what a lesson's text says, without fault. What a grid takes over from the one that it is like, or from the one
before it, is the reader's business: it is asked here.
"""

from collections.abc import Iterator, Mapping
from typing import Any

from station.core.toml.schema import checked_values
from station.core.toml.toml_faults import Faults
from station.core.toml.toml_places import KeyPath
from station.drills.grid.grid_timing import TIMING, GridTiming, meter, timing_of
from station.drills.reading.form import written_grids
from station.drills.reading.lesson_fields import DEFAULT_TIMING
from station.drills.writing.line_layout import Meters


def written_meters(raw: Mapping[str, object]) -> dict[KeyPath, Meters]:
    """The meters in turn of each grid and each cycle."""
    found: dict[KeyPath, Meters] = {}
    timings: list[GridTiming] = []
    lesson = _timing(raw, DEFAULT_TIMING)
    for grid in written_grids(raw["grid"], Faults()):
        assert isinstance(grid.raw, dict), "a lesson without fault"
        before = lesson if not timings else timings[-1 if grid.like is None else grid.like]
        timings.append(_timing(grid.raw, before))
        found[grid.path] = Meters(timings[-1].meters, timings[-1].beat_ticks)
        for path, cycle in _cycles(grid.raw, grid.path):
            found[path] = Meters((meter(cycle["meter"]),), timings[-1].beat_ticks)
    return found


def _cycles(grid: Mapping[str, Any], path: KeyPath) -> Iterator[tuple[KeyPath, Mapping[str, object]]]:
    """The one cycle of a grid, or the several."""
    cycles = grid.get("cycle", [])
    if isinstance(cycles, list):
        yield from (((*path, "cycle", i), cycle) for i, cycle in enumerate(cycles))
    else:
        yield (*path, "cycle"), cycles


def _timing(raw: Mapping[str, object], before: GridTiming) -> GridTiming:
    values, _ = checked_values({key: value for key, value in raw.items() if key in TIMING}, TIMING)
    return timing_of(values, before, Faults())
