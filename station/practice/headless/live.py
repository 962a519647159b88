"""A session in real time without a window: the engine process plays and hears, a runner moves it on, a text shows it.

The capture is written by the engine as the bytes come, so that nothing that follows can lose a hit.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from station.core.clock import Clock
from station.core.errors import DeviceError, StationError
from station.core.units import ns_from_s
from station.engine.messages import CaptureSaved, Command, EngineEvent, Ready, RecordCapture
from station.music.judgement import Judgement
from station.practice.headless.end_signals import EndAsked
from station.practice.headless.guarded_output import GuardedOutput
from station.practice.session.engine_state import EngineState
from station.practice.session.runner import SessionRunner
from station.practice.session.session import Session, SessionResult
from station.sync.drill.drill_model import DrillModel

POLL_S = 0.02
"""How long to wait for an event before handing the session the time; our choice, no verdict depends on it."""

LAST_WORDS_S = 2.0
"""How long to wait for the engine to say that the capture is closed; our choice."""

Show = Callable[[Session, tuple[Judgement, ...]], None]


class EngineLink(Protocol):
    """What a live session needs of the engine."""

    def send(self, command: Command) -> None:
        """Hand the engine a command."""
        ...

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        """What has happened since the last call."""
        ...


class Listener(Protocol):
    """What is recorded: a session, or a free take."""

    @property
    def heard(self) -> EngineState:
        """What the engine has said."""
        ...

    def start(self) -> tuple[Command, ...]:
        """The commands that set the engine going."""
        ...

    def stop(self) -> tuple[Command, ...]:
        """The commands that end it."""
        ...

    def handle(self, event: EngineEvent) -> object:
        """Take one event of the engine."""
        ...


@dataclass(frozen=True, eq=False)
class LiveOutcome:
    """A live session's result and, where something went wrong that the user must know, the `fault`.

    `is_attended` whether the student may still be there, to be asked something.
    """

    result: SessionResult
    fault: StationError | None
    is_attended: bool = True


@dataclass(frozen=True, slots=True)
class LiveSetup:
    """Where a session is played: its `engine` and `clock`, who hears every round of judgements, who may end it.

    A `show` that fails costs no session: `telling` remembers it. Where a kit hangs `in_air`, sticks with sensors are
    enough.
    """

    engine: EngineLink
    clock: Clock
    show: Show
    telling: GuardedOutput = field(default_factory=GuardedOutput)
    asked: EndAsked = field(default_factory=EndAsked)
    in_air: bool = False

    def is_played(self, heard: EngineState) -> bool:
        """Whether there is something to play on."""
        return bool(heard.devices) or (self.in_air and bool(heard.sensors))

    def step(self, runner: SessionRunner) -> None:
        """Take in what the engine has heard, move on to the present, show it and do what it asks for."""
        events = self.engine.events(POLL_S)
        update = runner.update(self.clock.now_ns(), events)
        self.telling.attempt(self.show, update.session, update.judged)
        for command in update.commands:
            self.engine.send(command)

    def fault(self, heard: EngineState) -> StationError | None:
        """What the user must know at the end that nobody has raised."""
        if not self.is_played(heard):
            return DeviceError("the kit was unplugged and did not come back; what was played until then is kept")
        return self.telling.fault("not all could be shown while you played, the session is kept")


def practise_live(
    setup: LiveSetup, runner: SessionRunner, capture: Path, drill: DrillModel | None = None
) -> LiveOutcome:
    """Play what `runner` has to play until it is over, the end is `asked` for, or the engine dies.

    The sticks are tracked through the `drill`, the model of its section, where there is one.

    Raises `DeviceError` if the engine dies before the transport runs: then there is nothing to report.
    """
    try:
        section = runner.session.plan.section
        begin(setup.engine, runner, capture)
        for command in () if drill is None else runner.track(section, drill):
            setup.engine.send(command)
        while not runner.over and not setup.asked:
            setup.step(runner)
    except DeviceError as error:
        if not runner.started:
            raise
        fault: StationError | None = error
    else:
        fault = end(setup.engine, runner)
    return LiveOutcome(runner.finish(), fault or setup.fault(runner.heard), setup.asked.is_attended)


def begin(engine: EngineLink, listener: Listener, capture: Path | None) -> None:
    """Have everything recorded, if it is to be captured, and start the transport; raises `DeviceError`."""
    if capture is not None:
        engine.send(RecordCapture(capture))
    for command in listener.start():
        engine.send(command)


def end(engine: EngineLink, listener: Listener) -> StationError | None:
    """Stop, close the capture and take in every hit that was still on its way; returns why the capture lacks some.

    An engine that is dead, or dies meanwhile, is such a reason: what it said until then was taken in.
    """
    try:
        for command in (*listener.stop(), RecordCapture(None)):
            engine.send(command)
        _hear_out(engine, listener)
    except DeviceError as dead:
        return dead
    return None if listener.heard.capture_fault is None else DeviceError(listener.heard.capture_fault)


def _hear_out(engine: EngineLink, listener: Listener) -> None:
    for _ in range(round(LAST_WORDS_S / POLL_S)):
        events = engine.events(POLL_S)
        for event in events:
            listener.handle(event)
        if any(isinstance(event, CaptureSaved) and event.path is None for event in events):
            break


def wait_for_kits(
    engine: EngineLink, listener: Listener, clock: Clock, wait_s: float, kits: int = 1, sensors: int = 0
) -> None:
    """Let the engine wake and find so many `kits` and `sensors`, for at most `wait_s` after it is ready.

    `listener` hears of it.
    """

    def lacks() -> bool:
        return len(listener.heard.devices) < kits or len(listener.heard.sensors) < sensors

    until_ns: int | None = None
    while lacks() and (until_ns is None or clock.now_ns() < until_ns):
        for event in engine.events(POLL_S):
            listener.handle(event)
            if isinstance(event, Ready):
                until_ns = clock.now_ns() + ns_from_s(wait_s)
