"""A session with a virtual student: the same engine, decoder and runner, on a clock that is moved by hand."""

from collections.abc import Callable
from pathlib import Path

from station.core.errors import DeviceError, StationError
from station.practice.headless.engine_here import EngineHere
from station.practice.headless.live import begin, end
from station.practice.records.virtual_practice import VirtualSession
from station.practice.session.adaptation import Adaptation
from station.practice.session.device_latency import Latency
from station.practice.session.plan import TAIL_NS, Plan
from station.practice.session.runner import SessionRunner
from station.practice.session.session import LEAD_IN_NS
from station.simulation.student_spec import StudentSpec
from station.simulation.virtual_student import VirtualPerformance, VirtualStudent, joined, play

DEVICE = "virtual student"


def practise_virtually(plan: Plan, spec: StudentSpec, capture: Path | None = None) -> VirtualSession:
    """Let a virtual student practise `plan`; the bytes go to `capture` too.

    Raises `BadInput` where the lesson asks for a piece that General MIDI has no number for, `DeviceError` where the
    capture cannot be begun.
    """
    runner, student = SessionRunner(plan, Latency()), play(plan.score, spec)
    fault = _practise(runner, lambda _: student, capture)
    return VirtualSession(runner.finish(), student, fault)


def practise_adaptively(adaptation: Adaptation, spec: StudentSpec, capture: Path | None = None) -> VirtualSession:
    """Let a virtual student practise, pass by pass, what `adaptation` asks for; raises as `practise_virtually` does."""
    runner, student, parts = SessionRunner(adaptation, Latency()), VirtualStudent(spec), list[VirtualPerformance]()

    def perform(plan: Plan) -> VirtualPerformance:
        parts.append(student.play(plan.score))
        return parts[-1]

    fault = _practise(runner, perform, capture)
    row = adaptation.row()
    performance = row.performance(part.performance for part in parts)
    return VirtualSession(runner.finish(), joined(parts, row.score, performance), fault)


def _practise(
    runner: SessionRunner, perform: Callable[[Plan], VirtualPerformance], capture: Path | None
) -> StationError | None:
    """Play every pass of `runner` as the student would `perform` it; returns why the capture lacks some, if it does."""
    engine, session = _PassPlayer([DEVICE]), None
    begin(engine, runner, capture)
    engine.step(runner, 0)
    if runner.heard.capture_fault is not None:
        raise DeviceError(runner.heard.capture_fault)
    while not runner.over and runner.session is not session:  # one without a click may wait for more than is played
        session = runner.session
        engine.play(runner, perform(session.plan))
    return end(engine, runner)


class _PassPlayer(EngineHere):
    """An engine on which passes are played."""

    def play(self, runner: SessionRunner, student: VirtualPerformance) -> None:
        """Play a pass that has just been started, and let it end."""
        session, zero_ns = runner.session, self.now_ns + LEAD_IN_NS
        plan = session.plan
        self.step(runner, zero_ns)
        played_until_ns = plan.passes_start_ns
        for at_ns, data in student.midi:
            if runner.session is not session:  # the pass ended while they were still playing
                return
            played_until_ns = max(plan.passes_start_ns + at_ns, played_until_ns)
            now_ns = zero_ns + plan.passes_start_ns + at_ns
            self.feed(DEVICE, data, now_ns)
            self.step(runner, now_ns)
        if runner.session is session:
            self.step(runner, zero_ns + max(plan.end_ns, played_until_ns) + TAIL_NS)

    def step(self, runner: SessionRunner, now_ns: int) -> None:
        """Let the runner hear and do what comes until then."""
        self.advance_to(now_ns)
        for command in runner.update(self.now_ns, self.events()).commands:
            self.send(command)
