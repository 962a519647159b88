"""What was learnt in a session, to be remembered with it; and its file for the day on which the history is away.

`learnt.json` lies in the session's folder only where the history could not be reached at its end. It is remembered when
the folder is taken in, unless something later is known by then.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

from station.core.errors import BadInput
from station.drills.mastery.mastery_json import state_from
from station.practice.history.kept_json import kept_document
from station.practice.history.old_mastery import LEVELS_SCHEMA, levels_from, mastery_row
from station.practice.history.session_files import LEARNT_NAME, write_document
from station.store.rows import MasteryRow

SCHEMA = "drum-station/learnt/1"


@dataclass(frozen=True, slots=True)
class Learnt:
    """Mastery of some bars and levels of lessons; `on_top`: of what was known, else nobody could say what was."""

    mastery: tuple[MasteryRow, ...] = ()
    levels: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    on_top: bool = True


NOTHING_LEARNT = Learnt()


def write_learnt(folder: Path, learnt: Learnt) -> None:
    """Leave it in a session's folder; raises `DeviceError`."""
    mastery = [json.loads(row.document) for row in learnt.mastery]
    document = {"schema": SCHEMA, "mastery": mastery, "levels": dict(learnt.levels), "on_top": learnt.on_top}
    write_document(folder / LEARNT_NAME, document)


def learnt_in(folder: Path) -> Learnt:
    """What lies in a session's folder; nothing where none does, or what does cannot be read."""
    path = folder / LEARNT_NAME
    try:
        said = kept_document(path)
        if not isinstance(said, dict) or said.get("schema") != SCHEMA or not isinstance(said.get("mastery"), list):
            return NOTHING_LEARNT
        rows = tuple(mastery_row(state_from(each, str(path))) for each in said["mastery"])
        levels = levels_from({"schema": LEVELS_SCHEMA, "levels": said.get("levels")}, str(path))
    except BadInput:
        return NOTHING_LEARNT
    return Learnt(rows, levels, said.get("on_top") is True)
