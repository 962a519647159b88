"""What the station remembers of a student and a lesson between sessions: one small file for each.

`<sessions>/<student>/mastery/<lesson>_<bars>.json`, written whole after a session, holds the document of
`station.drills.mastery.mastery_json`. A file that cannot be read is set aside under another name, never written over.
"""

import json
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from station.core.errors import BadInput, DeviceError
from station.drills.lesson import Lesson
from station.drills.mastery.agenda import Turn, next_turn
from station.drills.mastery.mastery_json import document_of, state_from
from station.drills.mastery.mastery_state import ItemState
from station.practice.records.session_files import folder_name, write_document
from station.practice.session.adaptation import Adaptation
from station.practice.session.plan import PlanOptions

FOLDER = "mastery"
_SPARE_NAMES = 1000


@dataclass(frozen=True, slots=True)
class Memory:
    """Where a student's mastery of one lesson is kept."""

    path: Path

    @classmethod
    def of(cls, sessions: Path, student: str, lesson: str, bars: tuple[int, int]) -> "Memory":
        """The memory of `student` for `bars` (first, last, from 0) of `lesson`, under the folder of all sessions."""
        name = f"{folder_name(lesson)}_{bars[0] + 1}-{bars[1] + 1}.json"
        return cls(sessions / folder_name(student) / FOLDER / name)

    def recall(self) -> tuple[ItemState | None, str | None]:
        """What is remembered, None where nothing is; and a line for the student where it could not be read.

        Raises `DeviceError` where the file can neither be read nor set aside.
        """
        try:
            return state_from(json.loads(self.path.read_text(encoding="utf-8")), str(self.path)), None
        except FileNotFoundError:
            return None, None
        except OSError as fault:
            raise DeviceError(f"{self.path}: cannot be read: {fault.strerror or fault}") from fault
        except BadInput as fault:
            return None, f"{fault}; {self._set_aside()}"
        except (ValueError, RecursionError) as fault:
            return None, f"{self.path}: is no JSON document ({fault}); {self._set_aside()}"

    def keep(self, state: ItemState) -> None:
        """Remember `state` from now on; raises `DeviceError`, and then what was remembered stays."""
        write_document(self.path, document_of(state))

    def _set_aside(self) -> str:
        for attempt in range(1, _SPARE_NAMES):
            spare = self.path.with_name(f"{self.path.name}.unread-{attempt}")
            if spare.exists():
                continue
            try:
                self.path.rename(spare)
            except OSError as fault:
                raise DeviceError(f"{self.path}: cannot be set aside: {fault.strerror or fault}") from fault
            return f"it is kept as {spare.name}, mastery begins anew"
        raise DeviceError(f"{self.path}: too many files that could not be read lie beside it")


@dataclass(frozen=True, eq=False)
class Remembered:
    """Practice that follows a student, `memory` where it is remembered (None: nowhere), `fault` a line for the user."""

    adaptation: Adaptation
    memory: Memory | None = None
    fault: str | None = None

    @classmethod
    def of(cls, lesson: Lesson, options: PlanOptions, today: date, memory: Memory | None) -> "Remembered":
        """Practice of `lesson` from what `memory` holds; raises `BadInput` and `DeviceError` as its parts do."""
        known, fault = memory.recall() if memory is not None else (None, None)
        return cls(Adaptation(lesson, options, today, known), memory, fault)

    def next_turn(self) -> Turn | None:
        """What the student should practise next of all that is remembered; None where nothing is.

        A file that cannot be read is reported when its own lesson is practised.
        """
        if self.memory is None:
            return None
        here = self.adaptation.state
        known = _all_in(self.memory.path.parent)
        others = [state for state in known if (state.item.name, state.item.bars) != (here.item.name, here.item.bars)]
        return next_turn(here, others, self.adaptation.today, self.adaptation.rules)

    def keep(self) -> None:
        """Remember what was learnt; raises `DeviceError`."""
        if self.memory is not None:
            self.memory.keep(self.adaptation.state)


def remembered(sessions: Path, student: str) -> list[ItemState]:
    """All that is remembered of `student` under the folder of all sessions; what cannot be read is left out."""
    return _all_in(sessions / folder_name(student) / FOLDER)


def _all_in(folder: Path) -> list[ItemState]:
    return [state for path in sorted(folder.glob("*.json")) if (state := _known(path)) is not None]


def _known(path: Path) -> ItemState | None:
    try:
        return state_from(json.loads(path.read_text(encoding="utf-8")), str(path))
    except (OSError, ValueError, RecursionError, BadInput):
        return None
