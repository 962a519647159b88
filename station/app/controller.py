"""The station behind its window: what is practised, chosen, set and measured, and what is shown of it. No window.

`update` takes in what has happened and moves everything on; `dispatch` does what the user asks; nothing else changes
anything. `view` is what the window shows, one frozen value. Hits carry their own times, so that the frame rate decides
nothing.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import assert_never

from station.app.actions.action import Action, DeskAction, Notify, Show
from station.app.actions.editor_actions import CloseEditor, EditorAction
from station.app.actions.equipment_actions import (
    CalibrationAction,
    CancelMeasuring,
    EquipmentAction,
    ForgetMeasured,
    KeepMeasured,
    MappingAction,
    Measure,
    StickAction,
)
from station.app.actions.exam_actions import ExamAction, LeaveExam, ReadyForExam
from station.app.actions.file_actions import FileAction, Import, ImportAction
from station.app.actions.phase_actions import PhaseAction
from station.app.actions.player_actions import PlayerAction
from station.app.actions.practice_actions import (
    Begin,
    ChoiceAction,
    ChooseBars,
    Drill,
    EndSession,
    Leave,
    Pause,
    PracticeAction,
    StrikeKey,
)
from station.app.actions.settings_actions import (
    Embody,
    FinishFirstStart,
    KeepViewpoint,
    LeadWith,
    LearnPause,
    PutUp,
    SetPreferences,
    SettingsAction,
    SetView,
)
from station.app.actions.song_actions import BringSound, SaveSong, SongAction
from station.app.actions.style_actions import StyleAction
from station.app.actions.teacher_actions import AssignedAction, SendReturn, TeacherAction
from station.app.actions.today_actions import StartBlock, TodayAction
from station.app.child_programs import ChildPrograms
from station.app.chooser import Chooser
from station.app.editor.draft_files import DraftFiles
from station.app.editor.lesson_editor import LessonEditor
from station.app.engine_client import EngineClient
from station.app.equipment.calibration import Calibration, CalibrationView
from station.app.equipment.mapping_editor import MappingEditor
from station.app.equipment.mapping_view import MappingView
from station.app.equipment.sticks_editor import SticksEditor
from station.app.equipment.sticks_view import SticksView
from station.app.exam_page import ExamPage, ExamSurroundings, ExamView
from station.app.export import Exporter
from station.app.importer import Importer, lessons_of, told
from station.app.phase_page import PhasePage, PhaseView
from station.app.room_state import Stage
from station.app.sessions.pad_control import PadControl
from station.app.sessions.session_control import Launch, SessionControl
from station.app.settings.first_start import answered, student_level
from station.app.settings.preferences import Preferences
from station.app.settings.settings_store import SettingsStore
from station.app.settings.view_settings import ViewSettings, view_settings_of, with_view_settings
from station.app.songs.song_page import Ear, SongPage
from station.app.style_editor import StyleEditor
from station.app.teacher_desk.assigned_page import AssignedPage, AssignedView
from station.app.teacher_desk.teacher_page import TeacherPage, TeacherView
from station.app.toasts import Toasts
from station.app.today_page import TodayPage, TodayView
from station.app.window_state import State
from station.core.errors import DeviceError, StationError
from station.core.events import DeviceLost
from station.core.measured_latency import StoredCalibration, load_calibration
from station.drills.songs.song_file import is_song
from station.drills.songs.song_folder import SOUND_ENDINGS
from station.engine.messages import EngineEvent
from station.practice.records.recovery import offer
from station.practice.session.device_latency import latency_of

_NO_CALIBRATION = CalibrationView(StoredCalibration())


class Controller:
    """Owns everything that is not drawn; `processes` start an engine: once now, and again when one has died.

    Sessions go by `store`; `launch` is what it opens on. Raises `BadInput` for settings whose words mean nothing.
    """

    def __init__(self, processes: ChildPrograms, store: SettingsStore, launch: Launch) -> None:
        self._store, self._toasts = store, Toasts()
        notify = self._toasts.notify
        if store.fault is not None:
            notify(f"{store.fault}; the defaults hold for what is wrong")
        notify(offer(store.now) or "")
        self._view_settings = view_settings_of(store.now)
        self._engine = EngineClient(processes.engine, store.now.rate_hz)
        self._style = StyleEditor(store, notify)
        self.sessions = SessionControl(
            self._engine, store, launch, self._style.demonstrator, notify, ThreadPoolExecutor(1, "drummer")
        )
        self._drafts = DraftFiles(self.sessions.catalog, store, notify, ThreadPoolExecutor(1, "draft reader"))
        self.editor = LessonEditor(self._drafts, self.sessions, notify)
        self.mapping = MappingEditor(self._engine.forward)
        self.calibration = Calibration(self._rest, self._engine.wake, processes.measure)
        self.sticks = SticksEditor(self._engine.forward, store, self._start_anew)
        self._tried(self.sticks.begin)
        self.preferences = Preferences(store)
        self._pads = PadControl(store, self.preferences, launch.plan.score)
        self.export = Exporter(processes.animate, processes.work)
        self.imports = Importer(store, processes.work)
        self.phase = PhasePage(
            self.sessions.listen_to, self.sessions.is_listening_to, self.sessions.quiet, ThreadPoolExecutor(1, "motion")
        )
        sessions = self.sessions
        ear = Ear(sessions.listen_to, sessions.is_listening_to, sessions.quiet, sessions.heard_ns)
        self.song = SongPage(store, ear, lambda: self._engine.rate_hz, processes.work)
        self._chooser = Chooser(self.sessions, store, launch, ThreadPoolExecutor(1, "catalog"))
        self.today = TodayPage(store, notify, ThreadPoolExecutor(1, "book"))
        around = ExamSurroundings(lambda: self._chooser.lesson_name, self._make_ready, self._chooser.show_anew)
        self.exam = ExamPage(store, self.sessions, around)
        self.teacher = TeacherPage(
            store,
            self.sessions.look_at,
            self.sessions.catalog.lesson,
            processes.work,
            ThreadPoolExecutor(1, "returns"),
        )
        self.assigned = AssignedPage(store, ThreadPoolExecutor(1, "assignments"))
        self._shown = Show()
        self._now_ns = 0
        self._view: State | None = None

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def update(self, now_ns: int) -> bool:
        """Take in what has happened until `now_ns` and move on; returns whether the engine has said anything."""
        self._view, self._now_ns = None, now_ns
        self._tried(self.calibration.advance)
        if not self.editor.is_open and not self.exam.looks:
            self._tried(self._chooser.update)
        events = self._heard()
        asked = [action for event in events if (action := self._handle(event)) is not None]
        self.mapping.advance(now_ns)
        self._tried(lambda: self.sticks.advance(now_ns))
        self._tried(lambda: self.sessions.advance(now_ns))
        self._tried(lambda: self.exam.advance(now_ns))
        self._tried(lambda: self.editor.advance(now_ns))
        self._tried(lambda: self.phase.advance(now_ns))
        self._tried(lambda: self.song.advance(now_ns))
        self._tried(lambda: self._toasts.notify(self.export.news() or self.export.written() or ""))
        self._tried(self._import)
        if self._shown.today:
            self._tried(lambda: self.today.advance(date.today(), self.sessions.practice.stage))
        if self._shown.teacher:
            self._tried(self.teacher.advance)
        if self._shown.assigned:
            self._tried(lambda: self.assigned.advance(date.today(), self.sessions.practice.stage))
        for action in asked:
            self.dispatch(action)
        if not self.sessions.practice.is_playing:
            self._keep()
        self._toasts.update(now_ns)
        return bool(events)

    def _import(self) -> None:
        """Choose what was imported; raises `StationError`."""
        kept = self.imports.advance()
        if kept is not None:
            self._toasts.notify(told(kept))
            self.teacher.look_again()
            self.assigned.look_again()
            if lessons := lessons_of(kept):
                self._chooser.open(*lessons)

    def _heard(self) -> list[EngineEvent]:
        try:
            return self._engine.events()
        except DeviceError as fault:
            self._toasts.notify(str(fault))
            self.sessions.died()
            self.editor.died()
            return []

    def _handle(self, event: EngineEvent) -> Begin | None:
        """Handle one event; a session that it asks for begins when all others are handled, anything else at once."""
        self.mapping.handle(event)
        self.sticks.handle(event)
        self._tried(lambda: self.song.handle(event))
        self.sessions.handle(event, self._now_ns)
        if self.mapping.learns or self.sticks.learns:  # strokes teach, and ask for nothing
            return None
        if self.editor.is_open:  # they write, and ask for nothing
            self._tried(lambda: self.editor.handle(event))
            return None
        if self.exam.is_on:  # whoever tries a piece, plays it or reads their marks asks for nothing
            return None
        asked = self._pads.handle(event, self.sessions.practice)
        if asked is None or isinstance(asked, Begin):
            return asked
        self.dispatch(asked)
        return None

    def _keep(self) -> None:
        """Write what was set; never while somebody plays."""
        self._tried(self._style.keep)
        if self._store.is_due:
            self._tried(self._store.write)

    # --- what is shown -----------------------------------------------------------------------------------------------

    def view(self) -> State:
        """What the window shows, as of the last update and what was dispatched since."""
        if self._view is None:
            self._view = self._seen()
        return self._view

    def _seen(self) -> State:
        sessions, shown = self.sessions, self._shown
        snapshot = sessions.snapshot(self._now_ns) if shown.picture else None
        return State(
            room=replace(sessions.room(), exam=self.exam.is_on),
            selection=self._chooser.selection,
            player=sessions.player.view(),
            settings=self._store.now,
            view_settings=self._view_settings,
            style=self._style.view(),
            hands=sessions.hands,
            score=sessions.practice.session.plan.lesson.score,
            preferences=self.preferences.now,
            mapping=self.mapping.view() if shown.devices else MappingView(),
            calibration=self.calibration.view() if shown.devices else _NO_CALIBRATION,
            sticks=self.sticks.view() if shown.sticks else SticksView(),
            snapshot=snapshot if snapshot is None else self.exam.named(snapshot),
            report=sessions.practice.last_result.report,
            curves=sessions.curves() if shown.curves else None,
            phase=self.phase.view() if shown.phase else PhaseView(),
            learns_pause=self.preferences.learns,
            export_bars=self._chooser.bars,
            export=self.export.view(),
            played=sessions.played,
            imports=self.imports.view(),
            editor=self.editor.view(),
            drafts=self._drafts.left if shown.catalog and not self.editor.is_open else (),
            today=self.today.view() if shown.today else TodayView(),
            song=self.song.view(),
            exam=self.exam.view() if shown.exam or self.exam.is_on else ExamView(),
            teacher=self.teacher.view() if shown.teacher else TeacherView(),
            assigned=self.assigned.view() if shown.assigned else AssignedView(),
            toast=self._toasts.text,
            is_lively=sessions.is_lively(self._now_ns) or (shown.sticks and self.sticks.is_lively),
        )

    # --- what the user does ------------------------------------------------------------------------------------------

    def dispatch(self, action: Action) -> None:
        """Do what the user asks; what cannot be done is said in one line."""
        self._view = None
        self._tried(lambda: self._do(action))

    def _tried(self, act: Callable[[], object]) -> None:
        try:
            act()
        except StationError as fault:
            self._toasts.notify(str(fault))

    def _do(self, action: Action) -> None:
        """Raises `StationError` where it cannot be done."""
        if isinstance(action, PlayerAction):
            self.sessions.player.act(action)
        elif isinstance(action, ChoiceAction):
            self._choose(action)
        elif isinstance(action, DeskAction):
            self._at_desk(action)
        elif isinstance(action, PracticeAction):
            self._practise(action)
        elif isinstance(action, EquipmentAction):
            self._equip(action)
        elif isinstance(action, StyleAction):
            self._restyle(action)
        elif isinstance(action, SettingsAction):
            self._set(action)
        elif isinstance(action, FileAction | ImportAction):
            self._toasts.notify(self._transfer(action))
        elif isinstance(action, PhaseAction):
            self.phase.act(action)
        elif isinstance(action, Show):
            self._show(action)
        elif isinstance(action, Notify):
            self._toasts.notify(action.line)
        else:
            assert_never(action)

    def _at_desk(self, action: DeskAction) -> None:
        if isinstance(action, EditorAction):
            self._edit(action)
        elif isinstance(action, TodayAction):
            self._on_today(action)
        elif isinstance(action, ExamAction):
            self._sit(action)
        elif isinstance(action, TeacherAction):
            self.teacher.act(action)
        elif isinstance(action, AssignedAction):
            self._on_assigned(action)
        else:
            self._at_song(action)

    def _choose(self, action: ChoiceAction) -> None:
        if isinstance(action, ChooseBars) and self.editor.is_open:
            self.editor.choose_played(action.bars)
        else:
            self._chooser.act(action)

    def _transfer(self, action: FileAction | ImportAction) -> str:
        """Bring music in or take it along; returns a line for the user."""
        if isinstance(action, ImportAction):
            return self._bring(action)
        lesson, bars = self.sessions.player.lesson, self._chooser.bars
        return self.export.act(action, lesson, bars, self._store.now, self._view_settings)

    def _edit(self, action: EditorAction) -> None:
        was_open = self.editor.is_open
        if not was_open and self.sessions.practice.stage is not Stage.IDLE:
            raise DeviceError("end the session first: the editor takes its place")
        if not was_open:
            self._leave_look()
        self.editor.act(action)
        if was_open and not self.editor.is_open:
            self._turn_back()

    def _turn_back(self) -> None:
        """The editor is left: the lessons again, with what was saved."""
        if self._drafts.kept is not None:
            self._chooser.open(self._drafts.kept)
            self._drafts.kept = None
        self._chooser.show_anew()

    def _on_today(self, action: TodayAction) -> None:
        if not isinstance(action, StartBlock):
            self.today.act(action)
            return
        item = self.today.block(action.place)
        if item is not None:
            self._chooser.take_block(item)
            self._begin()

    def _on_assigned(self, action: AssignedAction) -> None:
        if isinstance(action, SendReturn):
            self.assigned.send(action)
        else:
            self._chooser.take_up(action.lesson)

    def _bring(self, action: ImportAction) -> str:
        """Choose a song, make a sound a song's, a lesson of anything else; returns a line for the user."""
        path = Path(action.source) if isinstance(action, Import) else Path()
        if is_song(path):
            self._chooser.open(path)
            return ""
        if path.suffix.lower() in SOUND_ENDINGS:
            self.song.act(BringSound(str(path)))
            return f"{path.name} is the sound of a song: choose its part on the page Song"
        return self.imports.act(action)

    def _at_song(self, action: SongAction) -> None:
        if isinstance(action, SaveSong):
            path = self.song.save(action.title)
            self._chooser.open(path)
            self._toasts.notify(f"kept in {path}: it is among your lessons")
        else:
            self.song.act(action)

    def _equip(self, action: EquipmentAction) -> None:
        if isinstance(action, MappingAction):
            self._toasts.notify(self.mapping.act(action))
        elif isinstance(action, StickAction):
            self.sticks.act(action)
        else:
            self._measure(action)

    def _practise(self, action: PracticeAction) -> None:
        match action:
            case Begin() if self.exam.looks:
                self.exam.act(ReadyForExam())
            case Begin() | Drill() if self.exam.is_on:
                raise DeviceError("an exam is one take: go back to the lessons to practise")
            case Begin():
                self._begin()
            case Drill(bar):
                self._begin(bar)
            case Pause(strokes):
                self._pads.forget()
                self.sessions.practice.turn(strokes)
            case Leave():
                self._leave()
            case StrikeKey(hit):
                with suppress(DeviceError):  # a dead engine hears none, and has said so
                    self._engine.send(hit)
            case _:
                self.sessions.act(action)

    def _begin(self, bar: int | None = None) -> None:
        self._make_ready()
        self._leave_look()
        self._chooser.begin(bar)

    def _make_ready(self) -> None:
        """Let the kit be heard for what is played alone; raises `DeviceError` while it is measured."""
        self.calibration.refuse()
        self.sticks.give_up()
        self.preferences.learn(on=False)  # what is played from now on is no gesture to be learnt

    def _sit(self, action: ExamAction) -> None:
        if self.editor.is_open:
            raise DeviceError("close the editor first: an exam takes its place")
        self.exam.act(action)

    def _leave_look(self) -> None:
        """Whoever begins something else takes no exam."""
        if self.exam.looks:
            self.exam.act(LeaveExam())

    def _leave(self) -> None:
        stage = self.sessions.practice.stage
        if self.mapping.learns or self.sticks.learns:
            self.mapping.give_up()
            self.sticks.give_up()
        elif stage is Stage.PLAYING:
            self.sessions.practice.end()
        elif stage is Stage.RESULT:
            self.sessions.dismiss()
        elif self.exam.looks:
            self.exam.act(LeaveExam())
        elif self.editor.is_open and not self.sessions.player.player.playing:
            self._edit(CloseEditor())
        else:
            self.sessions.act(EndSession())  # one that waits for its track
            self.sessions.player.halt()

    def _show(self, shown: Show) -> None:
        before, self._shown = self._shown, shown
        self.mapping.listen(shown.devices)
        if not shown.sticks:
            self.sticks.give_up()
        if not shown.practice:
            self.preferences.learn(on=False)
        if shown.catalog or shown.today or shown.teacher or shown.assigned:
            self._chooser.offer_all()
        if shown.devices and not before.devices:
            self.calibration.look_up()

    def _set(self, action: SettingsAction) -> None:
        match action:
            case FinishFirstStart(answers):
                self._store.update(lambda settings: answered(settings, answers))
                if answers is not None:
                    self._tried(lambda: self._engine.stand(student_level(self._store.now)))
                    self._chooser.show_anew()
            case SetView(view_settings):
                self._set_view(replace(view_settings, viewpoints=self._view_settings.viewpoints))
            case KeepViewpoint(slot, camera):
                self._set_view(self._view_settings.keeping(slot, camera))
                self._toasts.notify(f"viewpoint {slot + 1} is kept: {slot + 1} comes back to it")
            case SetPreferences(preferences):
                self.preferences.put(preferences)
            case LearnPause(on):
                self.preferences.learn(on)
            case LeadWith(hands):
                self._store.update(lambda settings: replace(settings, hands=hands.value))
                self._chooser.show_anew()
            case PutUp(stands):
                self._store.update(lambda settings: replace(settings, stands=stands))
                self._chooser.show_anew()
            case Embody(figure):
                self._embody(figure)
            case _:
                assert_never(action)

    def _set_view(self, view_settings: ViewSettings) -> None:
        self._view_settings = view_settings
        self._store.update(lambda settings: with_view_settings(settings, view_settings))

    def _restyle(self, action: StyleAction) -> None:
        before = self._style.demonstrator.figure
        self._style.act(action, self.sessions.practice.session.plan.lesson.score)
        self.sessions.perform_as(self._style.demonstrator)
        if self._style.demonstrator.figure is not before:
            self._chooser.show_anew()

    def _embody(self, figure: str) -> None:
        before = self._style.figure
        self._style.embody(figure)
        self.sessions.perform_as(self._style.demonstrator)
        try:
            self._chooser.show_anew()
        except StationError:  # out of reach
            self._style.embody(before)
            self.sessions.perform_as(self._style.demonstrator)
            raise
        self._store.update(lambda settings: replace(settings, figure=figure))

    def _measure(self, action: CalibrationAction) -> None:
        match action:
            case Measure(by, distance_m):
                from station.app.equipment.latency_methods import MeasureRequest

                self.calibration.measure(MeasureRequest.of(self._store.now, by, distance_m))
            case CancelMeasuring():
                self.calibration.cancel()
            case KeepMeasured():
                message = self.calibration.keep()
                self.sessions.trust(latency_of(self._store.now, load_calibration()))
                self._toasts.notify(message)
                self.calibration.look_up()
            case ForgetMeasured():
                self.calibration.drop()
            case _:
                assert_never(action)

    def _rest(self) -> Callable[[], bool]:
        """Let the engine's devices go; returns what says whether it has. Raises `DeviceError` while somebody plays."""
        for kit in self.sessions.rest():
            self.mapping.handle(DeviceLost(0, kit))
        return self._engine.has_rested

    def _start_anew(self) -> None:
        """Have an engine by the settings as they are now; raises `DeviceError` while somebody plays."""
        self._rest()
        self._engine.wake()

    def close(self) -> StationError | None:
        """Keep what runs and what was set, end a measurement and a video; returns what nobody can be shown any more."""
        self._view, fault = None, None
        self.calibration.close()
        self.export.close()
        self.imports.close()
        self.phase.close()
        self.editor.close()
        self.today.close()
        self.teacher.close()
        self.assigned.close()
        self.song.close()
        self._chooser.close()
        if self.sessions.practice.is_playing:
            self.sessions.practice.end()
            fault = self.sessions.practice.fault
        try:
            self._style.keep()
            self._store.write()
        except StationError as refused:
            fault = fault or refused
        return fault
