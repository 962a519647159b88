"""What practises behind the window: the engine's process, the session, its folder, its pictures. No window.

`snapshot` is called once a frame and does everything: it reads what the engine has heard, moves the session on, keeps
it when it is over. The hits carry their own times, so that the frame rate decides nothing.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from station.app.calibration_desk import CalibrationDesk
from station.app.deck import Deck
from station.app.demonstrator import Demonstrator, kept_demonstrator
from station.app.ear import Ear
from station.app.engine_line import EngineLine, WakeEngine
from station.app.graphed import Graphed
from station.app.habits import HabitDesk, Habits
from station.app.just_play import JustPlay
from station.app.kit_commands import KitCommands
from station.app.kit_desk import KitDesk
from station.app.lesson_cards import wish_of
from station.app.lesson_run import LessonRun
from station.app.model import FreeWish, LessonCard, Report, RoomState, Stage, Start
from station.app.outcome import Outcome
from station.app.preparation import LaidOut, Preparation
from station.app.welcome import Answers, student_level
from station.app.welcome import answered as met
from station.core.calibration import Calibration, load_calibration
from station.core.errors import DeviceError, StationError
from station.core.events import DeviceLost
from station.core.settings import Settings
from station.engine.messages import Command, Eavesdrop, EngineEvent, KeyHit, Started
from station.motion.figure import load_figure
from station.motion.hand_notes import Hands
from station.motion.style import Style
from station.music.score import Score
from station.practice.backing import BackingWish
from station.practice.by_ear import Whose
from station.practice.latency import Latency, latency_of
from station.practice.lead import hands_of
from station.practice.listening import Listening
from station.practice.own_ear import Guess
from station.practice.plan import Plan
from station.render.snapshot import Snapshot

NOTICES_KEPT = 5
"""How many notices the window may show at once; our choice."""


class PracticeRoom:
    """The `PracticeModel` of the real window; `first` is shown, and not yet played, when it opens.

    `wake` starts an engine: once now, and again when a session is begun after one has died. `latency` is what was
    measured of the devices, the settings' word where nothing was. Sessions whose tempo stays play along to `backing`.
    """

    def __init__(
        self,
        wake: WakeEngine,
        settings: Settings,
        first: Plan,
        adapt: bool = False,
        latency: Latency | None = None,
        backing: BackingWish | None = None,
    ) -> None:
        self._engine = EngineLine(wake, settings.rate_hz)
        self._prepared = Preparation(settings, first.lesson, backing)
        self._latency = latency or latency_of(settings, Calibration())
        self._first = replace(wish_of(first), adapt=adapt)
        self._notices: list[str] = []
        self._who = kept_demonstrator(settings, self._notices.append)
        self._run = LessonRun(self._engine, LaidOut(first), self._who, self._latency, self._notices.append)
        self._outcome = Outcome()
        self._stage = Stage.IDLE
        self._free = JustPlay(settings, self._latency)
        self.desk = KitDesk(self._tell_engine)
        self.calibration = CalibrationDesk(self._rest, self._engine.wake)
        self._is_free = False
        self._ear = Ear(self._engine, self._prepared.has_tracks)
        self._kit = KitCommands(settings, first.score, self._accustom)
        self._fault: StationError | None = None
        self.deck = Deck(self._ear.demonstrate, self._prepared.watched(first.lesson, first.kit), self._who)
        self.deck.repeat(self._first.bars)

    # --- what the window shows ---------------------------------------------------------------------------------------

    def snapshot(self, now_ns: int) -> Snapshot:
        """Take in what has happened, then the picture at `now_ns`."""
        self._measured()
        for event in self._heard():
            self.desk.take(event)
            self._take(event, now_ns)
        self.desk.advance(now_ns)
        heard_ns = self._ear.advance(now_ns)
        if self._is_free:
            self._free.advance(now_ns)
            if self._free.runs and self._free.over:
                self.stop()
            return self._free.snapshot(self._run.plan.kit, now_ns, heard_ns)
        if self._stage is Stage.PLAYING and self._run.advance(now_ns):
            self._finish()
        self.deck.advance(now_ns)
        if self._stage is Stage.IDLE and self.deck.is_shown:
            return self.deck.snapshot()
        compared = self._outcome.compared(heard_ns) if self._stage is Stage.RESULT and self._ear.hears else None
        return compared or self._run.snapshot(now_ns)

    def room(self) -> RoomState:
        """What surrounds the picture."""
        state = RoomState(
            self._stage,
            self._engine.kits,
            self._engine.sound,
            tuple(self._notices[-NOTICES_KEPT:]),
            has_take=self._free.has_take,
            listening=self._ear.hears,
            free=self._is_free,
            question=self._outcome.question,
        )
        return state if self._is_free else self._run.told(state)

    def first_card(self) -> LessonCard:
        """The lesson that the window was opened on, in the list."""
        return self._prepared.first_card()

    def lessons(self) -> Sequence[LessonCard]:
        """Every shipped lesson, and the one that was named when the window was opened."""
        return self._prepared.cards()

    def report(self) -> Report | None:
        """The result of the session that ended last, once the question before it was answered."""
        return self._outcome.report

    def graphed(self) -> Graphed | None:
        """What the graph shows: the demonstration, the session, or its whole result once it may be seen."""
        if self._is_free:
            return None
        if self._stage is Stage.PLAYING:
            return self._run.graphed()
        if self._stage is Stage.IDLE:
            return self.deck.graphed()
        return self._outcome.graphed(self._who)

    def first(self) -> Start:
        """The lesson that the window was opened on, as it was asked for."""
        return self._first

    # --- what the user does ------------------------------------------------------------------------------------------

    def preview(self, wish: Start | None) -> None:
        """Show the chosen lesson, its bars on the player, or the kit alone, to just play; raises `StationError`."""
        if self._stage is Stage.IDLE:
            self._ear.quiet()
            self._is_free = wish is None
            if self._is_free:
                self.deck.halt()
        if self._stage is Stage.IDLE and wish is not None:
            self._run = self._laid_out(wish)
            lesson = self._prepared.lesson(wish.lesson)
            self.deck.load(self._prepared.watched(lesson, self._run.plan.kit), wish.bars)

    def start(self, wish: Start) -> None:
        """Begin a session, ending the one that runs; wakes a new engine if the old has ended. Raises `StationError`."""
        run = self._laid_out(wish)
        self._make_room()
        track = None if wish.adapt else self._prepared.track(run.plan, self._engine.rate_hz)
        if track is None:
            self._ear.without_track()
        run.begin(self._prepared.settings, track)
        self._outcome.leave()
        self._run, self._stage, self._is_free = run, Stage.PLAYING, False

    def just_play(self, wish: FreeWish) -> None:
        """Begin a free take, ending what runs; raises `StationError`."""
        self._make_room()
        self._ear.without_track()
        self._free.begin(self._engine, wish)
        self._outcome.leave()
        self._stage, self._is_free = Stage.PLAYING, True

    def listen(self) -> None:
        """Hear the last free take from its capture, or end what is heard; raises `StationError`."""
        if self._ear.hears:
            self._ear.quiet()
        elif self._stage is not Stage.PLAYING:
            self._hear(self._free.listening())

    def hear_bar(self, bar: int, whose: Whose) -> None:
        """Hear and see a bar (from 0) of the result's score, as it was written or played; raises `StationError`."""
        if self._stage is Stage.RESULT:
            self._hear(self._outcome.hear(bar, whose, self._who))

    def score(self) -> Score:
        """The whole score of the lesson that is shown, at its own tempo."""
        return self._run.plan.lesson.score

    def demonstrator(self) -> Demonstrator:
        """Who demonstrates."""
        return self._who

    def move_as(self, style: Style) -> None:
        """Let the demonstrator move in another style at once; hands hold as before while a pass is played."""
        self._who = replace(self._who, style=style)
        self._run.move_as(self._who, hands_stay=self._stage is Stage.PLAYING and not self._is_free)
        self.deck.perform_as(self._who)

    def embody(self, figure: str) -> None:
        """Let another body demonstrate from the next preview or session on: a name or file; raises `BadInput`."""
        self._who = replace(self._who, figure=load_figure(figure))
        self.deck.perform_as(self._who)

    def hands(self) -> Hands:
        """Whose hand leads: as it was chosen, else as the lesson's kit is built."""
        return hands_of(self._prepared.settings) or (Hands.LEFT if self._run.plan.kit.left_handed else Hands.RIGHT)

    def lead_with(self, hands: Hands) -> None:
        """Let another hand lead from the next preview or session on."""
        self._prepared.settings = replace(self._prepared.settings, hands=hands.value)

    def _tell_engine(self, command: Command) -> None:
        """For this engine, and where it asks for something lasting, for every later one."""
        if isinstance(command, Eavesdrop):
            self._engine.stand(command)
        else:
            self._engine.send(command)

    @property
    def habits(self) -> HabitDesk:
        """How the student likes sessions to go."""
        return self._kit.habits

    def _accustom(self, habits: Habits) -> None:
        """Sessions go so from now on; one that runs waits as it began."""
        self._prepared.settings = habits.within(self._prepared.settings)
        self._kit.accustom(self._prepared.settings, self._run.plan.score)

    def meet(self, answers: Answers) -> None:
        """Who plays, what is heard and whose hand leads, from now on; raises `DeviceError` for a dead engine."""
        settings = self._prepared.settings = met(self._prepared.settings, answers)
        self._free.meet(settings)
        self._engine.stand(student_level(settings))

    def answer(self, guess: Guess) -> None:
        """What the student believes of the session that ended: now its result is shown beside it."""
        told = self._outcome.answer(guess)
        if told is not None:
            self._notices.append(told)

    def measure(self, by: str, distance_m: float) -> None:
        """Measure how late the devices are, while the engine rests; raises `DeviceError` while somebody plays."""
        from station.app.measuring import MeasureWish

        self.calibration.refuse()
        if self._stage is Stage.PLAYING:
            raise DeviceError("end the session first: what is measured needs the sound card and the kit")
        self.calibration.measure(MeasureWish.of(self._prepared.settings, by, distance_m))

    def trust_measured(self) -> None:
        """Subtract what is stored of the devices from the next session on; raises `BadInput` for a foreign file."""
        self._latency = latency_of(self._prepared.settings, load_calibration())
        self._free.delayed_by(self._latency)

    def veto(self) -> None:
        """Refuse what the next pass would change, while it is counted in: the last one once more."""
        if self.room().can_veto and not self._run.veto():
            self._finish()

    def pause(self) -> None:
        """Pause the session, or go on; nothing where there is none, or where the score waits by itself."""
        if self._stage is Stage.PLAYING and not self._is_free:
            self._kit.turn(self._run)

    def wants_start(self) -> bool:
        """Whether two kicks have asked for what Enter starts; said once."""
        return self._kit.wants_start()

    def stop(self) -> None:
        """End the session early; what was played is judged and kept."""
        if self._stage is Stage.PLAYING:
            self._end()

    def close(self) -> StationError | None:
        """Keep a session that still runs; returns what the window can no longer tell of it."""
        if self._stage is not Stage.PLAYING:
            return None
        self._end()
        return self._fault

    def key(self, hit: KeyHit) -> None:
        """A stroke on the computer's keyboard; a dead engine hears none, and has said so."""
        with suppress(DeviceError):
            self._engine.send(hit)

    def dismiss(self) -> None:
        """Back to the lessons."""
        if self._stage is Stage.RESULT:
            self._ear.quiet()
            self._outcome.leave()
            self._stage = Stage.IDLE
            self._run = self._new_run(LaidOut(self._run.plan))

    # --- inside ------------------------------------------------------------------------------------------------------

    def _rest(self) -> None:
        """Let the engine's devices go."""
        self._ear.quiet()
        self.deck.halt()
        for kit in self._engine.rest():
            self.desk.take(DeviceLost(0, kit))

    def _measured(self) -> None:
        try:
            self.calibration.advance()
        except DeviceError as fault:  # the engine does not wake
            self._notices.append(str(fault))

    def _command(self, event: EngineEvent) -> None:
        """Do what pads and foot switches ask for; a question has the pads for itself."""
        if self._outcome.is_asking:
            self._kit.forget()
            return
        is_playing = self._stage is Stage.PLAYING
        self._kit.take(event, self._run, is_running=is_playing and not self._is_free, is_quiet=not is_playing)

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

    def _end(self) -> None:
        """End the session or the take that runs, and keep it."""
        if not self._free.runs:
            self._finish()
            return
        self._fault = self._free.finish(self._engine)
        self._notices.append(f"{self._fault}" if self._fault is not None else f"kept in {self._free.folder}")
        self._stage = Stage.IDLE

    def _laid_out(self, wish: Start) -> LessonRun:
        laid = self._prepared.laid_out(wish)
        if laid.followed is not None and laid.followed.fault is not None:
            self._notices.append(laid.followed.fault)
        return self._new_run(laid)

    def _new_run(self, laid: LaidOut) -> LessonRun:
        return LessonRun(self._engine, laid, self._who, self._latency, self._notices.append, self._run)

    def _heard(self) -> list[EngineEvent]:
        try:
            return self._engine.events()
        except DeviceError as fault:
            self._notices.append(str(fault))
            self._ear.forget()
            if self._stage is Stage.PLAYING:
                self._end()
            return []

    def _take(self, event: EngineEvent, now_ns: int) -> None:
        if self._ear.hears:
            self._ear.take(event)
        elif isinstance(event, Started) and self._stage is not Stage.PLAYING:
            self.deck.started(event.zero_ns)
            return
        if self._is_free:
            told = len(self._free.notices)
            self._free.handle(event)
            self._notices += self._free.notices[told:]
            self._command(event)
            return
        self._run.take(event, now_ns)
        self._command(event)
        guess = self._outcome.guess_of(event)
        if guess is not None:
            self.answer(guess)

    def _finish(self) -> None:
        """End the session, judge what was played and keep it."""
        settings = self._prepared.settings
        kept = self._run.finish(settings)
        self._fault = kept.fault
        if kept.fault is not None:
            self._notices.append(str(kept.fault))
        self._outcome.keep(kept, settings.ask_first)
        self._stage = Stage.RESULT
