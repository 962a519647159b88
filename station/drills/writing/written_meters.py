"""The meters that the grids of a lesson are written in, by the path of each table: what the layout of its lines needs.

`raw` is what a lesson's text says. What a grid takes over from the one that it is like, or from the one
before it, is the reader's business: it is asked here.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

from station.core.toml.schema import checked_values
from station.core.toml.toml_faults import Faults, Wrong
from station.core.toml.toml_places import KeyPath
from station.drills.grid.grid_timing import TIMING, GridTiming, meter, timing_of
from station.drills.reading.form import WrittenGrid, written_grids
from station.drills.reading.lesson_fields import DEFAULT_TIMING
from station.drills.writing.line_layout import Meters


def written_meters(raw: Mapping[str, object]) -> dict[KeyPath, Meters]:
    """The meters in turn of each grid and each cycle, but for those that cannot be read."""
    found: dict[KeyPath, Meters] = {}
    grids = written_grids(raw["grid"], Faults()) if "grid" in raw else []
    for grid, timing in zip(grids, written_timings(raw, grids), strict=True):
        if not isinstance(grid.raw, dict) or not timing.is_sure:
            continue
        found[grid.path] = Meters(timing.meters, timing.beat_ticks)
        for path, cycle in _cycles(grid.raw, grid.path):
            with suppress(Wrong):
                found[path] = Meters((meter(cycle.get("meter")),), timing.beat_ticks)
    return found


def written_timings(raw: Mapping[str, object], grids: Sequence[WrittenGrid]) -> tuple[GridTiming, ...]:
    """The timing of each of the grids of a lesson, which may have faults: what cannot be read counts as not said."""
    timings: list[GridTiming] = []
    lesson = timing_said(raw, DEFAULT_TIMING)
    for grid in grids:
        before = lesson if not timings else timings[-1 if grid.like is None else grid.like]
        timings.append(timing_said(grid.raw, before) if isinstance(grid.raw, dict) else before)
    return tuple(timings)


def _cycles(grid: Mapping[str, Any], path: KeyPath) -> Iterator[tuple[KeyPath, Mapping[str, object]]]:
    """The one cycle of a grid, or the several."""
    cycles = grid.get("cycle", [])
    if isinstance(cycles, list):
        yield from (((*path, "cycle", i), cycle) for i, cycle in enumerate(cycles) if isinstance(cycle, dict))
    elif isinstance(cycles, dict):
        yield (*path, "cycle"), cycles


def timing_said(raw: Mapping[str, object], before: GridTiming) -> GridTiming:
    """What a table says of tempo, meter and swing, and what was said `before` where it says nothing."""
    values, faults = checked_values({key: value for key, value in raw.items() if key in TIMING}, TIMING)
    return timing_of(values, before, faults)
