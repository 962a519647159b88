"""What practises behind the window: the engine's process, the session, its folder, its pictures. No thread, no picture.

`snapshot` is called once a frame and does everything: it reads what the engine has heard, moves the session on, keeps
it when it is over. The hits carry their own times, so that the frame rate decides nothing.
"""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import replace
from datetime import date

from station.app.deck import Deck, Watched
from station.app.demonstrator import Demonstrator, kept_demonstrator
from station.app.engine_line import EngineLine, WakeEngine
from station.app.every_hit import every_hit
from station.app.graphed import Graphed
from station.app.heat_map import heat_map
from station.app.just_play import JustPlay
from station.app.kit_desk import KitDesk
from station.app.lesson_cards import all_lessons, card, wish_of
from station.app.model import FreeWish, LessonCard, PlaceNow, Report, RoomState, Stage, Start
from station.app.results import session_facts
from station.app.session_folder import SessionFolder, rescued
from station.app.session_view import SessionView, graphed_result
from station.app.welcome import Answers, student_level
from station.app.welcome import answered as met
from station.core.calibration import Calibration
from station.core.errors import DeviceError, StationError
from station.core.events import Hit
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.lesson import Lesson
from station.drills.library import find_lesson
from station.engine.messages import Command, Eavesdrop, EngineEvent, KeyHit, Play, SetBacking, Started
from station.motion.figure import load_figure
from station.motion.hand_notes import Hands
from station.motion.style import Style
from station.music.judgement import Judgement
from station.music.score import Score
from station.practice.adaptation import Adaptation
from station.practice.backing import Backing, BackingWish
from station.practice.by_ear import Whose, bar_by_ear
from station.practice.click_word import parse_click
from station.practice.latency import Latency, latency_of
from station.practice.lead import hands_of
from station.practice.listening import Listening
from station.practice.live import begin, end, next_session
from station.practice.mastery_report import with_mastery
from station.practice.memory import Memory, Remembered
from station.practice.own_ear import GUESS_OF, QUESTION, Guess, answered, is_worth_asking
from station.practice.pad_commands import PadCommands
from station.practice.plan import Phase, Plan, Wishes, plan_practice
from station.practice.report import practice_document
from station.practice.session import Session, SessionResult
from station.render.snapshot import Hud, Snapshot
from station.scoring.document import Json
from station.sound.track import PreparedTrack

