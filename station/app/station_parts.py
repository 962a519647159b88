"""What the station is made of, behind its window: who practises, listens, measures, edits and keeps, each made once."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from station.app.actions.action import Show
from station.app.battle.battle_page import BattlePage, BattleSurroundings
from station.app.child_programs import ChildPrograms
from station.app.chooser import Chooser
from station.app.editor.draft_files import DraftFiles
from station.app.editor.lesson_editor import LessonEditor
from station.app.engine_client import EngineClient
from station.app.equipment.calibration import Calibration
from station.app.equipment.mapping_editor import MappingEditor
from station.app.equipment.sticks_editor import SticksEditor
from station.app.exam_page import ExamPage, ExamSurroundings
from station.app.export import Exporter
from station.app.history.history_opening import HistoryOpening
from station.app.history.history_page import HistoryPage
from station.app.importer import Importer
from station.app.phase_page import PhasePage
from station.app.sessions.launch import Launch
from station.app.sessions.pad_control import PadControl
from station.app.sessions.screen_choice import ScreenChoice, choice_beside
from station.app.sessions.session_control import SessionControl
from station.app.sessions.who_plays import WhoPlays
from station.app.settings.preferences import Preferences
from station.app.settings.settings_store import SettingsStore
from station.app.settings.students import Students
from station.app.settings.view_settings import view_settings_of
from station.app.songs.song_page import Ear, SongPage
from station.app.sound.sound_page import SoundPage, SoundSurroundings
from station.app.style_editor import StyleEditor
from station.app.teacher_desk.assigned_page import AssignedPage
from station.app.teacher_desk.teacher_page import TeacherPage
from station.app.toasts import Toasts
from station.app.today_page import TodayPage
from station.core.errors import StationError
from station.core.events import DeviceLost


class StationParts:
    """The parts; `processes` start an engine: once now, and again when one has died.

    Sessions go by `store`; `launch` is what it opens on. Raises `BadInput` for settings whose words mean nothing.
    """

    def __init__(self, processes: ChildPrograms, store: SettingsStore, launch: Launch) -> None:
        self.store, self.toasts = store, Toasts()
        notify = self.toasts.notify
        if store.fault is not None:
            notify(f"{store.fault}; the defaults hold for what is wrong")
        self.shown = Show()
        """What is on the screen; nothing else is computed."""
        self.view_settings = view_settings_of(store.now)
        self.engine = EngineClient(processes.engine, store.now.rate_hz)
        self.style = StyleEditor(store, notify)
        self.sessions = SessionControl(
            self.engine, store, launch, self.style.demonstrator, notify, ThreadPoolExecutor(1, "drummer")
        )
        self.chooser = Chooser(self.sessions, store, launch, ThreadPoolExecutor(1, "catalog"))
        self.drafts = DraftFiles(self.sessions.catalog, store, notify, ThreadPoolExecutor(1, "draft reader"))
        self.editor = LessonEditor(self.drafts, self.sessions, notify)
        self.mapping = MappingEditor(self.engine.forward)
        self.calibration = Calibration(self._rest, self.engine.wake, processes.measure)
        self.sticks = SticksEditor(self.engine.forward, store, self._start_anew)
        self.toasts.attempt(self.sticks.begin)
        self.preferences = Preferences(store)
        self.students = Students(store)
        self.who = WhoPlays(self.students, lambda: self.sessions.practice.session.plan.kit.pieces)
        self.pads = PadControl(store, self.preferences, self.who, launch.plan.score)
        self.export = Exporter(processes.animate, processes.work)
        self.imports = Importer(store, processes.work)
        hear, hears, quiet = self.sessions.listen_to, self.sessions.is_listening_to, self.sessions.quiet
        self.phase = PhasePage(hear, hears, quiet, ThreadPoolExecutor(1, "motion"))
        ear = Ear(hear, hears, quiet, self.sessions.heard_ns)
        self.song = SongPage(store, ear, lambda: self.engine.rate_hz, processes.work)
        self.today = TodayPage(store, notify, ThreadPoolExecutor(1, "book"))
        around = ExamSurroundings(lambda: self.chooser.lesson_name, self.make_ready, self.chooser.show_anew)
        self.exam = ExamPage(store, self.sessions, around)
        beside = BattleSurroundings(
            lambda: self.engine.devices,
            self.make_ready,
            self.chooser.show_anew,
            self.chooser.open,
            self.export.film_battle,
        )
        self.battle = BattlePage(store, self.sessions, beside, ThreadPoolExecutor(1, "bars of lessons"))
        self.teacher = TeacherPage(
            store, self.sessions.look_at, self.sessions.catalog.lesson, processes.work, ThreadPoolExecutor(1, "returns")
        )
        rooms = SoundSurroundings(lambda: self.chooser.selection.tempo_bpm, self._rest, notify, processes.work)
        self.sound = SoundPage(store, self.engine, self.sessions, rooms)
        self.assigned = AssignedPage(store, ThreadPoolExecutor(1, "assignments"))
        self.history = HistoryPage(store, ThreadPoolExecutor(1, "history"), processes.work)
        self.history_opening = HistoryOpening(store, notify, ThreadPoolExecutor(1, "history opening"))

    def make_ready(self) -> None:
        """Let the kit be heard for what is played alone; raises `DeviceError` while it is measured."""
        self.calibration.refuse()
        self.sticks.give_up()
        self.who.ask(on=False)
        self.preferences.learn(on=False)  # what is played from now on is no gesture to be learnt

    @property
    def kit_commands(self) -> bool:
        """Whether strokes may ask for something: not where they teach, write, or are of an exam."""
        is_for_else = self.mapping.learns or self.sticks.learns or self.editor.is_open or self.exam.is_on
        return not is_for_else

    def choice(self) -> ScreenChoice | None:
        """What is to be chosen on the screen now."""
        return (
            self.who.choice()
            or self.battle.choice()
            or choice_beside(self.sessions.practice, self.store.now.kicks_start)
        )

    def look_again(self) -> None:
        """Sessions came into the history: what is known of students and lessons is out of date."""
        self.sessions.catalog.learnt()
        self.students.look_again()
        self.today.look_again()
        self.history.look_again()

    def _rest(self) -> Callable[[], bool]:
        """Let the engine's devices go; returns what says whether it has. Raises `DeviceError` while somebody plays."""
        for kit in self.sessions.rest():
            self.mapping.handle(DeviceLost(0, kit))
        return self.engine.has_rested

    def _start_anew(self) -> None:
        """Have an engine by the settings as they are now; raises `DeviceError` while somebody plays."""
        self._rest()
        self.engine.wake()

    def close(self) -> StationError | None:
        """Keep what runs and what was set, end a measurement and a video; returns what nobody can be shown any more."""
        fault = None
        for part in (
            self.calibration,
            self.export,
            self.imports,
            self.phase,
            self.editor,
            self.today,
            self.teacher,
            self.assigned,
            self.history,
            self.song,
            self.sound,
            self.chooser,
            self.history_opening,
        ):
            part.close()
        if self.sessions.practice.is_playing:
            self.sessions.practice.end()
            fault = self.sessions.practice.fault
        self.battle.close()
        try:
            self.style.keep()
            self.store.write()
        except StationError as refused:
            fault = fault or refused
        return fault
