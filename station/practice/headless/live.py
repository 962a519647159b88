"""A session in real time without a window: the engine process plays and hears, this loop judges and tells.

The capture is written by the engine as the bytes come, so that nothing that follows can lose a hit.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from station.core.clock import Clock
from station.core.errors import DeviceError, StationError
from station.core.units import ns_from_s
from station.engine.messages import CaptureSaved, Command, EngineEvent, Ready, RecordCapture
from station.music.judgement import Judgement
from station.practice.control.pad_pause import PadPause
from station.practice.headless.end_signals import EndAsked
from station.practice.headless.telling import Telling
from station.practice.session.adaptation import Adaptation
from station.practice.session.engine_state import EngineState
from station.practice.session.session import Session, SessionResult

POLL_S = 0.02
"""How long to wait for an event before telling the session the time; our choice, no verdict depends on it."""

LAST_WORDS_S = 2.0
"""How long to wait for the engine to say that the capture is closed; our choice."""

Tell = Callable[[Session, tuple[Judgement, ...]], None]


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

    heard: EngineState

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
class Room:
    """Where a session is played: its `engine` and `clock`, who hears every round of judgements, what the pads ask.

    A `tell` that fails costs no session: `telling` remembers it.
    """

    engine: EngineLink
    clock: Clock
    tell: Tell
    pads: PadPause | None = None
    telling: Telling = field(default_factory=Telling)
    asked: EndAsked = field(default_factory=EndAsked)

    def begin(self, session: Session, capture: Path) -> None:
        """Have everything recorded, and start the transport."""
        session.waits = self.pads is not None and self.pads.waits
        begin(self.engine, session, capture)

    def step(self, session: Session) -> None:
        """Take in what the engine has heard, move on to the present, and obey the pads."""
        judged: tuple[Judgement, ...] = ()
        for event in self.engine.events(POLL_S):
            judged += session.handle(event)
            self._obey(() if self.pads is None else self.pads.take(session, event))
        judged += session.advance(self.clock.now_ns())
        self._obey(() if self.pads is None else self.pads.look(session))
        self.telling.attempt(self.tell, session, judged)

    def fault(self, session: Session) -> StationError | None:
        """What the user must know at the end of `session` that nobody has raised."""
        if not session.heard.devices:
            return DeviceError("the kit was unplugged and did not come back; what was played until then is kept")
        return self.telling.fault("not all could be shown while you played, the session is kept")

    def _obey(self, commands: Sequence[Command]) -> None:
        for command in commands:
            self.engine.send(command)


def practise_live(room: Room, session: Session, capture: Path) -> LiveOutcome:
    """Run `session` to its end, or until the end is `asked` for or the engine dies.

    Raises `DeviceError` if the engine dies before the transport runs: then there is nothing to report.
    """
    fault: StationError | None = None
    try:
        room.begin(session, capture)
        while not session.over and not room.asked:
            room.step(session)
        fault = end(room.engine, session)
    except DeviceError as error:
        if not session.started:
            raise
        fault = error
    return LiveOutcome(session.result(), fault or room.fault(session), room.asked.is_attended)


def practise_rounds(room: Room, adaptation: Adaptation, first: Session, capture: Path) -> LiveOutcome:
    """Run pass after pass of `adaptation`, the session `first` to begin with, until it is over, or the end is `asked`.

    The capture goes on from pass to pass. Raises `DeviceError` if the engine dies before the transport runs.
    """
    session, fault, taken = first, None, False
    try:
        room.begin(session, capture)
        while not room.asked:
            room.step(session)
            if not session.over:
                continue
            adaptation.take(session.result())
            taken = True
            if adaptation.over:
                break
            session, taken = next_session(room.engine, adaptation, session), False
        fault = end(room.engine, session)
    except DeviceError as error:
        if not session.started and not adaptation.rounds:
            raise
        fault = error
    if not taken:
        adaptation.take(session.result())
    return LiveOutcome(adaptation.result(), fault or room.fault(session), room.asked.is_attended)


def next_session(engine: EngineLink, adaptation: Adaptation, before: Session) -> Session:
    """Start the pass that `adaptation` asks for, on what the session `before` knows of the kit."""
    session = adaptation.session(before.latency)
    session.heard.go_on_from(before.heard)
    session.waits = before.waits
    for command in session.start():
        engine.send(command)
    return session


def begin(engine: EngineLink, session: Listener, capture: Path) -> None:
    """Have everything recorded, and start the transport."""
    engine.send(RecordCapture(capture))
    for command in session.start():
        engine.send(command)


def end(engine: EngineLink, session: Listener) -> StationError | None:
    """Stop, close the capture and take in every hit that was still on its way; returns why the capture lacks some."""
    for command in (*session.stop(), RecordCapture(None)):
        engine.send(command)
    for _ in range(round(LAST_WORDS_S / POLL_S)):
        events = engine.events(POLL_S)
        for event in events:
            session.handle(event)
        if any(isinstance(event, CaptureSaved) and event.path is None for event in events):
            break
    return None if session.heard.capture_fault is None else DeviceError(session.heard.capture_fault)


def wait_for_kits(engine: EngineLink, session: Session, clock: Clock, wait_s: float, kits: int = 1) -> None:
    """Let the engine wake and find so many `kits`, for at most `wait_s` after it is ready; `session` hears of it."""
    until_ns: int | None = None
    while len(session.heard.devices) < kits and (until_ns is None or clock.now_ns() < until_ns):
        for event in engine.events(POLL_S):
            session.handle(event)
            if isinstance(event, Ready):
                until_ns = clock.now_ns() + ns_from_s(wait_s)
