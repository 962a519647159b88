"""One session of a lesson: ready, playing, paused, over; what is seen of it, and what is kept.

The controller owns engine, pads and questions; it hands over every event, says what time it is, and asks for the
result when the session is over. Where the tempo follows the student, each pass is a session of its own
(`practice.session.adaptation`).
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from datetime import date

from station.app.engine_client import EngineClient
from station.app.room_state import PlaceNow, RoomState, ShownResult, Stage
from station.app.sessions.phase_following import PhaseFollowing
from station.app.sessions.session_preparation import PreparedSession
from station.app.sessions.shown_result import SavedSession, shown_result
from station.core.errors import DeviceError, StationError
from station.core.events import Hit, StickPose
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.exam.rubric import Marks
from station.drills.mastery.agenda import Turn
from station.drills.mastery.feedback_fading import Feedback
from station.engine.messages import Command, EngineEvent
from station.practice.exam.exam_take import exam_runner
from station.practice.headless.live import begin, end
from station.practice.lag.fair_judgement import FairResult
from station.practice.lag.first_groove import FIRST_GROOVE
from station.practice.now.whereabouts import place_of
from station.practice.records.earlier_lags import fair_session
from station.practice.records.memory import following_lesson
from station.practice.records.previous_session import find_previous
from station.practice.records.report.next_steps import steps_in
from station.practice.records.report.session_report import practice_document
from station.practice.records.save_session import SessionFolder, SessionRecord, save
from station.practice.session.device_latency import Latency
from station.practice.session.plan import Phase, Plan
from station.practice.session.runner import SessionRunner, Update
from station.practice.session.session import Session, SessionResult
from station.render.snapshot import Snapshot
from station.scenes.curves import ScoreCurves
from station.scenes.demonstrator import Demonstrator
from station.scenes.session_scene import SessionView
from station.sound.track import PreparedTrack
from station.sync.drill.drummed_model import is_soon_made

KICKS_ON, GO_ON = "two kicks, Backspace or Go on", "Backspace or Go on"
"""How a paused session goes on; kicks ask for nothing where the settings say so."""


def _say_nothing(_: str) -> None:
    """Who does not ask to be followed need not know why they cannot be."""


class LessonSession:
    """One session as it is `laid` out, or passes that follow the student; `notify` hears what a user should read.

    `before` is what was shown last: its drummer sits there until the one of this session is made.
    """

    def __init__(
        self,
        engine: EngineClient,
        laid: PreparedSession,
        demonstrator: Demonstrator,
        latency: Latency,
        notify: Callable[[str], None],
        before: "LessonSession | None" = None,
    ) -> None:
        self._engine, self._demonstrator, self._notify = engine, demonstrator, notify
        self._followed = laid.followed
        self.sitting = laid.sitting
        """The exam that it is the take of, None for practice."""
        asked = laid.plan if laid.followed is None else laid.followed.adaptation
        self._runner = SessionRunner(asked, latency) if laid.sitting is None else exam_runner(asked, latency)
        seen = None if before is None else before.view
        self.view: SessionView = self._seen_with(seen, demonstrates=laid.sitting is None)
        self._folder: SessionFolder | None = None
        self._following: PhaseFollowing | None = None
        self._way_on = KICKS_ON
        self._leads = False  # whether the drummer goes by the student's phase

    @property
    def follows_student(self) -> bool:
        """Whether tempo and bars follow the student from pass to pass."""
        return self._followed is not None

    @property
    def session(self) -> Session:
        """The session that runs: the newest pass."""
        return self._runner.session

    @property
    def plan(self) -> Plan:
        """What is played in it."""
        return self._runner.session.plan

    def begin(self, settings: Settings, track: PreparedTrack | None) -> None:
        """Start the transport and the capture; raises `StationError`, and leaves nothing behind then."""
        sitting = self.sitting
        folder = SessionFolder.make(None, settings, self.plan.lesson.name) if sitting is None else sitting.folder
        self.session.backing, self.session.waits = track, settings.auto_pause and sitting is None
        if self.plan.lesson.name == FIRST_GROOVE:  # what is early or late is not known before its end: equipment may be
            self.session.feedback = Feedback.PADS
        try:
            begin(self._engine, self._runner, folder.capture)
        except StationError:
            folder.let_go()
            raise
        self._folder, self._way_on = folder, KICKS_ON if settings.kicks_start else GO_ON
        self.view.make_ahead()
        self._leads = settings.follow_phase and sitting is None
        if self._leads:
            self._following = PhaseFollowing(self._engine, self._runner, self._notify, settings.sound_phase)

    # --- while it runs -----------------------------------------------------------------------------------------------

    def handle(self, event: EngineEvent, now_ns: int) -> None:
        """Handle one event of the engine."""
        if self._may_track(event):
            self._following = PhaseFollowing(self._engine, self._runner, _say_nothing)  # for the report
        if self._following is not None:
            self._following.handle(event)
        notices = self._runner.heard.notices
        known = len(notices)
        self._follow(self._runner.handle(event), now_ns)
        for notice in notices[known:]:
            self._notify(notice)

    def _may_track(self, event: EngineEvent) -> bool:
        """Whether sticks are there, and tracked neither yet nor in vain."""
        is_stick = self._following is None and self._folder is not None and isinstance(event, StickPose)
        return is_stick and not self.plan.steps and is_soon_made(self.plan.section)

    def advance(self, now_ns: int) -> bool:
        """Move on, or wait for a student who has stopped; returns whether the session is over."""
        self._follow(self._runner.advance(now_ns), now_ns)
        if self._following is not None:
            place_s = self._following.advance(now_ns, self.plan.section, self.view.pass_place_s(self.session))
            if self._leads:
                self.view.follow(place_s)
        return self._runner.over

    def veto(self) -> bool:
        """Refuse what the next pass would change, the last one once more; returns whether there was an engine."""
        try:
            self._send(self._runner.veto())
        except DeviceError as fault:
            self._notify(str(fault))
            return False
        self._see_next_pass()
        return True

    def _follow(self, update: Update, now_ns: int) -> None:
        """Do what a step asks for, and show the student what they are to see of it."""
        with suppress(DeviceError):  # a dead engine says so itself
            self._send(update.commands)
        session = update.session
        self.view.judged(session.shown(update.judged), session.hits, now_ns, session.plan.level.windows)
        if update.is_anew:
            self.view.judged_anew(session)
        if update.notice is not None:
            self._notify(update.notice)
        if session is not self.session:
            self._see_next_pass()

    def _see_next_pass(self) -> None:
        self.view = self._seen_with(self.view)
        self.view.make_ahead()

    def _seen_with(self, before: SessionView | None, demonstrates: bool = True) -> SessionView:
        """The pictures of the newest pass, after those of `before`."""
        adaptation = None if self._followed is None else self._followed.adaptation
        goes_on = adaptation is not None and len(adaptation.rounds) + 1 < adaptation.loops
        return SessionView(self.plan, self._demonstrator, before, demonstrates, goes_on)

    def _send(self, commands: Sequence[Command]) -> None:
        for command in commands:
            self._engine.send(command)

    # --- pauses ------------------------------------------------------------------------------------------------------

    @property
    def paused(self) -> bool:
        """Whether it stands still."""
        return self.session.paused

    def hold(self, command: Sequence[Hit] = ()) -> None:
        """Pause; `command` are the strokes that asked for it, where some did. An exam goes on."""
        if self.sitting is None:
            self._follow(self._runner.pause(command), 0)

    def go_on(self) -> None:
        """Out of a pause."""
        self._follow(self._runner.resume(), 0)

    # --- what is seen ------------------------------------------------------------------------------------------------

    def snapshot(self, now_ns: int) -> Snapshot:
        """The picture at `now_ns`."""
        return self.view.snapshot(self.session, now_ns, self._way_on)

    def curves(self) -> ScoreCurves | None:
        """What the graph shows of it, nothing of an exam."""
        return self.view.curves(self.session) if self.sitting is None else None

    def move_as(self, demonstrator: Demonstrator, hands_stay: bool) -> None:
        """Let `demonstrator` demonstrate from now on."""
        self._demonstrator = demonstrator
        self.view.move_as(demonstrator.style, hands_stay=hands_stay)

    def state_in(self, room: RoomState) -> RoomState:
        """The room, and how far the session is."""
        state, adaptation, progress = self.session.state(), None, None
        if room.stage is Stage.PLAYING:
            adaptation = None if self._followed is None else self._followed.adaptation
            if state.transport_ns is not None:
                progress = min(max(state.transport_ns / self.plan.end_ns, 0.0), 1.0)
        if adaptation is not None and progress is not None:
            progress = (len(adaptation.rounds) + progress) / adaptation.loops
        clock = None
        if progress is not None and state.transport_ns is not None:
            clock = PlaceNow(max(state.transport_ns, 0) / NS_PER_S, *place_of(self.session))
        return replace(
            room,
            progress=progress,
            why=self.session.message,
            can_veto=adaptation is not None and bool(adaptation.rounds) and state.segment.phase is Phase.COUNT_IN,
            can_pause=room.stage is Stage.PLAYING and self.session.can_pause and self.sitting is None,
            paused=self.paused,
            clock=clock,
            judged=self.plan.level.words,
        )

    # --- the end -----------------------------------------------------------------------------------------------------

    def finish(self, settings: Settings) -> SavedSession:
        """End the session, judge what was played and keep it."""
        fault = end(self._engine, self._runner) if self._engine.alive else None
        if self._following is not None:
            self._following.end()
        assert self._folder is not None, "it was begun"
        result = self._runner.finish()
        fair = fair_session(result, settings) if self.sitting is None else FairResult(result)
        document = practice_document(fair.result, settings, fair.lag, self._following_lesson(settings))
        saved = save(self._folder, fair.result, document, self._followed)
        if saved.unkept is not None:
            self._notify(saved.unkept)
        marks, refused = self._marked(result)
        fault = saved.fault or refused or fault
        steps = steps_in(saved.document) if marks is None else ()
        return SavedSession(fair.result, self._report(saved, self._folder), fault, marks, fair, steps)

    def _following_lesson(self, settings: Settings) -> Turn | None:
        """What to turn to after practice that has not followed the student; theirs knows it itself."""
        is_asked = self._followed is None and self.sitting is None
        return following_lesson(settings, self.plan.lesson, date.today()) if is_asked else None

    def _marked(self, result: SessionResult) -> tuple[Marks | None, StationError | None]:
        """The marks of an exam, kept, and what the disk refused; nothing of practice."""
        if self.sitting is None:
            return None, None
        marks = self.sitting.marks(result)
        try:
            self.sitting.keep(marks)
        except StationError as refused:
            return marks, refused
        return marks, None

    def _report(self, saved: SessionRecord, folder: SessionFolder) -> ShownResult:
        before = find_previous(folder.whose, folder.path, self.plan.lesson.name)
        return shown_result(saved.result, saved.document, str(folder.path), before)