PAUSED = "Paused: two kicks, or Go on"
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
        self._settings = settings
        self._backing = None if backing is None else Backing(backing)
        self._latency = latency or latency_of(settings, Calibration())
        self._lessons = all_lessons(first.lesson)
        self._first = replace(wish_of(first), adapt=adapt)
        self._followed: Remembered | None = None
        self._taken: Session | None = None
        self._plan = first
        self._notices: list[str] = []
        self._who = kept_demonstrator(settings, self._notices.append)
        self._view = SessionView(first, self._who)
        self._session = self._new_session(first)
        self._folder: SessionFolder | None = None
        self._report: Report | None = None
        self._result: SessionResult | None = None
        self._asked: set[str] = set()
        self._is_asking = False
        self._stage = Stage.IDLE
        self._free = JustPlay(settings, self._latency)
        self.desk = KitDesk(self._tell_engine)
        self._is_free = False
        self._listening: Listening | None = None
        self._pads = PadCommands(settings, first.score)
        self._is_wanted = self._was_asked = False
        self._fault: StationError | None = None
        self.deck = Deck(self._let_sound, Watched(first.lesson, first.kit, hands_of(settings)), self._who)
        self.deck.do(lambda player, now_ns: player.looped(now_ns, _from_0(self._first.bars)))
        self._hud = Hud()
        self._graphed: Graphed | None = None

    # --- what the window shows ---------------------------------------------------------------------------------------

    def snapshot(self, now_ns: int) -> Snapshot:
        """Take in what has happened, then the picture at `now_ns`."""
        for event in self._heard():
            self.desk.take(event)
            self._take(event, now_ns)
        self.desk.advance(now_ns)
        if self._listening is not None and self._listening.is_over(now_ns):
            self._listening = None
        if self._is_free:
            self._free.advance(now_ns)
            if self._free.runs and self._free.over:
                self.stop()
            heard_ns = None if self._listening is None else self._listening.at_ns(now_ns)
            return self._free.snapshot(self._plan.kit, now_ns, heard_ns)
        if self._stage is Stage.PLAYING:
            self._judged(self._session.advance(now_ns), now_ns)
            if self._settings.auto_pause and self._session.is_left:
                self._hold(asked=False)
            elif self._session.over:
                self._pass_over()
        self.deck.advance(now_ns)
        if self._stage is Stage.IDLE and self.deck.is_shown:
            return self.deck.snapshot()
        shown = self._view.snapshot(self._session, now_ns, PAUSED if self._session.paused else "")
        self._hud = shown.hud
        return shown

    def room(self) -> RoomState:
        """What surrounds the picture."""
        state = RoomState(
            self._stage,
            self._engine.kits,
            self._engine.sound,
            tuple(self._notices[-NOTICES_KEPT:]),
            has_take=self._free.has_take,
            listening=self._listening is not None,
            free=self._is_free,
        )
        return state if self._is_free else self._with_session(state)

    def _with_session(self, room: RoomState) -> RoomState:
        """The room, and how far its session is."""
        state, adaptation, progress = self._session.state(), None, None
        if room.stage is Stage.PLAYING:
            adaptation = None if self._followed is None else self._followed.adaptation
            if state.transport_ns is not None:
                progress = min(max(state.transport_ns / self._plan.end_ns, 0.0), 1.0)
        if adaptation is not None and progress is not None:
            progress = (len(adaptation.rounds) + progress) / adaptation.loops
        can_veto = adaptation is not None and bool(adaptation.rounds) and state.segment.phase is Phase.COUNT_IN
        clock = None
        if progress is not None and state.transport_ns is not None:
            clock = PlaceNow(max(state.transport_ns, 0) / NS_PER_S, self._hud.bar, self._hud.beat)
        return replace(
            room,
            progress=progress,
            why=self._session.message,
            can_veto=can_veto,
            question=QUESTION if self._is_asking else "",
            can_pause=room.stage is Stage.PLAYING and self._session.can_pause,
            paused=self._session.paused,
            clock=clock,
        )

    def lessons(self) -> Sequence[LessonCard]:
        """Every shipped lesson, and the one that was named when the window was opened."""
        return [card(lesson) for lesson in self._lessons.values()]

    def report(self) -> Report | None:
        """The result of the session that ended last, once the question before it was answered."""
        return None if self._is_asking else self._report

    def graphed(self) -> Graphed | None:
        """What the graph shows: the demonstration, the session, or its whole result once it may be seen."""
        if self._is_free:
            return None
        if self._stage is Stage.PLAYING:
            return self._view.graphed(self._session)
        if self._stage is Stage.IDLE:
            return self.deck.graphed()
        if self._graphed is None and self._result is not None and not self._is_asking:
            self._graphed = graphed_result(self._result, self._who)
        return self._graphed

    def first(self) -> Start:
        """The lesson that the window was opened on, as it was asked for."""
        return self._first

    # --- what the user does ------------------------------------------------------------------------------------------

    def preview(self, wish: Start | None) -> None:
        """Show the chosen lesson, its bars on the player, or the kit alone, to just play; raises `StationError`."""
        if self._stage is Stage.IDLE:
            self._quiet()
            self._is_free = wish is None
            if self._is_free:
                self.deck.halt()
        if self._stage is Stage.IDLE and wish is not None:
            self._plan, self._view, _ = self._laid_out(wish)
            self._session = self._new_session(self._plan)
            click = parse_click(self._settings.click_pattern, "settings: click_pattern")
            lesson = self._lesson(wish.lesson)
            self.deck.load(Watched(lesson, self._plan.kit, hands_of(self._settings), click), _from_0(wish.bars))

    def start(self, wish: Start) -> None:
        """Begin a session, ending the one that runs; wakes a new engine if the old has ended. Raises `StationError`."""
        plan, view, followed = self._laid_out(wish)
        self._make_room()
        track = None if wish.adapt else self._track(plan)
        folder = SessionFolder(None, self._settings, plan.lesson.name)
        session = self._new_session(plan) if followed is None else followed.adaptation.session(self._latency)
        session.backing = track
        try:
            if self._backing is not None and track is None:
                self._engine.send(SetBacking(None))
            begin(self._engine, session, folder.capture)
        except StationError:
            folder.discard()
            raise
        self._plan, self._view, self._session, self._folder = plan, view, session, folder
        self._followed, self._stage, self._is_asking, self._is_free = followed, Stage.PLAYING, False, False
        self._pads.practise(plan.score)

    def just_play(self, wish: FreeWish) -> None:
        """Begin a free take, ending what runs; raises `StationError`."""
        self._make_room()
        self._free.begin(self._engine, wish)
        self._stage, self._is_asking, self._is_free = Stage.PLAYING, False, True

    def listen(self) -> None:
        """Hear the last free take from its capture, or end what is heard; raises `StationError`."""
        if self._listening is not None:
            self._quiet()
        elif self._stage is not Stage.PLAYING:
            self._hear(self._free.listening())

    def hear_bar(self, bar: int, whose: Whose) -> None:
        """Hear a bar (from 0) of the result's score, as it was written or played; raises `StationError`."""
        if self._stage is Stage.RESULT and self._result is not None:
            self._hear(bar_by_ear(self._result, bar, whose))

    def score(self) -> Score:
        """The whole score of the lesson that is shown, at its own tempo."""
        return self._plan.lesson.score

    def demonstrator(self) -> Demonstrator:
        """Who demonstrates."""
        return self._who

    def move_as(self, style: Style) -> None:
        """Let the demonstrator move in another style at once; hands hold as before while a pass is played."""
        self._who = replace(self._who, style=style)
        self._view.move_as(style, hands_stay=self._stage is Stage.PLAYING and not self._is_free)
        self.deck.perform_as(self._who)

    def embody(self, figure: str) -> None:
        """Let another body demonstrate from the next preview or session on: a name or file; raises `BadInput`."""
        self._who = replace(self._who, figure=load_figure(figure))
        self.deck.perform_as(self._who)

    def hands(self) -> Hands:
        """Whose hand leads: as it was chosen, else as the lesson's kit is built."""
        return hands_of(self._settings) or (Hands.LEFT if self._plan.kit.left_handed else Hands.RIGHT)

    def lead_with(self, hands: Hands) -> None:
        """Let another hand lead from the next preview or session on."""
        self._settings = replace(self._settings, hands=hands.value)

    def _tell_engine(self, command: Command) -> None:
        """For this engine, and where it asks for something lasting, for every later one."""
        if isinstance(command, Eavesdrop):
            self._engine.stand(command)
        else:
            self._engine.send(command)

    def meet(self, answers: Answers) -> None:
        """Who plays, what is heard and whose hand leads, from now on; raises `DeviceError` for a dead engine."""
        self._settings = met(self._settings, answers)
        self._free.meet(self._settings)
        self._engine.stand(student_level(self._settings))

    def answer(self, guess: Guess) -> None:
        """What the student believes of the session that ended: now its result is shown beside it."""
        if self._is_asking and self._report is not None:
            self._notices.append(answered(guess, self._report.document))
            self._is_asking = False

    def veto(self) -> None:
        """Refuse what the next pass would change, while it is counted in: the last one once more."""
        if self._followed is not None and self.room().can_veto:
            self._followed.adaptation.veto()
            self._next_pass(self._followed.adaptation)

    def pause(self) -> None:
        """Pause the session, or go on; nothing where there is none, or where the score waits by itself."""
        if self._stage is Stage.PLAYING and not self._is_free:
            self._go_on() if self._session.paused else self._hold()

    def wants_start(self) -> bool:
        """Whether two kicks have asked for what Enter starts; said once."""
        wanted, self._is_wanted = self._is_wanted, False
        return wanted

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
            self._quiet()
            self._stage, self._is_asking = Stage.IDLE, False
            self._session = self._new_session(self._plan)
            self._view = SessionView(self._plan, self._who)

    # --- inside ------------------------------------------------------------------------------------------------------

    def _hold(self, command: Sequence[Hit] = (), asked: bool = True) -> None:
        """Pause; `command` are the strokes that asked for it, where some did."""
        self._was_asked = asked
        self._pads.forget()
        self._send(self._session.pause(command))
        self._view.judged_anew(self._session)

    def _go_on(self) -> None:
        """Out of a pause: a pass that moves the tempo is taken whole, else from the bar of the last stroke."""
        self._pads.forget()
        self._send(self._session.resume(self._was_asked, whole=self._followed is not None))
        self._view.judged_anew(self._session)

    def _send(self, commands: Iterable[Command]) -> None:
        """Tell the engine; a dead one says so itself."""
        for command in commands:
            with suppress(DeviceError):
                self._engine.send(command)

    def _command(self, event: EngineEvent) -> None:
        """Do what pads and foot switches ask for; a question has the pads for itself."""
        if self._is_asking:
            self._pads.forget()
            return
        is_paused = self._stage is Stage.PLAYING and not self._is_free and self._session.paused
        if (is_paused or self._stage is not Stage.PLAYING) and self._pads.starts(event):
            self._is_wanted = not is_paused
            if is_paused:
                self._go_on()
            return
        command = self._pads.pauses(event)
        if command is None or self._stage is not Stage.PLAYING or self._is_free:
            return
        self._go_on() if is_paused else self._hold(command)

    def _make_room(self) -> None:
        """End what runs or sounds, and have an engine; raises `DeviceError`."""
        self._quiet()
        self.deck.halt()
        self.stop()
        self._engine.wake()

    def _hear(self, listening: Listening | None) -> None:
        """Let something sound once; raises `DeviceError`."""
        self._quiet()
        self.deck.halt()
        if listening is not None:
            for command in listening.start():
                self._engine.send(command)
            self._listening = listening

    def _quiet(self) -> None:
        """End what is heard."""
        if self._listening is not None:
            self._send(self._listening.stop())
            self._listening = None

    def _end(self) -> None:
        """End the session or the take that runs, and keep it."""
        if not self._free.runs:
            self._finish()
            return
        self._fault = self._free.finish(self._engine)
        self._notices.append(f"{self._fault}" if self._fault is not None else f"kept in {self._free.folder}")
        self._stage = Stage.IDLE

    def _lesson(self, name: str) -> Lesson:
        return self._lessons.get(name) or find_lesson(name)

    def _laid_out(self, wish: Start) -> tuple[Plan, SessionView, Remembered | None]:
        lesson = self._lesson(wish.lesson)
        tempo_bpm = None if wish.adapt else wish.tempo_bpm
        click = parse_click(self._settings.click_pattern, "settings: click_pattern") if wish.click else None
        hands = hands_of(self._settings)
        wishes = Wishes(tempo_bpm, wish.loops, wish.bars, wish.demonstrations, click, self._settings.guide, hands)
        plan, followed = plan_practice(lesson, wishes), None
        if wish.adapt:
            settings = self._settings
            memory = Memory.of(settings.sessions_dir, settings.student, lesson.name, plan.bars)
            followed = Remembered.of(lesson, wishes, date.today(), memory)
            plan = followed.adaptation.plan
            if followed.fault is not None:
                self._notices.append(followed.fault)
        return plan, SessionView(plan, self._who), followed

    def _let_sound(self, command: Command) -> None:
        """Tell the engine what the demonstration needs, without a track; a dead one plays none, and has said so."""
        with suppress(DeviceError):
            if isinstance(command, Play):
                self._quiet()
            if isinstance(command, Play) and self._backing is not None:
                self._engine.send(SetBacking(None))
            self._engine.send(command)

    def _track(self, plan: Plan) -> PreparedTrack | None:
        """The track to play along to; raises `DeviceError` while it is being made ready, `BadInput` if it cannot be."""
        if self._backing is None:
            return None
        self._backing.ask(plan, self._engine.rate_hz)
        track = self._backing.take()
        if track is None:
            raise DeviceError("the track is being made ready for this tempo: start again in a moment")
        return track

    def _new_session(self, plan: Plan) -> Session:
        return Session(plan, self._latency)

    def _judged(self, verdicts: tuple[Judgement, ...], now_ns: int) -> None:
        """Show what the student is to see of `verdicts`."""
        session = self._session
        self._view.judged(session.told(verdicts), session.hits, now_ns, session.windows)

    def _pass_over(self) -> None:
        """On to the next pass where the tempo follows the student and there is one, else to the result."""
        if self._followed is not None:
            adaptation = self._followed.adaptation
            step = adaptation.take(self._session.result())
            self._taken = self._session
            if step.notice is not None:
                self._notices.append(step.notice)
            if not adaptation.over:
                self._next_pass(adaptation)
                return
        self._finish()

    def _next_pass(self, adaptation: Adaptation) -> None:
        try:
            self._session = next_session(self._engine, adaptation, self._session)
        except DeviceError as fault:
            self._notices.append(str(fault))
            self._finish()
            return
        self._plan = adaptation.plan
        self._pads.practise(self._plan.score)
        self._view = SessionView(self._plan, self._who)

    def _heard(self) -> list[EngineEvent]:
        try:
            return self._engine.events()
        except DeviceError as fault:
            self._notices.append(str(fault))
            self._listening = None
            if self._stage is Stage.PLAYING:
                self._end()
            return []

    def _take(self, event: EngineEvent, now_ns: int) -> None:
        if self._listening is not None:
            self._listening.handle(event)
        elif isinstance(event, Started) and self._stage is not Stage.PLAYING:
            self.deck.started(event.zero_ns)
            return
        if self._is_free:
            told = len(self._free.notices)
            self._free.handle(event)
            self._notices += self._free.notices[told:]
            self._command(event)
            return
        told = len(self._session.heard.notices)
        verdicts = self._session.handle(event)
        self._judged(verdicts, now_ns)
        self._notices += self._session.heard.notices[told:]
        self._command(event)
        if isinstance(event, Hit) and self._is_asking and event.piece in GUESS_OF:
            self.answer(GUESS_OF[event.piece])

    def _finish(self) -> None:
        """End the session, judge what was played and keep it."""
        self._fault = None
        if self._engine.alive:
            try:
                self._fault = end(self._engine, self._session)
            except DeviceError as fault:
                self._fault = fault
        result, document = self._told_whole()
        self._graphed = None
        path = ""
        if self._folder is not None:
            path = str(self._folder.path)
            try:
                self._folder.write(result, document)
                if self._followed is not None:
                    self._followed.keep()
            except StationError as fault:
                self._fault = rescued(fault, result, document)
        if self._fault is not None:
            self._notices.append(str(self._fault))
        self._result = result
        self._report = Report(session_facts(result, document), document, path, heat_map(result), every_hit(result))
        self._stage, self._is_asking = Stage.RESULT, self._may_ask(document)

    def _may_ask(self, document: dict[str, Json]) -> bool:
        """Whether to ask before the result: at most once a lesson, and only what it can answer."""
        name = self._plan.lesson.name
        if not self._settings.ask_first or name in self._asked or not is_worth_asking(document):
            return False
        self._asked.add(name)
        return True

    def _told_whole(self) -> tuple[SessionResult, dict[str, Json]]:
        """The session's result and report, over all passes where there were several sessions."""
        if self._followed is None:
            result = self._session.result()
            return result, practice_document(result, self._settings)
        adaptation = self._followed.adaptation
        if self._taken is not self._session:
            adaptation.take(self._session.result())
            self._taken = self._session
        result = adaptation.result()
        return result, with_mastery(practice_document(result, self._settings), adaptation, self._followed.next_turn())


def _from_0(bars: tuple[int, int] | None) -> tuple[int, int] | None:
    return None if bars is None else (bars[0] - 1, bars[1] - 1)
