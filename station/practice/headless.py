"""A session with a virtual student: the same engine, decoder and session, on a clock that is moved by hand."""

from dataclasses import dataclass
from pathlib import Path

from station.core.clock import ManualClock
from station.core.errors import DeviceError, StationError
from station.devices.presets import GENERAL_MIDI_PRESET
from station.engine.engine import Engine
from station.engine.messages import Command, Record
from station.practice.plan import TAIL_NS, Plan
from station.practice.session import LEAD_IN_NS, Session, SessionResult
from station.practice.student_spec import StudentSpec
from station.practice.virtual_student import VirtualPerformance, play

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
    student = play(plan.score, spec)
    session, engine, clock = Session(plan), Engine(), ManualClock()

    def step(now_ns: int) -> None:
        clock.advance_to(max(now_ns, clock.now_ns()))
        for event in engine.advance(clock.now_ns()):
            session.handle(event)
        session.advance(clock.now_ns())

    step(0)
    engine.use_preset(DEVICE, GENERAL_MIDI_PRESET)
    engine.device_found(DEVICE, clock.now_ns())
    commands: tuple[Command, ...] = session.start()
    if capture is not None:
        commands = (Record(capture), *commands)
    for command in commands:
        engine.handle(command)
    step(LEAD_IN_NS)
    if session.capture_fault is not None:
        raise DeviceError(session.capture_fault)
    zero_ns = LEAD_IN_NS
    for at_ns, data in student.midi:
        now_ns = zero_ns + plan.passes_start_ns + at_ns
        engine.feed(DEVICE, data, now_ns)
        step(now_ns)
    step(zero_ns + plan.end_ns + TAIL_NS)
    engine.handle(Record(None))
    step(clock.now_ns())
    fault = None if session.capture_fault is None else DeviceError(session.capture_fault)
    return VirtualSession(session.result(), student, fault)
