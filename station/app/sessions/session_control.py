"""Begins and ends what is practised, and what sounds between: previews, the demonstration, bars and takes heard again.

Only one thing sounds at a time: whoever begins something ends what runs before.
"""

from collections.abc import Callable
from concurrent.futures import Executor
from contextlib import suppress
from pathlib import Path
from typing import assert_never

from station.app.actions.practice_actions import Answer, Dismiss, EndSession, HearBar, Listen, SessionAction, Veto
from station.app.catalog import Catalog
from station.app.engine_client import EngineClient
from station.app.room_state import FreeRequest, RoomState, SessionRequest, Stage
from station.app.sessions.battle_session import BattleSession, NewBattle
from station.app.sessions.current_practice import CurrentPractice
from station.app.sessions.demo_player import DemoPlayer
from station.app.sessions.free_session import FreeSession
from station.app.sessions.launch import Launch
from station.app.sessions.lesson_session import LessonSession
from station.app.sessions.playback import Playback
from station.app.sessions.recording_line import RecordingLine
from station.app.sessions.session_preparation import PreparedSession, SessionPreparation
from station.app.sessions.shown_result import SavedSession
from station.app.settings.settings_store import SettingsStore
from station.core.errors import DeviceError, StationError
from station.core.events import Hit
from station.core.measured_latency import StoredCalibration
from station.core.units import NS_PER_S
from station.drills.exam.exam_piece import ExamPiece
from station.drills.lesson import Lesson
from station.engine.messages import EngineEvent, Started
from station.motion.sticking.hand_notes import Hands
from station.practice.exam.exam_sitting import Sitting
from station.practice.exam.exam_take import exam_plan
from station.practice.history.session_files import CAPTURE_NAME
from station.practice.session.cues.listening import Listening
from station.practice.session.device_latency import Latency, latency_of
from station.practice.session.leading_hand import hands_of
from station.render.snapshot import Snapshot
from station.scenes.battle.motion_chain import Body
from station.scenes.curves import ScoreCurves
from station.scenes.demonstrator import Demonstrator

LIVELY_NS = 5 * NS_PER_S
"""So long after a stroke another may come at any moment (our choice: a bar or two)."""


