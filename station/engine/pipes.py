"""Commands in and events out of the engine's process, each in a thread of its own.

So neither a busy app nor a full pipe holds up a stroke.
"""

import threading
from collections import deque
from contextlib import suppress
from dataclasses import replace
from multiprocessing.connection import Connection
from queue import SimpleQueue

from station.core.errors import DeviceError
from station.core.join_timeout import ends_within
from station.engine.messages import Command, EngineEvent, SetBacking
from station.sound.track import load

CLOSE_WITHIN_S = 1.5
"""How long the last events may take to be sent (our choice: half of what the parent waits)."""


class Outbox:
    """Carries events to the parent in a thread of its own, for a pipe can be full."""

    def __init__(self, events: "Connection[list[EngineEvent], None]") -> None:
        self._events = events
        self._queue: SimpleQueue[list[EngineEvent] | None] = SimpleQueue()
        self._thread = threading.Thread(target=self._run, name="events", daemon=True)
        self._thread.start()

    def put(self, events: list[EngineEvent]) -> None:
        """Send `events` soon."""
        self._queue.put(events)

    def close(self) -> None:
        """Wait until everything is sent, or the parent is gone; it learns at once that nothing more will come."""
        self._queue.put(None)
        if ends_within(self._thread, CLOSE_WITHIN_S):
            self._events.close()

    def _run(self) -> None:
        with suppress(OSError):
            while (events := self._queue.get()) is not None:
                self._events.send(events)


class Inbox:
    """Receives commands in a thread of its own; closed once the parent is gone, or nothing more can be received."""

    def __init__(self, commands: "Connection[None, Command]") -> None:
        self._commands = commands
        self._received: deque[Command] = deque()
        self.is_closed = False
        threading.Thread(target=self._run, name="commands", daemon=True).start()

    def pop_all(self) -> list[Command]:
        """The commands since the last call."""
        commands = []
        while self._received:
            commands.append(self._received.popleft())
        return commands

    def _run(self) -> None:
        try:
            while True:
                self._received.append(with_track(self._commands.recv()))
        except (EOFError, OSError):  # the parent is gone
            pass
        finally:  # an engine that hears no command any more shall not play on
            self.is_closed = True


def with_track(command: Command) -> Command:
    """The command, with a track's file read here, where nobody waits; a fault is left for the engine to find."""
    if isinstance(command, SetBacking) and command.track is not None:
        with suppress(DeviceError):
            return replace(command, loaded=load(command.track))
    return command
