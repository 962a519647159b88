"""The schema of a lesson's top table: its keys, what may stand at each, and what counts where the file is silent.

The grids' own keys are in `grid/grid_reader` and `form`, those of `at` in `bar_cues`.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from station.core.expected import LINE, TEXT, either_of, expected_by, expects, later, list_like
from station.core.pieces import Limb
from station.core.toml.schema import (
    Field,
    Fields,
    checked_values,
    choice,
    key_of,
    list_of,
    no_such,
    number,
    optional,
    prose,
    row_of,
    said,
    shown,
    table_like,
    table_of,
    title,
    whole,
)
from station.core.toml.toml_faults import Faults, wrong
from station.core.units import PPQ
from station.drills.grid.grid_lines import LINES
from station.drills.grid.grid_reader import GRID
from station.drills.grid.grid_timing import TIMING, GridTiming
from station.drills.grid.line_group import MAX_BARS
from station.drills.grid.tab_symbols import LIMB_TABLES
from station.drills.lesson import DEFAULT_DEMONSTRATIONS, DEFAULT_PASSES, LEVELS, BarGoals, Goals, PartGoals
from station.drills.reading.bar_cues import AT
from station.drills.reading.form import FORM_FIELDS
from station.motion.kit.kit import kit_names
from station.music.swing import MAX_RATIO
from station.music.tempo import MAX_BPM, MIN_BPM, MeterChange
from station.scoring.analysis.fault_table import MUTE, Asked
from station.scoring.analysis.fault_table import WORDS as FAULT_WORDS
from station.scoring.matching.hit_windows import OUR_LEVELS, Level

MAX_PASSES = 1000
MAX_COUNT_IN_BARS = 8
MAX_DEMONSTRATIONS = 20
MAX_PREREQUISITES = 100
"""Our choice: nobody masters more for the sake of one lesson."""
DEFAULT_TIMING = GridTiming(80.0, (MeterChange(0, 4, 4),), PPQ)
"""Where a file says no tempo: a slow walk, our choice."""


@expects(LINE)
def _word(value: object) -> str:
    word = prose(value)
    if not word:
        raise wrong('expected a word such as "rock"')
    return word


_NAMES = list_of(_word, 'a list of lessons, such as ["rock-1", "rock-2"]')


@expects(list_like(LINE))
def _prerequisites(value: object) -> tuple[str, ...]:
    if isinstance(value, list) and len(value) > MAX_PREREQUISITES:
        raise wrong(f"{len(value)} entries; expected at most {MAX_PREREQUISITES}")
    return _NAMES(value)


@expects(LINE)
def _advice(value: object) -> str:
    advice = prose(value)
    if not advice:
        raise wrong('expected a sentence such as "A minute with the left alone."')
    return advice


@expects(TEXT)
def _kit(value: object) -> str:
    """The name of a shipped kit, or a file's; nothing where it is empty."""
    name = prose(value)
    if name and not name.endswith(".toml") and name not in (shipped := kit_names()):
        raise wrong(f"{no_such('kit', name, shipped)}; or a kit file's name, which ends in .toml")
    return name


@expects({"type": "object", "propertyNames": {"enum": sorted(FAULT_WORDS)}, "additionalProperties": LINE})
def _hints(raw: object) -> Mapping[str, str]:
    words = {word: word for word in sorted(FAULT_WORDS)}
    return MappingProxyType(table_of(key_of(words, "fault"), _advice)(raw))


# --- goals ------------------------------------------------------------------------------------------------------------

_SMALLEST_FAULT, _LARGEST_FAULT = 0.1, 1000.0
"""Bounds of the sizes of faults, in whatever unit: nobody hears less, and nobody plays so far off (our choice)."""


@expects(either_of({"const": MUTE}, expected_by(number(_SMALLEST_FAULT, _LARGEST_FAULT))))
def _fault_size(value: object) -> float | None:
    """From which size a fault counts; None for `MUTE`."""
    if isinstance(value, str) and value != MUTE:
        raise wrong(f'expected a size, or "{MUTE}", found {shown(value)}')
    return None if value == MUTE else number(_SMALLEST_FAULT, _LARGEST_FAULT)(value)


_FAULT_SIZES: Fields = {word: optional(_fault_size) for word in sorted(FAULT_WORDS)}


@expects(table_like(_FAULT_SIZES))
def _asked(raw: object) -> Asked:
    return Asked(MappingProxyType(said(_FAULT_SIZES, "fault")(raw)))


