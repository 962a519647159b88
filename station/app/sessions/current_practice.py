"""What is practised now: nothing, a session, a free take, a battle, or a result, and how one follows the other.

It owns what is played and what was; who demonstrates, what sounds between sessions and what the pads ask for are the
controller's.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

from station.app.engine_client import EngineClient
from station.app.room_state import FreeRequest, RoomState, Stage
from station.app.sessions.battle_session import BattleSession
from station.app.sessions.free_session import FreeSession
from station.app.sessions.last_result import LastResult
from station.app.sessions.lesson_session import LessonSession
from station.app.sessions.shown_result import SavedSession
from station.app.settings.settings_store import SettingsStore
from station.core.errors import StationError
from station.core.events import Hit
from station.engine.messages import EngineEvent
from station.practice.records.report.next_steps import NextStep
from station.practice.session.self_estimate import SelfEstimate
from station.render.snapshot import Snapshot
from station.sound.track import PreparedTrack


class CurrentPractice:
    """At first `session` is shown and nothing played; sessions go by `store`, `notify` gets what a user should read."""

    def __init__(
        self,
        engine: EngineClient,
        store: SettingsStore,
        session: LessonSession,
        free: FreeSession,
        notify: Callable[[str], None],
    ) -> None:
        self._engine, self._store, self._notify = engine, store, notify
        self.session, self.free = session, free
        self.last_result = LastResult()
        self.stage = Stage.IDLE
        self.is_free = False
        """Whether no lesson is shown: the kit alone, to just play."""
        self._was_free = False  # before a student's result was looked at
        self.battle: BattleSession | None = None
        """The battle that runs, or whose result is shown; no lesson is shown then."""
        self.next_block: NextStep | None = None
        """The block behind the one of the day's plan that is played; None where there is none, or no plan."""
        self.fault: StationError | None = None
        """What went wrong with the last session or take when it ended."""

    @property
    def is_playing(self) -> bool:
        """Whether a session or a free take runs."""
        return self.stage is Stage.PLAYING

    @property
    def is_session(self) -> bool:
        """Whether a session of a lesson runs."""
        return self.is_playing and not self.is_free

    @property
    def is_exam(self) -> bool:
        """Whether the take of an exam runs, or its result is shown."""
        return self.stage is not Stage.IDLE and not self.is_free and self.session.sitting is not None

    @property
    def is_battle(self) -> bool:
        """Whether a battle runs, or its result is shown."""
        return self.stage is not Stage.IDLE and self.battle is not None

    @property
    def shows_result(self) -> bool:
        """Whether the result of a session is shown."""
        return self.stage is Stage.RESULT and self.battle is None

    @property
    def _sender(self) -> str:
        """Who sent the result that is shown, empty where it is one's own, or none is."""
        report = self.last_result.report
        return report.student if report is not None and self.shows_result else ""

    @property
    def lag_ms(self) -> float | None:
        """The lag that the shown result leaves out until its student has said whose it is."""
        return self.last_result.lag_ms if self.shows_result and not self._sender else None

    # --- one after the other -----------------------------------------------------------------------------------------

    def show(self, session: LessonSession | None) -> None:
        """Show what would be played, None the kit alone."""
        self.is_free, self.battle = session is None, None
        self.session = session or self.session

    def begin(self, session: LessonSession, track: PreparedTrack | None) -> None:
        """Play a lesson; raises `StationError`, and goes on as before then."""
        session.begin(self._store.now, track)
        self.last_result.leave()
        self.session, self.stage, self.is_free, self._was_free = session, Stage.PLAYING, False, False
        self.battle = None

    def begin_free(self, request: FreeRequest) -> None:
        """Begin a free take; raises `StationError`, and goes on as before then."""
        self.free.begin(self._engine, request)
        self.last_result.leave()
        self.stage, self.is_free, self.battle = Stage.PLAYING, True, None

    def begin_battle(self, battle: BattleSession) -> None:
        """Begin a battle; raises `StationError`, and goes on as before then."""
        battle.begin(self._store.now)
        self.last_result.leave()
        self.stage, self.is_free, self.battle = Stage.PLAYING, True, battle

    def handle(self, event: EngineEvent, now_ns: int) -> None:
        """Handle one event of the engine."""
        if self.battle is not None and self.is_battle:
            self.battle.handle(event)
            return
        if not self.is_free:
            self.session.handle(event, now_ns)
            return
        known = len(self.free.notices)
        self.free.handle(event)
        for notice in self.free.notices[known:]:
            self._notify(notice)

    def advance(self, now_ns: int) -> None:
        """Move on; what is over ends."""
        if self.battle is not None:
            is_over = self.battle.advance(now_ns) and self.is_playing
        elif self.is_free:
            self.free.advance(now_ns)
            is_over = self.free.runs and self.free.over
        else:
            is_over = self.is_playing and self.session.advance(now_ns)
        if is_over:
            self.end()

    def end(self) -> None:
        """End the session, the battle or the take that runs, if one does: it is judged and kept."""
        if self.is_session:
            self._finish()
        elif self.is_playing and self.battle is not None:
            self.fault = self.battle.finish()
            self._notify("" if self.fault is None else str(self.fault))
            self.stage = Stage.RESULT
        elif self.is_playing:
            self.fault = self.free.finish(self._engine)
            self._notify(f"{self.fault}" if self.fault is not None else f"kept in {self.free.folder}")
            self.stage = Stage.IDLE

    def _finish(self) -> None:
        settings = self._store.now
        saved = self.session.finish(settings)
        self.fault = saved.fault
        if saved.fault is not None:
            self._notify(str(saved.fault))
        is_open = saved.fair is not None and saved.fair.is_open  # one question at a time
        if self.next_block is not None and saved.steps:
            saved = saved.leading_to(self.next_block)
        self.last_result.keep(saved, settings.ask_first and saved.marks is None and not is_open)
        self.stage = Stage.RESULT

    def veto(self) -> None:
        """Play the last pass once more in place of the one that is counted in."""
        if not self.session.veto():
            self._finish()

    def turn(self, strokes: Sequence[Hit] = ()) -> None:
        """Pause what runs, as these `strokes` asked for, or let it go on; nothing where there is none."""
        if self.is_playing and self.battle is not None:
            self.battle.turn()
        elif self.is_session:
            self.session.go_on() if self.session.paused else self.session.hold(strokes)

    def answer(self, guess: SelfEstimate) -> None:
        """What the student believes, where a question is open."""
        message = self.last_result.answer(guess)
        if message is not None:
            self._notify(message)

    def look_at(self, saved: SavedSession) -> None:
        """Show a result that a student has sent, in place of what is shown; nobody plays."""
        assert not self.is_playing, "whoever asks has looked"
        self.last_result.keep(saved, may_ask=False)
        if self.stage is Stage.IDLE:
            self._was_free = self.is_free
        self.stage, self.is_free = Stage.RESULT, False

    def look_at_battle(self, battle: BattleSession) -> None:
        """Show the result of a battle of another day, in place of what is shown; nobody plays."""
        assert not self.is_playing, "whoever asks has looked"
        self.last_result.leave()
        self.stage, self.is_free, self.battle = Stage.RESULT, True, battle

    def leave(self, session: LessonSession) -> None:
        """The result was read: `session` is shown again."""
        self.last_result.leave()
        self.session, self.stage, self.battle = session, Stage.IDLE, None
        self.is_free, self._was_free = self._was_free, False

    def leave_battle(self) -> None:
        """Its result was read: the kit alone is shown."""
        self.stage, self.battle = Stage.IDLE, None

    def put_away(self, free: FreeSession) -> None:
        """Forget the last result and the last take; nobody plays, and takes are `free`'s from now on."""
        assert not self.is_playing, "whoever asks has looked"
        self.last_result, self.free = LastResult(), free

    # --- what is seen ------------------------------------------------------------------------------------------------

    def state_in(self, state: RoomState) -> RoomState:
        """The room's state, and what goes on in it."""
        state = replace(
            state,
            stage=self.stage,
            take=self.free.take,
            free=self.is_free,
            question=self.last_result.question,
            student=self._sender,
            lag_ms=self.lag_ms,
        )
        if self.battle is not None:
            return self.battle.state_in(state)
        return state if self.is_free else self.session.state_in(state)

    def snapshot(self, now_ns: int, heard_ns: int | None, hears: bool) -> Snapshot:
        """The picture at `now_ns`; `heard_ns` is the place in what sounds, where the ear `hears` something."""
        if self.battle is not None:
            return self.battle.snapshot(heard_ns if hears else None)
        if self.is_free:
            return self.free.snapshot(self.session.plan.kit, now_ns, heard_ns)
        compared = self.last_result.compared(heard_ns) if self.stage is Stage.RESULT and hears else None
        return compared or self.session.snapshot(now_ns)
