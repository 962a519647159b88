"""What is practised now: nothing, a session, a free take, or a result, and how one follows the other.

It owns what is played and what was; who demonstrates, what sounds between sessions and what the pads ask for are the
controller's.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

from station.app.engine_client import EngineClient
from station.app.room_state import FreeRequest, RoomState, Stage
from station.app.sessions.free_session import FreeSession
from station.app.sessions.last_result import LastResult
from station.app.sessions.lesson_session import LessonSession
from station.app.settings_store import SettingsStore
from station.core.errors import StationError
from station.core.events import Hit
from station.engine.messages import EngineEvent
from station.practice.session.self_estimate import SelfEstimate
from station.render.snapshot import Snapshot
from station.sound.track import PreparedTrack


class CurrentPractice:
    """At first `run` is shown and nothing is played; sessions go by `store`, `notify` hears what a user should read."""

    def __init__(
        self,
        engine: EngineClient,
        store: SettingsStore,
        run: LessonSession,
        free: FreeSession,
        notify: Callable[[str], None],
    ) -> None:
        self._engine, self._store, self._notify = engine, store, notify
        self.run, self.free = run, free
        self.outcome = LastResult()
        self.stage = Stage.IDLE
        self.is_free = False
        """Whether no lesson is shown: the kit alone, to just play."""
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

    # --- one after the other -----------------------------------------------------------------------------------------

    def show(self, run: LessonSession | None) -> None:
        """Show what would be played, None the kit alone."""
        self.is_free = run is None
        self.run = run or self.run

    def begin(self, run: LessonSession, track: PreparedTrack | None) -> None:
        """Play a lesson; raises `StationError`, and goes on as before then."""
        run.begin(self._store.now, track)
        self.outcome.leave()
        self.run, self.stage, self.is_free = run, Stage.PLAYING, False

    def begin_free(self, wish: FreeRequest) -> None:
        """Begin a free take; raises `StationError`, and goes on as before then."""
        self.free.begin(self._engine, wish)
        self.outcome.leave()
        self.stage, self.is_free = Stage.PLAYING, True

    def take(self, event: EngineEvent, now_ns: int) -> None:
        """Take one event of the engine."""
        if not self.is_free:
            self.run.take(event, now_ns)
            return
        told = len(self.free.notices)
        self.free.handle(event)
        for notice in self.free.notices[told:]:
            self._notify(notice)

    def advance(self, now_ns: int) -> None:
        """Move on; what is over ends."""
        if self.is_free:
            self.free.advance(now_ns)
            is_over = self.free.runs and self.free.over
        else:
            is_over = self.is_playing and self.run.advance(now_ns)
        if is_over:
            self.end()

    def end(self) -> None:
        """End the session or the take that runs, if one does: it is judged and kept."""
        if self.is_session:
            self._finish()
        elif self.is_playing:
            self.fault = self.free.finish(self._engine)
            self._notify(f"{self.fault}" if self.fault is not None else f"kept in {self.free.folder}")
            self.stage = Stage.IDLE

    def _finish(self) -> None:
        settings = self._store.now
        kept = self.run.finish(settings)
        self.fault = kept.fault
        if kept.fault is not None:
            self._notify(str(kept.fault))
        self.outcome.keep(kept, settings.ask_first)
        self.stage = Stage.RESULT

    def veto(self) -> None:
        """Play the last pass once more in place of the one that is counted in."""
        if not self.run.veto():
            self._finish()

    def turn(self, strokes: Sequence[Hit] = ()) -> None:
        """Pause the session, as these `strokes` asked for, or let it go on; nothing where there is none."""
        if self.is_session:
            self.run.go_on() if self.run.paused else self.run.hold(strokes)

    def answer(self, guess: SelfEstimate) -> None:
        """What the student believes, where a question is open."""
        told = self.outcome.answer(guess)
        if told is not None:
            self._notify(told)

    def leave(self, run: LessonSession) -> None:
        """The result was read: `run` is shown again."""
        self.outcome.leave()
        self.run, self.stage = run, Stage.IDLE

    # --- what is seen ------------------------------------------------------------------------------------------------

    def told(self, state: RoomState) -> RoomState:
        """The room's state, and what goes on in it."""
        state = replace(
            state,
            stage=self.stage,
            take=self.free.take,
            free=self.is_free,
            question=self.outcome.question,
        )
        return state if self.is_free else self.run.told(state)

    def snapshot(self, now_ns: int, heard_ns: int | None, hears: bool) -> Snapshot:
        """The picture at `now_ns`; `heard_ns` is the place in what sounds, where the ear `hears` something."""
        if self.is_free:
            return self.free.snapshot(self.run.plan.kit, now_ns, heard_ns)
        compared = self.outcome.compared(heard_ns) if self.stage is Stage.RESULT and hears else None
        return compared or self.run.snapshot(now_ns)
