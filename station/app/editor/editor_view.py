"""What the editor shows in one frame: the text, its grids and faults, where one is, what is heard. One frozen value."""

from dataclasses import dataclass, field

from station.app.editor.take_recorder import TakeView
from station.core.toml.toml_faults import Fault
from station.drills.editing.grid_cursor import BarRange, Cursor, GridStep, Place
from station.drills.editing.grid_page import GridPage, PageGrid
from station.drills.editing.take_options import TakeOptions
from station.drills.editing.words.fault_cells import FaultCell
from station.drills.lesson import Lesson


@dataclass(frozen=True, slots=True, eq=False)
class EditorView:
    """A lesson that is written.

    `name` is what its file is called, empty where it has none yet; `page` are the grids of `text`; `lesson` the last
    that could be read, that of the text where `faults` is empty, None where none could. `bars` are those that are
    selected and repeated, None for all; `step` how fine one writes; `letter` what a click writes, empty for the usual
    stroke of the line; `playhead` where the demonstration is, None while it stands at the beginning. `undo` and `redo`
    say what they would take back or do again, empty where there is nothing. `takes` says whether what the kit plays is
    written at the cursor. `is_blank` says whether this is a new lesson in which nothing stands yet.
    """

    name: str
    text: str
    page: GridPage
    lesson: Lesson | None
    faults: tuple[Fault, ...] = ()
    fault_cells: tuple[FaultCell, ...] = ()
    cursor: Cursor = field(default_factory=Cursor)
    bars: BarRange | None = None
    step: GridStep = GridStep.SIXTEENTHS
    letter: str = ""
    playhead: Place | None = None
    plays: bool = False
    undo: str = ""
    redo: str = ""
    is_saved: bool = True
    step_entry: bool = False
    options: TakeOptions = field(default_factory=TakeOptions)
    take: TakeView | None = None
    is_blank: bool = False

    @property
    def is_sound(self) -> bool:
        """Whether the text could be read."""
        return not self.faults

    @property
    def grid(self) -> PageGrid | None:
        """The grid that the cursor is in; None where the text has none that can be shown."""
        return self.page.grids[self.cursor.grid] if self.cursor.grid < len(self.page.grids) else None
