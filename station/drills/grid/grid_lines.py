"""The lines of a table: which piece and limb each is for, and its text as it stands in the file."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from station.core.expected import LINE, expects, later
from station.core.pieces import USUAL_FEET, Limb, Piece, word
from station.core.toml.schema import Fields, Reader, checked_values, optional, table_like
from station.core.toml.toml_faults import Faults, wrong
from station.core.toml.toml_places import KeyPath
from station.drills.grid.cell_strokes import GridLine
from station.drills.grid.sticking_line import STICKING
from station.drills.grid.stroke_timing import STROKE_TIMING, LineTiming, line_timings
from station.drills.grid.tab_symbols import LIMB_TABLES, LINE_PIECES


@dataclass(frozen=True, slots=True)
class RawLine:
    """A line, its text, and how it was played where the grid says that."""

    line: GridLine
    text: str
    timing: LineTiming | None = None


@expects(LINE)
def cells(value: object) -> str:
    """A line of the grid."""
    if not isinstance(value, str) or not value.strip():
        raise wrong('expected a line of the grid in quotes, such as "o---o---"')
    return value


def _cells_of(piece: Piece, limb: Limb) -> Reader[str]:
    """A line that one limb plays alone."""

    @expects(LINE)
    def read(value: object) -> str:
        if piece in _PEDALS and limb.is_hand:
            raise wrong(f"a hand plays no {_PEDALS[piece]}; expected right_foot or left_foot")
        if piece not in _PEDALS and not limb.is_hand:
            raise wrong(f"a foot plays no {word(piece)}; expected right_hand or left_hand")
        return cells(value)

    return read


_PEDALS = {Piece.KICK: "kick", Piece.HIHAT_PEDAL: "pedal"}
_LIMB_LINES: Mapping[str, Fields] = {
    name: {key: optional(_cells_of(piece, limb)) for key, piece in LINE_PIECES.items()}
    for name, limb in LIMB_TABLES.items()
}


def _limb_table(name: str) -> Reader[object]:
    """A limb's lines, to be read with `_LIMB_LINES`; editors are told of those that the limb can play."""
    can_play = {key for key, piece in LINE_PIECES.items() if (piece in _PEDALS) != LIMB_TABLES[name].is_hand}
    return later(table_like({key: each for key, each in _LIMB_LINES[name].items() if key in can_play}))


LINES: Fields = {
    STICKING: optional(cells),
    **{name: optional(_limb_table(name)) for name in LIMB_TABLES},
    **{key: optional(cells) for key in LINE_PIECES},
}
"""The lines that a grid, a cycle or a landing may have."""


def lines_of_table(values: Mapping[str, Any], path: KeyPath, faults: Faults) -> list[RawLine]:
    """The lines of pieces of the table at `path`, then those under limb tables; faults count from that table."""
    found = [
        RawLine(GridLine(piece, USUAL_FEET.get(piece, Limb.UNKNOWN), (*path, key)), values[key])
        for key, piece in LINE_PIECES.items()
        if values[key] is not None
    ]
    for name, limb in LIMB_TABLES.items():
        if values[name] is None:
            continue
        own, inner = checked_values(values[name], _LIMB_LINES[name], "line")
        faults.merge(inner, name)
        found += [
            RawLine(GridLine(piece, limb, (*path, name, key)), own[key])
            for key, piece in LINE_PIECES.items()
            if own[key] is not None
        ]
    _no_twins(found, len(path), faults)
    return _with_timing(found, values.get(STROKE_TIMING), path, faults)


def _with_timing(
    lines: list[RawLine], table: Mapping[str, object] | None, path: KeyPath, faults: Faults
) -> list[RawLine]:
    """The lines of the table at `path` with what its `timing` says of them; a fault for a line that is not there."""
    timings = line_timings(table, path)
    timed = [replace(raw, timing=timings.pop((raw.line.piece, raw.line.limb), None)) for raw in lines]
    for timing in timings.values():
        text = f"the grid has no line {'.'.join(map(str, timing.path[len(path) + 1 :]))} whose timing this could be"
        faults.add(timing.path[len(path) :], text, at_key=True)
    return timed


def plain_line(values: Mapping[str, Any], key: str, path: KeyPath) -> RawLine | None:
    """The line at `key`, which is for no piece of its own: the sticking, the loudness."""
    return None if values[key] is None else RawLine(GridLine(Piece.SNARE, Limb.UNKNOWN, (*path, key)), values[key])


def _no_twins(lines: list[RawLine], depth: int, faults: Faults) -> None:
    seen: dict[tuple[Piece, Limb], GridLine] = {}
    for raw in lines:
        twin = seen.setdefault((raw.line.piece, raw.line.limb), raw.line)
        if twin is not raw.line:
            faults.add(raw.line.path[depth:], f"{raw.line.path[-1]} and {twin.path[-1]} are one line", at_key=True)
