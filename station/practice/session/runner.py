"""What moves a session on, in the window, in the terminal and with a virtual student: events and time in, commands out.

A runner knows no clock, thread, engine or window. Whoever drives it hands over every event of the engine and now and
then the time, sends the engine the `commands` of each `Update`, and shows the student what was `judged`; when it is
`over`, or somebody wants it to end, they send what `stop` gives, hand over what the engine still has to say, and
`finish`. Where the tempo follows the student each pass is a session of its own (`session.adaptation`): the next one
begins by itself. Judgement depends on the events' own times alone, however often anybody looks.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from station.core.events import Hit
from station.drills.mastery.practice_steps import PracticeStep
from station.engine.messages import Command, EngineEvent, TrackPhase
from station.music.judgement import Judgement
from station.music.score import Score
from station.practice.control.pad_commands import PadCommands
from station.practice.session.adaptation import Adaptation
from station.practice.session.device_latency import Latency
from station.practice.session.engine_state import EngineState
from station.practice.session.event_log import Tracked, text_of
from station.practice.session.plan import Plan
from station.practice.session.session import Session, SessionResult
from station.sync.drill.drill_model import DrillModel
from station.sync.sonification.triggers import Trigger


@dataclass(frozen=True, slots=True)
class Update:
    """What a step has brought: the `session` it was in, what was `judged` there, the `commands` for the engine.

    `is_anew`: the session was paused or goes on, so that verdicts of before may have been taken back. `notice` is what
    the student should read once of the pass that comes next, if anything.
    """

    session: Session
    judged: tuple[Judgement, ...] = ()
    commands: tuple[Command, ...] = ()
    is_anew: bool = False
    notice: str | None = None


class SessionRunner:
    """A session of one plan, or pass after pass of an adaptation; `pads` may pause it, if any are given.

    Set `waits` and `backing` of its `session` before `start`. It is a `Listener` of the engine (`headless.live`).
    """

    def __init__(self, asked: Plan | Adaptation, latency: Latency, pads: PadCommands | None = None) -> None:
        self._adaptation = asked if isinstance(asked, Adaptation) else None
        self.session = Session(asked, latency) if isinstance(asked, Plan) else asked.session(latency)
        """The session that runs: the newest pass."""
        self.over = False
        """Whether all that was asked for was played."""
        self._pads = pads
        self._was_asked = self._is_recorded = self._is_stopped = False

    @property
    def heard(self) -> EngineState:
        """What the engine has said."""
        return self.session.heard

    @property
    def started(self) -> bool:
        """Whether anything was played, or could have been."""
        return self.session.started or (self._adaptation is not None and bool(self._adaptation.rounds))

    def track(self, section: Score, model: DrillModel, triggers: tuple[Trigger, ...] = ()) -> tuple[Command, ...]:
        """Track the sticks from now on through `section`, of which `model` is; the commands for it."""
        self.session.phases.model = model
        return (TrackPhase(model, triggers, text_of(Tracked(section))),)

    # --- from step to step -------------------------------------------------------------------------------------------

    def start(self) -> tuple[Command, ...]:
        """The commands that set the engine going."""
        return self.session.start()

    def update(self, now_ns: int, events: Iterable[EngineEvent]) -> Update:
        """Take all `events`, then move on to the present."""
        steps = [*(self.handle(event) for event in events), self.advance(now_ns)]
        return Update(
            steps[0].session,
            tuple(verdict for step in steps for verdict in step.judged),
            tuple(command for step in steps for command in step.commands),
            any(step.is_anew for step in steps),
            steps[-1].notice,
        )

    def handle(self, event: EngineEvent) -> Update:
        """Take one event, and do what the pads ask for with it."""
        session = self.session
        told = len(session.heard.unheard)
        judged = session.handle(event)
        kept = session.unheard_texts(told)
        asked = None
        if self._pads is not None and not self._is_stopped:
            asked = self._pads.asks(event, session.plan.score, is_paused=session.paused)
        if asked is None:
            return Update(session, judged, kept)
        update = self.resume() if session.paused else self.pause(asked)
        return replace(update, judged=judged, commands=(*kept, *update.commands))

    def advance(self, now_ns: int) -> Update:
        """Move on: wait for a student who has stopped, go on when they kick, begin the next pass where one is over."""
        session = self.session
        judged = session.advance(now_ns)
        if self._pads is not None and self._pads.starts_by(now_ns) and session.paused and not self._is_stopped:
            return replace(self.resume(), judged=judged)
        if session.waits and session.is_left:
            return replace(self.pause(is_asked=False), judged=judged)
        if self.over or not session.over:
            return Update(session, judged)
        if self._adaptation is None:
            self.over = True
            return Update(session, judged)
        kept = session.stop_listening()
        step = self._record_pass(self._adaptation)
        self.over = self._adaptation.over
        commands = () if self.over else self._next_pass(self._adaptation)
        return Update(session, judged, (*kept, *commands), notice=step.notice)

    def _record_pass(self, adaptation: Adaptation) -> PracticeStep:
        self._is_recorded = True
        return adaptation.record_pass(self.session.result())

    def _next_pass(self, adaptation: Adaptation) -> tuple[Command, ...]:
        """Begin the pass that `adaptation` asks for, on what the one before knows of the kit."""
        before, self._is_recorded = self.session, False
        self.session = adaptation.session(before.latency)
        self.session.heard.go_on_from(before.heard)
        self.session.waits = before.waits
        self.session.phases.model = before.phases.model
        return self.session.start()

    # --- what the student asks for -----------------------------------------------------------------------------------

    def pause(self, command: Sequence[Hit] = (), is_asked: bool = True) -> Update:
        """Stand still; `command` are the strokes that asked for it, `is_asked` not where silence did."""
        self._was_asked = is_asked
        return Update(self.session, commands=self.session.pause(command), is_anew=True)

    def resume(self) -> Update:
        """Out of a pause: a pass that moves the tempo is taken whole, else from the bar of the last stroke."""
        commands = self.session.resume(self._was_asked, whole=self._adaptation is not None)
        return Update(self.session, commands=commands, is_anew=True)

    def veto(self) -> tuple[Command, ...]:
        """Refuse what the pass that is counted in would change, the last one once more; the commands for it."""
        assert self._adaptation is not None, "whoever asks sees that passes follow the student"
        self._adaptation.veto()
        return self._next_pass(self._adaptation)

    # --- the end -----------------------------------------------------------------------------------------------------

    def stop(self) -> tuple[Command, ...]:
        """The commands that end it; from now on the pads ask for nothing."""
        self._is_stopped = True
        return self.session.stop()

    def finish(self) -> SessionResult:
        """The result of all that was played, over all passes; one that never began to sound is nobody's."""
        if self._adaptation is None:
            return self.session.result()
        if not self._is_recorded and (self.session.started or not self._adaptation.rounds):
            self._record_pass(self._adaptation)
        return self._adaptation.result()
