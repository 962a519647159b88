"""Keys that stand in the wrong table: where in a lesson file they belong.

In TOML a key belongs to the last `[table]` above it, so that a teacher who adds `passes` at the end of the file has
written it into the last grid. Such a key is known, only not there.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from station.core.toml.schema import Fields
from station.core.toml.toml_faults import Noted
from station.drills.grid.grid_reader import GRID
from station.drills.grid.grid_timing import DYNAMICS, GRACES
from station.drills.reading.bar_cues import AT
from station.drills.reading.lesson_fields import BAR_GOALS, FIELDS, GOALS

_HOMES: Mapping[str, Fields] = MappingProxyType(
    {
        "the lesson itself; expected above the first line in brackets": FIELDS,
        "the goals; expected below [goals]": GOALS,
        "the goals of some bars; expected below [[goals.bars]]": BAR_GOALS,
        "a grid; expected below [grid]": GRID,
        "what happens at a bar; expected in the list at": AT,
        "the velocities; expected below [dynamics]": DYNAMICS,
        "the grace strokes; expected below [graces]": GRACES,
    }
)
"""Where keys belong, most general first; a key that stands in several tables belongs to the first of them."""


def sent_home(faults: Sequence[Noted]) -> list[Noted]:
    """The same faults; those of keys that nobody knows where they stand say where they belong, if anywhere.

    Such a key is not missing as well in the table that lacks it.
    """
    strays = {fault.path[-1:] for fault in faults if fault.is_unknown}
    return [_sent_home(fault) for fault in faults if not (fault.is_missing and fault.path[-1:] in strays)]


def _sent_home(fault: Noted) -> Noted:
    if not fault.is_unknown:
        return fault
    key = str(fault.path[-1])
    home = next((home for home, fields in _HOMES.items() if key in fields), "")
    return replace(fault, text=f"{key} belongs to {home}") if home else fault
