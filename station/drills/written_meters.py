"""The meters that the grids of a lesson are written in, by the path of each table: what the layout of its lines needs.

`raw` is what a lesson's text says, without fault.
"""

from collections.abc import Mapping

from station.core.toml_places import KeyPath
from station.core.units import PPQ
from station.drills.grid.grid_timing import meters, note_length
from station.drills.line_layout import Meters
from station.music.tempo import MeterChange

_UNSAID = Meters((MeterChange(0, 4, 4),), PPQ)


def written_meters(raw: Mapping[str, object]) -> dict[KeyPath, Meters]:
    """The meters in turn of each grid and each cycle."""
    grids = raw["grid"]
    found: dict[KeyPath, Meters] = {}
    last = _said(raw, _UNSAID)
    named: dict[object, Meters] = {}
    for i, grid in enumerate(grids if isinstance(grids, list) else [grids]):
        path: KeyPath = ("grid", i) if isinstance(grids, list) else ("grid",)
        last = found[path] = _said(grid, named.get(grid.get("like"), last))
        named[grid.get("name")] = last
        for j, cycle in enumerate(grid.get("cycle", ())):
            found[*path, "cycle", j] = _said(cycle, last)
    return found


def _said(table: Mapping[str, object], before: Meters) -> Meters:
    """Meters and beat as a table says them, and as they were `before` where it does not."""
    said, beat = table.get("meter"), table.get("beat")
    in_turn = before.in_turn if said is None else meters(said)
    return Meters(in_turn, before.beat_ticks if beat is None else note_length(beat))
