"""A session with a virtual student: the same engine, decoder and session, on a clock that is moved by hand."""

from dataclasses import dataclass
from pathlib import Path

from station.core.clock import ManualClock
from station.core.errors import DeviceError, StationError
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.engine.engine import Engine
from station.engine.messages import Command, RecordCapture
from station.practice.session.adaptation import Adaptation
from station.practice.session.plan import TAIL_NS, Plan
from station.practice.session.session import LEAD_IN_NS, Session, SessionResult
from station.simulation.student_spec import StudentSpec
from station.simulation.virtual_student import VirtualPerformance, VirtualStudent, joined, play

DEVICE = "virtual student"


@dataclass(frozen=True, eq=False)
class VirtualSession:
    """What the session made of it, what the student knows it did, and why the capture lacks some of it, if it does."""

    result: SessionResult
    student: VirtualPerformance
    fault: StationError | None


def practise_virtually(plan: Plan, spec: StudentSpec, capture: Path | None = None) -> VirtualSession:
    """Let a virtual student practise `plan`; the bytes go to `capture` too.

    Raises `BadInput` where the lesson asks for a piece that General MIDI has no number for, `DeviceError` where the
    capture cannot be begun.
    """
    student, room = play(plan.score, spec), _Room()
    result = room.practise(plan, student, capture)
    return VirtualSession(result, student, room.end())


def practise_adaptively(adaptation: Adaptation, spec: StudentSpec, capture: Path | None = None) -> VirtualSession:
    """Let a virtual student practise, pass by pass, what `adaptation` asks for; raises as `practise_virtually` does."""
    student, room, parts = VirtualStudent(spec), _Room(), list[VirtualPerformance]()
    while not adaptation.over:
        plan = adaptation.plan
        parts.append(student.play(plan.score))
        adaptation.take(room.practise(plan, parts[-1], capture if len(parts) == 1 else None))
    row = adaptation.row()
    performance = row.performance(part.performance for part in parts)
    return VirtualSession(adaptation.result(), joined(parts, row.score, performance), room.end())


class _Room:
    """One engine on one clock, for one plan after the other."""

    def __init__(self) -> None:
        self._engine, self._clock = Engine(), ManualClock()
        self._session: Session | None = None
        self._step(0)
        self._engine.use_preset(DEVICE, GENERAL_MIDI_PRESET)
        self._engine.device_found(DEVICE, self._clock.now_ns())

    def practise(self, plan: Plan, student: VirtualPerformance, capture: Path | None) -> SessionResult:
        """What the session makes of `plan` as the student played it; the capture begins before it."""
        session, before = Session(plan), self._session
        if before is not None:
            session.heard.go_on_from(before.heard)
        self._session = session
        commands: tuple[Command, ...] = session.start()
        for command in commands if capture is None else (RecordCapture(capture), *commands):
            self._engine.handle(command)
        zero_ns = self._clock.now_ns() + LEAD_IN_NS
        self._step(zero_ns)
        if session.heard.capture_fault is not None:
            raise DeviceError(session.heard.capture_fault)
        for at_ns, data in student.midi:
            now_ns = zero_ns + plan.passes_start_ns + at_ns
            self._engine.feed(DEVICE, data, now_ns)
            self._step(now_ns)
        played_until_ns = plan.passes_start_ns + max((at_ns for at_ns, _ in student.midi), default=0)
        self._step(zero_ns + max(plan.end_ns, played_until_ns) + TAIL_NS)
        return session.result()

    def end(self) -> StationError | None:
        """Close the capture; returns why it lacks some of what was played, if it does."""
        assert self._session is not None, "something was practised"
        for command in (*self._session.stop(), RecordCapture(None)):
            self._engine.handle(command)
        self._step(self._clock.now_ns())
        fault = self._session.heard.capture_fault
        return None if fault is None else DeviceError(fault)

    def _step(self, now_ns: int) -> None:
        self._clock.advance_to(max(now_ns, self._clock.now_ns()))
        for event in self._engine.advance(self._clock.now_ns()):
            if self._session is not None:
                self._session.handle(event)
        if self._session is not None:
            self._session.advance(self._clock.now_ns())
