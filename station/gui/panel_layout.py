"""Every panel of the window, in one table: what it is called, where it docks, who draws it.

A panel belongs to what goes on (`shown`), or it is a tool that the user opens from the strip's "Panels". Whoever adds
one writes a module in `panels` and a line here.
"""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import hello_imgui

from station.app.actions.action import Action, Show
from station.app.actions.player_actions import Seek
from station.app.actions.practice_actions import Drill, JudgeAt
from station.app.exam_page import ExamStage
from station.app.room_state import Stage
from station.app.window_state import State
from station.core.units import ns_from_s
from station.gui import theme
from station.gui.panels import (
    exam_panel,
    export_panel,
    graph_panel,
    hits_panel,
    import_panel,
    phase_panel,
    practice_panel,
    song_panel,
    today_panel,
)
from station.gui.panels.bars_panel import bars_panel
from station.gui.panels.devices import devices_panel, sticks_panel
from station.gui.panels.editor.editor_panel import EDITOR, EditorPanel
from station.gui.panels.exam_notes import NOTES, ExamNotes
from station.gui.panels.figure import style_panel
from station.gui.panels.history import history_panel
from station.gui.panels.lessons.who_plays import WhoPlaysPage
from station.gui.panels.lessons_panel import LessonsPanel
from station.gui.panels.panel import DockSide, Panel, panels_popup
from station.gui.panels.playback_row import PlaybackRow
from station.gui.panels.sound import sound_panel
from station.gui.panels.teacher import assigned_panel, teacher_panel
from station.gui.panels.transport_bar import TransportBar
from station.gui.panels.view_popup import ViewActions
from station.gui.view_keys import ViewKeys
from station.gui.viewport import Viewport
from station.gui.widgets.level_choice import level_choice

LESSONS, TRANSPORT, BARS, GRAPH = "Lessons", "Transport", "Bars", "Graph"


