"""Pass after pass in real time, against an engine that says what it is given to say on a clock that it moves itself."""

from datetime import date
from pathlib import Path

from station.core.clock import ManualClock
from station.core.errors import DeviceError
from station.core.events import DeviceFound, Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import CaptureSaved, Command, EngineEvent, Play, RecordCapture, Started
from station.music.judgement import Judgement
from station.practice.headless.live import LiveSetup, practise_live
from station.practice.session.adaptation import Adaptation
from station.practice.session.device_latency import Latency
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.runner import SessionRunner
from station.practice.session.session import Session

TODAY = date(2026, 3, 1)


class Link:
    """Each look at the events is a second later; every transport that runs gets one stroke after ten seconds."""

    def __init__(self, clock: ManualClock) -> None:
        self._clock = clock
        self._says: list[EngineEvent] = [DeviceFound(0, "kit")]
        self.plays = 0
        self.records: list[Path | None] = []

    def send(self, command: Command) -> None:
        if isinstance(command, Play):
            self.plays += 1
            zero_ns = self._clock.now_ns() + command.start_in_ns
            self._says += [Started(zero_ns), Hit(zero_ns + 10 * NS_PER_S, Piece.SNARE, Zone.HEAD, 90)]
        elif isinstance(command, RecordCapture):
            self.records.append(command.path)
            self._says.append(CaptureSaved(command.path))

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        del wait_s
        self._clock.advance_to(self._clock.now_ns() + NS_PER_S)
        said, self._says = self._says, []
        return said


def test_passes_follow_each_other_in_one_capture_and_come_down(tmp_path: Path) -> None:
    """One stroke of 24 is right at best: too much went wrong, two steps of 8 % down from 70 % after each pass."""
    clock = ManualClock()
    link, adaptation = Link(clock), Adaptation(find_lesson("rock-1"), PlanOptions(loops=3, demonstrations=0), TODAY)
    heard: list[Session] = []

    def tell(session: Session, judged: tuple[Judgement, ...]) -> None:
        del judged
        if session not in heard:
            heard.append(session)

    outcome = practise_live(LiveSetup(link, clock, tell), SessionRunner(adaptation, Latency()), tmp_path / "x")
    assert outcome.fault is None
    assert (link.plays, len(heard)) == (3, 3)
    assert link.records == [tmp_path / "x", None]
    assert [one.step.pct for one in adaptation.rounds] == [70.0, 54.0, 40.0]
    assert len(outcome.result.performance) == 3
    assert all(session.heard.devices == ["kit"] for session in heard)
    assert heard[1].message == adaptation.rounds[1].step.why


class Dying(Link):
    """An engine that ends when it is asked for its second pass."""

    def send(self, command: Command) -> None:
        if isinstance(command, Play) and self.plays:
            raise DeviceError("the engine has ended")
        super().send(command)


def test_an_engine_that_ends_between_passes_leaves_the_passes_that_were_played(tmp_path: Path) -> None:
    clock = ManualClock()
    link, adaptation = Dying(clock), Adaptation(find_lesson("rock-1"), PlanOptions(loops=3, demonstrations=0), TODAY)
    room = LiveSetup(link, clock, lambda *_: None)
    outcome = practise_live(room, SessionRunner(adaptation, Latency()), tmp_path / "x")
    assert str(outcome.fault) == "the engine has ended"
    assert len(adaptation.rounds) == 1
    assert len(outcome.result.performance) == 1


def unheard(session: Session, judged: tuple[Judgement, ...]) -> None:
    del session, judged
    raise BrokenPipeError(32, "Broken pipe")


def test_what_cannot_be_told_costs_no_session_and_is_told_at_the_end(tmp_path: Path) -> None:
    clock = ManualClock()
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))
    outcome = practise_live(LiveSetup(Link(clock), clock, unheard), SessionRunner(plan, Latency()), tmp_path / "x")
    assert outcome.result.complete
    assert len(outcome.result.performance) == 1
    told = "not all could be shown while you played, the session is kept: Broken pipe"
    assert str(outcome.fault) == told
