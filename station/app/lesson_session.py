"""One session of a lesson as the room holds it: ready, playing, paused, over; what is seen of it, and what is kept.

The room owns engine, pads and questions; it hands over every event, says what time it is, and asks for the result when
the session is over. Where the tempo follows the student, each pass is a session of its own (`practice.adaptation`).
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

from station.app.engine_client import EngineClient
from station.app.model import PlaceNow, RoomState, ShownResult, Stage
from station.app.session_preparation import PreparedSession
from station.core.errors import DeviceError, StationError
from station.core.events import Hit
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.engine.messages import Command, EngineEvent
from station.music.judgement import Judgement
from station.practice.headless.live import begin, end, next_session
from station.practice.records.keeping import SavedSession, SessionFolder, save
from station.practice.records.previous_session import find_earlier
from station.practice.records.session_report import practice_document
from station.practice.session.adaptation import Adaptation
from station.practice.session.device_latency import Latency
from station.practice.session.plan import Phase
from station.practice.session.session import Session, SessionResult
from station.render.snapshot import Hud, Snapshot
from station.scenes.curves import ScoreCurves
from station.scenes.demonstrator import Demonstrator
from station.scenes.heat_map import heat_map
from station.scenes.hit_table import every_hit
from station.scenes.result_tables import session_facts
from station.scenes.session_scene import SessionView
from station.scenes.wrong_pads import wrong_pads
from station.sound.track import PreparedTrack

PAUSED = "Paused: two kicks, or Go on"


@dataclass(frozen=True, eq=False)
class SavedSession:
    """What a session that is over leaves: its `result`, the `report` of it, and what went wrong, if anything did."""

    result: SessionResult
    report: ShownResult
    fault: StationError | None


class LessonSession:
    """One session as it is `laid` out, or passes that follow the student; `tell` hears what a user should read.

    `before` is what was shown last: its drummer sits there until the one of this session is made.
    """

    def __init__(
        self,
        engine: EngineClient,
        laid: PreparedSession,
        who: Demonstrator,
        latency: Latency,
        tell: Callable[[str], None],
        before: "LessonSession | None" = None,
    ) -> None:
        self._engine, self._who, self._tell = engine, who, tell
        self.plan, self._followed = laid.plan, laid.followed
        followed = None if laid.followed is None else laid.followed.adaptation
        self.session = Session(laid.plan, latency) if followed is None else followed.session(latency)
        self.view: SessionView = SessionView(laid.plan, who, None if before is None else before.view)
        self._folder: SessionFolder | None = None
        self._taken: Session | None = None
        self._was_asked = False
        self._hud = Hud()

    def begin(self, settings: Settings, track: PreparedTrack | None) -> None:
        """Start the transport and the capture; raises `StationError`, and leaves nothing behind then."""
        folder = SessionFolder.make(None, settings, self.plan.lesson.name)
        self.session.backing, self.session.waits = track, settings.auto_pause
        try:
            begin(self._engine, self.session, folder.capture)
        except StationError:
            folder.discard()
            raise
        self._folder = folder
        self.view.make_ahead()

    # --- while it runs -----------------------------------------------------------------------------------------------

    def take(self, event: EngineEvent, now_ns: int) -> None:
        """Take one event of the engine."""
        told = len(self.session.heard.notices)
        verdicts = self.session.handle(event)
        self._judged(verdicts, now_ns)
        for notice in self.session.heard.notices[told:]:
            self._tell(notice)

    def advance(self, now_ns: int) -> bool:
        """Move on, or wait for a student who has stopped; returns whether the session is over."""
        self._judged(self.session.advance(now_ns), now_ns)
        if self.session.waits and self.session.is_left:
            self.hold(asked=False)
        return self.session.over and self._is_last()

    def _judged(self, verdicts: tuple[Judgement, ...], now_ns: int) -> None:
        """Show what the student is to see of `verdicts`."""
        session = self.session
        self.view.judged(session.told(verdicts), session.hits, now_ns, session.windows)

    def _is_last(self) -> bool:
        """On to the next pass where the tempo follows the student and there is one; whether there is none."""
        if self._followed is None:
            return True
        adaptation = self._followed.adaptation
        step = adaptation.take(self.session.result())
        self._taken = self.session
        if step.notice is not None:
            self._tell(step.notice)
        return adaptation.over or not self._next_pass(adaptation)

    def _next_pass(self, adaptation: Adaptation) -> bool:
        """Begin it; returns whether there was an engine for it."""
        try:
            self.session = next_session(self._engine, adaptation, self.session)
        except DeviceError as fault:
            self._tell(str(fault))
            return False
        self.plan = adaptation.plan
        self.view = SessionView(self.plan, self._who, self.view)
        self.view.make_ahead()
        return True

    def veto(self) -> bool:
        """Refuse what the next pass would change, the last one once more; returns whether there was an engine."""
        assert self._followed is not None, "the room asks where it may"
        self._followed.adaptation.veto()
        has_begun = self._next_pass(self._followed.adaptation)
        if not has_begun:
            self._taken = self.session  # it was refused: no pass of anybody's
        return has_begun

    # --- pauses ------------------------------------------------------------------------------------------------------

    @property
    def paused(self) -> bool:
        """Whether it stands still."""
        return self.session.paused

    def hold(self, command: Sequence[Hit] = (), asked: bool = True) -> None:
        """Pause; `command` are the strokes that asked for it, where some did."""
        self._was_asked = asked
        self._send(self.session.pause(command))
        self.view.judged_anew(self.session)

    def go_on(self) -> None:
        """Out of a pause: a pass that moves the tempo is taken whole, else from the bar of the last stroke."""
        self._send(self.session.resume(self._was_asked, whole=self._followed is not None))
        self.view.judged_anew(self.session)

    def _send(self, commands: Sequence[Command]) -> None:
        for command in commands:
            with suppress(DeviceError):  # a dead engine says so itself
                self._engine.send(command)

    # --- what is seen ------------------------------------------------------------------------------------------------

    def snapshot(self, now_ns: int) -> Snapshot:
        """The picture at `now_ns`."""
        shown = self.view.snapshot(self.session, now_ns, PAUSED if self.paused else "")
        self._hud = shown.hud
        return shown

    def graphed(self) -> ScoreCurves | None:
        """What the graph shows of it."""
        return self.view.graphed(self.session)

    def move_as(self, who: Demonstrator, hands_stay: bool) -> None:
        """Let `who` demonstrate from now on."""
        self._who = who
        self.view.move_as(who.style, hands_stay=hands_stay)

    def told(self, room: RoomState) -> RoomState:
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
            clock = PlaceNow(max(state.transport_ns, 0) / NS_PER_S, self._hud.bar, self._hud.beat)
        return replace(
            room,
            progress=progress,
            why=self.session.message,
            can_veto=adaptation is not None and bool(adaptation.rounds) and state.segment.phase is Phase.COUNT_IN,
            can_pause=room.stage is Stage.PLAYING and self.session.can_pause,
            paused=self.paused,
            clock=clock,
        )

    # --- the end -----------------------------------------------------------------------------------------------------

    def finish(self, settings: Settings) -> SavedSession:
        """End the session, judge what was played and keep it."""
        fault: StationError | None = None
        if self._engine.alive:
            try:
                fault = end(self._engine, self.session)
            except DeviceError as dead:
                fault = dead
        assert self._folder is not None, "it was begun"
        result, followed = self._result(), self._followed
        saved = save(self._folder, result, practice_document(result, settings), followed)
        return SavedSession(result, self._report(saved, self._folder), saved.fault or fault)

    def _report(self, saved: SavedSession, folder: SessionFolder) -> ShownResult:
        result = saved.result
        return ShownResult(
            session_facts(result, saved.document),
            saved.document,
            str(folder.path),
            heat_map(result),
            every_hit(result),
            find_earlier(folder.path, self.plan.lesson.name),
            wrong_pads(result),
        )

    def _result(self) -> SessionResult:
        """The result over all passes where there were several sessions."""
        if self._followed is None:
            return self.session.result()
        adaptation = self._followed.adaptation
        if self._taken is not self.session:
            adaptation.take(self.session.result())
            self._taken = self.session
        return adaptation.result()