_PART: Fields = {
    "min_accuracy": optional(number(0, 1)),
    "max_sd_ms": optional(number(1, 1000)),
    "max_lean_ms": optional(number(0, 1000)),
    "max_loudness_error_db": optional(number(0.5, 40)),
}
"""What may be asked of all of the lesson, of one limb, and of some bars."""
_BARS = row_of([whole(1, MAX_BARS)] * 2, "two bar numbers such as [3, 4]")
BAR_GOALS: Fields = {
    "bars": Field(_BARS, None, "two bar numbers such as bars = [3, 4]"),
    **_PART,
    "max_tempo_error_pct": optional(number(0.1, 50)),
}


def _part(values: dict[str, Any], faults: Faults) -> PartGoals:
    """The goals among `values`; raises `Wrong` for the faults, and where nothing is asked."""
    if not faults and all(value is None for value in values.values()):
        faults.add((), f"asks nothing; expected one of {', '.join(values)}")
    faults.check()
    return PartGoals(**values)


@expects(table_like(_PART))
def _limb_goals(raw: object) -> PartGoals:
    return _part(*checked_values(raw, _PART))


@expects(table_like(BAR_GOALS))
def _bar_goals(raw: object) -> BarGoals:
    values, faults = checked_values(raw, BAR_GOALS)
    bars = values.pop("bars")
    if bars and bars[1] < bars[0]:
        faults.add(("bars",), f"bar {bars[1]} comes before bar {bars[0]}; expected the first bar first")
    goals = _part(values, faults)
    return BarGoals(bars[0] - 1, bars[1] - 1, goals)


_LEVEL = choice(OUR_LEVELS, "level")
GOALS: Fields = {
    "level": optional(_LEVEL),
    "strictest_level": Field(_LEVEL, Level.STUDIO),
    **_PART,
    "max_swing_error": optional(number(0, MAX_RATIO)),
    "target_tempo_bpm": optional(number(MIN_BPM, MAX_BPM)),
    "min_score": optional(number(0, 100)),
    "faults": Field(_asked, Asked()),
    **{limb: optional(_limb_goals) for limb in LIMB_TABLES},
    "bars": Field(list_of(_bar_goals, "tables [[goals.bars]]"), ()),
}
"""The schema of `[goals]`; tempi as written, in the lesson's own beat."""


@expects(table_like(GOALS))
def _goals(raw: object) -> Goals:
    values, faults = checked_values(raw, GOALS)
    level, strictest = values["level"], values["strictest_level"]
    if level is not None and level.rank > strictest.rank:
        faults.add(("level",), f"{level} is stricter than the strictest_level, {strictest}")
    faults.check()
    limbs: dict[Limb, PartGoals] = {
        limb: goals for key, limb in LIMB_TABLES.items() if (goals := values.pop(key)) is not None
    }
    return Goals(**values, limbs=MappingProxyType(limbs))


# --- what is read when more is known, though editors are told of it already -------------------------------------------

_LOOP = later(expected_by(row_of([whole(1, MAX_BARS)] * 2, "")))
_FORM = later(either_of(LINE, list_like(LINE, 1)))
_LANDING = later(table_like(LINES))
_ONE_GRID = table_like({**GRID, **FORM_FIELDS, "at": optional(later(list_like(table_like(AT))))})
_GRIDS = later(either_of(_ONE_GRID, list_like(_ONE_GRID, 1)))

# --- the whole --------------------------------------------------------------------------------------------------------

FIELDS: Fields = {
    "title": Field(title, "", 'a name such as title = "Rock 1"'),
    "author": Field(prose, ""),
    "level": Field(whole(min(LEVELS), max(LEVELS)), 1),
    "tags": Field(list_of(_word, 'a list of words, such as ["rock", "groove"]'), ()),
    "about": Field(prose, ""),
    "prerequisites": Field(_prerequisites, ()),
    "kit": Field(_kit, ""),
    **TIMING,
    "loop": optional(_LOOP),  # read when the bars are known
    "passes": Field(whole(1, MAX_PASSES), DEFAULT_PASSES),
    "count_in_bars": Field(whole(0, MAX_COUNT_IN_BARS), 1),
    "demonstrations": Field(whole(0, MAX_DEMONSTRATIONS), DEFAULT_DEMONSTRATIONS),
    "form": optional(_FORM),  # read when the grids are known
    "landing": optional(_LANDING),  # read when the grids are known
    "hints": Field(_hints, MappingProxyType({})),
    "goals": Field(_goals, Goals()),
    "grid": Field(_GRIDS, None, "a table [grid] with the lines to play"),
}
"""The schema of the top table, in the order in which a message lists its keys."""
AS_THEY_ARE = (
    "title",
    "author",
    "level",
    "tags",
    "about",
    "prerequisites",
    "kit",
    "passes",
    "count_in_bars",
    "demonstrations",
    "hints",
)
"""The keys that say what the field of that name in `Lesson` holds."""