class Pages:
    """The panels; what the user does in them goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None], viewport: Viewport) -> None:
        self._dispatch = dispatch
        self.view_keys = ViewKeys(viewport, dispatch)
        self._lessons = LessonsPanel(dispatch, self.open_import)
        self.editor = EditorPanel(dispatch, viewport.canvas)
        self._playback = PlaybackRow(dispatch)
        self.hits = hits_panel.HitsPanel(self._playback)
        self.figure = style_panel.StylePanel(dispatch)
        self._practice = practice_panel.PracticePanel(dispatch)
        self._devices = devices_panel.DevicesPanel(dispatch)
        self._sticks = sticks_panel.SticksPanel(dispatch)
        self._export = export_panel.ExportPanel(dispatch)
        self.imports = import_panel.ImportPanel(dispatch)
        self.graph = graph_panel.GraphPanel(lambda to_s: dispatch(Seek(ns_from_s(to_s))))
        self._phase = phase_panel.PhasePanel(dispatch)
        self._today = today_panel.TodayPanel(dispatch)
        self.song = song_panel.SongPanel(dispatch)
        self.sound = sound_panel.SoundPanel(dispatch, self.open_import)
        self._exam = exam_panel.ExamPanel(dispatch)
        self._exam_notes = ExamNotes(dispatch, viewport.canvas)
        self._exam_stage = ExamStage.ASKED
        self.teacher = teacher_panel.TeacherPanel(dispatch, self._playback)
        self.assigned = assigned_panel.AssignedPanel(dispatch)
        self.history = history_panel.HistoryPanel(dispatch)
        viewpoints = ViewActions(self.view_keys.keep, self.view_keys.go, lambda: viewport.quality)
        self._transport = TransportBar(dispatch, viewpoints, self._open_tools)
        self.controls = self._transport.controls
        self.table = self._table()
        self.who = WhoPlaysPage(dispatch)
        self.docking: hello_imgui.DockingParams | None = None
        """Where they are docked, once the window is made."""

    def _table(self) -> tuple[Panel, ...]:
        """Every panel; those without `shown` are tools that the user opens."""
        beside, right, strip = DockSide.BESIDE, DockSide.RIGHT, DockSide.STRIP
        return (
            Panel(LESSONS, beside, self._lessons.gui, shown=_chooses),
            Panel(EDITOR, DockSide.EDITOR, self.editor.gui, shown=lambda state: state.editor is not None),
            Panel(NOTES, DockSide.EDITOR, self._exam_notes.gui, shown=lambda state: state.exam.shows_notes),
            Panel(BARS, beside, self._bars_gui, shown=lambda state: state.shows_result),
            Panel(today_panel.TODAY, right, self._today.gui, today_panel.ABOUT, help=today_panel.HELP),
            Panel(history_panel.HISTORY, right, self.history.gui, history_panel.ABOUT, help=history_panel.HELP),
            Panel(exam_panel.EXAM, right, self._exam.gui, exam_panel.ABOUT, help=exam_panel.HELP),
            Panel(teacher_panel.TEACHER, right, self.teacher.gui, teacher_panel.ABOUT, help=teacher_panel.HELP),
            Panel(assigned_panel.ASSIGNMENTS, right, self.assigned.gui, assigned_panel.ABOUT, help=assigned_panel.HELP),
            Panel(hits_panel.HITS, strip, self._hits_gui, hits_panel.ABOUT),
            Panel(style_panel.FIGURE, right, self.figure.gui, style_panel.ABOUT, help=style_panel.HELP),
            Panel(practice_panel.PRACTICE, right, self._practice.gui, practice_panel.ABOUT, help=practice_panel.HELP),
            Panel(devices_panel.DEVICES, right, self._devices.gui, devices_panel.ABOUT, help=devices_panel.HELP),
            Panel(sound_panel.SOUND, right, self.sound.gui, sound_panel.ABOUT, help=sound_panel.HELP),
            Panel(sticks_panel.STICKS, right, self._sticks.gui, sticks_panel.ABOUT, help=sticks_panel.HELP),
            Panel(import_panel.IMPORT, right, self._import_gui, import_panel.ABOUT, help=import_panel.HELP),
            Panel(export_panel.EXPORT, right, self._export.gui, export_panel.ABOUT, help=export_panel.HELP),
            Panel(GRAPH, strip, self._graph_gui, graph_panel.ABOUT, help=graph_panel.HELP),
            Panel(song_panel.SONG, right, self._song_gui, song_panel.ABOUT, help=song_panel.HELP),
            Panel(phase_panel.PHASE, strip, self._phase_gui, phase_panel.ABOUT, help=phase_panel.HELP),
            Panel(TRANSPORT, DockSide.BELOW, self._transport_gui, shown=lambda state: True),
        )

    # --- which are open ----------------------------------------------------------------------------------------------

    @property
    def tools(self) -> list[Panel]:
        """Those that the user opens."""
        return [page for page in self.table if page.shown is None]

    def is_open(self, name: str) -> bool:
        """Whether a panel is there."""
        return self._docked(name).is_visible

    def _docked(self, name: str) -> hello_imgui.DockableWindow:
        assert self.docking is not None, "the window has been made"
        return self.docking.dockable_window_of_name(name)

    def open_import(self) -> None:
        """Show the panel that brings music in."""
        self._docked(import_panel.IMPORT).is_visible = True

    def open_song(self) -> None:
        """Show the panel that pins a part to a band's sound."""
        self._docked(song_panel.SONG).is_visible = True

    def open_track(self) -> None:
        """Show the track that is played along to."""
        self.sound.leaf = sound_panel.TRACK_TAB

    def open_teacher(self) -> None:
        """Show the panel of what students sent."""
        self._to_front(teacher_panel.TEACHER)

    def open_assigned(self) -> None:
        """Show the panel of what a teacher gave."""
        self._to_front(assigned_panel.ASSIGNMENTS)

    def _to_front(self, name: str) -> None:
        """Show a panel before those that share its place."""
        docked = self._docked(name)
        docked.is_visible = docked.focus_window_at_next_frame = True

    def poll(self) -> None:
        """Take what the system's dialogs have brought."""
        for asks in (self.imports, self.song, self.sound, self.teacher, self.assigned):
            asks.poll()

    def show(self, state: State, is_welcomed: bool) -> None:
        """Show what belongs to `state`, nothing before the first questions were answered."""
        for page in self.table:
            if page.shown is not None:
                self._docked(page.name).is_visible = is_welcomed and page.shown(state)
        if state.exam.stage is not self._exam_stage:  # whatever was closed meanwhile, the marks are seen
            self._exam_stage = state.exam.stage
            self._docked(exam_panel.EXAM).is_visible = True

    def seen(self, shown: Show) -> Show:
        """What the window shows, as the tools that are open have it."""
        return replace(
            shown,
            devices=self.is_open(devices_panel.DEVICES),
            sticks=self.is_open(sticks_panel.STICKS),
            practice=self.is_open(practice_panel.PRACTICE),
            curves=self.is_open(GRAPH),
            phase=self.is_open(phase_panel.PHASE),
            today=self.is_open(today_panel.TODAY),
            exam=self.is_open(exam_panel.EXAM),
            teacher=self.is_open(teacher_panel.TEACHER),
            assigned=self.is_open(assigned_panel.ASSIGNMENTS),
            history=self.is_open(history_panel.HISTORY),
            sound=self.is_open(sound_panel.SOUND),
        )

    # --- drawing -----------------------------------------------------------------------------------------------------

    def _transport_gui(self, state: State) -> None:
        self._transport.gui(state)
        theme.fit_height(self._transport.height)

    def _open_tools(self) -> None:
        assert self.docking is not None, "the window has been made"
        panels_popup(self.tools, self.docking)

    def _import_gui(self, state: State) -> None:
        self.imports.gui(state.imports)

    def _bars_gui(self, state: State) -> None:
        self._playback.is_listening = state.room.listening
        self._next_level(state)
        bar = None if state.report is None else bars_panel(state.report, self._playback, can_drill=not state.room.exam)
        if bar is not None:
            self._dispatch(Drill(bar))

    def _next_level(self, state: State) -> None:
        """How strictly the lesson of one's own result is judged from the next session on."""
        selection = state.selection
        if selection.card is None or selection.level is None or state.room.exam or state.room.student or selection.free:
            return
        level = level_choice(selection.card.levels, selection.level, "From the next session on")
        if level is not None:
            self._dispatch(JudgeAt(selection.card.name, level))

    def _hits_gui(self, state: State) -> None:
        self._playback.is_listening = state.room.listening
        self.hits.gui(state.report if state.shows_result else None)

    def _graph_gui(self, state: State) -> None:
        self.graph.gui(state.curves, can_seek=state.room.stage is Stage.IDLE)

    def _song_gui(self, state: State) -> None:
        self.song.gui(state.song, can_play=state.room.stage is not Stage.PLAYING)

    def _phase_gui(self, state: State) -> None:
        self._phase.gui(state.phase, can_play=state.room.stage is not Stage.PLAYING)


def _chooses(state: State) -> bool:
    """Whether lessons are chosen from."""
    return state.room.stage is Stage.IDLE and state.editor is None and not state.room.exam and not state.room.battle