class SessionControl:
    """What is practised by the settings of `store`, as `launch` begins; `notify` hears what a user should read."""

    def __init__(
        self,
        engine: EngineClient,
        store: SettingsStore,
        launch: Launch,
        demonstrator: Demonstrator,
        notify: Callable[[str], None],
        maker: Executor | None = None,
    ) -> None:
        self._engine, self._store, self._notify = engine, store, notify
        plan = launch.plan
        self._demonstrator = demonstrator
        self._latency = latency = launch.latency or latency_of(store.now, StoredCalibration())
        self._prepared = SessionPreparation(store, launch.backing)
        self.catalog = Catalog(store, plan.lesson, notify)
        session = LessonSession(engine, PreparedSession(plan), demonstrator, latency, notify)
        self._make_ahead(session)
        self.practice = CurrentPractice(engine, store, session, FreeSession(store, latency), notify)
        self._playback = Playback(engine, lambda: self._prepared.has_tracks)
        self.player = DemoPlayer(
            self._playback.demonstrate, self._prepared.watched(plan.lesson, plan.kit), demonstrator, maker
        )
        self.rehearses = False
        """Whether the demonstration alone is shown: its lesson is being written."""
        self._heard_ns: int | None = None
        self._waiting: LessonSession | None = None  # it begins once its track is ready
        self.begun: SessionRequest | None = None
        """What was asked for last of all sessions that began."""

    # --- what is shown -----------------------------------------------------------------------------------------------

    def room(self) -> RoomState:
        """What goes on; after `snapshot`, whose place in the music it has."""
        state = RoomState(kit=self._engine.kits, sound=self._engine.sound, listening=self._playback.hears)
        return self.practice.state_in(state)

    def snapshot(self, now_ns: int) -> Snapshot:
        """The picture at `now_ns`."""
        practice = self.practice
        if not practice.is_free and practice.stage is Stage.IDLE and (self.player.is_shown or self.rehearses):
            return self.player.snapshot()
        return practice.snapshot(now_ns, self._heard_ns, self._playback.hears)

    @property
    def played(self) -> Path | None:
        """The capture of the result that is shown, else of the last free take; None where there is none."""
        report = self.practice.last_result.report
        if self.practice.shows_result and report is not None and report.folder:
            capture = Path(report.folder) / CAPTURE_NAME
            return capture if capture.is_file() else None
        return self.practice.free.take

    def curves(self) -> ScoreCurves | None:
        """What the graph shows: the demonstration, the session, or its whole result once it may be seen."""
        practice = self.practice
        if practice.is_free:
            return None
        if practice.is_playing:
            return practice.session.curves()
        return self.player.curves() if practice.stage is Stage.IDLE else practice.last_result.curves(self._demonstrator)

    def is_lively(self, now_ns: int) -> bool:
        """Whether something moves, or may at any moment: a frame that is spared would be missed."""
        moves = self.practice.is_playing or self._playback.hears or self.player.player.rate_percent != 0
        return moves or (self._engine.struck_ns is not None and now_ns - self._engine.struck_ns < LIVELY_NS)

    @property
    def hands(self) -> Hands:
        """Whose hand leads: as it was chosen, else as the lesson's kit is built."""
        built = Hands.LEFT if self.practice.session.plan.kit.left_handed else Hands.RIGHT
        return hands_of(self._store.now) or built

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def handle(self, event: EngineEvent, now_ns: int) -> None:
        """Handle one event of the engine."""
        if self._playback.hears:
            self._playback.handle(event)
        elif isinstance(event, Started) and not self.practice.is_playing:
            self.player.started(event.zero_ns)
            return
        self.practice.handle(event, now_ns)

    def died(self) -> None:
        """The engine has ended: what was played is kept."""
        self._waiting = None
        self._playback.forget()
        self.practice.end()

    def advance(self, now_ns: int) -> None:
        """Move on; what is over ends, what waited for its track begins. Raises `StationError` where that fails."""
        if self._waiting is not None:
            self._begin(self._waiting)
        self._heard_ns = self._playback.advance(now_ns)
        self.practice.advance(now_ns)
        if not self.practice.is_free:
            self.player.advance(now_ns)

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: SessionAction) -> None:
        """Do what the user asks; raises `StationError`."""
        match action:
            case EndSession():
                self._waiting = None
                self.practice.end()
            case Veto():
                if self.room().can_veto:
                    self.practice.veto()
            case Answer(guess):
                self.practice.answer(guess)
            case Dismiss():
                self.dismiss()
            case Listen():
                self._listen()
            case HearBar(bar, whose):
                if self.practice.stage is Stage.RESULT:
                    self._hear(self.practice.last_result.hear(bar, whose, self._demonstrator))
            case _:
                assert_never(action)

    # --- one after the other -----------------------------------------------------------------------------------------

    def preview(self, request: SessionRequest | None) -> None:
        """Show a lesson, its bars on the player, or the kit alone, to just play; raises `StationError`."""
        self._waiting = None
        self._playback.quiet()
        self.rehearses = False
        session = None if request is None else self._laid_out(request)
        self.practice.show(session)
        if session is not None:
            self._make_ahead(session)
        if request is None or session is None:
            self.player.halt()
        else:
            self.player.load(
                self._prepared.watched(self.catalog.lesson(request.lesson), session.plan.kit), request.bars
            )

    def rehearse(self, lesson: Lesson | None, bars: tuple[int, int] | None) -> None:
        """Demonstrate a lesson that is being written from where the player is, `bars` (from 1) repeated, None for all.

        Where there is no music yet the kit alone is shown. Raises `BadInput` for a kit or a click that is none.
        """
        self._waiting = None
        self._playback.quiet()
        self.rehearses = True
        if lesson is None:
            self.player.halt()
            self.practice.show(None)
            return
        self.practice.show(self.practice.session)
        self.player.revise(self._prepared.rehearsed(lesson), bars or (1, lesson.played_once.bar_count))

    def record(self) -> RecordingLine:
        """Let all be quiet for a recording of a lesson that is being written; raises `StationError`."""
        self._make_room()
        self._playback.without_track()
        return RecordingLine(self._engine.send, self._prepared.click(), self._latency)

    def start(self, request: SessionRequest) -> None:
        """Begin a session, ending what runs; wakes a new engine if the old has ended. Raises `StationError`.

        Where its track is still being made ready, it begins by itself as soon as that is done.
        """
        self.catalog.learnt()
        session = self._laid_out(request)
        self._make_room()
        self._begin(session)
        self.begun = request
        if self._waiting is not None:
            self._notify("the band's sound is being made ready for this tempo: it begins by itself")

    def _make_ahead(self, session: LessonSession) -> None:
        """Begin to make the band's sound ready; whoever starts the session is told of its faults."""
        if session.plan.lesson.band is not None:
            with suppress(StationError):
                self._prepared.track(session.plan, self._engine.rate_hz)

    def _takes_track(self, session: LessonSession) -> bool:
        return not session.follows_student and self._prepared.needs_track(session.plan)

    def _begin(self, session: LessonSession) -> None:
        """Begin the session, or wait for its track; raises `StationError`, and waits no more then.

        One whose track is the settings' alone goes without where that cannot be had.
        """
        self._waiting, track = None, None
        takes_track = self._takes_track(session)
        if takes_track:
            try:
                track = self._prepared.track(session.plan, self._engine.rate_hz)
            except StationError as fault:
                if not self._prepared.can_do_without(session.plan):
                    raise
                takes_track = False
                self._notify(f"{fault}; the session goes without its track")
        if not takes_track:
            self._playback.without_track()
        elif track is None:
            self._waiting = session
            return
        else:
            self._playback.quiet()
            self.player.halt()
        self.practice.begin(session, track)

    def look(self) -> None:
        """Show the kit alone, to try what of an exam's piece one likes, and be quiet; raises `StationError`."""
        self._make_room()
        self.preview(None)

    def examine(self, piece: ExamPiece, sitting: Sitting | None = None) -> None:
        """Begin the one take of an exam, `sitting` where its piece was looked at; raises `StationError`."""
        plan = exam_plan(piece, self._store.now) if sitting is None else sitting.plan
        self._make_room()
        track = None if plan.lesson.band is None else self._prepared.track(plan, self._engine.rate_hz)
        if track is None:
            self._playback.without_track()
        sitting = sitting or Sitting.begin(piece, self._store.now)
        self.practice.begin(self._new_session(PreparedSession(sitting.plan, sitting=sitting)), track)

    def just_play(self, request: FreeRequest) -> None:
        """Begin a free take, ending what runs; raises `StationError`."""
        self._make_room()
        self._playback.without_track()
        self.practice.begin_free(request)

    def battle(self, new: NewBattle) -> None:
        """Begin a battle, ending what runs; raises `StationError`."""
        self._make_room()
        self._playback.without_track()
        self.practice.begin_battle(self._made(new))

    def _made(self, new: NewBattle) -> BattleSession:
        player = Body(self._prepared.own_kit(), self._demonstrator.figure, self._demonstrator.style)
        return new(self._engine, self._latency, player, self._notify)

    def leave_battle(self) -> None:
        """The result of a battle was read: the kit alone is shown."""
        self._playback.quiet()
        self.practice.leave_battle()

    def _listen(self) -> None:
        """Hear the last free take from its capture, or end what is heard; raises `StationError`."""
        if self._playback.hears:
            self._playback.quiet()
        elif not self.practice.is_playing:
            self._hear(self.practice.free.listening())

    def listen_to(self, listening: Listening) -> None:
        """Let something from elsewhere sound once; raises `DeviceError`, also while somebody plays."""
        self._refuse("it needs the sound card")
        self._hear(listening)

    def is_listening_to(self, listening: Listening) -> bool:
        """Whether that is what sounds."""
        return self._playback.is_hearing(listening)

    def heard_ns(self, stroke: Hit) -> int:
        """When what was heard with a stroke left the station, by what is known of the kit's and the output's delay."""
        played_ns = stroke.at_ns - self._latency.of_stroke(stroke.device, stroke.piece)
        return played_ns - self._latency.of_output(self._engine.sound)

    def quiet(self) -> None:
        """End what is heard."""
        self._playback.quiet()

    def look_at(self, shown: SavedSession | NewBattle) -> None:
        """Show what a student has sent, or one's own of another day; raises `DeviceError` while somebody plays."""
        self._refuse("the take that you open comes in its place")
        self._playback.quiet()
        self.player.halt()
        if isinstance(shown, SavedSession):
            self.practice.look_at(shown)
        else:
            self.practice.look_at_battle(self._made(shown))

    def dismiss(self) -> None:
        """The result was read: back to the lessons."""
        if self.practice.stage is Stage.RESULT:
            self._playback.quiet()
            self.catalog.learnt()
            self.practice.leave(self._new_session(PreparedSession(self.practice.session.plan)))

    def put_away(self) -> None:
        """Another student plays: nothing of the one before is waited for, shown or heard any more."""
        self._waiting = None
        self._playback.quiet()
        self.player.halt()
        self.dismiss()
        self.practice.put_away(FreeSession(self._store, self._latency))

    def rest(self) -> list[str]:
        """Let the engine's devices go; returns the kits that it had. Raises `DeviceError` while somebody plays."""
        self._refuse("what is measured needs the sound card and the kit")
        self._playback.quiet()
        self.player.halt()
        return self._engine.rest()

    # --- by whom and by what -----------------------------------------------------------------------------------------

    def perform_as(self, demonstrator: Demonstrator) -> None:
        """Let `demonstrator` demonstrate: in their style at once, but that hands hold as before while a pass is played.

        Another body comes with the next preview or session.
        """
        self._demonstrator = demonstrator
        self.practice.session.move_as(demonstrator, hands_stay=self.practice.is_session)
        self.player.perform_as(demonstrator)

    def trust(self, latency: Latency) -> None:
        """Take devices to be so late from the next session on."""
        self._latency = latency
        self.practice.free.delayed_by(latency)

    # --- inside ------------------------------------------------------------------------------------------------------

    def _refuse(self, why: str) -> None:
        if self.practice.is_playing:
            raise DeviceError(f"end the session first: {why}")

    def _make_room(self) -> None:
        """End what runs or sounds, and have an engine; raises `DeviceError`."""
        self._waiting = None
        self._playback.quiet()
        self.player.halt()
        self.practice.end()
        self._engine.wake()

    def _hear(self, listening: Listening | None) -> None:
        """Let something sound once in place of the demonstration; raises `DeviceError`."""
        self.player.halt()
        if listening is not None:
            self._playback.hear(listening)

    def _laid_out(self, request: SessionRequest) -> LessonSession:
        lesson = self.catalog.lesson(request.lesson)
        laid = self._prepared.laid_out(lesson, request, self.catalog.level(lesson))
        if laid.followed is not None and laid.followed.fault is not None:
            self._notify(laid.followed.fault)
        return self._new_session(laid)

    def _new_session(self, laid: PreparedSession) -> LessonSession:
        return LessonSession(self._engine, laid, self._demonstrator, self._latency, self._notify, self.practice.session)
