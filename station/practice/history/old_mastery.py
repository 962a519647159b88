"""Mastery and levels as they lay in files before there was a history: taken in once, then set aside.

`<student>/mastery/<lesson>_<bars>.json` held what was known of some bars, `levels.json` the level of each lesson. When
the student is first asked for, all of it comes into the history and the folder becomes `mastery-before-history`, in
which a file that cannot be read stays. Where the folder cannot be renamed, what the history knows since stays.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING

from station.core.errors import BadInput
from station.drills.mastery.mastery_json import document_of, state_from
from station.drills.mastery.mastery_state import ItemState
from station.practice.history.kept_json import kept_document
from station.scoring.matching.hit_windows import OUR_LEVELS
from station.store.rows import MasteryRow

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History

FOLDER = "mastery"
SET_ASIDE = "mastery-before-history"
LEVELS_NAME = "levels.json"
LEVELS_SCHEMA = "drum-station/levels/1"
_ITEMS = "*_*.json"
_SPARE_NAMES = 1000
_turn = Lock()
"""Of a window's threads one takes a folder in, and the others wait until it is."""
_untold: dict[tuple[str, Path], list[str]] = {}
"""Of each history and student's folder that was looked into: what nobody has been told yet."""


def take_in_old(history: "History", folder: Path, student: str) -> None:
    """Have the history know what lies in a student's `folder`; looked for once in a program. Raises `DeviceError`."""
    key = history.name, folder
    with _turn:
        if key not in _untold:
            _untold[key] = _taken_in(history, folder / FOLDER, student) if (folder / FOLDER).is_dir() else []


def untold_faults(history: "History", folder: Path) -> list[str]:
    """What could not be taken in, a line each, told once."""
    lines, _untold[history.name, folder] = _untold.get((history.name, folder), []), []
    return lines


def begun_anew(history: "History") -> str:
    """What is lost where a history's file was emptied."""
    return f"history {history.name}: was empty: sessions come from their folders again, mastery and levels begin anew"


def mastery_row(state: ItemState) -> MasteryRow:
    """What is known of an item, as the history keeps it."""
    return MasteryRow(state.item.name, *state.item.bars, json.dumps(document_of(state)))


def _taken_in(history: "History", old: Path, student: str) -> list[str]:
    faults: list[str] = []
    states: list[ItemState] = []
    for path in sorted(old.glob(_ITEMS)):
        try:
            states.append(state_from(kept_document(path), str(path)))
        except BadInput as fault:
            faults.append(_left_out(fault, path))
    levels: Mapping[str, str] = {}
    if (old / LEVELS_NAME).exists():
        try:
            levels = levels_from(kept_document(old / LEVELS_NAME), str(old / LEVELS_NAME))
        except BadInput as fault:
            faults.append(_left_out(fault, old / LEVELS_NAME))
    history.remember_new(student, map(mastery_row, states), levels)
    return faults + _set_aside(old)


def levels_from(document: object, source: str) -> dict[str, str]:
    """The levels in a document; raises `BadInput` that names `source`, the place and the fault."""
    if not isinstance(document, dict) or document.get("schema") != LEVELS_SCHEMA:
        raise BadInput(source, "schema", f"is not {LEVELS_SCHEMA}")
    levels = document.get("levels")
    if not isinstance(levels, dict):
        raise BadInput(source, "levels", "is no table")
    for lesson, level in levels.items():
        if level not in list(OUR_LEVELS):
            raise BadInput(source, f"levels.{lesson}", f"{level!r} is no level")
    return {lesson: str(level) for lesson, level in levels.items()}


def _left_out(fault: BadInput, path: Path) -> str:
    begins_anew = "levels begin" if path.name == LEVELS_NAME else "mastery begins"
    return f"{fault}; it is kept in {SET_ASIDE}, {begins_anew} anew"


def _set_aside(old: Path) -> list[str]:
    for number in range(1, _SPARE_NAMES):
        spare = old.with_name(SET_ASIDE if number == 1 else f"{SET_ASIDE}-{number}")
        if spare.exists():
            continue
        try:
            old.rename(spare)
        except FileNotFoundError:  # another program has just taken it in
            return []
        except OSError as fault:
            return [f"{old}: what it holds is in the history now, but it cannot be renamed: {fault.strerror or fault}"]
        return []
    return [f"{old}: what it holds is in the history now, but it cannot be renamed: too many lie beside it"]
