"""The teacher's page: what students sent, a take opened to be heard and judged, the note on it; assignments to give."""

from collections.abc import Callable
from itertools import groupby

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.teacher_actions import JudgeReturns, OpenTake
from station.app.teacher_desk.returns_desk import LessonRow, SessionRow
from station.app.teacher_desk.teacher_page import Answer, TeacherView
from station.app.window_state import State
from station.gui import theme
from station.gui.panels.playback_row import PlaybackRow
from station.gui.panels.teacher.give_part import GivePart
from station.gui.panels.teacher.take_part import TakePart

TEACHER = "Teacher"
ABOUT = "What your students sent, heard and judged; assignments to give"
HELP = (
    "Drop the files that your students sent (.drum-return) on the window. They are listed by class and student;"
    " until you check them, scores are the students' own word. Press a session to open it: the bars, every hit,"
    " and any bar as the teacher plays it and as the student played it. What you judge otherwise goes into the"
    " note, and so does what you say; write the note (.drum-note) to a place of your choice and send the file."
    " Give makes an assignment of lessons: choose one in the list on the left, add it, and say what you ask of it."
)
CHECK_LABEL, LIST_LABEL = "Check all##returns", "All returns##returns"
RETURNS_TAB, GIVE_TAB = "Returns", "Give"
_NOTHING = "No return came yet. Drop the files of your students (.drum-return) on the window."
_GOALS = {True: "reached", False: "not yet", None: "yours to say"}
_WIDE = 120.0
"""Design pixels of a button."""


class TeacherPanel:
    """The panel; what the teacher does goes to `dispatch`, `playback` chooses which bar is heard."""

    def __init__(self, dispatch: Callable[[Action], None], playback: PlaybackRow) -> None:
        self._dispatch = dispatch
        self.take, self.give = TakePart(dispatch, playback), GivePart(dispatch)
        self._left_take: object = None  # it was opened, and the list is shown again

    def poll(self) -> None:
        """Take what the system's dialogs have brought, whether or not the panel is seen."""
        self.take.poll()
        self.give.poll()

    def gui(self, state: State) -> None:
        """Draw the panel and do what the teacher does in it."""
        view = state.teacher
        if imgui.begin_tab_bar("##teacher"):
            if imgui.begin_tab_item(RETURNS_TAB)[0]:
                self._returns(state, view)
                imgui.end_tab_item()
            if imgui.begin_tab_item(GIVE_TAB)[0]:
                self.give.gui(state)
                imgui.end_tab_item()
            imgui.end_tab_bar()

    def _returns(self, state: State, view: TeacherView) -> None:
        if view.opened is not None and view.opened is not self._left_take and view.opening is None:
            if imgui.button(LIST_LABEL, imgui.ImVec2(theme.points(_WIDE), 0)):
                self._left_take = view.opened
            theme.tooltip("Back to the list; what you judged stays")
            self.take.gui(state, view)
            return
        if not view.rows:
            theme.soft("Reading the returns …" if view.reads else _NOTHING)
            return
        self._list(view)

    # --- the list ----------------------------------------------------------------------------------------------------

    def _list(self, view: TeacherView) -> None:
        imgui.begin_disabled(view.judging > 0)
        if imgui.button(CHECK_LABEL, imgui.ImVec2(theme.points(_WIDE), 0)):
            self._dispatch(JudgeReturns())
        imgui.end_disabled()
        theme.tooltip("Judge every session again from its capture, and tell where a report says otherwise")
        if view.judging:
            theme.soft(f"{view.judging} still to be judged …")
        if view.opening is not None:
            theme.soft("Opening the take …")
        if view.told:
            theme.soft(view.told)
        for (shelf, student), rows in groupby(view.rows, lambda row: (row.shelf, row.student)):
            theme.part(f"{student} · {shelf}")
            for stem, lessons in groupby(rows, lambda row: row.stem):
                self._return(list(lessons), view.answers.get(stem, Answer()))

    def _return(self, lessons: list[LessonRow], answer: Answer) -> None:
        first = lessons[0]
        told = "answered" if first.is_answered and answer.is_written else "no note yet"
        told = "note not written yet" if answer.verdicts and not answer.is_written else told
        imgui.text_wrapped(f"{first.title}, sent {first.stem[:10]} · {told}")
        if first.words:
            imgui.text_wrapped(f"“{' '.join(first.words.split())}”")
        for row in lessons:
            self._lesson(row)
        imgui.spacing()

    def _lesson(self, row: LessonRow) -> None:
        theme.heading(row.lesson, 17)
        for goal in row.goals:
            theme.soft(f"{goal.words}: {_GOALS[goal.reached]}")
        flags = imgui.TableFlags_.row_bg | imgui.TableFlags_.sizing_stretch_prop
        if not imgui.begin_table(f"##{row.stem}{row.lesson}", 4, flags):
            return
        for title, share in (("Played", 3.0), ("Score", 1.4), ("bpm", 1.2), ("Checked", 2.0)):
            imgui.table_setup_column(title, 0, share)
        imgui.table_headers_row()
        for session in row.sessions:
            self._session(session)
        imgui.end_table()

    def _session(self, session: SessionRow) -> None:
        told = session.told.figures
        imgui.table_next_row()
        imgui.table_next_column()
        stem, number = session.key
        label = f"{session.told.played:%d %b %H:%M}##take-{stem}-{number}"
        if imgui.selectable(label, False, imgui.SelectableFlags_.span_all_columns)[0]:
            self._dispatch(OpenTake(stem, number))
        early = "" if told.complete else ", stopped early"
        theme.tooltip(
            f"The report: score {_shown(told.score)}, {told.right} of {told.notes} notes right, judged as"
            f" {told.level}{early}. Press to hear and see it"
        )
        imgui.table_next_column()
        imgui.text(_score(session))
        imgui.table_next_column()
        imgui.text(f"{told.beats_a_minute:g}")
        imgui.table_next_column()
        _checked(session)


def take_label(stem: str, number: int) -> str:
    """The end of the label of that session in the list."""
    return f"##take-{stem}-{number}"


def _score(session: SessionRow) -> str:
    """The teacher's score where they gave one, else the report's."""
    given = None if session.verdict is None else session.verdict.score
    return _shown(session.told.figures.score) if given is None else f"{_shown(given)} (yours)"


def _shown(score: float | None) -> str:
    return "–" if score is None else f"{score:.0f}"


def _checked(session: SessionRow) -> None:
    """Whether the report is what the capture gives."""
    if session.fault is not None:
        theme.warning("unreadable")
        theme.tooltip(session.fault)
    elif session.heard is None:
        theme.soft("not yet")
    elif session.heard.differences:
        theme.warning("differs")
        theme.tooltip("\n".join(session.heard.differences))
    else:
        imgui.text("the same")
