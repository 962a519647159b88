"""A session in real time without a window: the engine process plays and hears, this loop judges and tells.

The capture is written by the engine as the bytes come, so that nothing that follows can lose a hit.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from station.core.clock import Clock
from station.core.errors import DeviceError
from station.core.units import ns_from_s
from station.engine.messages import Command, EngineEvent, Ready, Record, Stop
from station.music.judgement import Judgement
from station.practice.session import Session, SessionResult

POLL_S = 0.02
"""How long to wait for an event before telling the session the time; our choice, no verdict depends on it."""

Tell = Callable[[Session, tuple[Judgement, ...]], None]


class EngineLink(Protocol):
    """What a live session needs of the engine."""

    def send(self, command: Command) -> None:
        """Hand the engine a command."""
        ...

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        """What has happened since the last call."""
        ...


def practise_live(engine: EngineLink, session: Session, clock: Clock, capture: Path, tell: Tell) -> SessionResult:
    """Run `session` to its end, or until Ctrl-C or the engine's death; `tell` hears every round of judgements.

    Raises `DeviceError` if the engine dies before the transport runs: then there is nothing to report.
    """
    try:
        engine.send(Record(capture))
        for command in session.start():
            engine.send(command)
        while not session.over:
            judged: tuple[Judgement, ...] = ()
            for event in engine.events(POLL_S):
                judged += session.handle(event)
            judged += session.advance(clock.now_ns())
            tell(session, judged)
        engine.send(Record(None))
    except KeyboardInterrupt:
        engine.send(Stop())
        engine.send(Record(None))
    except DeviceError as fault:
        if not session.started:
            raise
        session.notices.append(str(fault))
        tell(session, ())
    return session.result()


def wait_for_kit(engine: EngineLink, session: Session, clock: Clock, wait_s: float, tell: Tell) -> None:
    """Let the engine wake and find a kit, for at most `wait_s` after it is ready."""
    until_ns: int | None = None
    while session.device is None and (until_ns is None or clock.now_ns() < until_ns):
        for event in engine.events(POLL_S):
            session.handle(event)
            if isinstance(event, Ready):
                until_ns = clock.now_ns() + ns_from_s(wait_s)
        tell(session, ())
