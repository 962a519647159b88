"""The student's page of assignments: what is due, what is done of it, what the teacher wrote, and the return."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.teacher_actions import SendReturn, TakeUp
from station.app.room_state import Stage
from station.app.teacher_desk.assigned_page import AssignedRow
from station.app.teacher_desk.parcel_out import proposed_path
from station.app.window_state import State
from station.core.disk.file_names import folder_name
from station.gui import theme
from station.gui.panels.teacher.save_row import SaveRow
from station.practice.exchange.assigned_work import LessonWork
from station.practice.exchange.parcel import Kind
from station.practice.exchange.plain_words import LONGEST_WORDS

ASSIGNMENTS = "Assignments"
ABOUT = "What your teacher gave you: what is due, what is done, and what goes back"
HELP = (
    "Drop the file that your teacher gave you (.drum-assignment) on the window. Its lessons are among your own; press"
    " one to practise it, and what you have reached is told here. When you are ready, write the return (.drum-return)"
    " to a place of your choice and send your teacher that file: it has your sessions of this assignment and your line,"
    " and nothing else. Drop the note that comes back (.drum-note) on the window and read it here."
)
RETURN_LABEL, LINE_LABEL = "Write the return##return", "##return-words"
_NOTHING = "Nothing was assigned yet. Drop your teacher's file (.drum-assignment) on the window."
_GOALS = {True: "reached", False: "not yet", None: "your teacher tells"}


class AssignedPanel:
    """Keeps what is typed; what the student does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.words: dict[str, str] = {}
        self.saves: dict[str, SaveRow] = {}

    def poll(self) -> None:
        """Take what the system's dialogs have brought, whether or not the panel is seen."""
        for save in self.saves.values():
            save.poll()

    def gui(self, state: State) -> None:
        """Draw the panel and do what the student does in it."""
        view = state.assigned
        if view.told:
            imgui.text_wrapped(view.told)
            imgui.separator()
        if not view.rows:
            theme.soft("Reading the assignments …" if view.reads else _NOTHING)
        for row in view.rows:
            imgui.push_id(row.one.assignment.id)
            self._assignment(row, state)
            imgui.pop_id()

    def _assignment(self, row: AssignedRow, state: State) -> None:
        asked = row.one.assignment
        theme.heading(asked.title, 20)
        due = row.due[0].upper() + row.due[1:]
        theme.warning(due) if row.is_late else imgui.text_wrapped(due)
        theme.soft(f"from {asked.teacher}{f', {asked.group}' if asked.group else ''}")
        if asked.words:
            imgui.text_wrapped(asked.words)
        for work in row.lessons:
            self._lesson(work, state)
        for note in row.notes:
            theme.part(f"{note.teacher} wrote, {note.made:%d %b}")
            for line in note.lines:
                imgui.text_wrapped(line)
        self._return(row, state)

    def _lesson(self, work: LessonWork, state: State) -> None:
        imgui.begin_disabled(state.room.stage is not Stage.IDLE)
        chosen = state.selection.card is not None and state.selection.card.name == work.here
        if imgui.selectable(f"{work.asked.title}##{work.here}", chosen)[0]:
            self._dispatch(TakeUp(work.here))
        imgui.end_disabled()
        theme.tooltip("Choose it to practise")
        imgui.indent()
        best = "" if work.best is None else f", best score {work.best:.0f}"
        count = f"{work.sessions} session{'' if work.sessions == 1 else 's'}" if work.sessions else "not played yet"
        theme.soft(f"{count}{best}{f'; to the song {work.asked.song}' if work.asked.song else ''}")
        for goal in work.goals:
            imgui.text_wrapped(f"{goal.words}: {_GOALS[goal.reached]}")
        imgui.unindent()

    def _return(self, row: AssignedRow, state: State) -> None:
        identity, title = row.one.assignment.id, row.one.assignment.title
        theme.part("What goes back")
        if not row.sessions:
            theme.soft("Practise a lesson first: your sessions go back to your teacher.")
            return
        if identity not in self.saves:
            self.saves[identity] = SaveRow("Where the return is written", Kind.RETURN, RETURN_LABEL)
            name = f"{folder_name(title)}-{folder_name(state.settings.student)}"
            self.saves[identity].propose(proposed_path(name, Kind.RETURN))
        imgui.set_next_item_width(-1)
        words = self.words.get(identity, "")
        _, self.words[identity] = imgui.input_text_with_hint(LINE_LABEL, "how it went, in a line", words)
        theme.tooltip("A line to your teacher, if you like")
        if self.saves[identity].gui():
            self._dispatch(SendReturn(identity, self.words[identity][:LONGEST_WORDS], self.saves[identity].path))
