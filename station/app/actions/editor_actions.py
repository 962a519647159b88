"""What the editor may be asked, by mouse, keys, kit and forms: to open, to edit, to go somewhere, to keep."""

from dataclasses import dataclass
from pathlib import Path

from station.drills.editing.grid_cursor import BarRange, Cursor, GridStep, Way
from station.drills.editing.lesson_edits import LessonEdit
from station.drills.editing.take_options import TakeOptions


@dataclass(frozen=True, slots=True)
class OpenEditor:
    """Edit the lesson of a name: one of the user's own in its file, one that ships as a copy of their own."""

    lesson: str


@dataclass(frozen=True, slots=True)
class NewLesson:
    """Begin a lesson."""


@dataclass(frozen=True, slots=True)
class ResumeDraft:
    """Go on with the draft whose journal lies at `path`."""

    path: Path


@dataclass(frozen=True, slots=True)
class DropDraft:
    """Throw away the draft whose journal lies at `path`."""

    path: Path


@dataclass(frozen=True, slots=True)
class CloseEditor:
    """Back to the lessons; a draft that is not saved is kept for the next time."""


@dataclass(frozen=True, slots=True)
class SaveLesson:
    """Write the lesson's file; with a `name` another file of that name from now on."""

    name: str = ""


@dataclass(frozen=True, slots=True)
class Edit:
    """Change the text; with `joins` an undo takes it back together with the same edits just before it."""

    edit: LessonEdit
    joins: bool = False


@dataclass(frozen=True, slots=True)
class Undo:
    """Take the last change back."""


@dataclass(frozen=True, slots=True)
class Redo:
    """Do again what was taken back last."""


@dataclass(frozen=True, slots=True)
class PutCursor:
    """Go to a place and a line."""

    cursor: Cursor


@dataclass(frozen=True, slots=True)
class MoveCursor:
    """Go a way from where the cursor is; with `selects` the bars between are selected."""

    way: Way
    selects: bool = False


@dataclass(frozen=True, slots=True)
class WriteLetter:
    """Write a letter, a hand or a loudness mark at the cursor, and go a cell on."""

    letter: str


@dataclass(frozen=True, slots=True)
class EraseHere:
    """Erase what stands at the cursor, which stays."""


@dataclass(frozen=True, slots=True)
class ChooseLetter:
    """What a click writes from now on; empty for the usual stroke of its line."""

    letter: str


@dataclass(frozen=True, slots=True)
class SetGridStep:
    """How fine one writes from now on."""

    step: GridStep


@dataclass(frozen=True, slots=True)
class SelectBars:
    """Select bars, which are then repeated; None for all."""

    bars: BarRange | None


@dataclass(frozen=True, slots=True)
class CopySelection:
    """Remember the selected bars, or that of the cursor."""


@dataclass(frozen=True, slots=True)
class CutSelection:
    """Remember the selected bars, or that of the cursor, and take them away."""


@dataclass(frozen=True, slots=True)
class PasteBars:
    """Write the bars that were copied over those from the cursor on, or before the cursor's with `inserts`."""

    inserts: bool = False


@dataclass(frozen=True, slots=True)
class DuplicateBars:
    """The selected bars, or that of the cursor, once more behind themselves."""


@dataclass(frozen=True, slots=True)
class RemoveSelection:
    """Take the selected bars, or that of the cursor, away."""


@dataclass(frozen=True, slots=True)
class SetStepEntry:
    """Write what the kit plays at the cursor, or no longer."""

    on: bool


@dataclass(frozen=True, slots=True)
class SetTakeOptions:
    """How what is played in is written from now on."""

    options: TakeOptions


@dataclass(frozen=True, slots=True)
class RecordTake:
    """Record over the selected bars, all of the grid where none are; or end the recording that runs."""


EditorAction = (
    OpenEditor
    | NewLesson
    | ResumeDraft
    | DropDraft
    | CloseEditor
    | SaveLesson
    | Edit
    | Undo
    | Redo
    | PutCursor
    | MoveCursor
    | WriteLetter
    | EraseHere
    | ChooseLetter
    | SetGridStep
    | SelectBars
    | CopySelection
    | CutSelection
    | PasteBars
    | DuplicateBars
    | RemoveSelection
    | SetStepEntry
    | SetTakeOptions
    | RecordTake
)
