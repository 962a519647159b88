"""The landing: what is struck on the first beat after the last loop, one letter a line."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Ornament
from station.core.toml.schema import checked_values
from station.core.toml.toml_faults import Faults
from station.core.toml.toml_places import KeyPath
from station.drills.grid.cell_strokes import BarClock, Origin, expand
from station.drills.grid.grid import GridFrame
from station.drills.grid.grid_lines import LINES, RawLine, lines_of_table, plain_line
from station.drills.grid.grid_timing import GridTiming
from station.drills.grid.line_group import joined_strokes, parsed
from station.drills.grid.sticking_line import STICKING
from station.drills.grid.tab_symbols import BEYOND, CHOKE, HOLD, RESTS, SYMBOLS, family_of
from station.music.tempo import MeterChange

_NOTHING_STRUCK = RESTS + HOLD + CHOKE + BEYOND + "%()|"
_BEAT = MeterChange(0, 1, 4)
"""A buzz on the landing lasts a quarter."""


def read_landing(
    raw: object, timing: GridTiming, faults: Faults, path: KeyPath = ("landing",)
) -> tuple[NDArray[np.void], list[Origin]]:
    """The strokes (n,) of `NOTE_DTYPE` of the table at `path`, all on tick 0, and their letters.

    `timing` says how they are struck. Faults are noted in full; where there are some, the strokes are those that
    could be read.
    """
    values, found = checked_values(raw, LINES, "line")
    lines = lines_of_table(values, path, found)
    if not lines and not found:
        found.miss((), 'has nothing to land on; expected a line such as crash = "X"')
    are_all = not found
    faults.merge(found, *path)
    frames = [GridFrame(_BEAT, _BEAT.beat_ticks)]
    under = plain_line(values, STICKING, path)
    sound = [line for line in lines if _is_one_stroke(line, faults)]
    if under and len(under.text.strip()) != 1:
        faults.add(under.line.path, "expected one letter: R, L or B", _first(under.text))
        under = None
    voices = [parsed(line, frames, faults) for line in sound]
    hands = parsed(under, frames, faults) if under and len(sound) == len(lines) else None
    strokes = joined_strokes(voices, hands, [0], BarClock([_BEAT], timing.swing), faults, are_all=are_all)
    rows, origins = expand([replace(stroke, settings=timing.settings) for stroke in strokes])
    order = np.lexsort((rows["piece"], -rows["lead_ms"]))
    return rows[order], [origins[i] for i in order]


def _is_one_stroke(line: RawLine, faults: Faults) -> bool:
    """Whether the line is one letter that strikes once; a fault if not."""
    letter = line.text.strip()
    if len(letter) != 1 or letter in _NOTHING_STRUCK:
        faults.add(line.line.path, 'expected one letter that is struck, such as "X"', _first(line.text))
        return False
    symbol = SYMBOLS[family_of(line.line.piece)].get(letter)
    if symbol and symbol.ornament is Ornament.DIDDLE:
        faults.add(line.line.path, "a diddle is two strokes, and the landing is one; expected o", _first(line.text))
        return False
    return True


def _first(text: str) -> int:
    """The index of the first letter."""
    return len(text) - len(text.lstrip())
