"""What practises behind the window: the engine's process, the session, its folder, its pictures. No window.

`snapshot` is called once a frame and does everything: it reads what the engine has heard, moves the session on, keeps
it when it is over. The hits carry their own times, so that the frame rate decides nothing.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from station.app.calibration import Calibration
from station.app.casting import Casting
from station.app.catalog import Catalog
from station.app.demo_player import DemoPlayer
from station.app.engine_client import EngineClient
from station.app.export import Exporter
from station.app.first_start import FirstAnswers, student_level
from station.app.first_start import answered as met
from station.app.free_session import FreeSession
from station.app.goings_on import GoingsOn
from station.app.kit_commands import KitCommands
from station.app.lesson_cards import request_of
from station.app.lesson_session import LessonSession
from station.app.mapping_editor import MappingEditor
from station.app.model import FreeRequest, RoomState, SessionRequest, ShownResult, Stage
from station.app.playback import Playback
from station.app.preferences import Preferences
from station.app.processes import Processes
from station.app.session_preparation import PreparedSession, SessionPreparation
from station.core.errors import DeviceError, StationError
from station.core.events import DeviceLost
from station.core.measured_latency import StoredCalibration, load_calibration
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.engine.messages import EngineEvent, KeyHit, Started
from station.music.score import Score
from station.practice.demonstration.compare_by_ear import Whose
from station.practice.records.recovery import offer
from station.practice.session.device_latency import Latency, latency_of
from station.practice.session.listening import Listening
from station.practice.session.plan import Plan
from station.practice.session.self_estimate import SelfEstimate
from station.render.snapshot import Snapshot
from station.scenes.curves import ScoreCurves
from station.scenes.demonstrator import kept_demonstrator

if TYPE_CHECKING:
    from station.practice.session.backing_track import BackingRequest

NOTICES_KEPT = 5
"""How many notices the window may show at once; our choice."""
LIVELY_NS = 5 * NS_PER_S
"""So long after a stroke another may come at any moment (our choice: a bar or two)."""


class PracticeRoom:
    """The `PracticeModel` of the real window; `first` is shown, and not yet played, when it opens.

    `processes` start an engine: once now, and again when a session is begun after one has died. `latency` is what was
    measured of the devices, the settings' word where nothing was. Sessions whose tempo stays play along to `backing`.
    """

    def __init__(
        self,
        processes: Processes,
        settings: Settings,
        first: Plan,
        adapt: bool = False,
        latency: Latency | None = None,
        backing: "BackingRequest | None" = None,
    ) -> None:
        self._engine = EngineClient(processes.engine, settings.rate_hz)
        self._prepared = SessionPreparation(settings, backing)
        self._latency = latency or latency_of(settings, StoredCalibration())
        self._first = replace(request_of(first), adapt=adapt)
        self._notices = [] if (cut_off := offer(settings)) is None else [cut_off]
        self.shelf = Catalog(lambda: self._prepared.settings, first.lesson, self._notices.append)
        who = kept_demonstrator(settings, self._notices.append)
        run = LessonSession(self._engine, PreparedSession(first), who, self._latency, self._notices.append)
        self._goings_on = GoingsOn(self._engine, run, FreeSession(settings, self._latency), self._notices.append)
        self.desk = MappingEditor(self._engine.tell)
        self.calibration = Calibration(self._rest, self._engine.wake, processes.measure)
        self.films = Exporter(processes.animate)
        self._ear = Playback(self._engine, self._prepared.has_tracks)
        self._kit = KitCommands(self._prepared, self._goings_on)
        self.deck = DemoPlayer(self._ear.demonstrate, self._prepared.watched(first.lesson, first.kit), who)
        self.deck.repeat(self._first.bars)
        self.casting = Casting(who, self._prepared, self._goings_on, self.deck)

    # --- what the window shows ---------------------------------------------------------------------------------------

    def snapshot(self, now_ns: int) -> Snapshot:
        """Take in what has happened, then the picture at `now_ns`."""
        self._measured()
        self._take_in(now_ns)
        self.desk.advance(now_ns)
        heard_ns = self._ear.advance(now_ns)
        self._goings_on.advance(now_ns, self._prepared.settings)
        if not self._goings_on.is_free:
            self.deck.advance(now_ns)
            if self._goings_on.stage is Stage.IDLE and self.deck.is_shown:
                return self.deck.snapshot()
        return self._goings_on.snapshot(now_ns, heard_ns, self._ear.hears)

    def news(self, now_ns: int) -> Snapshot | None:
        """The picture at `now_ns` if there is something new in it, while somebody plays: it need not wait a frame.

        What goes on with time does so in `snapshot` alone, once a frame.
        """
        if not self._goings_on.is_playing or not self._take_in(now_ns):
            return None
        return self._goings_on.snapshot(now_ns, None, hears=False)

    def is_lively(self, now_ns: int) -> bool:
        """Whether something moves, or may at any moment: a frame that is spared would be missed."""
        moves = self._goings_on.is_playing or self._ear.hears or self.deck.player.rate_percent != 0
        return moves or (self._engine.struck_ns is not None and now_ns - self._engine.struck_ns < LIVELY_NS)

    def room(self) -> RoomState:
        """What surrounds the picture."""
        shown = RoomState(
            kit=self._engine.kits,
            sound=self._engine.sound,
            notices=tuple(self._notices[-NOTICES_KEPT:]),
            listening=self._ear.hears,
        )
        return self._goings_on.told(shown)

    def report(self) -> ShownResult | None:
        """The result of the session that ended last, once the question before it was answered."""
        return self._goings_on.outcome.report

    def graphed(self) -> ScoreCurves | None:
        """What the graph shows: the demonstration, the session, or its whole result once it may be seen."""
        if self._goings_on.is_free:
            return None
        if self._goings_on.is_playing:
            return self._goings_on.run.graphed()
        if self._goings_on.stage is Stage.IDLE:
            return self.deck.graphed()
        return self._goings_on.outcome.graphed(self.casting.who)

    def first(self) -> SessionRequest:
        """The lesson that the window was opened on, as it was asked for."""
        return self._first

    # --- what the user does ------------------------------------------------------------------------------------------

    def preview(self, wish: SessionRequest | None) -> None:
        """Show the chosen lesson, its bars on the player, or the kit alone, to just play; raises `StationError`."""
        if self._goings_on.stage is not Stage.IDLE:
            return
        self._ear.quiet()
        run = None if wish is None else self._laid_out(wish)
        self._goings_on.show(run)
        if wish is None or run is None:
            self.deck.halt()
        else:
            self.deck.load(self._prepared.watched(self.shelf.lesson(wish.lesson), run.plan.kit), wish.bars)

    def start(self, wish: SessionRequest) -> None:
        """Begin a session, ending the one that runs; wakes a new engine if the old has ended. Raises `StationError`."""
        run = self._laid_out(wish)
        self._make_room()
        track = None if wish.adapt else self._prepared.track(run.plan, self._engine.rate_hz)
        if track is None:
            self._ear.without_track()
        self._goings_on.begin(run, self._prepared.settings, track)

    def just_play(self, wish: FreeRequest) -> None:
        """Begin a free take, ending what runs; raises `StationError`."""
        self._make_room()
        self._ear.without_track()
        self._goings_on.begin_free(wish)

    def listen(self) -> None:
        """Hear the last free take from its capture, or end what is heard; raises `StationError`."""
        if self._ear.hears:
            self._ear.quiet()
        elif not self._goings_on.is_playing:
            self._hear(self._goings_on.free.listening())

    def hear_bar(self, bar: int, whose: Whose) -> None:
        """Hear and see a bar (from 0) of the result's score, as it was written or played; raises `StationError`."""
        if self._goings_on.stage is Stage.RESULT:
            self._hear(self._goings_on.outcome.hear(bar, whose, self.casting.who))

    def score(self) -> Score:
        """The whole score of the lesson that is shown, at its own tempo."""
        return self._goings_on.run.plan.lesson.score

    @property
    def habits(self) -> Preferences:
        """How the student likes sessions to go."""
        return self._kit.habits

    def meet(self, answers: FirstAnswers) -> None:
        """Who plays, what is heard and whose hand leads, from now on; raises `DeviceError` for a dead engine."""
        settings = self._prepared.settings = met(self._prepared.settings, answers)
        self._goings_on.free.meet(settings)
        self._engine.stand(student_level(settings))

    def answer(self, guess: SelfEstimate) -> None:
        """What the student believes of the session that ended: now its result is shown beside it."""
        self._goings_on.answer(guess)

    def measure(self, by: str, distance_m: float) -> None:
        """Measure how late the devices are, while the engine rests; raises `DeviceError` while somebody plays."""
        from station.app.latency_methods import MeasureRequest

        self.calibration.measure(MeasureRequest.of(self._prepared.settings, by, distance_m))

    def trust_measured(self) -> None:
        """Subtract what is stored of the devices from the next session on; raises `BadInput` for a foreign file."""
        self._latency = latency_of(self._prepared.settings, load_calibration())
        self._goings_on.free.delayed_by(self._latency)

    def veto(self) -> None:
        """Refuse what the next pass would change, while it is counted in: the last one once more."""
        if self.room().can_veto:
            self._goings_on.veto(self._prepared.settings)

    def pause(self) -> None:
        """Pause the session, or go on; nothing where there is none, or where the score waits by itself."""
        self._kit.turn()

    def wants_start(self) -> bool:
        """Whether two kicks have asked for what Enter starts; said once."""
        return self._kit.wants_start()

    def stop(self) -> None:
        """End the session early; what was played is judged and kept."""
        self._goings_on.end(self._prepared.settings)

    def close(self) -> StationError | None:
        """Keep a session that still runs, end a measurement; returns what the window can no longer tell of it."""
        self.calibration.close()
        if not self._goings_on.is_playing:
            return None
        self.stop()
        return self._goings_on.fault

    def key(self, hit: KeyHit) -> None:
        """A stroke on the computer's keyboard; a dead engine hears none, and has said so."""
        with suppress(DeviceError):
            self._engine.send(hit)

    def dismiss(self) -> None:
        """Back to the lessons."""
        if self._goings_on.stage is Stage.RESULT:
            self._ear.quiet()
            self.shelf.learnt()
            self._goings_on.leave(self._new_run(PreparedSession(self._goings_on.run.plan)))

    # --- inside ------------------------------------------------------------------------------------------------------

    def _rest(self) -> Callable[[], bool]:
        """Let the engine's devices go; returns what says whether it has. Raises `DeviceError` while somebody plays."""
        if self._goings_on.is_playing:
            raise DeviceError("end the session first: what is measured needs the sound card and the kit")
        self._ear.quiet()
        self.deck.halt()
        for kit in self._engine.rest():
            self.desk.take(DeviceLost(0, kit))
        return self._engine.has_rested

    def _measured(self) -> None:
        try:
            self.calibration.advance()
        except DeviceError as fault:  # the engine does not wake
            self._notices.append(str(fault))

    def _make_room(self) -> None:
        """End what runs, sounds or learns, and have an engine; raises `DeviceError`."""
        self.calibration.refuse()
        self._ear.quiet()
        self.deck.halt()
        self.stop()
        self.habits.learn(on=False)  # what is played from now on is no gesture to be learnt
        self._engine.wake()

    def _hear(self, listening: Listening | None) -> None:
        """Let something sound once in place of the demonstration; raises `DeviceError`."""
        self.deck.halt()
        if listening is not None:
            self._ear.hear(listening)

    def _laid_out(self, wish: SessionRequest) -> LessonSession:
        laid = self._prepared.laid_out(self.shelf.lesson(wish.lesson), wish)
        if laid.followed is not None and laid.followed.fault is not None:
            self._notices.append(laid.followed.fault)
        return self._new_run(laid)

    def _new_run(self, laid: PreparedSession) -> LessonSession:
        return LessonSession(
            self._engine, laid, self.casting.who, self._latency, self._notices.append, self._goings_on.run
        )

    def _take_in(self, now_ns: int) -> bool:
        """Take in what the engine has said; whether it has said anything."""
        events = self._heard()
        for event in events:
            self.desk.take(event)
            self._take(event, now_ns)
        return bool(events)

    def _heard(self) -> list[EngineEvent]:
        try:
            return self._engine.events()
        except DeviceError as fault:
            self._notices.append(str(fault))
            self._ear.forget()
            self.stop()
            return []

    def _take(self, event: EngineEvent, now_ns: int) -> None:
        if self._ear.hears:
            self._ear.take(event)
        elif isinstance(event, Started) and not self._goings_on.is_playing:
            self.deck.started(event.zero_ns)
            return
        self._goings_on.take(event, now_ns)
        if self.desk.learns:  # strokes teach, and command nothing
            return
        self._kit.take(event)
        guess = self._goings_on.outcome.guess_of(event)
        if guess is not None:
            self.answer(guess)
