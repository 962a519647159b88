"""How strokes of a grid were played: `[grid.timing]`, a list of milliseconds for each line that keeps its timing.

A number for each stroke of the line in the order of its bars, those of a bar written `%` too, for nobody plays a bar
twice alike: negative is early. A letter that makes several strokes, a flam or a diddle, has one number. Lines that
stand in a limb's table have their timing in a table of the same name. Cycles have none: they fall elsewhere each time.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from station.core.pieces import USUAL_FEET, Limb, Piece
from station.core.toml.schema import Fields, list_of, number, optional, said
from station.core.toml.toml_faults import Faults
from station.core.toml.toml_places import KeyPath
from station.drills.grid.cell_strokes import WrittenCell
from station.drills.grid.tab_symbols import LIMB_TABLES, LINE_PIECES
from station.music.score import MAX_LATE_MS

STROKE_TIMING = "timing"

_LATE = list_of(number(-MAX_LATE_MS, MAX_LATE_MS), "milliseconds such as [0, -12, 8], one for each stroke of the line")
_LINES: Fields = {key: optional(_LATE) for key in LINE_PIECES}
STROKE_TIMINGS: Fields = {**{name: optional(said(_LINES, "line")) for name in LIMB_TABLES}, **_LINES}
"""The keys of `[grid.timing]`."""


@dataclass(frozen=True, slots=True)
class LineTiming:
    """How late each stroke of a line sounds, in ms, and where that is written."""

    path: KeyPath
    late_ms: Sequence[float]


def line_timings(timing: Mapping[str, object] | None, grid: KeyPath) -> dict[tuple[Piece, Limb], LineTiming]:
    """The timings of the grid at path `grid` by the line that they are of; `timing` is its table as it was read."""
    return dict(_entries(timing or {}, (*grid, STROKE_TIMING), None))


def _entries(
    table: Mapping[str, object], path: KeyPath, limb: Limb | None
) -> Iterator[tuple[tuple[Piece, Limb], LineTiming]]:
    for key, value in table.items():
        if key in LIMB_TABLES and isinstance(value, Mapping):
            yield from _entries(value, (*path, key), LIMB_TABLES[key])
        elif isinstance(value, tuple):
            piece = LINE_PIECES[key]
            whose = USUAL_FEET.get(piece, Limb.UNKNOWN) if limb is None else limb
            yield (piece, whose), LineTiming((*path, key), value)


def timed(strokes: Sequence[WrittenCell], timing: LineTiming, name: str, faults: Faults) -> list[WrittenCell]:
    """The strokes of the line called `name` with their timing; a fault where there are not as many numbers."""
    late = timing.late_ms
    if len(late) == len(strokes):
        return [replace(stroke, late_ms=ms) if ms else stroke for stroke, ms in zip(strokes, late, strict=True)]
    many = f"{len(strokes)} stroke{'s' * (len(strokes) != 1)}"
    text = f"{len(late)} number{'s' * (len(late) != 1)}, but {name} has {many}; expected a number for each"
    faults.add((*timing.path, len(strokes)) if len(late) > len(strokes) else timing.path, text)
    return list(strokes)
